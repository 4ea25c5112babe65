//! The trait of Lie groups, implemented once per group.

pub(crate) mod closed;
pub(crate) mod element_error;
mod log;
pub(crate) mod middle;
pub(crate) mod phase;
pub(crate) mod product;
pub(crate) mod se2;
pub(crate) mod se3;
pub(crate) mod so3;

use core::fmt::Debug;

use crate::group::element_error::ElementError;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// A Lie group G with a chosen basis e₁…eₙ of its Lie algebra 𝔤.
///
/// The implementing type *describes* the group (a zero-sized type for the groups of the catalogue,
/// tables for one known at run time); group elements are [`LieGroup::Element`]. Coordinates of 𝔤
/// refer to the basis, coordinates of 𝔤\* to the dual basis, [eᵢ, eⱼ] = Σₖ cᵢⱼᵏ eₖ. Conventions:
/// ⟨Ad\*_g μ, ξ⟩ = ⟨μ, Ad_{g⁻¹} ξ⟩ (a left action), ⟨ad\*_ξ μ, η⟩ = ⟨μ, [ξ, η]⟩.
pub trait LieGroup: Clone + Debug {
    /// The number type of coordinates.
    type Scalar: Scalar;
    /// Coordinates of 𝔤 in the basis the group documents, and of 𝔤\* in the dual one.
    type Vector: Coordinates<Self::Scalar>;
    /// An element g of the group.
    type Element: Clone + Debug;

    /// n, the dimension of the group.
    fn dim(&self) -> usize;

    /// The neutral element.
    fn identity(&self) -> Self::Element {
        self.exp(&Self::Vector::zeros(self.dim()))
    }

    /// The product g·h.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element;

    /// The inverse g⁻¹.
    fn inverse(&self, g: &Self::Element) -> Self::Element;

    /// The exponential exp(x) of an element of the algebra, to rounding.
    fn exp(&self, x: &Self::Vector) -> Self::Element;

    /// The x nearest to 0 with exp(x) = g; `None` where there is none, or none can be found.
    fn log(&self, g: &Self::Element) -> Option<Self::Vector>;

    /// The infinitesimal coadjoint action ad\*_x μ, coordinates Σ xᵢ cᵢⱼˡ μₗ: the transpose of ad_x applied to μ.
    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector;

    /// Ad\*_g μ, the left coadjoint action: for a phase point (g, μ), its spatial momentum.
    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector;

