//! exp(A) and φ(A) = (exp(A) − 1)/A for A = ad_xᵀ, applied to a momentum.
//!
//! Small A: the Taylor series until its terms vanish to rounding. Larger A: sub-steps, since
//! φ(A)μ = ∫₀¹ exp(sA)μ ds. Very large A: the matrices themselves, by doubling,
//! φ(2A) = ½ (exp(A) + 1) φ(A), so that the work grows only with the logarithm of ‖x‖.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::group::TableGroup;
use super::tables::Tables;
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::Scalar;

/// Up to this norm of A one Taylor series is used.
const TAYLOR: f64 = 1.5;
/// Up to this norm of A, sub-steps are.
const SUBSTEPS: f64 = 48.0;
/// Terms of a Taylor series for norms up to [`TAYLOR`]; rounding needs about 20 in f64.
const TERMS: usize = 30;

/// Square matrices of the algebra's dimension.
pub(crate) type Matrix<K> = <<K as Tables>::Vector as Coordinates<<K as Tables>::Scalar>>::Matrix;

/// φ(A)μ and exp(A)μ.
pub(crate) struct Action<V> {
    pub phi: V,
    pub exp: V,
}

/// How a norm is dealt with.
enum Regime {
    SubSteps(u32),
    Doublings(u32),
    NotFinite,
}

impl<K: Tables> TableGroup<K> {
    /// A bound of ‖ad_xᵀ‖ in the maximum norm.
    fn ad_norm(&self, x: &K::Vector) -> K::Scalar {
        let mut rows = K::Vector::zeros(self.algebra().dim);
        let mut poison = K::Scalar::of(0.0);
        for &(i, j, _, c) in self.algebra().structure {
            rows[j] = x[i].simd_abs().times_plus(K::Scalar::of(c.abs()), rows[j]);
        }
        for i in 0..self.algebra().dim {
            // The maximum of lanes may drop a NaN; this does not.
            poison += x[i] * K::Scalar::of(0.0);
        }
        rows.largest_entry() + poison
    }

    fn regime(&self, x: &K::Vector) -> Regime {
        let norm = self.ad_norm(x);
        let largest = norm.largest_lane();
        if largest <= TAYLOR {
            Regime::SubSteps(1)
        } else if largest <= SUBSTEPS {
            let mut steps = 1;
            while TAYLOR * f64::from(steps) < largest {
                steps += 1;
            }
            Regime::SubSteps(steps)
        } else {
            square::halvings(norm, 1.0).map_or(Regime::NotFinite, Regime::Doublings)
        }
    }

    fn not_a_number(&self) -> K::Vector {
        K::Vector::from_entries(self.algebra().dim, |_| K::Scalar::of(f64::NAN))
    }

    fn scaled(&self, x: &K::Vector, factor: K::Scalar) -> K::Vector {
        K::Vector::from_entries(self.algebra().dim, |i| x[i] * factor)
    }

    /// ad_xᵀ μ
    pub(super) fn ad_transpose(&self, x: &K::Vector, mu: &K::Vector) -> K::Vector {
        let mut result = K::Vector::zeros(self.algebra().dim);
        for &(i, j, k, c) in self.algebra().structure {
            result[j] = (x[i] * K::Scalar::of(c)).times_plus(mu[k], result[j]);
        }
        result
    }

    /// φ(A)μ by its Taylor series, ‖A‖ ≤ [`TAYLOR`].
    fn phi_series(&self, x: &K::Vector, mu: &K::Vector) -> K::Vector {
        let dim = self.algebra().dim;
        let rounding = K::Scalar::epsilon() * K::Scalar::of(0.125);
        let mut term = mu.clone();
        let mut sum = mu.clone();
        for k in 1..TERMS {
            let factor = K::Scalar::of(1.0 / (k + 1) as f64);
            term = self.scaled(&self.ad_transpose(x, &term), factor);
            sum = K::Vector::from_entries(dim, |i| sum[i] + term[i]);
            // ‖A‖/(k + 2) < 1, so that later terms are smaller.
            if term.largest_entry().simd_le(sum.largest_entry() * rounding).all() {
                break;
            }
        }
        sum
    }

    /// φ(A)μ and exp(A)μ, A = ad_xᵀ.
    pub(super) fn act(&self, x: &K::Vector, mu: &K::Vector) -> Action<K::Vector> {
        let dim = self.algebra().dim;
        match self.regime(x) {
            Regime::NotFinite => Action { phi: self.not_a_number(), exp: self.not_a_number() },
            Regime::Doublings(count) => {
                let (exp, phi) = self.action_matrices(x, count);
                Action { phi: mu.left_multiply(&phi), exp: mu.left_multiply(&exp) }
            }
            Regime::SubSteps(steps) => {
                let part = K::Scalar::of(1.0 / f64::from(steps));
                let x = self.scaled(x, part);
                let mut phi = K::Vector::zeros(dim);
                let mut exp = mu.clone();
                for _ in 0..steps {
                    let average = self.phi_series(&x, &exp);
                    let change = self.ad_transpose(&x, &average);
                    phi = K::Vector::from_entries(dim, |i| average[i].times_plus(part, phi[i]));
                    exp = K::Vector::from_entries(dim, |i| exp[i] + change[i]);
                }
                Action { phi, exp }
            }
        }
    }

    /// exp(A) and φ(A) as matrices, by `count` doublings.
    fn action_matrices(&self, x: &K::Vector, count: u32) -> (Matrix<K>, Matrix<K>) {
        let dim = self.algebra().dim;
        let one = K::Scalar::of(1.0);
        let x = self.scaled(x, square::half_power(count));
        let mut a = K::Vector::zero_matrix(dim);
        for &(i, j, k, c) in self.algebra().structure {
            a[(j, k)] = x[i].times_plus(K::Scalar::of(c), a[(j, k)]);
        }
        let unit = square::identity(dim, &a);
        let mut phi = unit.clone();
        let mut term = unit.clone();
        for k in 1..TERMS {
            term = square::multiply(dim, &a, &term);
            term = square::scale(dim, &term, K::Scalar::of(1.0 / (k + 1) as f64));
            phi = square::plus_scaled(dim, &phi, one, &term);
        }
        let mut exp = square::plus_scaled(dim, &unit, one, &square::multiply(dim, &a, &phi));
        for _ in 0..count {
            let sum = square::plus_scaled(dim, &exp, one, &unit);
            phi = square::scale(dim, &square::multiply(dim, &sum, &phi), K::Scalar::of(0.5));
            exp = square::multiply(dim, &exp, &exp);
        }
        (exp, phi)
    }
}
