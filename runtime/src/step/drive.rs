//! Steps by straight-line programs: the loop that drives them.
//!
//! ```text
//! for each step
//!     (p, k) = guess(μ)
//!     way = 0
//!     do   (p, x, left, moved) = correct(p, μ, k);  way = way + moved
//!     while not left ≤ tolerance, and way ≤ near, and there are corrections left
//!     if accept(μ, x, left, way) is not 1: stop before this step
//!     (g, μ) = transport(g, μ, x)
//! after each block of steps and at the end
//!     (g, μ) = frame(g, μ, steps of the block)      where there is a comoving frame
//!     if sound(g, μ) is not 1: back to the start of the block, stop
//! ```

use nalgebra::{SVector, SimdBool, SimdValue};

use crate::generating::{GeneratingFunction, ScalarOf};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::number::lift::Lift;
use crate::number::scalar::Scalar;
use crate::solve::{Candidate, Driven, DrivenOf};
use crate::step::numbers::ElementNumbers;

/// Steps after which a comoving frame moves on and the state is checked: few enough for the integrals of the frame, which
/// drift by rounding, to be the same in all of them.
pub const BLOCK: u64 = 256;

/// The largest residual of a solved step, relative to the largest coordinate of μ, in units of rounding.
const ROUNDINGS: f64 = 4.0;

/// Numbers that programs compute with, `C` being the type of their coefficients.
pub trait Number<C>: Scalar + Lift<C> {}

impl<C, T: Scalar + Lift<C>> Number<C> for T {}

/// A step as straight-line programs over folded coefficients c, of which there are `SLOTS`: `N` coordinates, `M` numbers
/// in a group element, `K` constants of a solve.
pub trait Programs<C, const N: usize, const M: usize, const K: usize, const SLOTS: usize> {
    /// How far the solution may be from its first guess, relative to the largest coordinate of μ.
    const NEAR: f64;
    /// Corrections at most.
    const CORRECTIONS: u32;
    /// Whether there is a comoving frame.
    const FRAMED: bool;

    /// A first guess of p, and the constants of the solve.
    fn guess<T: Number<C>>(c: &[C; SLOTS], mu: &[T; N]) -> ([T; N], [T; K]);

    /// The next p, x, a bound on what is left of the equation, and the length of the correction, both relative to the
    /// largest coordinate of μ.
    fn correct<T: Number<C>>(
        c: &[C; SLOTS],
        p: &[T; N],
        mu: &[T; N],
        k: &[T; K],
    ) -> ([T; N], [T; N], T, T);

    /// 1 if the step is right, else 0, given what is left and the way from the guess.
    fn accept<T: Number<C>>(c: &[C; SLOTS], mu: &[T; N], x: &[T; N], left: T, way: T) -> T;

    /// g·τ(x) and Ad\*_{τ(x)⁻¹} μ.
    fn transport<T: Number<C>>(
        c: &[C; SLOTS],
        g: &[T; M],
        mu: &[T; N],
        x: &[T; N],
    ) -> ([T; M], [T; N]);

    /// The state moved on by the comoving frame of `times` steps.
    fn frame<T: Number<C>>(c: &[C; SLOTS], g: &[T; M], mu: &[T; N], times: T) -> ([T; M], [T; N]);

    /// 1 if the state is finite and on the group, else 0.
    fn sound<T: Number<C>>(c: &[C; SLOTS], g: &[T; M], mu: &[T; N]) -> T;
}

