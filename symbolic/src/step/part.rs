//! A group with a chart, as formulas over nodes.

use crate::graph::{Graph, Id};
use crate::step::vector::Matrix;

/// [`Part::estimated`] where nothing better is known, and where S is no series with a radius: beyond, estimates were found
/// ten times too small.
pub(crate) const ESTIMATED: f64 = 1.0 / 3.0;

/// A factor of a group, with the chart of a step: what programs of a step are built of.
///
/// Coordinates x and μ have n entries, a group element m numbers. Conventions are those of the runtime's `LieGroup`.
pub(crate) trait Part: std::fmt::Debug + Send + Sync {
    /// n, the dimension.
    fn dim(&self) -> usize;

    /// m, how many numbers make a group element.
    fn element(&self) -> usize;

    /// (d^R τ_x)ᵀ μ
    fn pull_back(&self, graph: &mut Graph, x: &[Id], mu: &[Id]) -> Vec<Id>;

    /// (d^R τ_x)ᵀ μ and its derivative in x, which Newton's method alone uses.
    fn pull_back_with_derivative(
        &self,
        graph: &mut Graph,
        x: &[Id],
        mu: &[Id],
    ) -> (Vec<Id>, Matrix);

    /// g·τ(x) and Ad\*_{τ(x)⁻¹} μ.
    fn transport(&self, graph: &mut Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved;

    /// g·exp(y) and Ad\*_{exp(−y)} μ: the motion of a comoving frame, of any length.
    fn move_frame(&self, graph: &mut Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved>;

    /// Ad\*_g μ, the spatial momentum. `back` has the numbers of g⁻¹ where [`Part::inverted`] asks for them, else
    /// anything.
    fn spatial(&self, graph: &mut Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id>;

    /// Parts of an element that are matrices with an inverse that formulas do not give: where each begins, and its rows.
    fn inverted(&self) -> Vec<(usize, usize)> {
        Vec::new()
    }

    /// How far x goes into the chart: the square of its share of a half turn, or a bound on it; not a number where x is not
    /// finite. These formulas hold up to half a half turn.
    fn extent(&self, graph: &mut Graph, x: &[Id]) -> Id;

    /// Up to which share of a half turn the estimate of what Newton's method leaves is taken for a bound, if S is a series
    /// with a radius.
    fn estimated(&self) -> f64 {
        ESTIMATED
    }

    /// How far g is from the group; not a number where g is not finite.
    fn defect(&self, graph: &mut Graph, g: &[Id]) -> Id;

    /// The matrix of g.
    fn matrix(&self, graph: &mut Graph, g: &[Id]) -> Matrix;

    /// A description of the numbers of an element.
    fn about(&self) -> String;

    /// The numbers of the element with this matrix, row by row.
    fn element_of(&self, matrix: &[f64]) -> Vec<f64>;
}

/// A state moved on.
#[derive(Clone, Debug)]
pub(crate) struct Moved {
    /// The group element.
    pub g: Vec<Id>,
    /// The momentum.
    pub mu: Vec<Id>,
}
