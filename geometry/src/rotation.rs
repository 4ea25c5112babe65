//! SO(3), and its double cover SU(2), elements as unit quaternions (w, i, j, k). In dual numbers formulas of SO(3) are those
//! of SE(3).

use crate::angle::{Angle, Length, QUARTER_TURN_NEWTON, Reach, with_slopes};
use crate::bernoulli::bernoulli;
use crate::group::{Group, Matrices};
use crate::number::Number;
use crate::vector::{
    V3, by, cross, dot, each, minus, plus, plus_by, plus_cross, plus_outer, scaled, turned, unit,
};

/// A unit quaternion (w, s·x).
#[derive(Clone, Copy, Debug)]
pub struct Turn<T> {
    /// w
    pub w: T,
    /// s
    pub s: T,
    /// x
    pub x: V3<T>,
}

impl<T: Number> Turn<T> {
    /// The turn of a quaternion.
    #[inline(always)]
    pub fn of([w, i, j, k]: [T; 4]) -> Self {
        Self { w, s: T::of(1.0), x: [i, j, k] }
    }

    /// The numbers of the quaternion.
    #[inline(always)]
    pub fn quaternion(self) -> [T; 4] {
        let [i, j, k] = scaled(self.s, self.x);
        [self.w, i, j, k]
    }

    /// The inverse.
    #[inline(always)]
    #[must_use]
    pub fn inverse(self) -> Self {
        Self { x: minus(self.x), ..self }
    }

    /// R(q)ᵀ v = v + 2sw v×x + 2s² (v×x)×x, whose products with x need not wait for w and s: Ad\*_{q⁻¹} v.
    #[inline(always)]
    pub fn back(self, v: V3<T>) -> V3<T> {
        let once = cross(v, self.x);
        let doubled = self.s.by(2.0);
        plus(plus(v, doubled * self.w, once), doubled * self.s, cross(once, self.x))
    }

    /// g·q, pulled back onto the unit sphere to first order, so that rounding does not accumulate in the norm over many
    /// steps.
    #[inline(always)]
    pub fn after(self, [a, i, j, k]: [T; 4]) -> [T; 4] {
        let (b, u) = ([i, j, k], scaled(self.s, self.x));
        let scalar = a.times_plus(self.w, -dot(b, u));
        let [i, j, k] = plus(plus(cross(b, u), a, u), self.w, b);
        let product = [scalar, i, j, k];
        let factor = T::squares(product).by_plus(-0.5, T::of(1.5));
        each(|i| product[i] * factor)
    }
}

/// R(q) v = Ad\*_q v
#[inline(always)]
pub fn rotate<T: Number>(q: [T; 4], v: V3<T>) -> V3<T> {
    Turn::of(q).inverse().back(v)
}

/// μ + b μ×x + c (μ×x)×x, and these two products.
#[inline(always)]
fn bent<T: Number>(b: T, c: T, x: V3<T>, mu: V3<T>) -> [V3<T>; 3] {
    let once = cross(mu, x);
    let twice = cross(once, x);
    [plus(plus(mu, b, once), c, twice), once, twice]
}

/// (d^R exp_x)ᵀ μ and its derivative in x, for |x| up to a quarter turn, with b′ and c′ by |x|²:
/// v ↦ b μ×v + c [(μ×v)×x + (μ×x)×v] + (x·v)(2b′ μ×x + 2c′ (μ×x)×x), with (μ×v)×x = v (μ·x) − μ (v·x).
#[inline(always)]
pub fn pull_back_with_derivative<T: Number>(
    x: V3<T>,
    mu: V3<T>,
    reach: &'static Reach,
) -> (V3<T>, [V3<T>; 3]) {
    let [b, c, b_slope, c_slope] = with_slopes(x, reach);
    let [value, once, twice] = bent(b, c, x, mu);
    let along = plus(plus(scaled(b_slope, once), c_slope, twice), -c, mu);
    let constant = turned(plus(scaled(b, mu), c, once), c * dot(mu, x));
    (value, plus_outer(constant, along, x))
}

/// (d^R cay_x)ᵀ μ = (μ + ½ μ×x)/(1 + |x|²/4), the transpose of (1 + x̂/2)/(1 + |x|²/4), and its derivative in x.
#[inline(always)]
pub fn cayley_pull_back<T: Number>(x: V3<T>, mu: V3<T>) -> (V3<T>, [V3<T>; 3]) {
    let factor = T::of(1.0) / T::squares(x).by_plus(0.25, T::of(1.0));
    let value = scaled(factor, plus_by(mu, 0.5, cross(mu, x)));
    let half = factor.by(0.5);
    let turn = turned(scaled(half, mu), T::of(0.0));
    (value, plus_outer(turn, minus(scaled(half, value)), x))
}

/// SU(2)'s (d^R cay_x)ᵀ μ = ((1 − |a|²)μ + 2(a·μ)a + 2 μ×a)/(1 + |a|²)², a = x/4, and its derivative in x.
#[inline(always)]
pub fn cayley_pull_back_of_cover<T: Number>(x: V3<T>, mu: V3<T>) -> (V3<T>, [V3<T>; 3]) {
    let (a, one) = (by(0.25, x), T::of(1.0));
    let (n, along) = (T::squares(a), dot(a, mu));
    let bend = plus(cross(mu, a), along, a);
    let y = plus_by(scaled(one - n, mu), 2.0, bend);
    let m = one + n;
    let factor = one / (m * m);
    let value = scaled(factor, y);
    // ∂y/∂a = 2(aμᵀ − μaᵀ + (a·μ)1 + μ̂), ∂(m⁻²)/∂a = −4 m⁻³ aᵀ, ∂a/∂x = ¼.
    let slope = plus_outer(plus_outer(turned(mu, along), a, mu), minus(mu), a);
    let (weight, shrink) = (factor.by(0.5), one / m);
    let row = |i: usize| each(|j| slope[i][j].times_plus(weight, -(value[i] * a[j] * shrink)));
    (value, [row(0), row(1), row(2)])
}

