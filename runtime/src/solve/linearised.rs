//! Newton's method without matrices, for more than a few dimensions.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::{Solution, Yardstick, newton};
use crate::chart::{Chart, half_turn};
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::scalar::Scalar;

/// Gradients of S taken, and corrections with the same gradient, before Newton's method takes over.
const GRADIENTS: u32 = 4;
const CORRECTIONS: usize = 8;

/// [`solve`](super::solve) by [`Solver::Newton`](super::Solver) where
/// [`GeneratingFunction::by_products`] says so.
///
/// Newton's step from p₀ solves x = ∂S/∂p(p₀) + H·(P(x) − p₀), P(x) = (d^R τ_x)ᵀ μ. Elimination would
/// wait for divisions and for itself, and matrices go through memory: on SE(3) that takes longer than
/// polynomials do. Here x is corrected by its residual in that equation, P being evaluated exactly, and by
/// the first terms of Neumann's series in H·∂P/∂x, about h|Ω|/2: ∂P/∂x by [`Chart::turn`] in the first,
/// ½ ad\*_v p₀ in the smaller ones. A correction gains two to three digits at h|Ω| = 0.4. Where they gain
/// little, it is left to Newton's method.
#[inline(always)]
pub fn linearised<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let (group, chart) = (generating.group(), generating.chart());
    let dim = mu.dim();
    let (zero, half) = (ScalarOf::<S>::of(0.0), ScalarOf::<S>::of(0.5));

    let yardstick = Yardstick::of(mu);
    let Yardstick { smallest, scale, inverse_scale, tolerance } = yardstick;
    // Corrections are cheap: they leave less than rounding does.
    let least = half * ScalarOf::<S>::epsilon();
    let half_defect = half * scale * generating.hessian_defect(mu.pairing(mu).simd_sqrt());

    let mut base = guess.clone();
    let mut solved = mu.clone();
    let mut remaining = ScalarOf::<S>::of(1.0);
    let mut previous = remaining;
    // The lanes that go on, and those in which corrections gain little. Masks, so that one lane alone
    // waits for none.
    let mut open = zero.simd_le(zero);
    let mut failed = zero.simd_gt(zero);
    for iteration in 1..=GRADIENTS {
        let gradient = generating.gradient(&base);
        // H·v and, about, H·∂P/∂x·v.
        let leading = |v: &VectorOf<S>| generating.leading_product(&base, v);
        let turn = |v: &VectorOf<S>| half_turn(group, &base, v);
        // From the second gradient on p₀ is P(x) for the x of the first.
        let mut x = if iteration == 1 { gradient.clone() } else { solved.clone() };
        let mut p = base.clone();
        let mut stretch = zero;
        let mut before = zero;
        let mut correcting = open;
        for number in 0..CORRECTIONS {
            let (pulled, shift) = if iteration > 1 && number == 0 {
                (base.clone(), VectorOf::<S>::zeros(dim))
            } else {
                let pulled = chart.pull_back(group, &x, mu);
                let moved = pulled.clone().minus(&base);
                let shift = generating.hessian_product(&base, &moved);
                (pulled, shift)
            };
            let residual = VectorOf::<S>::from_entries(dim, |i| gradient[i] + shift[i] - x[i]);
            let first = leading(&chart.turn(group, &x, mu, &base, &residual));
            let second = leading(&turn(&first));
            let third = leading(&turn(&second));
            let correction = VectorOf::<S>::from_entries(dim, |i| {
                residual[i] + (first[i] + (second[i] + third[i]))
            });
            let turned = chart.turn(group, &x, mu, &base, &correction);
            let next = VectorOf::<S>::from_entries(dim, |i| x[i] + correction[i]);
            x = next.select(correcting, &x);
            let next = VectorOf::<S>::from_entries(dim, |i| pulled[i] + turned[i]);
            p = next.select(correcting, &p);
            stretch = shift.largest_entry().select(correcting, stretch);

            let size = turned.largest_entry() * inverse_scale;
            // What the corrections leave shrinks as they do; not a number is not smaller either.
            let enough = if number == 0 {
                // What `turn` leaves out, and Neumann's fourth term.
                let half_angle = half * x.pairing(&x).simd_sqrt();
                let order = <S::Chart as Chart<S::Group>>::TURN_ORDER;
                let gain = (1..order).fold(half_angle, |gain, _| gain * half_angle) * half_angle;
                (size * gain).simd_le(least)
            } else {
                let slow = !(ScalarOf::<S>::of(3.0) * size).simd_le(before);
                let rounding = size.simd_le(tolerance);
                failed = failed | (correcting & slow & !rounding);
                rounding | (size * size).simd_le(least * before)
            };
            correcting = correcting & !enough & !failed;
            if correcting.none() {
                break;
            }
            before = size;
        }
        failed = failed | correcting;

        // What the linear model of ∂S/∂p leaves: D·(Hess S − H)·δp and |D| |S‴ δp δp| with |D| ≈ |μ|/2. Of
        // the bound on the first, which adds up the monomials' largest values, a quarter: it was found 2 to
        // 60 times too large (tops, bodies in a fluid).
        let relative = p.clone().minus(&base).largest_entry() * inverse_scale;
        let bend = generating.bend(x.largest_entry()) * relative;
        let bound = stretch * bend + half * half * half_defect * relative;
        let left = yardstick.left(bound, relative, (iteration > 1).then_some(previous));
        previous = relative + smallest;
        solved = x.select(open, &solved);
        remaining = left.select(open, remaining);
        open = open & !remaining.simd_le(tolerance) & !failed;
        if open.none() {
            if failed.none() {
                return Ok(Solution {
                    p: chart.pull_back(group, &solved, mu),
                    x: solved,
                    iterations: iteration,
                    residual: remaining,
                });
            }
            break;
        }
        base = p;
    }
    failed = failed | open;
    let slow = slowly(generating, mu, guess)?;
    let x = slow.x.select(failed, &solved);
    Ok(Solution {
        p: slow.p.select(failed, &chart.pull_back(group, &x, mu)),
        x,
        iterations: slow.iterations,
        residual: slow.residual.select(failed, remaining),
    })
}

/// Newton's method with matrices, out of the way of what is fast.
#[cold]
#[inline(never)]
fn slowly<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    newton::newton(generating, mu, guess)
}
