//! Flows by a series, without programs: its generating function run by the interpreter.

use std::marker::PhantomData;
use std::sync::{Arc, OnceLock};

use coadjoint::generating::hessian_by_differences;
use coadjoint::groups::Chart;
use coadjoint::plumbing;
use coadjoint::solve::Solver;
use coadjoint::steps::advance;
use coadjoint::{GeneratingFunction, StepError};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::{FoldTable, Integrator, Predictor};
use coadjoint_codegen::problem;
use coadjoint_codegen::step::{Convergence, Converging};
use coadjoint_codegen::{cancel, in_other_frame};
use coadjoint_program::WIDTH;
use nalgebra::{DMatrix, DVector};

use super::compiled::{Compiled, STEEP, Solved, refusal};
use super::method::{Flow, Propagator};
use super::space::{Group, Tables, moved_in};

/// The series of a polynomial, on a group with its chart.
pub(super) struct Series<'a, G, C> {
    integrator: &'a Integrator,
    group: Arc<G>,
    chart: PhantomData<C>,
    /// The programs of ratios, once one was asked for, where there are no other programs.
    convergence: OnceLock<Convergence>,
    /// Their coefficients for the longest flow of a step.
    converging: OnceLock<Option<Converging>>,
    /// This system in the comoving frame, once advice was asked for.
    comoving: OnceLock<Option<Integrator>>,
}

impl<'a, G, C> Series<'a, G, C> {
    pub(super) fn new(integrator: &'a Integrator, group: Arc<G>) -> Self {
        let (convergence, converging, comoving) = Default::default();
        Self { integrator, group, chart: PhantomData, convergence, converging, comoving }
    }
}

impl<'a, G, C> Propagator<'a> for Series<'a, G, C>
where
    G: Group + Clone + 'a,
    C: Chart<G> + Send + Sync + 'a,
{
    fn flow(&self, _: &Tables, length: f64, parameters: &[f64]) -> Result<Flow<'a>, StepError> {
        let group = (*self.group).clone();
        let step = Interpreter::<G, C>::new(self.integrator, group, length, parameters)?;
        Ok(Box::new(move |phase, _| {
            let report = moved_in(phase, |phase| advance(&step, phase))?;
            Ok(Solved::one(report.iterations, report.residual))
        }))
    }

    fn forgets(&mut self) -> bool {
        self.converging = OnceLock::new();
        true
    }

    fn ratio(
        &self,
        compiled: Option<&Compiled>,
        longest: f64,
        parameters: &[f64],
        (momenta, lanes): (&[f64], usize),
    ) -> f64 {
        let integrator = self.integrator;
        let quiet = |compiled: &Compiled| compiled.is_quiet(momenta, lanes);
        if integrator.largest_rate.is_none() && compiled.is_some_and(quiet) {
            return 0.0;
        }
        let fold = || Convergence::fold(integrator, longest, parameters, STEEP).ok();
        let convergence = match compiled {
            Some(compiled) => compiled.convergence(integrator),
            None => self.convergence.get_or_init(|| Convergence::new(integrator)),
        };
        self.converging.get_or_init(fold).as_ref().map_or(0.0, |own| match lanes {
            WIDTH => convergence.ratio::<WIDTH>(own, momenta.as_chunks().0),
            _ => convergence.ratio::<1>(own, momenta.as_chunks().0),
        })
    }

    fn comoving(&self) -> Option<Box<dyn Propagator<'_> + '_>> {
        let make = || {
            let other = in_other_frame(&self.integrator.problem)?;
            other.comoving.as_ref()?;
            Integrator::build(other, TermLimit::of_open_method()).ok()
        };
        let other = self.comoving.get_or_init(make).as_ref()?;
        Some(Box::new(Series::<G, C>::new(other, self.group.clone())))
    }
}

/// The truncated series of an integrator for one step size, on any group with its algebra; solved as its plan says.
#[derive(Clone, Debug)]
pub(crate) struct Interpreter<'a, G, C> {
    integrator: &'a Integrator,
    group: G,
    /// The coefficients for the step size, as programs of it read them; see [`FoldTable::new`].
    slots: Vec<f64>,
    chart: PhantomData<C>,
}