/// Makes up to `steps` steps by the programs `P`, over lanes as long as all of them are right; `phase` is then the state
/// after the last one made.
#[inline(always)]
pub fn drive<P, S, const N: usize, const M: usize, const K: usize, const SLOTS: usize>(
    c: &[ScalarOf<S>; SLOTS],
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> DrivenOf<S>
where
    S: GeneratingFunction + ?Sized,
    S::Group: ElementNumbers + LieGroup<Vector = SVector<ScalarOf<S>, N>>,
    P: Programs<ScalarOf<S>, N, M, K, SLOTS>,
{
    let mut g = [ScalarOf::<S>::of(0.0); M];
    <S::Group as ElementNumbers>::write(&phase.group_element, &mut g);
    let mut now = (g, phase.momentum.into());
    let mut driven = Driven::none();
    while driven.steps < steps {
        let length = BLOCK.min(steps - driven.steps);
        if !block::<P, _, N, M, K, SLOTS>(c, &mut now, length, &mut driven) {
            break;
        }
    }
    if driven.steps > 0 {
        phase.group_element = <S::Group as ElementNumbers>::read(&now.0);
        phase.momentum = now.1.into();
    }
    driven
}

/// Makes up to `length` steps, the frame and the check; returns whether all of them were made.
#[inline(always)]
fn block<P, T, const N: usize, const M: usize, const K: usize, const SLOTS: usize>(
    c: &[T; SLOTS],
    now: &mut ([T; M], [T; N]),
    length: u64,
    driven: &mut Driven<SVector<T, N>, T>,
) -> bool
where
    T: Scalar,
    P: Programs<T, N, M, K, SLOTS>,
{
    let one = T::of(1.0);
    let begun = *now;
    let mut made = 0;
    while made < length {
        let found = solve::<P, T, N, M, K, SLOTS>(c, &now.1);
        let right = P::accept(c, &now.1, &found.x, found.left, found.way);
        if !right.simd_ge(one).all() {
            driven.refused = Some(found.candidate());
            break;
        }
        *now = P::transport(c, &now.0, &now.1, &found.x);
        driven.iterations = driven.iterations.max(found.iterations);
        driven.residual = driven.residual.simd_max(found.left);
        made += 1;
    }
    if made > 0 {
        if P::FRAMED {
            *now = P::frame(c, &now.0, &now.1, T::of(made as f64));
        }
        if !P::sound(c, &now.0, &now.1).simd_ge(one).all() {
            *now = begun;
            driven.refused = None;
            return false;
        }
    }
    driven.steps += made;
    made == length
}

/// A solution of the equation of a step.
struct Found<T, const N: usize> {
    x: [T; N],
    left: T,
    way: T,
    iterations: u32,
}

impl<T: Scalar, const N: usize> Found<T, N> {
    fn candidate(self) -> Candidate<SVector<T, N>, T> {
        let Self { x, left, way, iterations } = self;
        Candidate { x: x.into(), moved: way, residual: left, iterations }
    }
}

#[inline(always)]
fn solve<P, T, const N: usize, const M: usize, const K: usize, const SLOTS: usize>(
    c: &[T; SLOTS],
    mu: &[T; N],
) -> Found<T, N>
where
    T: Scalar,
    P: Programs<T, N, M, K, SLOTS>,
{
    let (zero, one) = (T::of(0.0), T::of(1.0));
    let (near, tolerance) = (T::of(P::NEAR), T::of(ROUNDINGS) * T::epsilon());
    let (mut p, k) = P::guess(c, mu);
    let mut found = Found { x: [zero; N], left: one, way: zero, iterations: 0 };
    let mut open = zero.simd_le(one);
    while found.iterations < P::CORRECTIONS {
        found.iterations += 1;
        let (next, x, left, moved) = P::correct(c, &p, mu, &k);
        let way = found.way + moved;
        if <T as SimdValue>::LANES == 1 {
            (p, found.x, found.left, found.way) = (next, x, left, way);
        } else {
            for i in 0..N {
                p[i] = next[i].select(open, p[i]);
                found.x[i] = x[i].select(open, found.x[i]);
            }
            found.left = left.select(open, found.left);
            found.way = way.select(open, found.way);
        }
        // A point far from its guess will not be accepted, nor will NaN.
        open = open & !found.left.simd_le(tolerance) & found.way.simd_le(near);
        if open.none() {
            break;
        }
    }
    found
}
