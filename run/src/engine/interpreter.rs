//! A generating function run by the interpreter.

use std::marker::PhantomData;

use coadjoint::generating::{MatrixOf, ScalarOf, VectorOf, hessian_by_differences};
use coadjoint::plumbing;
use coadjoint::solve::Solver;
use coadjoint::{Chart, Coordinates, GeneratingFunction, LieGroup, Scalar, StepError};
use coadjoint_codegen::cancel;
use coadjoint_codegen::graph::{self, Arithmetic, Id, Program};
use coadjoint_codegen::integrator::{Integrator, Predictor};
use coadjoint_codegen::problem;

/// The results of a program.
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
) -> impl Iterator<Item = (f64, usize, &'a [(u32, u32)])> + Clone {
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
    /// The coefficients of the last two terms of the series, the direct factor of each coordinate, and the |μ| of each up
    /// to which their ratio is at most ½ in every direction.
    pub(super) last: Vec<f64>,
    pub(super) factors: Vec<u32>,
    pub(super) radius: f64,
    pub(super) chart: PhantomData<C>,
}

impl<'a, G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> Interpreter<'a, G, C> {
    /// Folds the coefficients for the step size.
    pub fn new(integrator: &'a Integrator, group: G, step: f64) -> Result<Self, StepError> {
        let parts = fold_parts(integrator, step)?;
        let coefficients = &integrator.coefficients;
        let truncation = integrator.problem.truncation;
        let last: Vec<f64> =
            coefficients.last_orders(truncation).map(|(number, ..)| parts[number]).collect();
        let factors = integrator.problem.algebra.factor_of_coordinates();
        let radius = plumbing::radius_of(truncation, &factors, of_last(integrator, &last));
        let slots = coefficients.slots_of_parts(&parts);
        Ok(Self { integrator, group, slots, last, factors, radius, chart: PhantomData })
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

    fn largest_rate(&self) -> f64 {
        self.integrator.largest_rate().unwrap_or(f64::MAX)
    }

    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let terms = of_last(self.integrator, &self.last);
        let terms = terms.map(|(value, order, monomial)| (Scalar::of(value), order, monomial));
        let mut sums = vec![[Scalar::of(0.0); 2]; self.factors.len()];
        let truncation = self.integrator.problem.truncation;
        plumbing::ratio_of(truncation, &self.factors, terms, &mut sums, |i| p[i])
    }
}

impl<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>> coadjoint::Integrator for Interpreter<'_, G, C> {
    fn solver(&self) -> Solver {
        match self.integrator.plan.solver {
            problem::Solver::Newton => Solver::Newton,
            problem::Solver::FixedPoint => Solver::FixedPoint,
        }
    }

    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        cancel::check();
        let guess = self.vector(&self.integrator.predictor, mu);
        match self.integrator.plan.predictor {
            Predictor::Explicit(_) => guess,
            Predictor::Flow(_) => C::default().pull_back(&self.group, &guess, mu),
        }
    }
}
