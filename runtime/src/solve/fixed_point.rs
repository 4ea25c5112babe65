//! The fixed point p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), for groups of many dimensions.

use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};

use super::{Candidate, CandidateOf, Method, NEAR, Predict, Settings, Yardstick};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Evaluations of the fixed point allowed before the solver gives up.
pub const MAX_EVALUATIONS: u32 = 60;

/// How many earlier differences the acceleration looks at.
const WINDOW: usize = 3;

/// Below this share of its own length a difference is a combination of the newer ones.
const INDEPENDENT: f64 = 1e-20;

/// The fixed point with Anderson's acceleration: more iterations than Newton's method, each with the gradient of S alone
/// and work linear in the dimension. Contracts for about h|Ω| < 1.
///
/// With f(p) = (d^R τ_x)ᵀ μ − p, Anderson's acceleration (H. Walker and P. Ni, SIAM J. Numer.
/// Anal. 49, 2011, 1715) goes from p to p + f − Σ γⱼ (Δpⱼ + Δfⱼ), γ minimising |f − Σ γⱼ Δfⱼ| over
/// the last few differences: GMRES where f is linear. The least squares go by orthogonalisation,
/// newest difference first, in pairs, so that no coefficients need to be solved for.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint;

impl<S: Predict + ?Sized> Method<S> for FixedPoint {
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
        fixed_point(generating, mu, None, generating.predict(mu), settings)
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
        fixed_point(generating, mu, None, guess, settings)
    }

    fn propose_scaled(
        generating: &S,
        mu: &VectorOf<S>,
        scale: ScalarOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        fixed_point(generating, mu, Some(scale), guess, settings)
    }
}

/// A step by the fixed point from this guess, of a multiple of S where a scale is given.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed_point<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: Option<ScalarOf<S>>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let (group, chart) = (generating.group(), S::Chart::default());
    let dim = mu.dim();
    let (zero, one) = (ScalarOf::<S>::of(0.0), ScalarOf::<S>::of(1.0));
    let near = ScalarOf::<S>::of(NEAR);

    let Yardstick { inverse_scale, tolerance, .. } = Yardstick::of(mu, settings);
    // Rounding of many coordinates may stay above that: then it no longer halves.
    let rounding = ScalarOf::<S>::of((4.0 * dim as f64).min(32.0)) * ScalarOf::<S>::epsilon();
    let half = ScalarOf::<S>::of(0.5);

    let mut p = guess.clone();
    let mut x_solved = mu.clone();
    let mut remaining = one;
    let mut way = zero;
    // 1 in lanes that go on, 0 in those that are done.
    let mut open = one;
    let mut last = (p.clone(), p.clone());
    // Pairs Δf, Δp + Δf, the newest first.
    let mut differences: [_; WINDOW] = core::array::from_fn(|_| (p.clone(), p.clone()));
    let mut iterations = 0;
    for iteration in 0..MAX_EVALUATIONS {
        iterations = iteration + 1;
        let mut x = generating.gradient(&p);
        if let Some(scale) = scale {
            x = VectorOf::<S>::from_entries(dim, |i| x[i] * scale);
        }
        let f = chart.pull_back(group, &x, mu);
        let f = VectorOf::<S>::from_entries(dim, |i| f[i] - p[i]);

        let left = f.largest_entry() * inverse_scale;
        let gone = p.clone().minus(&guess).largest_entry() * inverse_scale;
        let was_open = open.simd_gt(half);
        x_solved = x.select(was_open, &x_solved);
        way = gone.select(was_open, way);
        let stalled = left.simd_gt(half * remaining);
        let enough = rounding.simd_max(tolerance).select(stalled, tolerance);
        // Stalled at rounding is solved as well as it can be.
        let done = left.simd_le(enough);
        let left = left.simd_min(tolerance).select(done, left);
        // What is far from its guess is not going to be accepted; what is not a number neither.
        let goes_on = gone.simd_le(near) & left.simd_le(ScalarOf::<S>::of(f64::MAX));
        open = zero.select(done, open.select(goes_on, zero));
        remaining = left.select(was_open, remaining);
        if open.simd_le(half).all() {
            break;
        }

        let known = WINDOW.min(iteration as usize);
        if known > 0 {
            differences.rotate_right(1);
            let df = VectorOf::<S>::from_entries(dim, |i| f[i] - last.1[i]);
            let both = VectorOf::<S>::from_entries(dim, |i| p[i] - last.0[i] + df[i]);
            differences[0] = (df, both);
        }
        let next = p.clone().plus(&f);
        let next = accelerate(dim, &f, next, &differences[..known]);
        last = (p, f);
        p = next;
    }
    Candidate { x: x_solved, moved: way, residual: remaining, iterations }
}

/// Subtracts from `next` = p + f what the differences predict of f.
#[inline(always)]
fn accelerate<T: Scalar, V: Coordinates<T>>(
    dim: usize,
    f: &V,
    mut next: V,
    differences: &[(V, V)],
) -> V {
    let mut rest = f.clone();
    let mut pairs: [Option<(V, V, T)>; WINDOW] = core::array::from_fn(|_| None);
    for (at, (df, both)) in differences.iter().enumerate() {
        let (mut df, mut both) = (df.clone(), both.clone());
        let threshold = df.pairing(&df) * T::of(INDEPENDENT);
        for (newer_df, newer_both, inverse) in pairs.iter().flatten() {
            let share = newer_df.pairing(&df) * *inverse;
            df = V::from_entries(dim, |i| df[i] - share * newer_df[i]);
            both = V::from_entries(dim, |i| both[i] - share * newer_both[i]);
        }
        let square = df.pairing(&df);
        let inverse = (T::of(1.0) / square).select(square.simd_gt(threshold), T::of(0.0));
        let share = df.pairing(&rest) * inverse;
        rest = V::from_entries(dim, |i| rest[i] - share * df[i]);
        next = V::from_entries(dim, |i| next[i] - share * both[i]);
        if let Some(place) = pairs.get_mut(at) {
            *place = Some((df, both, inverse));
        }
    }
    next
}
