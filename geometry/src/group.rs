//! A group in closed form, for whoever uses its formulas without knowing which group it is.

use crate::angle::Length;
use crate::number::Number;

/// A group with formulas: N coordinates, elements of M numbers. Conventions: \[eᵢ, eⱼ\] = Σ cᵢⱼᵏ eₖ,
/// ⟨Ad\*_g μ, ξ⟩ = ⟨μ, Ad_{g⁻¹} ξ⟩.
pub trait Group<const N: usize, const M: usize> {
    /// An increment τ(x), as formulas have it.
    type Increment<T: Number>: Copy;

    /// The |x| of rotations at which the Cayley chart ends; the exponential one ends at π.
    const CAYLEY_LIMIT: f64;

    /// exp x
    fn exp<T: Number>(x: [T; N], length: Length) -> Self::Increment<T>;

    /// cay x
    fn cayley<T: Number>(x: [T; N]) -> Self::Increment<T>;

    /// g·h, pulled back onto the group to first order, so that rounding does not accumulate over many steps.
    fn after<T: Number>(h: Self::Increment<T>, g: [T; M]) -> [T; M];

    /// Ad\*_{h⁻¹} μ
    fn back<T: Number>(h: Self::Increment<T>, mu: [T; N]) -> [T; N];

    /// (d^R exp_x)ᵀ μ
    fn pull_back<T: Number>(x: [T; N], mu: [T; N], length: Length) -> [T; N];

    /// (d^R exp_x)ᵀ μ and its derivative in x, which Newton's method alone uses, for rotations up to a quarter turn.
    fn pull_back_with_derivative<T: Number>(x: [T; N], mu: [T; N]) -> ([T; N], [[T; N]; N]);

    /// (d^R cay_x)ᵀ μ
    #[inline(always)]
    fn cayley_pull_back<T: Number>(x: [T; N], mu: [T; N]) -> [T; N] {
        Self::cayley_pull_back_with_derivative(x, mu).0
    }

    /// (d^R cay_x)ᵀ μ and its derivative in x.
    fn cayley_pull_back_with_derivative<T: Number>(x: [T; N], mu: [T; N]) -> ([T; N], [[T; N]; N]);

    /// exp's J_R(x, p), its series up to x^degree.
    fn momentum<T: Number>(x: [T; N], p: [T; N], degree: usize) -> [T; N];

    /// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω.
    fn rates<T: Number>(x: [T; N], p: [T; N], omega: [T; N], degree: usize) -> [[T; N]; 2];

    /// ad\*_x μ
    fn ad_star<T: Number>(x: [T; N], mu: [T; N]) -> [T; N];

    /// \[x, y\]
    fn bracket<T: Number>(x: [T; N], y: [T; N]) -> [T; N];

    /// Ad\*_g μ
    fn coadjoint<T: Number>(g: [T; M], mu: [T; N]) -> [T; N];

    /// (|x|/limit)² of the rotations in x, for a chart that ends at this limit; NaN where x is not finite.
    fn extent<T: Number>(x: [T; N], limit: f64) -> T;

    /// The distance of g from the group; not a number where g is not finite.
    fn defect<T: Number>(g: [T; M]) -> T;
}

/// A group whose elements are known as matrices of D rows, too.
pub trait Matrices<const M: usize, const D: usize> {
    /// The matrix of g.
    fn matrix<T: Number>(g: [T; M]) -> [[T; D]; D];
}
