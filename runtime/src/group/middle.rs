//! The exponential chart about the middle of a step, by the series J_R = Σ βₖ (ad\*_x)ᵏ p in any algebra.

use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// The powers of x a series may have.
pub(crate) const MAX_DEGREE: usize = 14;

/// βₖ = (−1)ᵏ Bₖ/k! with Bernoulli's numbers, B₁ = −½.
const BETA: [f64; MAX_DEGREE + 1] = [
    1.0,
    0.5,
    1.0 / 12.0,
    0.0,
    -1.0 / 720.0,
    0.0,
    1.0 / 30_240.0,
    0.0,
    -1.0 / 1_209_600.0,
    0.0,
    1.0 / 47_900_160.0,
    0.0,
    -691.0 / 1_307_674_368_000.0,
    0.0,
    1.0 / 74_724_249_600.0,
];

/// a + s·b
#[inline(always)]
fn plus<T: Scalar, V: Coordinates<T>>(mut a: V, s: T, b: &V) -> V {
    for i in 0..a.dim() {
        a[i] = b[i].times_plus(s, a[i]);
    }
    a
}

/// J_R(x, p), given the algebra's ad\*.
pub(super) fn momentum<T: Scalar, V: Coordinates<T>>(
    ad_star: impl Fn(&V, &V) -> V,
    x: &V,
    p: V,
    degree: usize,
) -> V {
    let mut power = p.clone();
    let mut sum = p;
    for &beta in BETA.iter().take(degree + 1).skip(1) {
        power = ad_star(x, &power);
        if beta != 0.0 {
            sum = plus(sum, T::of(beta), &power);
        }
    }
    sum
}

/// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω, given the algebra's ad\* and bracket: with wₖ = (ad\*_x)ᵏ p and a_d = β_d ω,
/// aₖ = βₖ ω + [x, aₖ₊₁], they are a₀ and Σ ad\*_{aₖ₊₁} wₖ.
pub(super) fn rates<T: Scalar, V: Coordinates<T>>(
    ad_star: impl Fn(&V, &V) -> V,
    bracket: impl Fn(&V, &V) -> V,
    [x, p, omega]: [V; 3],
    degree: usize,
) -> (V, V) {
    let degree = degree.min(MAX_DEGREE);
    let mut powers: [Option<V>; MAX_DEGREE] = [const { None }; MAX_DEGREE];
    let mut power = p;
    for place in powers.iter_mut().take(degree) {
        let next = ad_star(&x, &power);
        *place = Some(core::mem::replace(&mut power, next));
    }
    let zero = V::zeros(x.dim());
    let mut a = plus(zero.clone(), T::of(BETA[degree]), &omega);
    let mut force = zero;
    for (k, power) in powers.iter().enumerate().take(degree).rev() {
        if let Some(power) = power {
            force = plus(force, T::of(1.0), &ad_star(&a, power));
        }
        a = bracket(&x, &a);
        if BETA[k] != 0.0 {
            a = plus(a, T::of(BETA[k]), &omega);
        }
    }
    (a, force)
}
