//! Choosing the matrix-free solver for a generating function that has a Hessian.

use super::{FixedPoint, Integrator, Predict};
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};

/// The same generating function, solved by the [`FixedPoint`].
///
/// ```
/// use coadjoint::{Phase, SO3, advance, lie_poisson, solve::MatrixFree};
///
/// #[lie_poisson(group = SO3, truncation = 3)]
/// fn body(mu: [f64; 3]) -> f64 {
///     mu[0] * mu[0] / 2.0 + mu[1] * mu[1] / 3.0 + mu[2] * mu[2] / 4.0
/// }
///
/// # fn main() -> Result<(), coadjoint::StepError> {
/// let step = Body::<f64>::new(0.1)?;
/// let (mut a, mut b) = (Phase::<SO3>::at_identity([1.0, 2.0, 3.0]), Phase::at_identity([1.0, 2.0, 3.0]));
/// advance(&step, &mut a)?;
/// advance(&MatrixFree(step), &mut b)?;
/// assert!((a.momentum - b.momentum).amax() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct MatrixFree<S>(pub S);

impl<S: GeneratingFunction> GeneratingFunction for MatrixFree<S> {
    type Group = S::Group;
    type Chart = S::Chart;

    #[inline(always)]
    fn group(&self) -> &Self::Group {
        self.0.group()
    }

    #[inline(always)]
    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        self.0.value(p)
    }

    #[inline(always)]
    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        self.0.gradient(p)
    }

    #[inline(always)]
    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        self.0.gradient_and_hessian(p)
    }

    #[inline(always)]
    fn frame(&self, motion: usize, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        self.0.frame(motion, mu)
    }

    #[inline(always)]
    fn radius(&self) -> ScalarOf<Self> {
        self.0.radius()
    }

    #[inline(always)]
    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        self.0.series_ratio(p)
    }
}

impl<S: Predict> Predict for MatrixFree<S> {
    #[inline(always)]
    fn predict_increment(&self, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        self.0.predict_increment(mu)
    }

    #[inline(always)]
    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        self.0.predict(mu)
    }

    #[inline(always)]
    fn predict_after(&self, last: &VectorOf<Self>, mu: &VectorOf<Self>) -> VectorOf<Self> {
        self.0.predict_after(last, mu)
    }
}

impl<S: Predict> Integrator for MatrixFree<S> {
    type Method = FixedPoint;
}
