//! A quasi-Newton method without matrices and with few gradients: most of the gradient is taken once and lags behind.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::newton::{careful_newton, newton};
use super::{Candidate, CandidateOf, Method, NewtonModel, Predict, Settings, Yardstick};
use crate::chart::{Chart, half_turn};
use crate::generating::{ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Fine gradients taken, and corrections with the same one, before Newton's method takes over.
const FINE_GRADIENTS: u32 = 4;
const CORRECTIONS: usize = 8;

/// A gradient that is a sum, ∂S/∂p = coarse + fine, where the fine gradient matters little and takes most of the work.
pub trait LaggedModel: NewtonModel + Predict {
    /// The coarse gradient at p.
    fn coarse_gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self>;

    /// The fine gradient at p, ∂S/∂p less the coarse one; [`NewtonModel::hessian_defect`] bounds its derivative.
    fn fine_gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self>;

    /// The product of the Hessian of S₁ (the leading order in the step size) at p with `direction`.
    fn leading_product(&self, p: &VectorOf<Self>, direction: &VectorOf<Self>) -> VectorOf<Self>;
}

/// The fine gradient changes so little that its value at the first guess p₀ will do:
/// x = coarse(P(x)) + fine(p₀), P(x) = (d^R τ_x)ᵀ μ, is solved by corrections of x by its
/// residual in this equation and the first terms of Neumann's series in H·∂P/∂x, about h|Ω|/2, with H the
/// Hessian of S₁; ∂P/∂x by [`Chart::pull_back_change`] in the first, ½ ad\*_v p₀ in the smaller ones. A correction gains
/// two to three digits at h|Ω| = 0.4. Elimination would wait for divisions and for itself, and matrices
/// go through memory: on SE(3) that takes longer than polynomials do. Where corrections gain little, [`Newton`](super::Newton)'s
/// method takes over.
#[derive(Clone, Copy, Debug)]
pub struct LaggedNewton;

impl<S: LaggedModel + ?Sized> Method<S> for LaggedNewton {
    #[inline(always)]
    fn begin(_: &S) -> Self {
        Self
    }

    #[inline(always)]
    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        _left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        lagged_newton(generating, mu, Start::predicted(generating, mu), settings)
    }

    #[inline(always)]
    fn forget(&mut self) {}

    #[inline(always)]
    fn propose_from(
        generating: &S,
        mu: &VectorOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        lagged_newton(generating, mu, Start { p: guess, x: None }, settings)
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

/// Where the solve starts.
#[derive(Clone, Debug)]
struct Start<V> {
    /// A first guess of p.
    p: V,
    /// The x from which p was had, p = (d^R τ_x)ᵀ μ, where it was had so.
    x: Option<V>,
}

impl<V> Start<V> {
    /// The guess that `generating` makes from μ.
    #[inline(always)]
    fn predicted<S>(generating: &S, mu: &V) -> Self
    where
        S: LaggedModel + ?Sized,
        S::Group: LieGroup<Vector = V>,
    {
        let x = generating.predict_increment(mu);
        let p = match &x {
            Some(x) => S::Chart::default().pull_back(generating.group(), x, mu),
            None => generating.predict(mu),
        };
        Self { p, x }
    }
}

/// A step by [`LaggedNewton`].
#[cfg_attr(not(debug_assertions), inline(always))]
fn lagged_newton<S: LaggedModel + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    start: Start<VectorOf<S>>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let (group, chart) = (generating.group(), S::Chart::default());
    let dim = mu.dim();
    let (zero, half) = (ScalarOf::<S>::of(0.0), ScalarOf::<S>::of(0.5));

    let yardstick = Yardstick::of(mu, settings);
    let Yardstick { smallest, scale, inverse_scale, tolerance } = yardstick;
    // Corrections are cheap: they leave less than rounding does.
    let rounding = half * ScalarOf::<S>::epsilon();

    let Start { p: guess, x: known } = start;
    let mut settled = known.is_some();
    let mut fine = generating.fine_gradient(&guess);
    // D times the derivative of the fine gradient, |D| ≈ |μ|/2. Of the bound on it, which adds up the monomials'
    // largest values, a quarter: it was found 2 to 60 times too large (tops, bodies in a fluid).
    let derivative = half * half * generating.hessian_defect(mu.pairing(mu).simd_sqrt());
    let defect = half * scale * derivative;
    let mut base = guess.clone();
    let mut solved = known.unwrap_or_else(|| generating.coarse_gradient(&base).plus(&fine));
    let mut remaining = ScalarOf::<S>::of(1.0);
    let mut previous = remaining;
    let mut way = zero;
    // The lanes that go on, and those in which corrections gain little. Masks, so that one lane alone
    // waits for none.
    let mut open = zero.simd_le(zero);
    let mut failed = zero.simd_gt(zero);
    for iteration in 1..=FINE_GRADIENTS {
        // H·v and, about, ∂P/∂x·v.
        let leading = |v: &VectorOf<S>| generating.leading_product(&base, v);
        let turn = |v: &VectorOf<S>| half_turn(group, &base, v);
        let gradient = |p: &VectorOf<S>| generating.coarse_gradient(p).plus(&fine);
        let mut x = solved.clone();
        let mut p = base.clone();
        let mut relative = zero;
        let mut before = zero;
        let mut correcting = open;
        for number in 0..CORRECTIONS {
            let pulled = match settled && number == 0 {
                true => base.clone(),
                false => chart.pull_back(group, &x, mu),
            };
            let residual = gradient(&pulled).minus(&x);
            let turned = chart.pull_back_change(group, &x, mu, &pulled, &residual);
            let first = leading(&turned);
            let second = leading(&turn(&first));
            let third = leading(&turn(&second));
            let next = VectorOf::<S>::from_entries(dim, |i| {
                x[i] + (residual[i] + (first[i] + (second[i] + third[i])))
            });
            x = next.select(correcting, &x);
            let next = pulled.plus(&turned);
            p = next.select(correcting, &p);
            relative = p.clone().minus(&base).largest_entry() * inverse_scale;

            let size = turned.largest_entry() * inverse_scale;
            // What another fine gradient will mend need not be mended here.
            let left = defect * relative;
            let mended = left * ScalarOf::<S>::of(0.01);
            let least = mended.simd_max(rounding).select(left.simd_gt(tolerance), rounding);
            // What the corrections leave shrinks as they do; not a number is not smaller either.
            let enough = if number == 0 {
                // What `pull_back_change` leaves out, Neumann's fourth term, and the Hessian of S₃.
                let half_angle = half * x.pairing(&x).simd_sqrt();
                let order = <S::Chart as Chart<S::Group>>::CHANGE_ORDER;
                let gain = (1..order).fold(half_angle, |gain, _| gain * half_angle) * half_angle;
                (size * gain).simd_le(least)
            } else {
                let slow = !(ScalarOf::<S>::of(3.0) * size).simd_le(before);
                let done = size.simd_le(tolerance.simd_max(least));
                failed = failed | (correcting & slow & !done);
                done | (size * size).simd_le(least * before)
            };
            correcting = correcting & !enough & !failed;
            if correcting.none() {
                break;
            }
            before = size;
        }
        failed = failed | correcting;

        let left = yardstick.left(defect * relative, relative, (iteration > 1).then_some(previous));
        previous = relative + smallest;
        way = (way + relative).select(open, way);
        solved = x.select(open, &solved);
        remaining = left.select(open, remaining);
        open = open & !remaining.simd_le(tolerance) & !failed;
        if open.none() {
            if failed.none() {
                return Candidate {
                    x: solved,
                    moved: way,
                    residual: remaining,
                    iterations: iteration,
                };
            }
            break;
        }
        base = chart.pull_back(group, &solved, mu);
        fine = once_more(generating, &base);
        settled = true;
    }
    failed = failed | open;
    let slow = slowly(generating, mu, guess, settings);
    Candidate {
        x: slow.x.select(failed, &solved),
        moved: slow.moved.select(failed, way),
        residual: slow.residual.select(failed, remaining),
        iterations: slow.iterations,
    }
}

/// The fine gradient, out of the way of what is fast.
#[cold]
#[inline(never)]
fn once_more<S: LaggedModel + ?Sized>(generating: &S, p: &VectorOf<S>) -> VectorOf<S> {
    generating.fine_gradient(p)
}

/// Newton's method with matrices, out of the way of what is fast.
#[cold]
#[inline(never)]
fn slowly<S: LaggedModel + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    newton(generating, mu, guess, settings).0
}
