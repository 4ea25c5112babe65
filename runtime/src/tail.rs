//! Summing the tail of the series.
//!
//! S_{K+2}, S_{K+4}, … are left out of a truncated series, yet what went before foretells them: seen
//! as functions of t, S and its gradient have their nearest singularities on the real axis (where the
//! chart folds), so that along a motion ∂S_{k+2}/∂p ≈ a ∂S_k/∂p + b ∂S_{k−2}/∂p, with a and b that
//! hardly change with k or p. Summing the tail of that recurrence multiplies S_{K−2} and S_K by
//! numbers close to one: a step costs what it did, and its error falls by a factor of 4 to 8 for
//! K = 7 and of 10 to 100 for K = 9 and more (measured on free, heavy and submerged bodies).
//!
//! The factors differ from one by O(h²) and multiply terms of order h^{K−2} and h^K; b, which alone
//! touches S_{K−2}, carries h⁴. So the order of accuracy stays K + 1; and since any function of p
//! generates an equivariant symplectic map, the geometry is as exact as before.
//!
//! This is the summation of Shanks, J. Math. Phys. 34 (1955) 1–42, with one recurrence for all
//! coordinates and momenta.

use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, VectorOf};
use crate::reconstruct::{about_onwards, poisson_map};
use crate::scalar::Scalar;

/// Momenta along the motion from each one given, a step apart; the last of them is looked at.
const STEPS: usize = 22;
/// Of so many momenta one is looked at.
const SPACING: usize = 3;

/// The factors of the terms S_k that sum the tail of a series: what `tuned` of a generated
/// integrator uses. Far from the motions it was made for the map is of the same order, and as
/// geometric, but no longer better than the plain series.
///
/// ```
/// use coadjoint::{Phase, SO3, lie_poisson};
///
/// #[lie_poisson(group = SO3, truncation = 9)]
/// fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
///     0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
/// }
///
/// # fn main() -> Result<(), coadjoint::StepError> {
/// let (inertia, start) = ([1.5, 2.0, 2.5], [2.0, 0.5, 1.0]);
/// let end = |step: Body, steps| {
///     let mut state = Phase::<SO3>::at_identity(start);
///     (0..steps).try_for_each(|_| step.advance(&mut state).map(|_| ()))?;
///     Ok::<_, coadjoint::StepError>(state.momentum)
/// };
/// let exact = end(Body::new(0.05, inertia)?, 400)?;
/// let plain = (end(Body::new(0.5, inertia)?, 40)? - exact).amax();
/// let tuned = (end(Body::tuned(0.5, inertia, [start])?, 40)? - exact).amax();
/// assert!(tuned < plain / 5.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tail<T> {
    truncation: usize,
    last: T,
    last_but_one: T,
}

impl<T: Scalar> Tail<T> {
    /// Nothing but the series S₁ … S_K itself.
    #[must_use]
    pub fn none(truncation: usize) -> Self {
        Self { truncation, last: T::of(1.0), last_but_one: T::of(1.0) }
    }

    /// The factor of S_k.
    #[inline]
    #[must_use]
    pub fn factor(&self, k: usize) -> T {
        if k == self.truncation {
            self.last
        } else if k + 2 == self.truncation {
            self.last_but_one
        } else {
            T::of(1.0)
        }
    }

    /// The tail for motions that start with `momenta`, twenty-two steps of each. `series` makes the
    /// generating function Σ factor(k) S_k for given factors. Where the terms do not fall fast
    /// enough to tell, and for K < 5, all factors are one.
    ///
    /// # Errors
    /// Those of the steps.
    pub fn along<S>(
        truncation: usize,
        momenta: impl IntoIterator<Item = VectorOf<S>>,
        series: impl Fn(&dyn Fn(usize) -> T) -> S,
    ) -> Result<Self, StepError>
    where
        S: GeneratingFunction,
        S::Group: crate::LieGroup<Scalar = T>,
    {
        let none = Self::none(truncation);
        let (Some(before), Some(first)) = (truncation.checked_sub(2), truncation.checked_sub(4))
        else {
            return Ok(none);
        };
        let only = |order: usize| series(&|k| T::of(if k == order { 1.0 } else { 0.0 }));
        let whole = series(&|_| T::of(1.0));
        let (first, before, last) = (only(first), only(before), only(truncation));
        let mut products = Products::default();
        for start in momenta {
            // Tells whether steps can be made from there.
            let mut mu = poisson_map(&whole, &start)?;
            for step in 0..STEPS {
                if step % SPACING == 0 {
                    // p differs from μ by O(h), where the recurrence is the same.
                    products.add(first.gradient(&mu), before.gradient(&mu), last.gradient(&mu));
                }
                mu = about_onwards(&whole, &mu)?;
            }
        }
        let (a, b) = products.recurrence(truncation > 5);
        // T = Σ_{k>K} with S_{k+2} = a S_k + b S_{k−2} is (1 − a − b) T = (a + b) S_K + b S_{K−2}.
        let share = T::of(1.0) / (T::of(1.0) - a - b);
        Ok(Self {
            last: (a + b).times_plus(share, T::of(1.0)),
            last_but_one: b.times_plus(share, T::of(1.0)),
            ..none
        })
    }
}

