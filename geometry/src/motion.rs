//! SE(3), elements as a unit quaternion (w, i, j, k) and a translation. Its exponential is SO(3)'s in dual numbers, x = ω + εv
//! and μ = Γ + εΠ, since the dual part of μ·x is Π·ω + Γ·v.

use crate::angle::{Angle, Length, QUARTER_TURN};
use crate::dual::{Dual, dual};
use crate::group::{Group, Matrices};
use crate::number::Number;
use crate::rotation::{self, Quaternions, Turn, rotate};
use crate::vector::{V3, cross, difference, dot, finite, minus, plus, plus_by, scaled, sum, unit};

type D3<T> = V3<Dual<T>>;

/// The rotations of space.
type Space = Quaternions<false>;

/// The rotations and the translations.
#[inline(always)]
pub fn halves<T: Number>([a, b, c, d, e, f]: [T; 6]) -> [V3<T>; 2] {
    [[a, b, c], [d, e, f]]
}

/// Both one after the other.
#[inline(always)]
fn whole<T: Number>([a, b, c]: V3<T>, [d, e, f]: V3<T>) -> [T; 6] {
    [a, b, c, d, e, f]
}

/// (ω, v) as ω + εv.
#[inline(always)]
fn coordinates<T: Number>(x: [T; 6]) -> D3<T> {
    let [omega, v] = halves(x);
    dual(omega, v)
}

/// (Π, Γ) as Γ + εΠ.
#[inline(always)]
fn momenta<T: Number>(mu: [T; 6]) -> D3<T> {
    let [pi, gamma] = halves(mu);
    dual(gamma, pi)
}

/// (ω, v) of ω + εv.
#[inline(always)]
fn of_coordinates<T: Number>([a, b, c]: D3<T>) -> [T; 6] {
    [a.real, b.real, c.real, a.dual, b.dual, c.dual]
}

/// (Π, Γ) of Γ + εΠ.
#[inline(always)]
fn of_momenta<T: Number>([a, b, c]: D3<T>) -> [T; 6] {
    [a.dual, b.dual, c.dual, a.real, b.real, c.real]
}

/// 1/(1 + |ω|²/4)
#[inline(always)]
fn cayley_factor<T: Number>(omega: V3<T>) -> T {
    T::of(1.0) / T::squares(omega).by_plus(0.25, T::of(1.0))
}

/// (1 + ω̂/2)⁻¹ y (1 + |ω|²/4) = y + ½ y×ω + ¼ (ω·y) ω
#[inline(always)]
fn resolve<T: Number>(omega: V3<T>, y: V3<T>) -> V3<T> {
    plus(plus_by(y, 0.5, cross(y, omega)), dot(omega, y).by(0.25), omega)
}

/// ¼ q×ω − ½ q
#[inline(always)]
fn lean<T: Number>(q: V3<T>, omega: V3<T>) -> V3<T> {
    plus_by(scaled(T::of(0.25), cross(q, omega)), -0.5, q)
}

/// The parts of (d^R cay_x)ᵀ (Π, Γ) = (P, Q) for the map of 4 × 4 matrices: Q = (1 + ω̂/2)⁻¹ Γ, r = ¼ Q×ω − ½ Q,
/// s = Π + v×r, P = f·(s + ½ s×ω), f = 1/(1 + |ω|²/4).
#[derive(Clone, Copy, Debug)]
struct CayleyParts<T> {
    f: T,
    q: V3<T>,
    r: V3<T>,
    s: V3<T>,
    p: V3<T>,
}

impl<T: Number> CayleyParts<T> {
    #[inline(always)]
    fn new(x: [T; 6], mu: [T; 6]) -> Self {
        let ([omega, v], [pi, gamma]) = (halves(x), halves(mu));
        let f = cayley_factor(omega);
        let q = scaled(f, resolve(omega, gamma));
        let r = lean(q, omega);
        let s = sum(pi, cross(v, r));
        let p = scaled(f, plus_by(s, 0.5, cross(s, omega)));
        Self { f, q, r, s, p }
    }
}

