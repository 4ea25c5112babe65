//! A generating function run by the interpreter.

use std::marker::PhantomData;

use coadjoint::generating::{MatrixOf, ScalarOf, VectorOf, hessian_by_differences};
use coadjoint::plumbing;
use coadjoint::solve::{
    CandidateOf, FixedPoint, LaggedModel, LaggedNewton, Method, Newton, NewtonModel, Predict,
    Settings,
};
use coadjoint::{Chart, Coordinates, GeneratingFunction, LieGroup, Scalar, StepError};
use coadjoint_codegen::cancel;
use coadjoint_codegen::graph::{self, Arithmetic, Id, Program};
use coadjoint_codegen::integrator::{Integrator, Predictor};
use coadjoint_codegen::problem::Solver;

/// What a program computed.
struct Outputs<'s, T> {
    nodes: &'s [T],
    ids: &'s [Id],
}

impl<T: Copy> Outputs<'_, T> {
    #[inline(always)]
    fn get(&self, i: usize) -> T {
        self.nodes[self.ids[i].index()]
    }
}

/// The parts of an integrator's coefficients for the step size.
fn fold_parts(integrator: &Integrator, step: f64) -> Result<Vec<f64>, StepError> {
    if step == 0.0 || !step.is_finite() {
        return Err(StepError::InvalidStep { step });
    }
    // Parameters are substituted; what symbols are left (sqrt(2)) need none.
    let symbols: Vec<f64> =
        integrator.problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect();
    Ok(integrator.coefficients.fold_parts(step, &symbols))
}

/// The terms of S_K and S_{K−2} with these coefficients, as (coefficient, order, monomial).
pub(super) fn of_last<'a>(
    integrator: &'a Integrator,
    last: &'a [f64],
) -> impl Iterator<Item = (f64, usize, &'a [(u32, u32)])> {
    let coefficients = &integrator.coefficients;
    coefficients
        .last_orders(integrator.problem.truncation)
        .zip(last)
        .map(|((_, order, base), &value)| (value, order, coefficients.monomials()[base].as_slice()))
}

/// The truncated series of an integrator for one step size, on any group with its algebra; solved as its plan says.
#[derive(Clone, Debug)]
pub struct Interpreter<'a, G, C> {
    pub(super) integrator: &'a Integrator,
    pub(super) group: G,
    /// The folded coefficients C_m(h).
    pub(super) slots: Vec<f64>,
    /// The bound on what the Newton program leaves out of the Hessian, by degree.
    pub(super) defect: Vec<f64>,
    /// Whether H_red is of degree two or less.
    pub(super) quadratic: bool,
    /// The coefficients of the last two terms of the series, and the |μ| up to which their ratio is at most ½ in
    /// every direction.
    pub(super) last: Vec<f64>,
    pub(super) radius: f64,
    pub(super) chart: PhantomData<C>,
}

impl<'a, G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> Interpreter<'a, G, C> {
    /// Folds the coefficients for the step size.
    pub fn new(integrator: &'a Integrator, group: G, step: f64) -> Result<Self, StepError> {
        let parts = fold_parts(integrator, step)?;
        let coefficients = &integrator.coefficients;
        let truncation = integrator.problem.truncation;
        let orders = coefficients.last_orders(truncation);
        let last: Vec<f64> = orders.map(|(number, ..)| parts[number]).collect();
        let radius = plumbing::radius_of(truncation, of_last(integrator, &last));
        let slots = coefficients.slots_of_parts(&parts);
        let mut defect = vec![0.0; integrator.defect_len()];
        for term in &integrator.defect {
            defect[term.degree as usize] += slots[term.slot].abs() * term.weight;
        }
        let quadratic = integrator.problem.is_quadratic();
        Ok(Self { integrator, group, slots, defect, quadratic, last, radius, chart: PhantomData })
    }