/// Unit quaternions: SO(3), where q and −q are one element, or its double cover SU(2).
#[derive(Clone, Copy, Debug)]
pub struct Quaternions<const COVER: bool>;

impl<const COVER: bool> Group<3, 4> for Quaternions<COVER> {
    type Increment<T: Number> = Turn<T>;

    const CAYLEY_LIMIT: f64 = if COVER { 4.0 } else { 2.0 };

    /// (cos(θ/2), sin(θ/2)/θ x)
    #[inline(always)]
    fn exp<T: Number>(x: V3<T>, length: Length) -> Turn<T> {
        let Angle { half_cosine, half_sine, .. } = Angle::new(x, length);
        Turn { w: half_cosine, s: half_sine, x }
    }
    /// (1, x/2)/√(1 + |x|²/4); of the cover (1 − a)⁻¹(1 + a) = (1 + a)²/(1 + |a|²) for the pure quaternion a = x/4.
    #[inline(always)]
    fn cayley<T: Number>(x: V3<T>) -> Turn<T> {
        let one = T::of(1.0);
        if COVER {
            let n = T::squares(by(0.25, x));
            let factor = one / (one + n);
            return Turn { w: (one - n) * factor, s: factor.by(0.5), x };
        }
        let w = one / (one + T::squares(by(0.5, x))).sqrt();
        Turn { w, s: w.by(0.5), x }
    }
    #[inline(always)]
    fn after<T: Number>(h: Turn<T>, g: [T; 4]) -> [T; 4] {
        h.after(g)
    }
    #[inline(always)]
    fn back<T: Number>(h: Turn<T>, mu: V3<T>) -> V3<T> {
        h.back(mu)
    }
    /// (d^R exp_x)ᵀ μ = μ + b μ×x + c (μ×x)×x.
    #[inline(always)]
    fn pull_back<T: Number>(x: V3<T>, mu: V3<T>, length: Length) -> V3<T> {
        let Angle { b, c, .. } = Angle::new(x, length);
        bent(b, c, x, mu)[0]
    }
    #[inline(always)]
    fn pull_back_with_derivative<T: Number>(x: V3<T>, mu: V3<T>) -> (V3<T>, [V3<T>; 3]) {
        pull_back_with_derivative(x, mu, QUARTER_TURN_NEWTON)
    }
    #[inline(always)]
    fn cayley_pull_back_with_derivative<T: Number>(x: V3<T>, mu: V3<T>) -> (V3<T>, [V3<T>; 3]) {
        if COVER { cayley_pull_back_of_cover(x, mu) } else { cayley_pull_back(x, mu) }
    }
    /// exp's J_R(x, p) = p − ½ x×p + c x×(x×p), its series up to x^degree.
    #[inline(always)]
    fn momentum<T: Number>(x: V3<T>, p: V3<T>, degree: usize) -> V3<T> {
        let [c, _] = bernoulli(x, degree);
        let once = cross(x, p);
        plus(plus_by(p, -0.5, once), c, cross(x, once))
    }
    /// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω: with u = ½ω + c x×ω they are ω + x×u and
    /// p×u + cω×(x×p) + 2c′ ((x×ω)·(x×p)) x.
    #[inline(always)]
    fn rates<T: Number>(x: V3<T>, p: V3<T>, omega: V3<T>, degree: usize) -> [V3<T>; 2] {
        let [c, slope] = bernoulli(x, degree);
        let (turned, once) = (cross(x, omega), cross(x, p));
        let u = plus(by(0.5, omega), c, turned);
        let force = plus_cross(cross(p, u), scaled(c, omega), once);
        [plus_cross(omega, x, u), plus(force, slope * dot(turned, once), x)]
    }
    #[inline(always)]
    fn ad_star<T: Number>(x: V3<T>, mu: V3<T>) -> V3<T> {
        cross(mu, x)
    }
    #[inline(always)]
    fn bracket<T: Number>(x: V3<T>, y: V3<T>) -> V3<T> {
        cross(x, y)
    }
    #[inline(always)]
    fn coadjoint<T: Number>(g: [T; 4], mu: V3<T>) -> V3<T> {
        rotate(g, mu)
    }
    /// (|x|/limit)², for a chart that ends at |x| = limit.
    #[inline(always)]
    fn extent<T: Number>(x: V3<T>, limit: f64) -> T {
        T::squares(x).by(1.0 / (limit * limit))
    }
    /// ||q|² − 1|
    #[inline(always)]
    fn defect<T: Number>(q: [T; 4]) -> T {
        (T::squares(q) - T::of(1.0)).abs()
    }
}

impl Matrices<4, 3> for Quaternions<false> {
    #[inline(always)]
    fn matrix<T: Number>(q: [T; 4]) -> [V3<T>; 3] {
        let [a, b, c] = [rotate(q, unit(0)), rotate(q, unit(1)), rotate(q, unit(2))];
        [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]]
    }
}

impl Matrices<4, 4> for Quaternions<true> {
    /// w − i(xσ₁ + yσ₂ + zσ₃) as the real matrix ((a, −b), (b, a)).
    #[inline(always)]
    fn matrix<T: Number>([w, x, y, z]: [T; 4]) -> [[T; 4]; 4] {
        [[w, -y, z, x], [y, w, x, -z], [-z, -x, w, -y], [-x, z, y, w]]
    }
}
