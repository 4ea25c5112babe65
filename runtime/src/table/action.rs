//! exp(A) and φ(A) = (exp(A) − 1)/A for A = ad_xᵀ, applied to a momentum.
//!
//! Small A: the Taylor series until its terms vanish to rounding. Larger A: sub-steps, since
//! φ(A)μ = ∫₀¹ exp(sA)μ ds. Very large A: the matrices themselves, by doubling,
//! φ(2A) = ½ (exp(A) + 1) φ(A), so that the work grows only with the logarithm of ‖x‖.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::algebra::Tables;
use super::group::TableGroup;
use super::linear;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

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
        let mut rows = K::Vector::zeros(self.tables.dim());
        let mut poison = K::Scalar::of(0.0);
        for &(i, j, _, c) in self.tables.structure() {
            rows[j] = x[i].simd_abs().times_plus(K::Scalar::of(c.abs()), rows[j]);
        }
        for i in 0..self.tables.dim() {
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
            linear::halvings(norm, 1.0).map_or(Regime::NotFinite, Regime::Doublings)
        }
    }

    fn not_a_number(&self) -> K::Vector {
        K::Vector::from_entries(self.tables.dim(), |_| K::Scalar::of(f64::NAN))
    }

    fn scaled(&self, x: &K::Vector, factor: K::Scalar) -> K::Vector {
        K::Vector::from_entries(self.tables.dim(), |i| x[i] * factor)
    }

    /// ad_xᵀ μ
    #[inline(always)]
    pub(super) fn ad_transpose(&self, x: &K::Vector, mu: &K::Vector) -> K::Vector {
        let mut result = K::Vector::zeros(self.tables.dim());
        for &(i, j, k, c) in self.tables.structure() {
            result[j] = (x[i] * K::Scalar::of(c)).times_plus(mu[k], result[j]);
        }
        result
    }

    /// φ(A)μ by its Taylor series, ‖A‖ ≤ [`TAYLOR`].
    fn phi_series(&self, x: &K::Vector, mu: &K::Vector) -> K::Vector {
        let dim = self.tables.dim();
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
        let dim = self.tables.dim();
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

    /// φ(A)μ and its derivative in x.
    pub(super) fn phi_with_derivative(
        &self,
        x: &K::Vector,
        mu: &K::Vector,
    ) -> (K::Vector, Matrix<K>) {
        let dim = self.tables.dim();
        match self.regime(x) {
            Regime::NotFinite => {
                let derivative =
                    K::Vector::matrix_from_entries(dim, |_, _| K::Scalar::of(f64::NAN));
                (self.not_a_number(), derivative)
            }
            Regime::Doublings(count) => self.phi_by_doubling(x, mu, count),
            Regime::SubSteps(steps) => {
                let part = K::Scalar::of(1.0 / f64::from(steps));
                let x = self.scaled(x, part);
                let mut phi = K::Vector::zeros(dim);
                let mut phi_slope = K::Vector::zero_matrix(dim);
                let mut exp = mu.clone();
                let mut exp_slope = K::Vector::zero_matrix(dim);
                for step in 1..=steps {
                    let (average, slope) = self.phi_series_slope(&x, &exp, &exp_slope, part);
                    phi = K::Vector::from_entries(dim, |i| average[i].times_plus(part, phi[i]));
                    phi_slope = linear::plus_scaled(dim, &phi_slope, part, &slope);
                    if step < steps {
                        let change = self.ad_transpose(&x, &average);
                        exp = K::Vector::from_entries(dim, |i| exp[i] + change[i]);
                        let change = self.ad_slope(&x, &average, &slope, part);
                        exp_slope =
                            linear::plus_scaled(dim, &exp_slope, K::Scalar::of(1.0), &change);
                    }
                }
                (phi, phi_slope)
            }
        }
    }

    /// The derivative of ad_{part·y}ᵀ v at part·y = x, in y: ad_xᵀ v_slope + part · (ad_{eᵢ}ᵀ v)ᵢ.
    fn ad_slope(
        &self,
        x: &K::Vector,
        v: &K::Vector,
        v_slope: &Matrix<K>,
        part: K::Scalar,
    ) -> Matrix<K> {
        let dim = self.tables.dim();
        let mut result = K::Vector::zero_matrix(dim);
        for &(i, j, k, c) in self.tables.structure() {
            let c = K::Scalar::of(c);
            let factor = x[i] * c;
            for column in 0..dim {
                result[(j, column)] = factor.times_plus(v_slope[(k, column)], result[(j, column)]);
            }
            result[(j, i)] = (c * part).times_plus(v[k], result[(j, i)]);
        }
        result
    }

    /// [`TableGroup::phi_series`] with the derivative, where μ has the derivative `mu_slope`.
    fn phi_series_slope(
        &self,
        x: &K::Vector,
        mu: &K::Vector,
        mu_slope: &Matrix<K>,
        part: K::Scalar,
    ) -> (K::Vector, Matrix<K>) {
        let dim = self.tables.dim();
        let rounding = K::Scalar::epsilon() * K::Scalar::of(0.125);
        let one = K::Scalar::of(1.0);
        let (mut term, mut sum) = (mu.clone(), mu.clone());
        let (mut term_slope, mut sum_slope) = (mu_slope.clone(), mu_slope.clone());
        for k in 1..TERMS {
            let factor = K::Scalar::of(1.0 / (k + 1) as f64);
            let slope = self.ad_slope(x, &term, &term_slope, part);
            term_slope = linear::scale(dim, &slope, factor);
            sum_slope = linear::plus_scaled(dim, &sum_slope, one, &term_slope);
            term = self.scaled(&self.ad_transpose(x, &term), factor);
            sum = K::Vector::from_entries(dim, |i| sum[i] + term[i]);
            if term.largest_entry().simd_le(sum.largest_entry() * rounding).all() {
                break;
            }
        }
        (sum, sum_slope)
    }

    /// exp(A) and φ(A) as matrices, by `count` doublings.
    fn action_matrices(&self, x: &K::Vector, count: u32) -> (Matrix<K>, Matrix<K>) {
        let dim = self.tables.dim();
        let one = K::Scalar::of(1.0);
        let x = self.scaled(x, linear::half_power(count));
        let mut a = K::Vector::zero_matrix(dim);
        for &(i, j, k, c) in self.tables.structure() {
            a[(j, k)] = x[i].times_plus(K::Scalar::of(c), a[(j, k)]);
        }
        let unit = linear::identity(dim, &a);
        let mut phi = unit.clone();
        let mut term = unit.clone();
        for k in 1..TERMS {
            term = linear::multiply(dim, &a, &term);
            term = linear::scale(dim, &term, K::Scalar::of(1.0 / (k + 1) as f64));
            phi = linear::plus_scaled(dim, &phi, one, &term);
        }
        let mut exp = linear::plus_scaled(dim, &unit, one, &linear::multiply(dim, &a, &phi));
        for _ in 0..count {
            let sum = linear::plus_scaled(dim, &exp, one, &unit);
            phi = linear::scale(dim, &linear::multiply(dim, &sum, &phi), K::Scalar::of(0.5));
            exp = linear::multiply(dim, &exp, &exp);
        }
        (exp, phi)
    }

    /// The matrix φ(A).
    pub(super) fn phi_matrix(&self, x: &K::Vector) -> Matrix<K> {
        match linear::halvings(self.ad_norm(x), 1.0) {
            Some(count) => self.action_matrices(x, count).1,
            None => {
                K::Vector::matrix_from_entries(self.tables.dim(), |_, _| K::Scalar::of(f64::NAN))
            }
        }
    }

    /// φ(A)μ and its derivative by doubling of exp, φ and their derivatives, one direction after
    /// the other: (φ(2A))′ = ½ (exp′ φ + (exp + 1) φ′).
    fn phi_by_doubling(&self, x: &K::Vector, mu: &K::Vector, count: u32) -> (K::Vector, Matrix<K>) {
        let dim = self.tables.dim();
        let (one, half) = (K::Scalar::of(1.0), K::Scalar::of(0.5));
        let part = linear::half_power(count);
        let small = self.scaled(x, part);
        let mut derivative = K::Vector::zero_matrix(dim);
        let mut value = mu.clone();
        let unit = linear::identity(dim, &derivative);
        for direction in 0..dim {
            // Column by column, exp and φ at the small argument with their slopes.
            let mut exp = unit.clone();
            let mut phi = unit.clone();
            let mut exp_slope = K::Vector::zero_matrix(dim);
            let mut phi_slope = K::Vector::zero_matrix(dim);
            for column in 0..dim {
                let e = K::Vector::from_entries(dim, |i| unit[(i, column)]);
                let zero = K::Vector::zero_matrix(dim);
                let (v, slope) = self.phi_series_slope(&small, &e, &zero, part);
                let moved = self.ad_transpose(&small, &v);
                let moved_slope = self.ad_slope(&small, &v, &slope, part);
                for i in 0..dim {
                    phi[(i, column)] = v[i];
                    phi_slope[(i, column)] = slope[(i, direction)];
                    exp[(i, column)] = e[i] + moved[i];
                    exp_slope[(i, column)] = moved_slope[(i, direction)];
                }
            }
            for _ in 0..count {
                let sum = linear::plus_scaled(dim, &exp, one, &unit);
                let turned = linear::multiply(dim, &exp_slope, &phi);
                let carried = linear::multiply(dim, &sum, &phi_slope);
                phi_slope = linear::plus_scaled(dim, &turned, one, &carried);
                phi_slope = linear::scale(dim, &phi_slope, half);
                phi = linear::scale(dim, &linear::multiply(dim, &sum, &phi), half);
                let left = linear::multiply(dim, &exp_slope, &exp);
                let right = linear::multiply(dim, &exp, &exp_slope);
                exp_slope = linear::plus_scaled(dim, &left, one, &right);
                exp = linear::multiply(dim, &exp, &exp);
            }
            let column = mu.left_multiply(&phi_slope);
            for i in 0..dim {
                derivative[(i, direction)] = column[i];
            }
            value = mu.left_multiply(&phi);
        }
        (value, derivative)
    }

    /// φ(A)⁻¹ p: the Bernoulli series where ‖A‖ ≤ 1, where it gains more than a factor 39 with
    /// each term, a linear solve elsewhere.
    pub(super) fn phi_inverse(&self, x: &K::Vector, p: &K::Vector) -> K::Vector {
        /// B₂ₖ/(2k)!, k = 1, 2, … (Abramowitz and Stegun, table 23.2).
        const BERNOULLI: [f64; 11] = [
            1.0 / 12.0,
            -1.0 / 720.0,
            1.0 / 30_240.0,
            -1.0 / 1_209_600.0,
            1.0 / 47_900_160.0,
            -691.0 / 1_307_674_368_000.0,
            1.0 / 74_724_249_600.0,
            -3617.0 / 10_670_622_842_880_000.0,
            43_867.0 / 5_109_094_217_170_944_000.0,
            -174_611.0 / 802_857_662_698_291_200_000.0,
            77_683.0 / 14_101_100_039_391_805_440_000.0,
        ];
        let dim = self.tables.dim();
        if self.ad_norm(x).largest_lane() <= 1.0 {
            let once = self.ad_transpose(x, p);
            let mut sum =
                K::Vector::from_entries(dim, |i| once[i].times_plus(K::Scalar::of(-0.5), p[i]));
            let mut term = once;
            for (k, b) in BERNOULLI.into_iter().enumerate() {
                if k > 0 {
                    term = self.ad_transpose(x, &term);
                }
                term = self.ad_transpose(x, &term);
                sum =
                    K::Vector::from_entries(dim, |i| term[i].times_plus(K::Scalar::of(b), sum[i]));
            }
            return sum;
        }
        p.left_multiply(&linear::invert(dim, &self.phi_matrix(x)))
    }
}
