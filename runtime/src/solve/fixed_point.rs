//! The fixed point p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), for groups of many dimensions.

use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};

use super::{MAX_EVALUATIONS, Solution, Solver, Yardstick, failure};
use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::scalar::Scalar;

/// How many earlier differences the acceleration looks at.
const WINDOW: usize = 3;

/// Below this share of its own length a difference is a combination of the newer ones.
const INDEPENDENT: f64 = 1e-20;

/// [`solve`](super::solve) by [`Solver::FixedPoint`].
///
/// With f(p) = (d^R τ_x)ᵀ μ − p, Anderson's acceleration (H. Walker and P. Ni, SIAM J. Numer.
/// Anal. 49, 2011, 1715) goes from p to p + f − Σ γⱼ (Δpⱼ + Δfⱼ), γ minimising |f − Σ γⱼ Δfⱼ| over
/// the last few differences: GMRES where f is linear. The least squares go by orthogonalisation,
/// newest difference first, in pairs, so that no coefficients need to be solved for.
#[inline(always)]
pub fn fixed_point<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let (group, chart) = (generating.group(), generating.chart());
    let dim = mu.dim();
    let (zero, one) = (ScalarOf::<S>::of(0.0), ScalarOf::<S>::of(1.0));

    let Yardstick { inverse_scale, tolerance, .. } = Yardstick::of(mu);
    // Rounding of many coordinates may stay above that: then it no longer halves.
    let rounding = ScalarOf::<S>::of(32.0) * ScalarOf::<S>::epsilon();
    let half = ScalarOf::<S>::of(0.5);

    let mut p = guess;
    let mut solved = (p.clone(), mu.clone());
    let mut remaining = one;
    // 1 in lanes that go on, 0 in those that are done.
    let mut open = one;
    let mut last = (p.clone(), p.clone());
    // Pairs Δf, Δp + Δf, the newest first.
    let mut differences: [_; WINDOW] = core::array::from_fn(|_| (p.clone(), p.clone()));
    for iteration in 0..MAX_EVALUATIONS {
        let x = generating.gradient(&p);
        let f = chart.pull_back(group, &x, mu);
        let f = VectorOf::<S>::from_entries(dim, |i| f[i] - p[i]);

        let left = f.largest_entry() * inverse_scale;
        let was_open = open.simd_gt(half);
        solved = (
            VectorOf::<S>::from_entries(dim, |i| p[i].select(was_open, solved.0[i])),
            VectorOf::<S>::from_entries(dim, |i| x[i].select(was_open, solved.1[i])),
        );
        let stalled = left.simd_gt(half * remaining);
        let enough = rounding.select(stalled, tolerance);
        open = zero.select(left.simd_le(enough), open);
        remaining = left.select(was_open, remaining);
        if open.simd_le(half).all() {
            let (p, x) = solved;
            return Ok(Solution { p, x, iterations: iteration + 1, residual: remaining });
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
    Err(failure(Solver::FixedPoint, mu, MAX_EVALUATIONS, remaining))
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