/// A motion: a turn, and a translation after it.
#[derive(Clone, Copy, Debug)]
pub struct Motion<T> {
    /// The turn.
    pub turn: Turn<T>,
    /// The translation.
    pub place: V3<T>,
}

impl<T: Number> Motion<T> {
    /// The motion of an element's numbers.
    #[inline(always)]
    pub fn of([w, i, j, k, a, b, c]: [T; 7]) -> Self {
        Self { turn: Turn::of([w, i, j, k]), place: [a, b, c] }
    }

    /// Ad\* of the inverse: (Rᵀ(Π − t×Γ), RᵀΓ).
    #[inline(always)]
    pub fn back(self, mu: [T; 6]) -> [T; 6] {
        let [pi, gamma] = halves(mu);
        let lever = cross(self.place, gamma);
        whole(self.turn.back(difference(pi, lever)), self.turn.back(gamma))
    }

    /// g·self
    #[inline(always)]
    pub fn after(self, [w, i, j, k, a, b, c]: [T; 7]) -> [T; 7] {
        let [x, y, z] = sum(rotate([w, i, j, k], self.place), [a, b, c]);
        let [w, i, j, k] = self.turn.after([w, i, j, k]);
        [w, i, j, k, x, y, z]
    }
}

/// The motions of space.
#[derive(Clone, Copy, Debug)]
pub struct Motions;

impl Group<6, 7> for Motions {
    type Increment<T: Number> = Motion<T>;

    const CAYLEY_LIMIT: f64 = 2.0;