/// Sums over samples of the products of u = ∂S_{K−4}, v = ∂S_{K−2} and w = ∂S_K.
struct Products<T> {
    uu: T,
    uv: T,
    vv: T,
    uw: T,
    vw: T,
}

impl<T: Scalar> Default for Products<T> {
    fn default() -> Self {
        let zero = T::of(0.0);
        Self { uu: zero, uv: zero, vv: zero, uw: zero, vw: zero }
    }
}

impl<T: Scalar> Products<T> {
    fn add<V: Coordinates<T>>(&mut self, u: V, v: V, w: V) {
        self.uu += u.pairing(&u);
        self.uv += u.pairing(&v);
        self.vv += v.pairing(&v);
        self.uw += u.pairing(&w);
        self.vw += v.pairing(&w);
    }

    /// The (a, b) for which w ≈ a v + b u in the sense of least squares; (a, 0) if one term is all
    /// that is wanted or can be told; (0, 0) where the terms do not fall.
    fn recurrence(&self, two: bool) -> (T, T) {
        let zero = T::of(0.0);
        let settled = |a: T, b: T| (a.simd_abs() + b.simd_abs()).simd_lt(T::of(0.5));
        let divide = |a: T, b: T| {
            let positive = b.simd_gt(zero);
            (a / b.select(positive, T::of(1.0))).select(positive, zero)
        };
        let one_term = divide(self.vw, self.vv);
        let one_term = one_term.select(settled(one_term, zero), zero);
        if !two {
            return (one_term, zero);
        }
        let determinant = self.uu * self.vv - self.uv * self.uv;
        let told = determinant.simd_gt(self.uu * self.vv * T::epsilon().simd_sqrt());
        let a = divide(self.uu * self.vw - self.uv * self.uw, determinant);
        let b = divide(self.vv * self.uw - self.uv * self.vw, determinant);
        let good = told & settled(a, b);
        (a.select(good, one_term), b.select(good, zero))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    fn products(a: f64, b: f64) -> Products<f64> {
        let mut products = Products::default();
        for i in 0..5 {
            let (u, v) = (Vector2::new(1.0, f64::from(i)), Vector2::new(0.1 * f64::from(i), 0.3));
            products.add(u, v, v * a + u * b);
        }
        products
    }

    #[test]
    fn a_recurrence_is_found() {
        let (a, b) = products(0.2, 0.03).recurrence(true);
        assert!((a - 0.2).abs() < 1e-14 && (b - 0.03).abs() < 1e-14, "{a} {b}");
        assert_eq!(products(0.2, 0.0).recurrence(false).1, 0.0);
    }

    #[test]
    fn nothing_is_told_from_terms_that_vanish_or_grow() {
        assert_eq!(Products::<f64>::default().recurrence(true), (0.0, 0.0));
        assert_eq!(products(2.0, 0.0).recurrence(true), (0.0, 0.0));
        assert_eq!(products(2.0, 0.0).recurrence(false), (0.0, 0.0));
    }

    #[test]
    fn parallel_terms_leave_one_factor() {
        let mut products = Products::<f64>::default();
        let u = Vector2::new(1.0, 2.0);
        products.add(u, u * 0.1, u * 0.01);
        let (a, b) = products.recurrence(true);
        assert!((a - 0.1).abs() < 1e-15 && b == 0.0, "{a} {b}");
    }
}
