//! The exact Hamilton–Jacobi series, evaluated: what learned functions are compared with.

use coadjoint_codegen::hamilton_jacobi::GeneratingSeries;

use crate::function::MomentumFunction;

/// A polynomial as a list of monomials.
#[derive(Clone, Debug, PartialEq)]
pub struct Monomials {
    dim: usize,
    terms: Vec<(Vec<(usize, i32)>, f64)>,
}

impl Monomials {
    /// The polynomial Σ_k step^k S_k of an exact series without opaque symbols.
    #[must_use]
    pub fn of_series(series: &GeneratingSeries, step: f64) -> Self {
        let dim = series.dim();
        let mut terms = Vec::new();
        let mut power = 1.0;
        for k in 1..=series.truncation() {
            power *= step;
            for (exponents, coefficient) in series.order(k).terms() {
                let factors = exponents
                    .iter()
                    .enumerate()
                    .filter(|&(i, &e)| e > 0 && i < dim)
                    .map(|(i, &e)| (i, e.cast_signed()))
                    .collect();
                let ratio = num_traits::ToPrimitive::to_f64(&coefficient).unwrap_or(f64::NAN);
                terms.push((factors, power * ratio));
            }
        }
        Self { dim, terms }
    }
}

/// The derivative of Π pᵢ^eᵢ by the coordinates listed.
fn derivative(factors: &[(usize, i32)], p: &[f64], by: &[usize]) -> f64 {
    let mut product = 1.0;
    for &(i, exponent) in factors {
        let order = by.iter().filter(|&&j| j == i).count();
        let mut left = exponent;
        for _ in 0..order {
            product *= f64::from(left);
            left -= 1;
        }
        if left > 0 {
            product *= p[i].powi(left);
        }
    }
    let present = |j: &usize| factors.iter().any(|(i, _)| i == j);
    if by.iter().all(present) { product } else { 0.0 }
}

impl MomentumFunction for Monomials {
    fn dim(&self) -> usize {
        self.dim
    }

    fn value(&self, p: &[f64]) -> f64 {
        self.terms.iter().map(|(factors, c)| c * derivative(factors, p, &[])).sum()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        gradient.fill(0.0);
        for (factors, c) in &self.terms {
            for &(i, _) in factors {
                gradient[i] += c * derivative(factors, p, &[i]);
            }
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        hessian.fill(0.0);
        for (factors, c) in &self.terms {
            for &(i, _) in factors {
                for &(j, _) in factors {
                    hessian[i * self.dim + j] += c * derivative(factors, p, &[i, j]);
                }
            }
        }
    }
}
