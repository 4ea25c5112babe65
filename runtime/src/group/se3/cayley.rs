//! The Cayley map of SE(3) in its 4×4 matrices.

use nalgebra::{Isometry3, Matrix6, Vector6};

use super::{SE3, V, isometry, join, split, unrotate};
use crate::group::CayleyGroup;
use crate::group::so3::{SO3, cross, dot};
use crate::number::scalar::Scalar;

/// (1 + ω̂/2)⁻¹ y (1 + |ω|²/4) = y + ½ y×ω + ¼ (ω·y) ω
#[inline(always)]
fn resolve<T: Scalar>(omega: &V<T>, y: &V<T>) -> V<T> {
    y + cross(y, omega) * T::of(0.5) + omega * (dot(omega, y) * T::of(0.25))
}

/// The parts of (d^R cay)ᵀ (Π, Γ) = (P, Q): Q = (1 + ω̂/2)⁻¹ Γ, r = ¼ Q×ω − ½ Q,
/// s = Π + v×r, P = f·(s + ½ s×ω), f = 1/(1 + |ω|²/4).
struct Parts<T: Scalar> {
    f: T,
    q: V<T>,
    r: V<T>,
    s: V<T>,
    p: V<T>,
}

impl<T: Scalar> Parts<T> {
    #[inline(always)]
    fn new(x: &Vector6<T>, mu: &Vector6<T>) -> Self {
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        let half = T::of(0.5);
        let f = T::of(1.0) / (T::of(1.0) + dot(&omega, &omega) * T::of(0.25));
        let q = resolve(&omega, &gamma) * f;
        let r = cross(&q, &omega) * T::of(0.25) - q * half;
        let s = pi + cross(&v, &r);
        let p = (s + cross(&s, &omega) * half) * f;
        Self { f, q, r, s, p }
    }
}

impl<T: Scalar> CayleyGroup for SE3<T> {
    #[inline(always)]
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        // cay(ω, v) has the rotation cay(ω) and the translation (1 − ω̂/2)⁻¹ v.
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        let f = T::of(1.0) / (T::of(1.0) + dot(&omega, &omega) * T::of(0.25));
        let t = resolve(&-omega, &v) * f;
        let lifted = pi - cross(&t, &gamma);
        let (rotation, angular) = SO3::new().cayley_transport(&omega, &lifted);
        let g = isometry(rotation, t);
        let moved = join(&angular, &unrotate(&g, &gamma));
        (g, moved)
    }

    #[inline(always)]
    fn cayley_extent(&self, x: &Self::Vector) -> T {
        let finite = (x[3] + x[4] + x[5]) * T::of(0.0);
        let angle = x[2].times_plus(x[2], x[1].times_plus(x[1], x[0] * x[0]));
        angle.times_plus(T::of(0.25), finite)
    }

    fn cayley_inverse(&self, g: &Isometry3<T>) -> Option<Self::Vector> {
        let omega = SO3::new().cayley_inverse(&g.rotation)?;
        let t = &g.translation.vector;
        Some(join(&omega, &(t - cross(&omega, t) * T::of(0.5))))
    }

    #[inline(always)]
    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let parts = Parts::new(x, mu);
        join(&parts.p, &parts.q)
    }

    #[inline(always)]
    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, Matrix6<T>) {
        let ((omega, v), (_, gamma)) = (split(x), split(mu));
        let Parts { f, q, r, s, p } = Parts::new(x, mu);
        let (zero, half, quarter) = (T::of(0.0), T::of(0.5), T::of(0.25));
        let mut derivative = Matrix6::repeat(zero);
        for j in 0..3 {
            let mut e = V::repeat(zero);
            e[j] = T::of(1.0);
            // Along ω: f changes by −½ f² ω_j.
            let stretch = f * omega[j] * (-half);
            let bent =
                cross(&gamma, &e) * half + (e * dot(&omega, &gamma) + omega * gamma[j]) * quarter;
            let dq = q * stretch + bent * f;
            let dr = (cross(&dq, &omega) + cross(&q, &e)) * quarter - dq * half;
            let ds = cross(&v, &dr);
            let dp = p * stretch + (ds + (cross(&ds, &omega) + cross(&s, &e)) * half) * f;
            // Along v only s changes.
            let ds = cross(&e, &r);
            let dp_v = (ds + cross(&ds, &omega) * half) * f;
            for i in 0..3 {
                derivative[(i, j)] = dp[i];
                derivative[(i + 3, j)] = dq[i];
                derivative[(i, j + 3)] = dp_v[i];
            }
        }
        (join(&p, &q), derivative)
    }

    #[inline(always)]
    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        // ⟨p, ξ − ½[x, ξ] − ¼ xξx⟩, where for ξ = (η, w): xξx = (−(ω·η) ω, ω×(η×v)).
        let ((omega, v), (angular, linear)) = (split(x), split(p));
        let (half, quarter) = (T::of(0.5), T::of(0.25));
        let turned = cross(&linear, &omega);
        let first = angular
            + (cross(&omega, &angular) + cross(&v, &linear)) * half
            + (omega * dot(&omega, &angular) - cross(&v, &turned)) * quarter;
        join(&first, &(linear - turned * half))
    }
}
