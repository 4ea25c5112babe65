//! The functions of an angle that exponentials need.

use crate::number::Number;
use crate::series::{NEWTON, ROUNDING, Taylor, alternating};

/// The series of an angle's functions for t = θ² up to a reach.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    half_cosine: Taylor,
    half_sine: Taylor,
    b: Taylor,
    c: Taylor,
}

impl Reach {
    const fn new(reach: f64, accuracy: [f64; 4]) -> Self {
        Self {
            half_cosine: Taylor::new(alternating(0, 1.0, 0.25), reach, accuracy),
            half_sine: Taylor::new(alternating(1, 0.5, 0.25), reach, accuracy),
            b: Taylor::new(alternating(2, 1.0, 1.0), reach, accuracy),
            c: Taylor::new(alternating(3, 1.0, 1.0), reach, accuracy),
        }
    }
}

/// The largest θ² of a step of a program: a quarter turn, and what is beyond it by rounding.
const QUARTER: f64 = 2.5;

// Constants, not statics: the compiler knows no values of another crate's statics.

/// Up to a quarter turn; first derivatives to rounding, those beyond for Newton's method.
pub const QUARTER_TURN: &Reach = &Reach::new(QUARTER, [ROUNDING, ROUNDING, NEWTON, NEWTON]);

/// Up to a quarter turn, all derivatives for Newton's method.
pub const QUARTER_TURN_NEWTON: &Reach = &Reach::new(QUARTER, [ROUNDING, NEWTON, NEWTON, NEWTON]);

/// The lengths of x for which a formula is right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// Up to a quarter turn.
    Short,
    /// Any, to |x|² = 2⁵⁰.
    Long,
    /// Any; where all numbers are known to be short, as [`Length::Short`].
    Any,
}

/// The functions of the angle θ = |x| that an exponential needs.
#[derive(Clone, Copy, Debug)]
pub struct Angle<T> {
    /// cos(θ/2)
    pub half_cosine: T,
    /// sin(θ/2)/θ
    pub half_sine: T,
    /// (1 − cos θ)/θ²
    pub b: T,
    /// (θ − sin θ)/θ³
    pub c: T,
}

impl<T: Number> Angle<T> {
    /// The functions at x.
    #[inline(always)]
    pub fn new<const N: usize>(x: [T; N], length: Length) -> Self {
        let known = match length {
            Length::Short => Some(true),
            Length::Long => Some(false),
            Length::Any => T::squares(x).known_at_most(QUARTER),
        };
        match known {
            Some(true) => Self::short(x, QUARTER_TURN),
            Some(false) => Self::far(x),
            None => Self::either(x),
        }
    }

    #[inline(always)]
    fn short<const N: usize>(x: [T; N], reach: &'static Reach) -> Self {
        Self {
            half_cosine: T::even(x, &reach.half_cosine, 0),
            half_sine: T::even(x, &reach.half_sine, 0),
            b: T::even(x, &reach.b, 0),
            c: T::even(x, &reach.c, 0),
        }
    }

    /// θ less whole turns, and quotients by θ and θ² from their series where t ≤ 1.
    #[inline(always)]
    fn long<const N: usize>(x: [T; N]) -> Self {
        // 2π in two pieces, so that a fused product takes whole turns off without rounding.
        const TURN: f64 = core::f64::consts::TAU;
        const REST: f64 = 2.449_293_598_294_706_4e-16;
        // |2r| ≤ 2π for the rest r of θ/2.
        const NEAR: &Reach = &Reach::new(4.0 * 9.88, [ROUNDING; 4]);
        const SMALL: &Reach = &Reach::new(1.0, [ROUNDING; 4]);
        let (t, one) = (T::squares(x), T::of(1.0));
        let angle = t.sqrt();
        let halved = angle.by(0.5);
        let turns = -halved.by(1.0 / TURN).round();
        let reduced = turns.times_plus(T::of(REST), turns.times_plus(T::of(TURN), halved));
        let doubled = [reduced.by(2.0)];
        let half_cosine = T::even(doubled, &NEAR.half_cosine, 0);
        let sine = (T::even(doubled, &NEAR.half_sine, 0) * reduced).by(2.0);
        let half_sine = t.at_most(one, T::even(x, &SMALL.half_sine, 0), sine / angle);
        let b = (half_sine * half_sine).by(2.0);
        let whole = (half_sine * half_cosine).by(2.0);
        let c = t.at_most(one, T::even(x, &SMALL.c, 0), (one - whole) / t);
        Self { half_cosine, half_sine, b, c }
    }

    #[cold]
    #[inline(never)]
    fn far<const N: usize>(x: [T; N]) -> Self {
        Self::long(x)
    }

    #[cold]
    #[inline(never)]
    fn either<const N: usize>(x: [T; N]) -> Self {
        let (t, limit) = (T::squares(x), T::of(QUARTER));
        let (near, far) = (Self::short(x, QUARTER_TURN), Self::long(x));
        Self {
            half_cosine: t.at_most(limit, near.half_cosine, far.half_cosine),
            half_sine: t.at_most(limit, near.half_sine, far.half_sine),
            b: t.at_most(limit, near.b, far.b),
            c: t.at_most(limit, near.c, far.c),
        }
    }
}

/// b, c, and their derivatives in θ²/2, up to a quarter turn.
#[inline(always)]
pub(crate) fn with_slopes<T: Number>(x: [T; 3], reach: &'static Reach) -> [T; 4] {
    [
        T::even(x, &reach.b, 0),
        T::even(x, &reach.c, 0),
        T::even(x, &reach.b, 1),
        T::even(x, &reach.c, 1),
    ]
}
