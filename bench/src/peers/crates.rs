//! DOP853 of two crates, as their users would call it.

use differential_equations::prelude::{
    ControlFlag, ExplicitRungeKutta, IVP, Interpolation, ODE, Solout, Solution,
};
use ode_solvers::{Dop853, SVector, System, dop_shared::OutputType};

use super::general::{Control, Solver};
use crate::{method::RunError, problem::VectorField};

/// Steps no honest run needs; above the crates' own limits, which are below what T = 1000 takes.
const MAX_STEPS: u32 = 100_000_000;

/// `ode_solvers::Dop853`.
#[derive(Clone, Copy, Debug)]
pub struct OdeSolvers;

struct Field<F>(F);

impl<const N: usize, F: VectorField<N>> System<f64, SVector<f64, N>> for Field<F> {
    fn system(&self, _: f64, y: &SVector<f64, N>, dy: &mut SVector<f64, N>) {
        *dy = SVector::from(self.0.evaluate(&y.data.0[0]));
    }
}

impl Solver for OdeSolvers {
    const CONTROL: Control = Control::Tolerance;

    fn solve<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        initial: [f64; N],
        end: f64,
        tolerance: f64,
    ) -> Result<[f64; N], RunError> {
        let mut stepper = Dop853::from_param(
            Field(*field),
            0.0,
            end,
            end,
            SVector::from(initial),
            tolerance,
            tolerance,
            0.9,
            0.0,
            0.333,
            6.0,
            end,
            0.0,
            MAX_STEPS,
            MAX_STEPS,
            OutputType::Sparse,
        );
        stepper.integrate().map_err(|error| RunError::Foreign(format!("ode_solvers: {error}")))?;
        stepper.y_out().last().map(|y| y.data.0[0]).ok_or(RunError::NotConverged)
    }
}

/// `differential_equations`' DOP853.
#[derive(Clone, Copy, Debug)]
pub struct DifferentialEquations;

impl<const N: usize, F: VectorField<N>> ODE<f64, [f64; N]> for Field<F> {
    fn diff(&self, _: f64, y: &[f64; N], dydt: &mut [f64; N]) {
        *dydt = self.0.evaluate(y);
    }
}

/// Keeps the last point only, so that storing a million points is not what is measured.
struct Last<const N: usize>([f64; N]);

impl<const N: usize> Solout<f64, [f64; N]> for &mut Last<N> {
    fn solout<I>(
        &mut self,
        _: f64,
        _: f64,
        y: &[f64; N],
        _: &[f64; N],
        _: &mut I,
        _: &mut Solution<f64, [f64; N]>,
    ) -> ControlFlag<f64, [f64; N]>
    where
        I: Interpolation<f64, [f64; N]> + ?Sized,
    {
        self.0 = *y;
        ControlFlag::Continue
    }
}

impl Solver for DifferentialEquations {
    const CONTROL: Control = Control::Tolerance;

    fn solve<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        initial: [f64; N],
        end: f64,
        tolerance: f64,
    ) -> Result<[f64; N], RunError> {
        let mut last = Last(initial);
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(tolerance)
            .max_steps(MAX_STEPS as usize);
        IVP::ode(&Field(*field), 0.0, end, initial)
            .method(method)
            .solout(&mut last)
            .solve()
            .map_err(|error| RunError::Foreign(format!("differential-equations: {error:?}")))?;
        Ok(last.0)
    }
}
