//! The exponential chart about the middle of a step, by the series J_R = Σ βₖ (ad\*_x)ᵏ p in any algebra.

use coadjoint_geometry::bernoulli::{BETA, MAX_DEGREE};

use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// a ← a + s·b at each node.
#[inline(always)]
pub(crate) fn add<T: Scalar, V: Coordinates<T>, const M: usize>(
    dim: usize,
    a: &mut V::Rows<M>,
    s: T,
    b: &V::Rows<M>,
) {
    for k in 0..dim {
        for i in 0..M {
            a[k][i] = b[k][i].times_plus(s, a[k][i]);
        }
    }
}

/// J_R(x, p) at each node, given the algebra's ad\*.
pub(super) fn momenta<T: Scalar, V: Coordinates<T>, const M: usize>(
    dim: usize,
    ad_stars: impl Fn(&V::Rows<M>, &V::Rows<M>) -> V::Rows<M>,
    x: &V::Rows<M>,
    p: &V::Rows<M>,
    degree: usize,
) -> V::Rows<M> {
    let (mut power, mut sum) = (p.clone(), p.clone());
    for &beta in BETA.iter().take(degree + 1).skip(1) {
        power = ad_stars(x, &power);
        if beta != 0.0 {
            add::<T, V, M>(dim, &mut sum, T::of(beta), &power);
        }
    }
    sum
}

/// ẋ = (∂J_R/∂p)ᵀ ω and ṗ = −(∂J_R/∂x)ᵀ ω at each node, given the algebra's ad\* and bracket: with wₖ = (ad\*_x)ᵏ p and
/// a_d = β_d ω, aₖ = βₖ ω + [x, aₖ₊₁], they are a₀ and Σ ad\*_{aₖ₊₁} wₖ.
pub(super) fn rates<T: Scalar, V: Coordinates<T>, const M: usize>(
    dim: usize,
    ad_stars: impl Fn(&V::Rows<M>, &V::Rows<M>) -> V::Rows<M>,
    brackets: impl Fn(&V::Rows<M>, &V::Rows<M>) -> V::Rows<M>,
    [x, p, omega]: [&V::Rows<M>; 3],
    degree: usize,
) -> [V::Rows<M>; 2] {
    let degree = degree.min(MAX_DEGREE);
    let mut powers: [Option<V::Rows<M>>; MAX_DEGREE] = [const { None }; MAX_DEGREE];
    let mut power = p.clone();
    for place in powers.iter_mut().take(degree) {
        let next = ad_stars(x, &power);
        *place = Some(core::mem::replace(&mut power, next));
    }
    let (mut a, mut force) = (V::zero_rows::<M>(dim), V::zero_rows::<M>(dim));
    add::<T, V, M>(dim, &mut a, T::of(BETA[degree]), omega);
    for (k, power) in powers.iter().enumerate().take(degree).rev() {
        if let Some(power) = power {
            add::<T, V, M>(dim, &mut force, T::of(1.0), &ad_stars(&a, power));
        }
        a = brackets(x, &a);
        if BETA[k] != 0.0 {
            add::<T, V, M>(dim, &mut a, T::of(BETA[k]), omega);
        }
    }
    [a, force]
}
