//! Newton's method, for groups of few dimensions.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::{Candidate, CandidateOf, Method, NEAR, Settings, Yardstick};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Newton iterations allowed before the solver gives up.
pub const MAX_ITERATIONS: u32 = 20;

/// Steps with the same factors, before the Hessian is taken anew.
const CHORDS: u32 = 4;

/// First guesses for the solve of a step; every method starts from one.
pub trait Predict: GeneratingFunction {
    /// A first guess of the x of a step from μ, if there is a better one than ∂S/∂p(μ).
    #[inline(always)]
    fn predict_increment(&self, mu: &VectorOf<Self>) -> Option<VectorOf<Self>> {
        let _ = mu;
        None
    }

    /// A first guess of the p with J_L(∂S/∂p(p), p) = μ; better guesses save corrections. If not given,
    /// (d^R τ_x)ᵀ μ with the x of [`Predict::predict_increment`], or with ∂S/∂p(μ).
    #[inline(always)]
    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        let x = self.predict_increment(mu).unwrap_or_else(|| self.gradient(mu));
        Self::Chart::default().pull_back(self.group(), &x, mu)
    }

    /// The same where `last` is the p of the step that has led to μ.
    ///
    /// That step run backwards leads from μ through the same p, so that with p = P(μ, h) also
    /// `last` = P(μ, −h): what of P is odd in h need not be computed, and twice the even
    /// half less `last` is a better guess at half the cost.
    #[inline(always)]
    fn predict_after(&self, last: &VectorOf<Self>, mu: &VectorOf<Self>) -> VectorOf<Self> {
        let _ = last;
        self.predict(mu)
    }
}

/// What Newton's method asks of a generating function beyond its gradient.
pub trait NewtonModel: GeneratingFunction {
    /// The exact gradient and a Hessian good enough for Newton's method, which may leave out
    /// terms too small to matter there. See [`NewtonModel::hessian_defect`].
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
        Scalar::of(1.0)
    }

    /// A bound on ‖Hess S − H‖ (row sums) for the H of [`NewtonModel::newton_model`], at
    /// momenta of Euclidean norm `size`. The solver counts it as residual left.
    #[inline(always)]
    fn hessian_defect(&self, size: ScalarOf<Self>) -> ScalarOf<Self> {
        let _ = size;
        Scalar::of(0.0)
    }
}

/// Newton's method with dense matrices: one to three iterations, each with the Hessian of S and a linear system.
///
/// The first step takes a Hessian; the next ones are chord steps, which keep its factors and need
/// only the gradient. Near the solution a chord step gains as many digits as the step before it.
#[derive(Clone, Debug)]
pub struct Newton<S: GeneratingFunction + ?Sized> {
    /// The p of the step before.
    last: Option<VectorOf<S>>,
}

impl<S: NewtonModel + Predict + ?Sized> Method<S> for Newton<S> {
    #[inline(always)]
    fn begin(_: &S) -> Self {
        Self { last: None }
    }

    #[inline(always)]
    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        _left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        let guess = match &self.last {
            Some(last) => generating.predict_after(last, mu),
            None => generating.predict(mu),
        };
        let (candidate, p) = newton(generating, mu, guess, settings);
        self.last = Some(p);
        candidate
    }

    #[inline(always)]
    fn forget(&mut self) {
        self.last = None;
    }

    #[inline(always)]
    fn propose_from(
        generating: &S,
        mu: &VectorOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        newton(generating, mu, guess, settings).0
    }

    fn propose_scaled(
        generating: &S,
        mu: &VectorOf<S>,
        scale: ScalarOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        careful_newton(generating, mu, scale, guess, settings)
    }
}

