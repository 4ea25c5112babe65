//! The one interface everything meets at: a generating function S(p) on 𝔤\*.

use nalgebra::{SimdComplexField, SimdValue};

use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::group::LieGroup;
use crate::scalar::Scalar;
use crate::solve::Solver;
use crate::wide::Steps;

/// The number type of a generating function's group.
pub type ScalarOf<S> = <<S as GeneratingFunction>::Group as LieGroup>::Scalar;
/// Coordinate vectors of a generating function's group.
pub type VectorOf<S> = <<S as GeneratingFunction>::Group as LieGroup>::Vector;
/// Square matrices of a generating function's group.
pub type MatrixOf<S> = <VectorOf<S> as Coordinates<ScalarOf<S>>>::Matrix;

/// Steps of which the fine parts of the gradient are taken at once
/// ([`GeneratingFunction::fine_gradients`]).
pub const AHEAD: usize = 4;

/// What [`GeneratingFunction::linearise`] finds.
pub type LinearisedOf<S> = Linearised<VectorOf<S>, MatrixOf<S>, ScalarOf<S>>;

/// Steps that are linearised at once ([`GeneratingFunction::linearise`]): as many as a register of the build
/// target has lanes.
pub const AT_ONCE: usize = <Steps as SimdValue>::LANES;

/// The equations x = ∂S/∂p(P(x, μ)), P(x, μ) = (d^R τ_x)ᵀ μ, of several steps, linearised about guesses of
/// their x and μ: the solution for another μ is x + J·(P(x, μ − start) + shift), up to second order.
///
/// The vectors' and the matrices' type, and that of their numbers.
#[derive(Clone, Debug)]
pub struct Linearised<V, M, T> {
    /// The guessed momentum before each step.
    pub start: [V; AT_ONCE],
    /// The solution for it, up to second order and to what `shift` brings.
    pub x: [V; AT_ONCE],
    /// How far p = P(x, start) is from where the gradient of S was taken; zero if `x` counts that already.
    pub shift: [V; AT_ONCE],
    /// How far that is from the guess: the largest difference of an entry.
    pub correction: [T; AT_ONCE],
    /// J = (1 − H·∂P/∂x)⁻¹ H with H the Hessian of the coarse part.
    pub response: [M; AT_ONCE],
    /// How much the fine part of the gradient changes with p: the largest |δ fine| / |δp| from one step
    /// to the next.
    pub slope: T,
}