    /// Evaluates a program and hands its outputs to `read`.
    #[inline(always)]
    fn run<R>(
        &self,
        program: &Program,
        input: impl Fn(usize) -> G::Scalar,
        read: impl FnOnce(Outputs<'_, G::Scalar>) -> R,
    ) -> R {
        let mut scratch = Vec::new();
        graph::evaluate(program, input, |i| G::Scalar::of(self.slots[i]), &mut scratch);
        read(Outputs { nodes: &scratch, ids: program.outputs() })
    }

    fn scalar(&self, program: &Program, p: &G::Vector) -> G::Scalar {
        self.run(program, |i| p[i], |output| output.get(0))
    }

    #[inline(always)]
    fn vector(&self, program: &Program, p: &G::Vector) -> G::Vector {
        self.run(program, |i| p[i], |output| G::Vector::from_entries(p.dim(), |i| output.get(i)))
    }

    /// A program of a point and a direction.
    #[inline(always)]
    fn product(&self, program: &Program, p: &G::Vector, direction: &G::Vector) -> G::Vector {
        let n = p.dim();
        let both = |i: usize| if i < n { p[i] } else { direction[i - n] };
        self.run(program, both, |output| G::Vector::from_entries(n, |i| output.get(i)))
    }

    #[inline(always)]
    fn gradient_and_matrix(
        &self,
        program: &Program,
        p: &G::Vector,
    ) -> (G::Vector, <G::Vector as Coordinates<G::Scalar>>::Matrix) {
        let n = p.dim();
        self.run(
            program,
            |i| p[i],
            |output| {
                let mut matrix = G::Vector::zero_matrix(n);
                // The upper triangle, row by row.
                let places = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
                for (number, (i, j)) in places.enumerate() {
                    let value = output.get(n + number);
                    matrix[(i, j)] = value;
                    matrix[(j, i)] = value;
                }
                (G::Vector::from_entries(n, |i| output.get(i)), matrix)
            },
        )
    }
}

impl<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> GeneratingFunction for Interpreter<'_, G, C> {
    type Group = G;
    type Chart = C;

    fn group(&self) -> &G {
        &self.group
    }

    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        self.scalar(&self.integrator.value, p)
    }

    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        self.vector(&self.integrator.gradient, p)
    }

    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        match &self.integrator.hessian {
            Some(program) => self.gradient_and_matrix(program, p),
            None => (self.gradient(p), hessian_by_differences(self, p)),
        }
    }

    #[inline(always)]
    fn frame(&self, motion: usize, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        self.integrator.frame.get(motion).map(|program| self.vector(program, mu))
    }

    fn radius(&self) -> ScalarOf<Self> {
        Scalar::of(self.radius)
    }

    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let terms = of_last(self.integrator, &self.last);
        let terms = terms.map(|(value, order, monomial)| (Scalar::of(value), order, monomial));
        plumbing::ratio_of(self.integrator.problem.truncation, terms, |i| p[i])
    }
}

impl<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> Predict for Interpreter<'_, G, C> {
    fn predict_increment(&self, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        let flows = matches!(self.integrator.plan.predictor, Predictor::Flow(_));
        flows.then(|| self.vector(&self.integrator.predictor, mu))
    }

    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        match self.predict_increment(mu) {
            Some(x) => C::default().pull_back(&self.group, &x, mu),
            None => self.vector(&self.integrator.predictor, mu),
        }
    }
}

impl<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> NewtonModel for Interpreter<'_, G, C> {
    fn newton_model(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        match &self.integrator.hessian {
            Some(_) => self.gradient_and_matrix(self.integrator.iteration(), p),
            None => self.gradient_and_hessian(p),
        }
    }

    fn bend(&self, x: ScalarOf<Self>) -> ScalarOf<Self> {
        // As generated code has it: a quarter of |x|² is ample for quadratic Hamiltonians.
        if self.quadratic { x * x * Scalar::of(0.25) } else { Scalar::of(1.0) }
    }

    fn hessian_defect(&self, size: ScalarOf<Self>) -> ScalarOf<Self> {
        let mut sum = ScalarOf::<Self>::of(0.0);
        for &coefficient in self.defect.iter().rev() {
            sum = sum.times_plus(size, Scalar::of(coefficient));
        }
        sum
    }
}

