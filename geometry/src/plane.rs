//! SE(2), the motions of space that keep the third axis: coordinates (ω, v₁, v₂), elements (cos(θ/2), sin(θ/2), t₁, t₂).

use crate::angle::{Angle, Length};
use crate::group::{Group, Matrices};
use crate::motion::{Motion, Motions};
use crate::number::Number;
use crate::rotation::Turn;

/// The coordinates of se(3).
#[inline(always)]
fn lifted<T: Number>([turn, a, b]: [T; 3]) -> [T; 6] {
    let zero = T::of(0.0);
    [zero, zero, turn, a, b, zero]
}

/// The coordinates of se(2).
#[inline(always)]
fn dropped<T: Number>([_, _, turn, a, b, _]: [T; 6]) -> [T; 3] {
    [turn, a, b]
}

/// The motion of space.
#[inline(always)]
fn in_space<T: Number>([w, k, a, b]: [T; 4]) -> [T; 7] {
    let zero = T::of(0.0);
    [w, zero, zero, k, a, b, zero]
}

/// A value and its derivative.
#[inline(always)]
fn both<T: Number>((value, slope): ([T; 6], [[T; 6]; 6])) -> ([T; 3], [[T; 3]; 3]) {
    (dropped(value), [dropped(slope[2]), dropped(slope[3]), dropped(slope[4])])
}

/// Functions of coordinates that are those of the motion of space.
macro_rules! in_space {
    ($($name:ident($x:ident, $y:ident $(; $rest:ident: $type:ty)?);)*) => {$(
        #[inline(always)]
        fn $name<T: Number>($x: [T; 3], $y: [T; 3] $(, $rest: $type)?) -> [T; 3] {
            dropped(Motions::$name(lifted($x), lifted($y) $(, $rest)?))
        }
    )*};
}

/// The motions of the plane. Increments are motions of space that keep the third axis.
#[derive(Clone, Copy, Debug)]
pub struct Plane;

impl Group<3, 4> for Plane {
    type Increment<T: Number> = Motion<T>;

    const CAYLEY_LIMIT: f64 = 2.0;

    #[inline(always)]
    fn after<T: Number>(h: Motion<T>, g: [T; 4]) -> [T; 4] {
        let [w, _, _, k, a, b, _] = h.after(in_space(g));
        [w, k, a, b]
    }
    #[inline(always)]
    fn back<T: Number>(h: Motion<T>, mu: [T; 3]) -> [T; 3] {
        dropped(h.back(lifted(mu)))
    }
    #[inline(always)]
    fn pull_back_with_derivative<T: Number>(x: [T; 3], mu: [T; 3]) -> ([T; 3], [[T; 3]; 3]) {
        both(Motions::pull_back_with_derivative(lifted(x), lifted(mu)))
    }
    #[inline(always)]
    fn cayley_pull_back_with_derivative<T: Number>(x: [T; 3], mu: [T; 3]) -> ([T; 3], [[T; 3]; 3]) {
        both(Motions::cayley_pull_back_with_derivative(lifted(x), lifted(mu)))
    }
    in_space! {
        ad_star(x, mu);
        bracket(x, y);
        pull_back(x, mu; length: Length);
        cayley_pull_back(x, mu);
        momentum(x, p; degree: usize);
    }
    #[inline(always)]
    fn exp<T: Number>(x: [T; 3], length: Length) -> Motion<T> {
        let ([turn, a, b], zero) = (x, T::of(0.0));
        let angle = Angle::new([turn], length);
        // Products of ω̂ with v, as those of SE(3) without their zeros.
        let once = [(-turn) * b, turn * a];
        let twice = [(-turn) * once[1], turn * once[0]];
        let entry = |v: T, i: usize| twice[i].times_plus(angle.c, once[i].times_plus(angle.b, v));
        let turn = Turn { w: angle.half_cosine, s: angle.half_sine, x: [zero, zero, turn] };
        Motion { turn, place: [entry(a, 0), entry(b, 1), zero] }
    }
    #[inline(always)]
    fn cayley<T: Number>(x: [T; 3]) -> Motion<T> {
        Motions::cayley(lifted(x))
    }
    #[inline(always)]
    fn rates<T: Number>(x: [T; 3], p: [T; 3], omega: [T; 3], degree: usize) -> [[T; 3]; 2] {
        let [velocity, force] = Motions::rates(lifted(x), lifted(p), lifted(omega), degree);
        [dropped(velocity), dropped(force)]
    }
    #[inline(always)]
    fn coadjoint<T: Number>(g: [T; 4], mu: [T; 3]) -> [T; 3] {
        dropped(Motions::coadjoint(in_space(g), lifted(mu)))
    }
    #[inline(always)]
    fn extent<T: Number>(x: [T; 3], limit: f64) -> T {
        Motions::extent(lifted(x), limit)
    }
    #[inline(always)]
    fn defect<T: Number>(g: [T; 4]) -> T {
        Motions::defect(in_space(g))
    }
}

impl Matrices<4, 3> for Plane {
    /// The matrix of a motion.
    #[inline(always)]
    fn matrix<T: Number>(g: [T; 4]) -> [[T; 3]; 3] {
        let [a, b, _, d] = Motions::matrix(in_space(g));
        [[a[0], a[1], a[3]], [b[0], b[1], b[3]], [d[0], d[1], d[3]]]
    }
}