impl<'a, G: Group, C: Chart<G>> Interpreter<'a, G, C> {
    /// Folds the coefficients for the step size and the values of the parameters that are kept.
    pub(crate) fn new(
        integrator: &'a Integrator,
        group: G,
        step: f64,
        parameters: &[f64],
    ) -> Result<Self, StepError> {
        let table = integrator.fold_table();
        let symbols = integrator.problem.symbols_at(parameters);
        let slots = table.fold(step, &symbols).map_err(|error| refusal(error, step, &symbols))?;
        Ok(Self { integrator, group, slots, chart: PhantomData })
    }

    /// The coefficients after those of the programs, from the square of the radius on.
    fn of_series(&self) -> &[f64] {
        self.slots.get(FoldTable::radius_at(self.integrator)..).unwrap_or(&[])
    }

    fn vector(&self, program: &Program, p: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(program.run(p.as_slice(), &self.slots))
    }
}

impl<G: Group, C: Chart<G>> GeneratingFunction for Interpreter<'_, G, C> {
    type Group = G;
    type Chart = C;

    fn group(&self) -> &G {
        &self.group
    }

    fn value(&self, p: &DVector<f64>) -> f64 {
        self.vector(&self.integrator.value, p)[0]
    }

    fn gradient(&self, p: &DVector<f64>) -> DVector<f64> {
        self.vector(&self.integrator.gradient, p)
    }

    fn gradient_and_hessian(&self, p: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let Some(program) = &self.integrator.hessian else {
            return (self.gradient(p), hessian_by_differences(self, p));
        };
        let (n, outputs) = (p.len(), self.vector(program, p));
        let mut matrix = DMatrix::zeros(n, n);
        // The upper triangle, row by row.
        let places = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
        for ((i, j), &value) in places.zip(outputs.iter().skip(n)) {
            matrix[(i, j)] = value;
            matrix[(j, i)] = value;
        }
        (outputs.rows(0, n).into_owned(), matrix)
    }

    fn frame(&self, motion: usize, mu: &DVector<f64>) -> Option<DVector<f64>> {
        self.integrator.frame.get(motion).map(|program| self.vector(program, mu))
    }

    fn unit(&self, i: usize) -> f64 {
        self.integrator.units[i]
    }

    fn radius(&self) -> f64 {
        let square = self.of_series().first().copied().unwrap_or(f64::INFINITY);
        if square.is_finite() { square.sqrt() } else { f64::MAX }
    }

    fn largest_rate(&self) -> f64 {
        self.integrator.largest_rate.unwrap_or(f64::MAX)
    }

    fn series_ratio(&self, p: &DVector<f64>) -> f64 {
        let (coefficients, truncation) =
            (&self.integrator.coefficients, self.integrator.problem.truncation);
        let values = self.of_series().iter().skip(1);
        let terms =
            coefficients.last_orders(truncation).zip(values).map(|((order, base), &value)| {
                (value, order == truncation, coefficients.monomials()[base].as_slice())
            });
        let factors = self.integrator.factors();
        let mut sums = vec![[0.0; 2]; factors.len()];
        plumbing::ratio_of(factors, terms, &mut sums, |i| p[i])
    }
}

impl<G: Group, C: Chart<G>> coadjoint::solve::Integrator for Interpreter<'_, G, C> {
    fn solver(&self) -> Solver {
        match self.integrator.plan.solver {
            problem::Solver::Newton => Solver::Newton,
            problem::Solver::FixedPoint => Solver::FixedPoint,
        }
    }

    fn predict(&self, mu: &DVector<f64>) -> DVector<f64> {
        cancel::check();
        let guess = self.vector(&self.integrator.predictor, mu);
        match self.integrator.plan.predictor {
            Predictor::Explicit(_) => guess,
            Predictor::Flow(_) => C::default().pull_back(&self.group, &guess, mu),
        }
    }
}