impl<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> LaggedModel for Interpreter<'_, G, C> {
    fn coarse_gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        let coarse = self.integrator.parts.as_ref().map(|parts| &parts.coarse);
        self.vector(coarse.unwrap_or(&self.integrator.gradient), p)
    }

    fn fine_gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        match &self.integrator.parts {
            Some(parts) => self.vector(&parts.fine, p),
            None => VectorOf::<Self>::zeros(p.dim()),
        }
    }

    fn leading_product(&self, p: &VectorOf<Self>, direction: &VectorOf<Self>) -> VectorOf<Self> {
        match &self.integrator.parts {
            Some(parts) => self.product(&parts.leading, p, direction),
            None => direction.left_multiply(&self.newton_model(p).1),
        }
    }
}

/// The method that the plan of an integrator names.
#[derive(Clone, Debug)]
pub enum Planned<S: LaggedModel> {
    /// Newton's method with matrices.
    Newton(Newton<S>),
    /// The quasi-Newton method with a lagged gradient.
    Lagged(LaggedNewton),
    /// The fixed point.
    FixedPoint,
}

impl<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> coadjoint::Integrator for Interpreter<'_, G, C> {
    type Method = Planned<Self>;
}

// Not inlined: each is compiled once for a group and chart, wherever steps are made.
impl<'a, G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> Method<Interpreter<'a, G, C>>
    for Planned<Interpreter<'a, G, C>>
{
    fn begin(generating: &Interpreter<'a, G, C>) -> Self {
        let integrator = generating.integrator;
        match (integrator.plan.solver, &integrator.parts) {
            (Solver::FixedPoint, _) => Self::FixedPoint,
            (Solver::Newton, None) => Self::Newton(Newton::begin(generating)),
            (Solver::Newton, Some(_)) => Self::Lagged(LaggedNewton),
        }
    }

    #[inline(never)]
    fn propose(
        &mut self,
        generating: &Interpreter<'a, G, C>,
        mu: &G::Vector,
        left: u64,
        settings: Settings<G::Scalar>,
    ) -> CandidateOf<Interpreter<'a, G, C>> {
        cancel::check();
        match self {
            Self::Newton(method) => method.propose(generating, mu, left, settings),
            Self::Lagged(method) => method.propose(generating, mu, left, settings),
            Self::FixedPoint => FixedPoint.propose(generating, mu, left, settings),
        }
    }

    fn forget(&mut self) {
        match self {
            Self::Newton(method) => method.forget(),
            // Nothing is carried from step to step by these.
            Self::Lagged(_) | Self::FixedPoint => {}
        }
    }

    fn propose_from(
        generating: &Interpreter<'a, G, C>,
        mu: &G::Vector,
        guess: G::Vector,
        settings: Settings<G::Scalar>,
    ) -> CandidateOf<Interpreter<'a, G, C>> {
        // The solution is the same whatever the method; this one is compiled already.
        let one = Scalar::of(1.0);
        Self::propose_scaled(generating, mu, one, guess, settings)
    }

    #[inline(never)]
    fn propose_scaled(
        generating: &Interpreter<'a, G, C>,
        mu: &G::Vector,
        scale: G::Scalar,
        guess: G::Vector,
        settings: Settings<G::Scalar>,
    ) -> CandidateOf<Interpreter<'a, G, C>> {
        match generating.integrator.plan.solver {
            Solver::Newton => Newton::propose_scaled(generating, mu, scale, guess, settings),
            Solver::FixedPoint => {
                FixedPoint::propose_scaled(generating, mu, scale, guess, settings)
            }
        }
    }
}
