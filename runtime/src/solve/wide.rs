//! Several steps linearised at once, in the lanes of one number.

use core::any::Any;
use core::array::from_fn;

use nalgebra::{SMatrix, SVector, SimdPartialOrd, SimdValue};

use super::block::{BLOCK, Linearised};
use crate::linear::coordinates::Coordinates;
use crate::linear::response::response;
use crate::number::lift::Lift;
use crate::number::scalar::Scalar;

/// Whether registers are wide enough for several steps at once to be faster: by two numbers they would take
/// half as long again.
pub const LINEARISES: bool = cfg!(target_feature = "avx2");

/// As many numbers as a register of AVX2 holds, for steps that are solved at once.
pub type Steps = simba::simd::WideF64x4;

type V<T, const N: usize> = SVector<T, N>;
type M<T, const N: usize> = SMatrix<T, N, N>;

/// What a step evaluates, over numbers that may be wider than the coefficients.
pub trait WideStep<C, const SLOTS: usize, const N: usize> {
    /// The momentum so many steps later, about: by a method of order six.
    fn onwards<T: Scalar + Lift<C>>(c: &[C; SLOTS], mu: &V<T, N>, steps: T) -> V<T, N>;

    /// x of a step, and the momentum at its beginning, from that in its middle; about.
    fn around<T: Scalar + Lift<C>>(c: &[C; SLOTS], middle: &V<T, N>) -> [V<T, N>; 2];

    /// (d^R τ_x)ᵀ μ and its derivative in x.
    fn pulled_back<T: Scalar>(x: &V<T, N>, mu: &V<T, N>) -> (V<T, N>, M<T, N>);

    /// The coarse gradient, and its derivative.
    fn coarse<T: Scalar + Lift<C>>(c: &[C; SLOTS], p: &V<T, N>) -> (V<T, N>, M<T, N>);

    /// The fine gradient.
    fn fine<T: Scalar + Lift<C>>(c: &[C; SLOTS], p: &V<T, N>) -> V<T, N>;
}

/// The number of pieces is meant for so many steps; where there are more, so are the pieces.
const GROUP: usize = 4;

type Wide<const N: usize> = V<Steps, N>;
type WideMatrix<const N: usize> = M<Steps, N>;

/// What is found for numbers that are `f64`.
type Found<const N: usize> = Linearised<V<f64, N>, M<f64, N>, f64>;

/// Coefficients and what is found, where `C` is `f64`: decided when compiled, `Any` only tells the compiler so.
#[inline(always)]
fn numbers<'a, C: Scalar, const SLOTS: usize, const N: usize>(
    c: &'a [C; SLOTS],
    found: &'a mut Linearised<V<C, N>, M<C, N>, C>,
) -> Option<(&'a [f64; SLOTS], &'a mut Found<N>)> {
    Some(((c as &dyn Any).downcast_ref()?, (found as &mut dyn Any).downcast_mut()?))
}

/// [`BlockModel::linearise`](super::BlockModel::linearise) where numbers are `f64`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn linearise<C, P, const SLOTS: usize, const N: usize>(
    c: &[C; SLOTS],
    mu: &V<C, N>,
    pieces: u32,
    found: &mut Linearised<V<C, N>, M<C, N>, C>,
) -> bool
where
    C: Scalar,
    P: WideStep<f64, SLOTS, N>,
{
    let mu = (mu as &dyn Any).downcast_ref();
    let (Some(mu), Some((c, found))) = (mu, numbers(c, found)) else { return false };
    linearise_in_lanes::<P, SLOTS, N>(c, mu, pieces, found);
    true
}

/// The steps in the lanes of one number, however wide registers are.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn linearise_in_lanes<P, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    mu: &V<f64, N>,
    pieces: u32,
    found: &mut Found<N>,
) where
    P: WideStep<f64, SLOTS, N>,
{
    let zero = Wide::<N>::repeat(Steps::splat(0.0));
    let zeros = WideMatrix::<N>::repeat(Steps::splat(0.0));
    let mut middle = zero;
    middles::<P, SLOTS, N>(c, mu, pieces, &mut middle);
    let mut guess = [zero, zero];
    around::<P, SLOTS, N>(c, &middle, &mut guess);
    let [x, start] = &guess;
    let (mut pulled, mut coarse, mut fine) = ((zero, zeros), (zero, zeros), zero);
    pulled_back::<P, SLOTS, N>(x, start, &mut pulled);
    let (p, derivative) = &pulled;
    coarse_part::<P, SLOTS, N>(c, p, &mut coarse);
    fine_part::<P, SLOTS, N>(c, p, &mut fine);
    let residual = entries(|i| coarse.0[i] + (fine[i] - x[i]));
    let mut answer = (zeros, zero);
    respond(&coarse.1, derivative, &residual, &mut answer);
    let (response, correction) = &answer;

    found.slope = steepest(p, &fine);
    found.correction = correction.largest_entry().into();
    take(&entries(|i| x[i] + correction[i]), &mut found.x);
    found.shift = from_fn(|_| V::zeros());
    take(start, &mut found.start);
    for j in 0..N {
        let column: [[f64; BLOCK]; N] = from_fn(|i| response[(i, j)].into());
        for k in 0..BLOCK {
            for i in 0..N {
                found.response[k][(i, j)] = column[i][k];
            }
        }
    }
}

