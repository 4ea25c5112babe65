//! Gradients and brackets in floating point.

use crate::lie::LieAlgebra;
use crate::poly::{Numeric, Polynomial};

/// ∂F/∂μ of a polynomial F, with values put in for the symbols.
#[derive(Clone, Debug)]
pub(super) struct Gradient(Vec<Numeric>);

impl Gradient {
    pub(super) fn new(polynomial: &Polynomial, dim: usize, symbols: &[f64]) -> Self {
        Self(Numeric::new(polynomial, dim, symbols).gradient(dim))
    }

    /// The gradient at μ.
    pub(super) fn at(&self, mu: &[f64]) -> Vec<f64> {
        self.0.iter().map(|derivative| derivative.value(mu)).collect()
    }
}

/// The brackets of a Lie algebra.
#[derive(Clone, Debug)]
pub(super) struct Brackets {
    dim: usize,
    /// [eᵢ, eⱼ] contains c·eₖ.
    structure: Vec<(usize, usize, usize, f64)>,
}

impl Brackets {
    pub(super) fn new(algebra: &LieAlgebra) -> Self {
        Self { dim: algebra.dim(), structure: algebra.constants() }
    }

    /// [x, y].
    pub(super) fn bracket(&self, x: &[f64], y: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.dim];
        for &(i, j, k, c) in &self.structure {
            result[k] += c * x[i] * y[j];
        }
        result
    }

    /// ad\*_x μ.
    pub(super) fn ad_star(&self, x: &[f64], mu: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.dim];
        for &(i, j, k, c) in &self.structure {
            result[j] += c * x[i] * mu[k];
        }
        result
    }

    /// The spectral radius of ad_x, by ‖A^(2^m)‖^(2^−m): the rate at which x turns the algebra.
    pub(super) fn turning_rate(&self, x: &[f64]) -> f64 {
        let mut matrix = vec![0.0; self.dim * self.dim];
        for &(i, j, k, c) in &self.structure {
            matrix[k * self.dim + j] += c * x[i];
        }
        spectral_radius(self.dim, matrix)
    }
}

/// About the largest modulus of an eigenvalue of a square matrix.
pub(super) fn spectral_radius(n: usize, mut matrix: Vec<f64>) -> f64 {
    const SQUARINGS: i32 = 6;
    // The logarithm of the scale taken out so far.
    let mut logarithm = 0.0;
    let mut power = 1.0;
    for _ in 0..SQUARINGS {
        let size = matrix.iter().map(|a| a * a).sum::<f64>().sqrt();
        if size == 0.0 || !size.is_finite() {
            return if size == 0.0 { 0.0 } else { f64::INFINITY };
        }
        logarithm += size.ln() / power;
        power *= 2.0;
        let scaled: Vec<f64> = matrix.iter().map(|a| a / size).collect();
        for i in 0..n {
            for j in 0..n {
                matrix[i * n + j] = (0..n).map(|k| scaled[i * n + k] * scaled[k * n + j]).sum();
            }
        }
    }
    let size = matrix.iter().map(|a| a * a).sum::<f64>().sqrt();
    // Rounding leaves about 1e-16 of a nilpotent matrix.
    if size < 1e-14 { 0.0 } else { (logarithm + size.ln() / power).exp() }
}

/// The largest absolute entry.
pub(super) fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |a, b| f64::max(a, b.abs()))
}
