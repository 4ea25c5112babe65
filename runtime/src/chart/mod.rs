//! Charts τ: 𝔤 → G near the identity, and the canonical coordinates (x, p) they induce on T\*G.

use core::fmt::Debug;

use crate::group::{CayleyGroup, LieGroup};
use crate::linear::coordinates::Coordinates;

type Matrix<G> = <<G as LieGroup>::Vector as Coordinates<<G as LieGroup>::Scalar>>::Matrix;

/// A chart τ with τ(0) = e and τ(−x) = τ(x)⁻¹; p·dx is the Liouville form in (x, p).
pub trait Chart<G: LieGroup>: Copy + Debug + Default {
    /// The name users write: `exp` or `cayley`.
    const NAME: &'static str;

    /// τ(x) and Ad\*_{τ(x)⁻¹} μ: the group increment of a step and the momentum after it.
    fn transport(self, group: &G, x: &G::Vector, mu: &G::Vector) -> (G::Element, G::Vector);

    /// How far x goes into the chart; steps are accepted up to one. See [`LieGroup::exp_extent`] and
    /// [`CayleyGroup::cayley_extent`].
    fn extent(self, group: &G, x: &G::Vector) -> G::Scalar;

    /// The x with τ(x) = g, where the chart reaches g.
    fn coordinate(self, group: &G, g: &G::Element) -> Option<G::Vector>;

    /// (d^R τ_x)ᵀ μ: the canonical momentum p of the covector with J_L = μ over τ(x).
    fn pull_back(self, group: &G, x: &G::Vector, mu: &G::Vector) -> G::Vector;

    /// [`Chart::pull_back`] and its derivative in x (rows: coordinates of p; columns: of x).
    fn pull_back_with_derivative(
        self,
        group: &G,
        x: &G::Vector,
        mu: &G::Vector,
    ) -> (G::Vector, Matrix<G>);

    /// J_L(x, p) = (d^R τ_x)^{−T} p, the momentum on the left: the body momentum before the step.
    fn left_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector;

    /// J_R(x, p) = J_L(−x, p), the momentum on the right: the body momentum after the step.
    fn right_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector {
        let negative = G::Vector::from_entries(x.dim(), |i| -x[i]);
        self.left_momentum(group, &negative, p)
    }
}

/// τ = exp, the default chart: at equal truncation far more accurate than Cayley.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exponential;

/// τ = cay, cay(x) = (1 − x/2)⁻¹(1 + x/2); only on groups that are [`CayleyGroup`]s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cayley;

impl<G: LieGroup> Chart<G> for Exponential {
    const NAME: &'static str = "exp";

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn transport(self, group: &G, x: &G::Vector, mu: &G::Vector) -> (G::Element, G::Vector) {
        group.exp_transport(x, mu)
    }

    #[inline(always)]
    fn extent(self, group: &G, x: &G::Vector) -> G::Scalar {
        group.exp_extent(x)
    }

    #[inline(always)]
    fn coordinate(self, group: &G, g: &G::Element) -> Option<G::Vector> {
        group.log(g)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull_back(self, group: &G, x: &G::Vector, mu: &G::Vector) -> G::Vector {
        group.dexp_transpose(x, mu)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull_back_with_derivative(
        self,
        group: &G,
        x: &G::Vector,
        mu: &G::Vector,
    ) -> (G::Vector, Matrix<G>) {
        group.dexp_transpose_with_derivative(x, mu)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn left_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector {
        group.dexp_inverse_transpose(x, p)
    }
}

impl<G: CayleyGroup> Chart<G> for Cayley {
    const NAME: &'static str = "cayley";

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn transport(self, group: &G, x: &G::Vector, mu: &G::Vector) -> (G::Element, G::Vector) {
        group.cayley_transport(x, mu)
    }

    #[inline(always)]
    fn extent(self, group: &G, x: &G::Vector) -> G::Scalar {
        group.cayley_extent(x)
    }

    #[inline(always)]
    fn coordinate(self, group: &G, g: &G::Element) -> Option<G::Vector> {
        group.cayley_inverse(g)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull_back(self, group: &G, x: &G::Vector, mu: &G::Vector) -> G::Vector {
        group.dcay_transpose(x, mu)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull_back_with_derivative(
        self,
        group: &G,
        x: &G::Vector,
        mu: &G::Vector,
    ) -> (G::Vector, Matrix<G>) {
        group.dcay_transpose_with_derivative(x, mu)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn left_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector {
        group.dcay_inverse_transpose(x, p)
    }
}
