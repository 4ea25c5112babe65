//! Any generating function, solved by the fixed point.

use coadjoint::GeneratingFunction;
use coadjoint::generating::{MatrixOf, ScalarOf, VectorOf};
use coadjoint::solve::Integrator;
use coadjoint::solve::Solver;

/// The function S, whose steps are solved by the fixed point.
pub struct MatrixFree<S>(pub S);

impl<S: GeneratingFunction> GeneratingFunction for MatrixFree<S> {
    type Group = S::Group;
    type Chart = S::Chart;

    fn group(&self) -> &S::Group {
        self.0.group()
    }

    fn value(&self, p: &VectorOf<S>) -> ScalarOf<S> {
        self.0.value(p)
    }

    fn gradient(&self, p: &VectorOf<S>) -> VectorOf<S> {
        self.0.gradient(p)
    }

    fn gradient_and_hessian(&self, p: &VectorOf<S>) -> (VectorOf<S>, MatrixOf<S>) {
        self.0.gradient_and_hessian(p)
    }

    fn frame(&self, motion: usize, mu: &VectorOf<S>) -> Option<VectorOf<S>> {
        self.0.frame(motion, mu)
    }

    fn unit(&self, i: usize) -> f64 {
        self.0.unit(i)
    }

    fn radius(&self) -> ScalarOf<S> {
        self.0.radius()
    }

    fn largest_rate(&self) -> f64 {
        self.0.largest_rate()
    }

    fn series_ratio(&self, p: &VectorOf<S>) -> ScalarOf<S> {
        self.0.series_ratio(p)
    }
}

impl<S: GeneratingFunction> Integrator for MatrixFree<S> {
    fn solver(&self) -> Solver {
        Solver::FixedPoint
    }
}