    /// The Lie bracket \[x, y\], in coordinates; if not given, from its transpose [`LieGroup::ad_star`].
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let covector = |k| self.ad_star(x, &Self::Vector::unit(x.dim(), k));
        Self::Vector::from_entries(x.dim(), |k| covector(k).pairing(y))
    }

    /// The adjoint action Ad_g x: the coordinates of g x g⁻¹; if not given, from its transpose
    /// [`LieGroup::coadjoint`].
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        let back = self.inverse(g);
        let covector = |k| self.coadjoint(&back, &Self::Vector::unit(x.dim(), k));
        Self::Vector::from_entries(x.dim(), |k| covector(k).pairing(x))
    }

    /// The element exp(x) together with Ad\*_{exp(−x)} μ, computed from x (not from a rounded group element).
    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let g = self.exp(x);
        let moved = self.coadjoint(&self.inverse(&g), mu);
        (g, moved)
    }

    /// The canonical momentum of the exponential chart, (d^R exp_x)ᵀ μ = Σₖ (ad_xᵀ)ᵏ μ / (k+1)!, to rounding, where dexp·exp⁻¹ = d^R exp_x dx.
    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector;

    /// The extent of x in the exponential chart: (max |Im λ|/π)² over the eigenvalues λ of ad_x, or a bound on
    /// it. The chart reaches to one. NaN where x is not finite. The elliptic part alone counts: nilpotent
    /// directions have no limit.
    fn exp_extent(&self, x: &Self::Vector) -> Self::Scalar;

    /// The distance of g from the group: the largest entry of what should vanish (gᵀg − 1 for rotations, the norm
    /// less one for unit quaternions). NaN where g is not finite; zero where there is nothing to check.
    fn element_defect(&self, g: &Self::Element) -> Self::Scalar;

    /// J_R(x, p) of the exponential chart, the body momentum, at several nodes (x, p): its series in x up to the power `degree`.
    fn node_momenta<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        degree: usize,
    ) -> Rows<Self, M> {
        let ad_stars = |x: &_, p: &_| self.ad_stars::<M>(x, p);
        middle::momenta::<_, Self::Vector, M>(self.dim(), ad_stars, x, p, degree)
    }

    /// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω at (x, p): derivatives of [`LieGroup::node_momenta`] of the same degree,
    /// and with ω = ∂H/∂μ Hamilton's equations of H∘J_R.
    fn node_rates<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        omega: &Rows<Self, M>,
        degree: usize,
    ) -> [Rows<Self, M>; 2] {
        let ad_stars = |x: &_, p: &_| self.ad_stars::<M>(x, p);
        let brackets = |x: &_, y: &_| self.brackets::<M>(x, y);
        let point = [x, p, omega];
        middle::rates::<_, Self::Vector, M>(self.dim(), ad_stars, brackets, point, degree)
    }

    /// [`LieGroup::ad_star`] at several nodes.
    fn ad_stars<const M: usize>(&self, x: &Rows<Self, M>, mu: &Rows<Self, M>) -> Rows<Self, M> {
        let at = |rows, node| Self::Vector::at::<M>(self.dim(), rows, node);
        Self::Vector::by_node::<M>(self.dim(), |node| self.ad_star(&at(x, node), &at(mu, node)))
    }

    /// [`LieGroup::bracket`] at several nodes.
    fn brackets<const M: usize>(&self, x: &Rows<Self, M>, y: &Rows<Self, M>) -> Rows<Self, M> {
        let at = |rows, node| Self::Vector::at::<M>(self.dim(), rows, node);
        Self::Vector::by_node::<M>(self.dim(), |node| self.bracket(&at(x, node), &at(y, node)))
    }

    /// The number of Casimirs that [`LieGroup::casimir`] knows.
    fn casimir_count(&self) -> usize;

    /// The Casimir number `index` (from 0) at μ: a function constant on coadjoint orbits.
    fn casimir(&self, index: usize, mu: &Self::Vector) -> Self::Scalar;

    /// d, where elements are d×d matrices (in the representation the group's doc states).
    fn matrix_size(&self) -> usize;

    /// Entry (row, column) of g as a matrix.
    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> Self::Scalar;

    /// Calls `visit` with row, column, and value of each entry of g as a matrix, at least of those that are not 0 for every g.
    fn matrix_entries(&self, g: &Self::Element, visit: &mut dyn FnMut(usize, usize, Self::Scalar)) {
        let size = self.matrix_size();
        for at in 0..size * size {
            visit(at / size, at % size, self.matrix_entry(g, at / size, at % size));
        }
    }

    /// The element whose matrix has these entries, checked to be one.
    ///
    /// # Errors
    /// [`ElementError`] saying what the matrix lacks.
    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> Self::Scalar,
    ) -> Result<Self::Element, ElementError>;
}

/// Vectors of a group's coordinates at `M` nodes.
pub type Rows<G, const M: usize> =
    <<G as LieGroup>::Vector as Coordinates<<G as LieGroup>::Scalar>>::Rows<M>;

/// A group whose dimension is known to the compiler; products of such groups check theirs there.
pub trait FixedDimension {
    /// n, the dimension of the group.
    const DIM: usize;
}

/// A group with the Cayley map cay(x) = (1 − x/2)⁻¹(1 + x/2) in its matrix representation.
///
/// Only for groups where ξ, x ∈ 𝔤 implies xξx ∈ 𝔤 (so(n), sp(n), se(3), u(n); not su(3)).
pub trait CayleyGroup: LieGroup {
    /// cay(x).
    fn cayley(&self, x: &Self::Vector) -> Self::Element;

    /// The extent of x in the Cayley chart: max |λ/2|² over the eigenvalues λ of the matrix of x, or a bound on
    /// it. The chart is used up to one, its own half turn (|x| = 2 on SO(3)). NaN where x is not finite.
    fn cayley_extent(&self, x: &Self::Vector) -> Self::Scalar;

    /// The x with cay(x) = g; `None` where g has no Cayley coordinate.
    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector>;

    /// (d^R cay_x)ᵀ μ: ⟨μ, (1 − x/2)⁻¹ ξ (1 + x/2)⁻¹⟩ for every ξ.
    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector;
}