impl<V: Coordinates<T>, T: Scalar> Linearised<V, V::Matrix, T> {
    /// Zeros throughout, to be filled.
    #[must_use]
    pub fn zeros(dim: usize) -> Self {
        let zero = T::of(0.0);
        Self {
            start: core::array::from_fn(|_| V::zeros(dim)),
            x: core::array::from_fn(|_| V::zeros(dim)),
            shift: core::array::from_fn(|_| V::zeros(dim)),
            correction: [zero; AT_ONCE],
            response: core::array::from_fn(|_| V::zero_matrix(dim)),
            slope: zero,
        }
    }
}

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

    /// How steps solve for p. [`MatrixFree`](crate::MatrixFree) chooses
    /// [`Solver::FixedPoint`] for any function.
    const SOLVER: Solver = Solver::Newton;

    /// Whether [`GeneratingFunction::in_parts`] may hold; where it may not, nothing of such steps is compiled.
    const IN_PARTS: bool = false;

    /// Whether [`GeneratingFunction::linearise`] may find anything.
    const LINEARISES: bool = false;

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
    ///
    /// The default takes the Hessian by central differences of the gradient, to about 1e-10: give
    /// the exact one where steps go by Newton's method.
    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        (self.gradient(p), hessian_by_differences(self, p))
    }

    /// A first guess of the x of a step from μ; `None` where there is no better one than zero.
    #[inline(always)]
    fn predict_increment(&self, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        let _ = mu;
        None
    }

    /// A first guess of the p with J_L(∂S/∂p(p), p) = μ, (d^R τ_x)ᵀ μ with the x of
    /// [`GeneratingFunction::predict_increment`] if not given; better guesses save Newton steps.
    #[inline(always)]
    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        match self.predict_increment(mu) {
            Some(x) => self.chart().pull_back(self.group(), &x, mu),
            None => mu.clone(),
        }
    }

    /// The same where `last` is the p of the step that has led to μ.
    ///
    /// That step run backwards leads from μ through the same p, so that with p = P(μ, h) also
    /// `last` = P(μ, −h): the part of P that is odd in h need not be computed, and twice the even
    /// part less `last` is a better guess at half the cost.
    #[inline(always)]
    fn predict_after(&self, last: &VectorOf<Self>, mu: &VectorOf<Self>) -> VectorOf<Self> {
        let _ = last;
        self.predict(mu)
    }

    /// Where S generates the motion in a comoving frame, the frame's own motion y in one step: a step
    /// is the map of S, then (g, μ) ↦ (g·exp y, Ad\*_{exp(y)⁻¹} μ) with y of that μ, for part 0 of
    /// the frame's motion, then part 1, … up to the first `None`. `None` for part 0: S generates the
    /// whole step.
    ///
    /// All these maps must commute and each y be an integral of its own, as with the flows of H − f
    /// and f where f is a function of an integral ⟨μ, e⟩, or a Casimir: then the frame goes the way of
    /// many steps at once.
    #[inline(always)]
    fn frame(&self, part: usize, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        let _ = (part, mu);
        None
    }

    /// The exact gradient and a Hessian good enough for Newton's method, which may leave out
    /// terms too small to matter there. See [`GeneratingFunction::hessian_defect`].
    #[inline(always)]
    fn newton_model(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        self.gradient_and_hessian(p)
    }

    /// Whether steps go by the gradient in two parts, without matrices, as is better in more than three
    /// dimensions: ∂S/∂p = coarse + fine, where the fine part matters little and takes most of the work.
    #[inline(always)]
    fn in_parts(&self) -> bool {
        Self::IN_PARTS
    }

    /// The coarse part of ∂S/∂p(p).
    #[inline(always)]
    fn coarse_gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        self.gradient(p)
    }

    /// The fine part of ∂S/∂p(p), the gradient less its coarse part. Where there are parts,
    /// [`GeneratingFunction::hessian_defect`] bounds its derivative.
    #[inline(always)]
    fn fine_gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        VectorOf::<Self>::zeros(p.dim())
    }

    /// The fine part at several points, those of steps to come.
    #[inline(always)]
    fn fine_gradients(&self, p: &[VectorOf<Self>; AHEAD]) -> [VectorOf<Self>; AHEAD] {
        core::array::from_fn(|k| self.fine_gradient(&p[k]))
    }

    /// The product of the Hessian of S₁ (the leading order in the step size) with `direction`.
    #[inline(always)]
    fn leading_product(&self, p: &VectorOf<Self>, direction: &VectorOf<Self>) -> VectorOf<Self> {
        direction.left_multiply(&self.newton_model(p).1)
    }

    /// Linearises the next steps from `mu` at once: in the lanes of one number that costs little more than one
    /// step. They are guessed by following the flow in so many pieces (for every four of them): the more, the
    /// better, and the more work. `false` where this cannot be, or does not pay.
    #[inline(always)]
    fn linearise(&self, mu: &VectorOf<Self>, pieces: u32, found: &mut LinearisedOf<Self>) -> bool {
        let _ = (mu, pieces, found);
        false
    }

    /// Once more, with the same J: takes the gradient of S at P(x, start), given `found` with an x for each
    /// `start`, and leaves that gradient in `x` and the `shift` that it brings. `false` where
    /// that cannot be: steps for which one J is not enough then go one by one.
    #[inline(always)]
    fn refine(&self, found: &mut LinearisedOf<Self>) -> bool {
        let _ = found;
        false
    }

    /// How strongly ∂S/∂p bends: about ‖S‴‖ |p| / (4 ‖Hess S‖), given the largest coordinate of
    /// x = ∂S/∂p. The solver weighs with it what Newton's method leaves; 1 is safe for polynomials
    /// of moderate degree. For the flow of a quadratic Hamiltonian S is quadratic up to terms
    /// smaller by |x|²/12, so a quarter of |x|² is ample there.
    #[inline(always)]
    fn bend(&self, x: ScalarOf<Self>) -> ScalarOf<Self> {
        let _ = x;
        Scalar::of(1.0)
    }

    /// A bound on ‖Hess S − H‖ (row sums) for the H of [`GeneratingFunction::newton_model`], at
    /// momenta of Euclidean norm `size`. The solver counts it as residual left.
    #[inline(always)]
    fn hessian_defect(&self, size: ScalarOf<Self>) -> ScalarOf<Self> {
        let _ = size;
        Scalar::of(0.0)
    }
}

/// ∂²S/∂p² at p by central differences of the gradient.
pub fn hessian_by_differences<S: GeneratingFunction + ?Sized>(
    generating: &S,
    p: &VectorOf<S>,
) -> MatrixOf<S> {
    let dim = p.dim();
    // The third root of rounding balances both errors.
    let spacing =
        (p.largest_entry() + ScalarOf::<S>::of(1e-3)) * ScalarOf::<S>::epsilon().simd_cbrt();
    let factor = ScalarOf::<S>::of(0.5) / spacing;
    let mut hessian = VectorOf::<S>::zero_matrix(dim);
    for j in 0..dim {
        let shifted = |by| {
            let mut shifted = p.clone();
            shifted[j] += by;
            generating.gradient(&shifted)
        };
        let (right, left) = (shifted(spacing), shifted(-spacing));
        for i in 0..dim {
            hessian[(i, j)] = (right[i] - left[i]) * factor;
        }
    }
    hessian
}
