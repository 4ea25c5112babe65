//! SE(2), the motions of space that keep the third axis: coordinates (ω, v₁, v₂), elements (cos(θ/2), sin(θ/2), t₁, t₂).

use crate::angle::{Angle, Length};
use crate::motion::{self, Motion};
use crate::number::Number;
use crate::rotation::Turn;

/// The coordinates of se(3).
#[inline(always)]
fn lifted<T: Number>([turn, a, b]: [T; 3]) -> [T; 6] {
    let zero = T::of(0.0);
    [zero, zero, turn, a, b, zero]
}

/// Those of se(2).
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

/// (d^R exp_x)ᵀ μ
#[inline(always)]
pub fn pull_back<T: Number>(x: [T; 3], mu: [T; 3], length: Length) -> [T; 3] {
    dropped(motion::pull_back(lifted(x), lifted(mu), length))
}

/// (d^R cay_x)ᵀ μ
#[inline(always)]
pub fn cayley_pull_back<T: Number>(x: [T; 3], mu: [T; 3]) -> [T; 3] {
    dropped(motion::cayley_pull_back(lifted(x), lifted(mu)))
}

/// (d^R τ_x)ᵀ μ and its derivative in x, from those of SE(3).
#[inline(always)]
pub fn pull_back_with_derivative<T: Number>(
    x: [T; 3],
    mu: [T; 3],
    of_space: impl Fn([T; 6], [T; 6]) -> ([T; 6], [[T; 6]; 6]),
) -> ([T; 3], [[T; 3]; 3]) {
    let (value, slope) = of_space(lifted(x), lifted(mu));
    (dropped(value), [dropped(slope[2]), dropped(slope[3]), dropped(slope[4])])
}

/// exp's J_R(x, p), its series up to x^degree.
#[inline(always)]
pub fn momentum<T: Number>(x: [T; 3], p: [T; 3], degree: usize) -> [T; 3] {
    dropped(motion::momentum(lifted(x), lifted(p), degree))
}

/// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω.
#[inline(always)]
pub fn rates<T: Number>(x: [T; 3], p: [T; 3], omega: [T; 3], degree: usize) -> [[T; 3]; 2] {
    let [velocity, force] = motion::rates(lifted(x), lifted(p), lifted(omega), degree);
    [dropped(velocity), dropped(force)]
}

/// exp x, as a motion of space.
#[inline(always)]
pub fn exp<T: Number>(x: [T; 3], length: Length) -> Motion<T> {
    let ([turn, a, b], zero) = (x, T::of(0.0));
    let angle = Angle::new([turn], length);
    // Products of ω̂ with v, as those of SE(3) without their zeros.
    let once = [(-turn) * b, turn * a];
    let twice = [(-turn) * once[1], turn * once[0]];
    let entry = |v: T, i: usize| twice[i].times_plus(angle.c, once[i].times_plus(angle.b, v));
    let turn = Turn { w: angle.half_cosine, s: angle.half_sine, x: [zero, zero, turn] };
    Motion { turn, place: [entry(a, 0), entry(b, 1), zero] }
}

/// cay x, as a motion of space.
#[inline(always)]
pub fn cayley<T: Number>(x: [T; 3]) -> Motion<T> {
    Motion::cayley(lifted(x))
}

/// g·h and Ad\*_{h⁻¹} μ for a motion h of space that keeps the third axis.
#[inline(always)]
pub fn transport<T: Number>(g: [T; 4], h: Motion<T>, mu: [T; 3]) -> ([T; 4], [T; 3]) {
    let [w, _, _, k, a, b, _] = h.after(in_space(g));
    ([w, k, a, b], dropped(h.back(lifted(mu))))
}

/// Ad\*_g μ
#[inline(always)]
pub fn coadjoint<T: Number>(g: [T; 4], mu: [T; 3]) -> [T; 3] {
    dropped(motion::coadjoint(in_space(g), lifted(mu)))
}

/// The matrix of a motion.
#[inline(always)]
pub fn matrix<T: Number>(g: [T; 4]) -> [[T; 3]; 3] {
    let [a, b, _, d] = motion::matrix(in_space(g));
    [[a[0], a[1], a[3]], [b[0], b[1], b[3]], [d[0], d[1], d[3]]]
}

/// As [`motion::extent`].
#[inline(always)]
pub fn extent<T: Number>(x: [T; 3], limit: f64) -> T {
    motion::extent(lifted(x), limit)
}

/// As [`motion::defect`].
#[inline(always)]
pub fn defect<T: Number>(g: [T; 4]) -> T {
    motion::defect(in_space(g))
}