/// [`BlockModel::refine`](super::BlockModel::refine) where numbers are `f64`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn refine<C, P, const SLOTS: usize, const N: usize>(
    c: &[C; SLOTS],
    found: &mut Linearised<V<C, N>, M<C, N>, C>,
) -> bool
where
    C: Scalar,
    P: WideStep<f64, SLOTS, N>,
{
    let Some((c, found)) = numbers(c, found) else { return false };
    refine_in_lanes::<P, SLOTS, N>(c, found);
    true
}

/// The same in lanes, however wide registers are.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn refine_in_lanes<P, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    found: &mut Found<N>,
) where
    P: WideStep<f64, SLOTS, N>,
{
    let zero = Wide::<N>::repeat(Steps::splat(0.0));
    let (x, mu) = (side_by_side(&found.x), side_by_side(&found.start));
    let (mut before, mut after, mut gradient) = (zero, zero, zero);
    pulled::<P, SLOTS, N>(&x, &mu, &mut before);
    gradients::<P, SLOTS, N>(c, &before, &mut gradient);
    pulled::<P, SLOTS, N>(&gradient, &mu, &mut after);
    take(&gradient, &mut found.x);
    take(&entries(|i| after[i] - before[i]), &mut found.shift);
}

// Each a function of its own, for the compiler's sake, and without large values to return.

#[inline(never)]
fn middles<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    mu: &V<f64, N>,
    pieces: u32,
    found: &mut Wide<N>,
) {
    let pieces = pieces * BLOCK.div_ceil(GROUP) as u32;
    let share = 1.0 / f64::from(pieces);
    let piece = Steps::from(from_fn(|k| share * (k as f64 + 0.5)));
    *found = entries(|i| Steps::splat(mu[i]));
    for _ in 0..pieces {
        *found = P::onwards(c, found, piece);
    }
}

#[inline(never)]
fn around<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    middle: &Wide<N>,
    found: &mut [Wide<N>; 2],
) {
    *found = P::around(c, middle);
}

#[inline(never)]
fn pulled_back<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    x: &Wide<N>,
    mu: &Wide<N>,
    found: &mut (Wide<N>, WideMatrix<N>),
) {
    *found = P::pulled_back(x, mu);
}

#[inline(never)]
fn coarse_part<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    p: &Wide<N>,
    found: &mut (Wide<N>, WideMatrix<N>),
) {
    *found = P::coarse(c, p);
}

#[inline(never)]
fn fine_part<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    p: &Wide<N>,
    found: &mut Wide<N>,
) {
    *found = P::fine(c, p);
}

#[inline(never)]
fn pulled<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    x: &Wide<N>,
    mu: &Wide<N>,
    found: &mut Wide<N>,
) {
    *found = P::pulled_back(x, mu).0;
}

#[inline(never)]
fn gradients<P: WideStep<f64, SLOTS, N>, const SLOTS: usize, const N: usize>(
    c: &[f64; SLOTS],
    p: &Wide<N>,
    found: &mut Wide<N>,
) {
    // The Hessian is not asked for, and the compiler leaves it out.
    let (coarse, fine) = (P::coarse(c, p).0, P::fine(c, p));
    *found = entries(|i| coarse[i] + fine[i]);
}

#[inline(never)]
fn respond<const N: usize>(
    hessian: &WideMatrix<N>,
    derivative: &WideMatrix<N>,
    residual: &Wide<N>,
    found: &mut (WideMatrix<N>, Wide<N>),
) {
    *found = response(hessian, derivative, residual);
}

/// The vector with these entries; vectors' own operators go through memory piece by piece.
#[inline(always)]
fn entries<const N: usize>(entry: impl Fn(usize) -> Steps) -> Wide<N> {
    let mut vector = Wide::<N>::repeat(Steps::splat(0.0));
    for i in 0..N {
        vector[i] = entry(i);
    }
    vector
}

/// The steps' vectors in lanes.
#[inline(always)]
fn side_by_side<const N: usize>(steps: &[V<f64, N>; BLOCK]) -> Wide<N> {
    entries(|i| Steps::from(from_fn(|k| steps[k][i])))
}

/// The vectors of the steps.
#[inline(always)]
fn take<const N: usize>(lanes: &Wide<N>, steps: &mut [V<f64, N>; BLOCK]) {
    let lanes: [[f64; BLOCK]; N] = from_fn(|i| lanes[i].into());
    for k in 0..BLOCK {
        for i in 0..N {
            steps[k][i] = lanes[i][k];
        }
    }
}

/// The largest |δ fine| / |δp| between one step and the next.
#[inline(always)]
fn steepest<const N: usize>(p: &Wide<N>, fine: &Wide<N>) -> f64 {
    let least = Steps::splat(f64::from(f32::MIN_POSITIVE));
    let ratio = changes(fine).largest_entry() / (changes(p).largest_entry() + least);
    ratio.simd_horizontal_max()
}

/// From each step to the next, and from the last to the first.
#[inline(always)]
fn changes<const N: usize>(steps: &Wide<N>) -> Wide<N> {
    entries(|i| {
        let lanes: [f64; BLOCK] = steps[i].into();
        Steps::from(from_fn(|k| lanes[(k + 1) % BLOCK])) - steps[i]
    })
}
