//! Charts τ: 𝔤 → G near the identity, and the canonical coordinates (x, p) they induce on T\*G.

use core::fmt::Debug;

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use crate::group::{CayleyGroup, LieGroup};
use crate::linear::coordinates::Coordinates;
use crate::linear::{differences, square};
use crate::number::Scalar;

/// The most terms of a series of derivatives: enough for ‖ad_x‖ up to 50.
const TERMS: usize = 200;

type Matrix<G> = <<G as LieGroup>::Vector as Coordinates<<G as LieGroup>::Scalar>>::Matrix;

/// A chart τ with τ(0) = e and τ(−x) = τ(x)⁻¹; p·dx is the Liouville form in (x, p).
pub trait Chart<G: LieGroup>: Copy + Debug + Default {
    /// The name users write: `exp` or `cayley`.
    const NAME: &'static str;

    /// τ(x) and Ad\*_{τ(x)⁻¹} μ: the group increment of a step and the momentum after it.
    fn transport(self, group: &G, x: &G::Vector, mu: &G::Vector) -> (G::Element, G::Vector);

    /// The extent of x in the chart; steps are accepted up to one. See [`LieGroup::exp_extent`] and
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

    /// The derivative to rounding, at several times the cost: derivatives of steps are made of it. Not a number for x
    /// far beyond the chart.
    fn pull_back_derivative(self, group: &G, x: &G::Vector, mu: &G::Vector) -> Matrix<G>;

    /// J_L(x, p) = (d^R τ_x)^{−T} p, the momentum on the left: the body momentum before the step.
    fn left_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector {
        let matrix = columns::<G>(p.dim(), |unit| self.pull_back(group, x, unit));
        G::Vector::solve(&matrix, p)
    }

    /// J_R(x, p) = J_L(−x, p), the momentum on the right: the body momentum after the step.
    fn right_momentum(self, group: &G, x: &G::Vector, p: &G::Vector) -> G::Vector {
        let negative = G::Vector::from_entries(x.dim(), |i| -x[i]);
        self.left_momentum(group, &negative, p)
    }
}

/// The matrix of a linear map of vectors.
pub(crate) fn columns<G: LieGroup>(dim: usize, map: impl Fn(&G::Vector) -> G::Vector) -> Matrix<G> {
    let mut matrix = G::Vector::zero_matrix(dim);
    for j in 0..dim {
        let column = map(&G::Vector::unit(dim, j));
        for i in 0..dim {
            matrix[(i, j)] = column[i];
        }
    }
    matrix
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

    /// By its series: with uₖ = (ad_xᵀ)ᵏ μ/(k+1)! it is Σ ∂uₖ, (k+1) ∂uₖ = ad_(·)ᵀ uₖ₋₁ + ad_xᵀ ∂uₖ₋₁.
    fn pull_back_derivative(self, group: &G, x: &G::Vector, mu: &G::Vector) -> Matrix<G> {
        let (dim, one) = (mu.dim(), G::Scalar::of(1.0));
        let turn = columns::<G>(dim, |unit| group.ad_star(x, unit));
        let shrinks_after = square::row_sum_norm(dim, &turn).largest_lane();
        let rounding = G::Scalar::epsilon() * G::Scalar::of(0.125);
        let mut power = mu.clone();
        let (mut slope, mut sum) = (G::Vector::zero_matrix(dim), G::Vector::zero_matrix(dim));
        for k in 1..TERMS {
            let factor = G::Scalar::of(1.0 / (k + 1) as f64);
            let bent = columns::<G>(dim, |unit| group.ad_star(unit, &power));
            let turned = square::multiply(dim, &turn, &slope);
            slope = square::scale(dim, &square::plus_scaled(dim, &bent, one, &turned), factor);
            sum = square::plus_scaled(dim, &sum, one, &slope);
            let turned = power.left_multiply(&turn);
            power = G::Vector::from_entries(dim, |i| turned[i] * factor);
            let largest = |matrix| square::largest_entry(dim, matrix);
            let small = largest(&slope).simd_le(largest(&sum) * rounding)
                & power.largest_entry().simd_le(mu.largest_entry() * rounding);
            if k as f64 > shrinks_after && small.all() {
                return sum;
            }
        }
        square::scale(dim, &sum, G::Scalar::of(f64::NAN))
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

    /// From the derivative of J_L(x, p) = μ: J_L is quadratic in x, and so its differences of any spacing are exact.
    fn pull_back_derivative(self, group: &G, x: &G::Vector, mu: &G::Vector) -> Matrix<G> {
        let dim = mu.dim();
        let p = self.pull_back(group, x, mu);
        let half = |_| G::Scalar::of(0.5);
        let bent = differences::central(x, half, |x| self.left_momentum(group, x, &p));
        let back = columns::<G>(dim, |unit| self.pull_back(group, x, unit));
        square::scale(dim, &square::multiply(dim, &back, &bent), G::Scalar::of(-1.0))
    }
}