    /// (ω, v) with the translation v + b ω×v + c ω×(ω×v).
    #[inline(always)]
    fn exp<T: Number>(x: [T; 6], length: Length) -> Motion<T> {
        let [omega, v] = halves(x);
        let Angle { half_cosine, half_sine, b, c } = Angle::new(omega, length);
        let once = cross(omega, v);
        let place = plus(plus(v, b, once), c, cross(omega, once));
        Motion { turn: Turn { w: half_cosine, s: half_sine, x: omega }, place }
    }
    /// Cayley's map of 4 × 4 matrices, with the translation (1 − ω̂/2)⁻¹ v.
    #[inline(always)]
    fn cayley<T: Number>(x: [T; 6]) -> Motion<T> {
        let [omega, v] = halves(x);
        let place = scaled(cayley_factor(omega), resolve(minus(omega), v));
        Motion { turn: Space::cayley(omega), place }
    }
    #[inline(always)]
    fn after<T: Number>(h: Motion<T>, g: [T; 7]) -> [T; 7] {
        h.after(g)
    }
    #[inline(always)]
    fn back<T: Number>(h: Motion<T>, mu: [T; 6]) -> [T; 6] {
        h.back(mu)
    }
    /// (d^R exp_x)ᵀ μ
    #[inline(always)]
    fn pull_back<T: Number>(x: [T; 6], mu: [T; 6], length: Length) -> [T; 6] {
        of_momenta(Space::pull_back(coordinates(x), momenta(mu), length))
    }
    /// (d^R exp_x)ᵀ μ and its derivative in x, for |ω| up to a quarter turn.
    #[inline(always)]
    fn pull_back_with_derivative<T: Number>(x: [T; 6], mu: [T; 6]) -> ([T; 6], [[T; 6]; 6]) {
        // The derivative of Γ's part enters that of Π: to rounding.
        let (x, mu) = (coordinates(x), momenta(mu));
        let (value, slope) = rotation::pull_back_with_derivative(x, mu, QUARTER_TURN);
        // A + εB as ((B, A), (A, 0)).
        let mut matrix = [[T::of(0.0); 6]; 6];
        for i in 0..3 {
            for j in 0..3 {
                matrix[i][j] = slope[i][j].dual;
                matrix[i][j + 3] = slope[i][j].real;
                matrix[i + 3][j] = slope[i][j].real;
            }
        }
        (of_momenta(value), matrix)
    }
    /// (d^R cay_x)ᵀ μ and its derivative in x.
    #[inline(always)]
    fn cayley_pull_back_with_derivative<T: Number>(x: [T; 6], mu: [T; 6]) -> ([T; 6], [[T; 6]; 6]) {
        let ([omega, v], [_, gamma]) = (halves(x), halves(mu));
        let CayleyParts { f, q, r, s, p } = CayleyParts::new(x, mu);
        let along = dot(omega, gamma).by(0.25);
        let mut matrix = [[T::of(0.0); 6]; 6];
        for j in 0..3 {
            let e: V3<T> = unit(j);
            // Along ω: f changes by −½ f² ω_j.
            let stretch = -(f * omega[j]).by(0.5);
            let bent = plus(scaled(T::of(0.5), cross(gamma, e)), along, e);
            let bent = plus(bent, gamma[j].by(0.25), omega);
            let dq = plus(scaled(stretch, q), f, bent);
            let ds = cross(v, plus_by(lean(dq, omega), 0.25, cross(q, e)));
            let change = plus_by(ds, 0.5, sum(cross(ds, omega), cross(s, e)));
            let dp = plus(scaled(stretch, p), f, change);
            // Along v only s changes.
            let ds = cross(e, r);
            let dp_v = scaled(f, plus_by(ds, 0.5, cross(ds, omega)));
            for i in 0..3 {
                matrix[i][j] = dp[i];
                matrix[i + 3][j] = dq[i];
                matrix[i][j + 3] = dp_v[i];
            }
        }
        (whole(p, q), matrix)
    }
    /// exp's J_R(x, p), its series up to x^degree.
    #[inline(always)]
    fn momentum<T: Number>(x: [T; 6], p: [T; 6], degree: usize) -> [T; 6] {
        of_momenta(Space::momentum(coordinates(x), momenta(p), degree))
    }
    /// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω.
    #[inline(always)]
    fn rates<T: Number>(x: [T; 6], p: [T; 6], omega: [T; 6], degree: usize) -> [[T; 6]; 2] {
        let [velocity, force] =
            Space::rates(coordinates(x), momenta(p), coordinates(omega), degree);
        [of_coordinates(velocity), of_momenta(force)]
    }
    /// ad\*_x μ
    #[inline(always)]
    fn ad_star<T: Number>(x: [T; 6], mu: [T; 6]) -> [T; 6] {
        of_momenta(cross(momenta(mu), coordinates(x)))
    }
    /// \[x, y\]
    #[inline(always)]
    fn bracket<T: Number>(x: [T; 6], y: [T; 6]) -> [T; 6] {
        of_coordinates(cross(coordinates(x), coordinates(y)))
    }
    /// Ad\*_g (Π, Γ) = (RΠ + t×RΓ, RΓ)
    #[inline(always)]
    fn coadjoint<T: Number>([w, i, j, k, a, b, c]: [T; 7], mu: [T; 6]) -> [T; 6] {
        let [pi, gamma] = halves(mu);
        let [pi, gamma] = [rotate([w, i, j, k], pi), rotate([w, i, j, k], gamma)];
        whole(sum(pi, cross([a, b, c], gamma)), gamma)
    }
    /// (|ω|/limit)², for a chart that ends at |ω| = limit; NaN where v is not finite.
    #[inline(always)]
    fn extent<T: Number>(x: [T; 6], limit: f64) -> T {
        let [omega, v] = halves(x);
        Space::extent(omega, limit) + finite(v)
    }
    /// ||q|² − 1|; not a number where the translation is not finite.
    #[inline(always)]
    fn defect<T: Number>([w, i, j, k, a, b, c]: [T; 7]) -> T {
        Space::defect([w, i, j, k]) + finite([a, b, c])
    }
}

impl Matrices<7, 4> for Motions {
    /// The matrix of a motion.
    #[inline(always)]
    fn matrix<T: Number>([w, i, j, k, x, y, z]: [T; 7]) -> [[T; 4]; 4] {
        let ([a, b, c], zero) = (Space::matrix([w, i, j, k]), T::of(0.0));
        [
            [a[0], a[1], a[2], x],
            [b[0], b[1], b[2], y],
            [c[0], c[1], c[2], z],
            [zero, zero, zero, T::of(1.0)],
        ]
    }
}
