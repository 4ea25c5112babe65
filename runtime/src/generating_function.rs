//! The one interface everything meets at: a generating function S(p) on 𝔤\*.

use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::group::LieGroup;

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
/// [`poisson_map`](crate::poisson_map) and [`advance`](crate::advance) turn it into a Poisson map
/// of 𝔤\* and a symplectic, G-equivariant, momentum-preserving map of T\*G (Algorithm 1 of
/// Vaquero, Cortés, Martín de Diego, *Symmetry Preservation in Hamiltonian Systems*).
pub trait GeneratingFunction {
    /// The group the map lives on.
    type Group: LieGroup;
    /// The chart whose canonical coordinates (x, p) are meant.
    type Chart: Chart<Self::Group>;

    /// The group.
    fn group(&self) -> &Self::Group;

    /// The chart; charts carry no data.
    #[inline(always)]
    fn chart(&self) -> Self::Chart {
        Self::Chart::default()
    }

    /// S(p).
    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self>;

    /// x = ∂S/∂p(p).
    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self>;

    /// ∂S/∂p and the full Hessian ∂²S/∂p² at p.
    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>);

    /// A first guess of the p with J_L(∂S/∂p(p), p) = μ; better guesses save Newton steps.
    #[inline(always)]
    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        mu.clone()
    }

    /// The exact gradient and a Hessian good enough for Newton's method, which may leave out
    /// terms too small to matter there. See [`GeneratingFunction::hessian_defect`].
    #[inline(always)]
    fn newton_model(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        self.gradient_and_hessian(p)
    }

    /// How strongly ∂S/∂p bends: about ‖S‴‖ |p| / (4 ‖Hess S‖), given the largest coordinate of
    /// x = ∂S/∂p. The solver weighs with it what Newton's method leaves; 1 is safe for polynomials
    /// of moderate degree. For the flow of a quadratic Hamiltonian S is quadratic up to terms
    /// smaller by |x|²/12, so a quarter of |x|² is ample there.
    #[inline(always)]
    fn bend(&self, x: ScalarOf<Self>) -> ScalarOf<Self> {
        let _ = x;
        crate::scalar::Scalar::of(1.0)
    }

    /// A bound on ‖Hess S − H‖ (row sums) for the H of [`GeneratingFunction::newton_model`], at
    /// momenta of Euclidean norm `size`. The solver counts it as residual left.
    #[inline(always)]
    fn hessian_defect(&self, size: ScalarOf<Self>) -> ScalarOf<Self> {
        let _ = size;
        crate::scalar::Scalar::of(0.0)
    }
}
