//! The inverse map of a generating function.

use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;

/// The generating function −S: its map is the inverse of that of S.
///
/// For J_L(−x, p) = J_R(x, p), so that x ↦ −x exchanges the momenta before and after.
#[derive(Clone, Copy, Debug)]
pub struct Reversed<'a, S: ?Sized>(pub &'a S);

impl<S: GeneratingFunction + ?Sized> GeneratingFunction for Reversed<'_, S> {
    type Group = S::Group;
    type Chart = S::Chart;

    fn group(&self) -> &Self::Group {
        self.0.group()
    }

    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        -self.0.value(p)
    }

    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        let x = self.0.gradient(p);
        VectorOf::<S>::from_entries(x.dim(), |i| -x[i])
    }

    fn frame(&self, motion: usize, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        self.0.frame(motion, mu).map(|y| VectorOf::<S>::from_entries(y.dim(), |i| -y[i]))
    }

    fn radius(&self) -> ScalarOf<Self> {
        self.0.radius()
    }

    fn rounding(&self) -> f64 {
        self.0.rounding()
    }

    fn largest_rate(&self) -> f64 {
        self.0.largest_rate()
    }

    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        self.0.series_ratio(p)
    }

    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        let (x, hessian) = self.0.gradient_and_hessian(p);
        let dim = self.0.group().dim();
        let negative = VectorOf::<S>::matrix_from_entries(dim, |i, j| -hessian[(i, j)]);
        (VectorOf::<S>::from_entries(x.dim(), |i| -x[i]), negative)
    }
}
