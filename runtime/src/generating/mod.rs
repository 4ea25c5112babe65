//! The one interface everything meets at: a generating function S(p) on 𝔤\*.

#[cfg(feature = "alloc")]
mod polynomial;
pub(crate) mod series;

use crate::chart::Chart;
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::linear::differences;
use crate::number::Scalar;

#[cfg(feature = "alloc")]
pub use polynomial::PolynomialFunction;

/// The number type of a generating function's group.
pub type ScalarOf<S> = <<S as GeneratingFunction>::Group as LieGroup>::Scalar;
/// Coordinate vectors of a generating function's group.
pub type VectorOf<S> = <<S as GeneratingFunction>::Group as LieGroup>::Vector;
/// Square matrices of a generating function's group.
pub type MatrixOf<S> = <VectorOf<S> as Coordinates<ScalarOf<S>>>::Matrix;

/// A function S on 𝔤\*, read as the Lagrangian submanifold {x = ∂S/∂p(p)} of T\*G in canonical
/// coordinates (x, p) of a chart.
///
/// Whatever S is (the truncated Hamilton–Jacobi series, a fitted polynomial, a neural network),
/// [`poisson_map`](crate::steps::poisson_map) and [`advance`](crate::steps::advance) turn it into a Poisson map
/// of 𝔤\* and a symplectic, G-equivariant, momentum-preserving map of T\*G (Algorithm 1 of
/// Vaquero, Cortés, Martín de Diego, *Symmetry Preservation in Hamiltonian Systems*). How a step
/// is solved is said apart, by [`Integrator`](crate::solve::Integrator).
pub trait GeneratingFunction {
    /// The group the map lives on.
    type Group: LieGroup;
    /// The chart whose canonical coordinates (x, p) are meant.
    type Chart: Chart<Self::Group>;

    /// The group.
    fn group(&self) -> &Self::Group;

    /// S(p).
    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self>;

    /// x = ∂S/∂p(p).
    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self>;

    /// ∂S/∂p and the full Hessian ∂²S/∂p² at p.
    ///
    /// The default takes the Hessian by central differences of the gradient, to about 1e-10: give
    /// the exact one where steps go by Newton's method.
    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        (self.gradient(p), hessian_by_differences(self, p))
    }

    /// If S generates the motion in a comoving frame: the frame's own motion y in one step: a step
    /// is the map of S, then (g, μ) ↦ (g·exp y, Ad\*_{exp(y)⁻¹} μ) with y of that μ, for motion 0 of
    /// the frame, then motion 1, … up to the first `None`. `None` for motion 0: S generates the
    /// whole step.
    ///
    /// All these maps must commute and each y be an integral of its own, as with the flows of H − f
    /// and f where f is a function of an integral ⟨μ, e⟩, or a Casimir: then the frame goes the way of
    /// many steps at once.
    #[inline(always)]
    fn frame(&self, motion: usize, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        let _ = (motion, mu);
        None
    }

    /// The factor of coordinate `i` of a momentum where sizes of coordinates are compared: of a group with translations it
    /// measures in a unit of length of the system's own, so that steps do not depend on that of the numbers.
    #[inline(always)]
    fn unit(&self, i: usize) -> f64 {
        let _ = i;
        1.0
    }

    /// The Euclidean norm of μ in these units, in each direct factor of the group, up to which [`GeneratingFunction::series_ratio`] is at
    /// most ½ in every direction; larger momenta are judged one by one. Unbounded where S is no truncated series.
    #[inline(always)]
    fn radius(&self) -> ScalarOf<Self> {
        Scalar::of(f64::MAX)
    }

    /// The rounding of the gradient, in units of that of a short sum: a step's equation is solved up to as many. More than 1
    /// for sums of many terms that cancel.
    #[inline(always)]
    fn rounding(&self) -> f64 {
        1.0
    }

    /// The largest rate at which motions may part in a step, √(maxᵢ Σⱼ |ZᵢⱼZⱼᵢ|) of Z = ad_xᵀ + 2 ∂p/∂x·Hess S; unbounded
    /// but where S is a series of so few terms that their ratio tells too little. The share of it counts as twice the
    /// ratio of terms.
    #[inline(always)]
    fn largest_rate(&self) -> f64 {
        f64::MAX
    }

    /// For a truncated series S₁ + S₃ + … + S_K: the ratio of its last two terms at p, each measured by
    /// the sum of the absolute values of all monomials of its gradient, in the direct factor of the group where it is
    /// largest. Steps are refused above ½, where the series has stopped to mean something. Zero for any other S.
    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let _ = p;
        Scalar::of(0.0)
    }
}

/// ∂²S/∂p² at p by central differences of the gradient.
pub fn hessian_by_differences<S: GeneratingFunction + ?Sized>(
    generating: &S,
    p: &VectorOf<S>,
) -> MatrixOf<S> {
    let spacing = (p.largest_entry() + Scalar::of(1e-3)) * differences::spacing::<ScalarOf<S>>();
    differences::central(p, |_| spacing, |p| generating.gradient(p))
}

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

    fn unit(&self, i: usize) -> f64 {
        self.0.unit(i)
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
