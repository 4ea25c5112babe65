//! Charts τ: 𝔤 → G near the identity, and the canonical coordinates (x, p) they induce on T\*G.

use core::fmt::Debug;

use nalgebra::{SimdComplexField, SimdPartialOrd};

use crate::group::{CayleyGroup, LieGroup};
use crate::linear::coordinates::Coordinates;
use crate::linear::differences;
use crate::number::scalar::Scalar;

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

    /// [`Chart::pull_back`] and its derivative in x (rows: coordinates of p; columns: of x), by differences: to about
    /// 1e-10, which serves Newton's method.
    fn pull_back_with_derivative(
        self,
        group: &G,
        x: &G::Vector,
        mu: &G::Vector,
    ) -> (G::Vector, Matrix<G>) {
        // Angles vary p on the scale of one, whatever the length of a translation beside them.
        let spacing = |x: G::Scalar| {
            differences::spacing::<G::Scalar>() * x.simd_abs().simd_max(G::Scalar::of(1.0))
        };
        let derivative = differences::central(x, spacing, |x| self.pull_back(group, x, mu));
        (self.pull_back(group, x, mu), derivative)
    }

    /// J_L(x, p) = (d^R τ_x)^{−T} p, the momentum on the left: the body momentum before the step.
    fn left_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector {
        let dim = p.dim();
        let mut matrix = G::Vector::zero_matrix(dim);
        for j in 0..dim {
            let column = self.pull_back(group, x, &G::Vector::unit(dim, j));
            for i in 0..dim {
                matrix[(i, j)] = column[i];
            }
        }
        G::Vector::solve(&matrix, p)
    }

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

    fn transport(self, group: &G, x: &G::Vector, mu: &G::Vector) -> (G::Element, G::Vector) {
        group.exp_transport(x, mu)
    }

    fn extent(self, group: &G, x: &G::Vector) -> G::Scalar {
        group.exp_extent(x)
    }

    fn coordinate(self, group: &G, g: &G::Element) -> Option<G::Vector> {
        group.log(g)
    }

    fn pull_back(self, group: &G, x: &G::Vector, mu: &G::Vector) -> G::Vector {
        group.dexp_transpose(x, mu)
    }
}

impl<G: CayleyGroup> Chart<G> for Cayley {
    const NAME: &'static str = "cayley";

    fn transport(self, group: &G, x: &G::Vector, mu: &G::Vector) -> (G::Element, G::Vector) {
        let g = group.cayley(x);
        let moved = group.coadjoint(&group.inverse(&g), mu);
        (g, moved)
    }

    fn extent(self, group: &G, x: &G::Vector) -> G::Scalar {
        group.cayley_extent(x)
    }

    fn coordinate(self, group: &G, g: &G::Element) -> Option<G::Vector> {
        group.cayley_inverse(g)
    }

    fn pull_back(self, group: &G, x: &G::Vector, mu: &G::Vector) -> G::Vector {
        group.dcay_transpose(x, mu)
    }
}