/// A step by Newton's method from this guess, and its p.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn newton<S: NewtonModel + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> (CandidateOf<S>, VectorOf<S>) {
    let group = generating.group();
    let chart = S::Chart::default();
    let dim = group.dim();
    let (zero, one) = (ScalarOf::<S>::of(0.0), ScalarOf::<S>::of(1.0));
    let near = ScalarOf::<S>::of(NEAR);

    let yardstick = Yardstick::of(mu, settings);
    let Yardstick { smallest, scale, inverse_scale, tolerance } = yardstick;

    let half = ScalarOf::<S>::of(0.5);
    let half_defect = half * scale * generating.hessian_defect(mu.pairing(mu).simd_sqrt());

    let mut p = guess;
    let mut solved = (p.clone(), mu.clone());
    let mut remaining = one;
    let mut way = zero;
    let mut iterations = 0;
    'solving: while iterations < MAX_ITERATIONS {
        let (mut x, hessian) = generating.newton_model(&p);
        let (mut pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
        let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
        let factors = VectorOf::<S>::factor(dim, jacobian);
        // How far the model of this Newton step is off, where p and x move by the steps below.
        let mut stretched = zero;
        let mut bent = zero;
        let mut previous = one;
        for chord in 0..CHORDS {
            iterations += 1;
            let residual = p.clone().minus(&pulled);
            let correction = VectorOf::<S>::solve(&factors, residual);
            let shift = correction.left_multiply(&hessian);
            let next = p.minus(&correction);
            // x moves linearly with p; what that leaves out is of the order of what Newton leaves.
            let moved = x.clone().minus(&shift);

            let relative = correction.largest_entry() * inverse_scale;
            let stretch = shift.largest_entry();
            let bend = generating.bend(x.largest_entry()) * relative;
            // A step leaves F″(step before + ½ this step, this step): about |μ| |δx|²/3 from the
            // chart, |D| |S‴ δp δp| from S with |D| ≈ |μ|/2, and, where the Hessian is not the
            // whole one, D·(Hess S − H)·δp.
            let curved = stretched + half * stretch + bent + bend;
            let bound = stretch * curved + half_defect * relative;
            let left = yardstick.left(bound, relative, (chord > 0).then_some(previous));
            previous = relative + smallest;
            let way_now = way + relative;
            if <ScalarOf<S> as SimdValue>::LANES == 1 {
                // One lane alone is open, or this would have ended; to select would only be to wait.
                (solved, remaining, way) = ((next.clone(), moved), left, way_now);
            } else {
                let was_open = remaining.simd_gt(tolerance);
                solved =
                    (next.clone().select(was_open, &solved.0), moved.select(was_open, &solved.1));
                remaining = left.select(was_open, remaining);
                way = way_now.select(was_open, way);
            }
            // What is far from its guess is not going to be accepted; what is not a number neither.
            let open = remaining.simd_gt(tolerance) & way.simd_le(near);
            if open.none() {
                break 'solving;
            }
            p = next;
            if chord + 1 < CHORDS {
                stretched += stretch;
                bent += bend + bend;
                x = generating.gradient(&p);
                pulled = chart.pull_back(group, &x, mu);
            }
        }
    }
    let (p, x) = solved;
    (Candidate { x, moved: way, residual: remaining, iterations }, p)
}

/// Corrections of the careful method at most.
const CAREFUL: u32 = 12;

/// The solution for s·S from this guess, each correction with a Hessian of its own and no larger than a quarter of the one
/// before it; what is left is measured.
pub(super) fn careful_newton<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: ScalarOf<S>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let group = generating.group();
    let chart = S::Chart::default();
    let dim = group.dim();
    let (quarter, none) = (ScalarOf::<S>::of(0.25), ScalarOf::<S>::of(f64::MAX));
    let yardstick = Yardstick::of(mu, settings);
    // Rounding of many coordinates may stay above the tolerance: then corrections no longer shrink.
    let rounding = ScalarOf::<S>::of(2.0 * dim as f64) * ScalarOf::<S>::epsilon();
    let rounding = rounding.simd_max(yardstick.tolerance);

    let mut p = guess;
    let mut way = ScalarOf::<S>::of(0.0);
    let mut previous = none;
    for iteration in 1..=CAREFUL {
        let (x, hessian) = generating.gradient_and_hessian(&p);
        let x = VectorOf::<S>::from_entries(dim, |i| scale * x[i]);
        let hessian = VectorOf::<S>::matrix_from_entries(dim, |i, j| scale * hessian[(i, j)]);
        let (pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        let residual = p.clone().minus(&pulled);
        let size = residual.largest_entry() * yardstick.inverse_scale;
        let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
        let correction = VectorOf::<S>::solve(&VectorOf::<S>::factor(dim, jacobian), residual);
        let relative = correction.largest_entry() * yardstick.inverse_scale;
        let done = size.simd_le(yardstick.tolerance) & relative.simd_le(rounding)
            | size.simd_le(rounding)
                & relative.simd_le(rounding)
                & relative.simd_ge(quarter * previous);
        if done.all() {
            let residual = size.simd_min(yardstick.tolerance);
            return Candidate { x, moved: way, residual, iterations: iteration };
        }
        if !relative.simd_le((quarter * previous).simd_max(rounding)).all() {
            break;
        }
        way += relative;
        p = p.minus(&correction);
        previous = relative;
    }
    Candidate { x: mu.clone(), moved: none, residual: none, iterations: CAREFUL }
}
