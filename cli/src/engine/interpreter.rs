//! A generating function run by the interpreter.

use std::cell::RefCell;
use std::marker::PhantomData;

use coadjoint::{Chart, GeneratingFunction, Solver, StepError, hessian_by_differences};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::integrator::Integrator;
use nalgebra::{DMatrix, DVector};

use super::Group;

/// The truncated series of an integrator for one step size, on a run-time group; solved by the
/// fixed point or by Newton's method.
#[derive(Debug)]
pub struct Interpreter<'a, G, C, const FIXED_POINT: bool> {
    integrator: &'a Integrator,
    group: G,
    /// The folded coefficients C_m(h).
    slots: Vec<f64>,
    /// Reused between evaluations.
    scratch: RefCell<Vec<f64>>,
    chart: PhantomData<C>,
}

impl<'a, G: Group, C: Chart<G>, const FIXED_POINT: bool> Interpreter<'a, G, C, FIXED_POINT> {
    /// Folds the coefficients for the step size.
    pub fn new(integrator: &'a Integrator, group: G, step: f64) -> Result<Self, StepError> {
        if step == 0.0 || !step.is_finite() {
            return Err(StepError::InvalidStep { step });
        }
        // Parameters are substituted; what symbols are left (sqrt(2)) need none.
        let symbols: Vec<f64> =
            integrator.problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect();
        let slots = integrator.coefficients.fold(step, &symbols);
        let scratch = RefCell::new(Vec::new());
        Ok(Self { integrator, group, slots, scratch, chart: PhantomData })
    }

    fn run(&self, program: &Program, p: &DVector<f64>, outputs: usize) -> Vec<f64> {
        let mut result = vec![0.0; outputs];
        program.run(p.as_slice(), &self.slots, &mut self.scratch.borrow_mut(), &mut result);
        result
    }
}

impl<G: Group, C: Chart<G>, const FIXED_POINT: bool> GeneratingFunction
    for Interpreter<'_, G, C, FIXED_POINT>
{
    type Group = G;
    type Chart = C;
    const SOLVER: Solver = if FIXED_POINT { Solver::FixedPoint } else { Solver::Newton };

    fn group(&self) -> &G {
        &self.group
    }

    fn value(&self, p: &DVector<f64>) -> f64 {
        self.run(&self.integrator.value, p, 1)[0]
    }

    fn gradient(&self, p: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.run(&self.integrator.gradient, p, p.len()))
    }

    fn gradient_and_hessian(&self, p: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let n = p.len();
        let Some(program) = &self.integrator.hessian else {
            return (self.gradient(p), hessian_by_differences(self, p));
        };
        let values = self.run(program, p, n + n * (n + 1) / 2);
        let (gradient, triangle) = values.split_at(n);
        let mut hessian = DMatrix::zeros(n, n);
        // The upper triangle, row by row.
        let places = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
        for ((i, j), &value) in places.zip(triangle) {
            hessian[(i, j)] = value;
            hessian[(j, i)] = value;
        }
        (DVector::from_column_slice(gradient), hessian)
    }

    fn predict(&self, mu: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.run(&self.integrator.predictor, mu, mu.len()))
    }
}
