//! A polynomial in the Chebyshev basis.

use serde::{Deserialize, Serialize};

use super::basis::{Basis, Scaling};
use crate::function::MomentumFunction;

/// S(p) = Σ_k c_k φ_k(u(p)), the φ_k products of Chebyshev polynomials of total degree ≤ d.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct PolynomialModel {
    basis: Basis,
    scaling: Scaling,
    coefficients: Vec<f64>,
}

/// The form on disk: the basis follows from dimension and degree.
#[derive(Serialize, Deserialize)]
struct Stored {
    degree: usize,
    scaling: Scaling,
    coefficients: Vec<f64>,
}

impl From<PolynomialModel> for Stored {
    fn from(model: PolynomialModel) -> Self {
        Self {
            degree: model.basis.degree(),
            scaling: model.scaling,
            coefficients: model.coefficients,
        }
    }
}

impl TryFrom<Stored> for PolynomialModel {
    type Error = String;

    fn try_from(stored: Stored) -> Result<Self, String> {
        let Scaling { centre, half_width } = &stored.scaling;
        let dim = centre.len();
        let expected = Basis::size(dim, stored.degree);
        if dim == 0 || half_width.len() != dim {
            return Err(format!(
                "the scaling has {dim} centres and {} half widths; both must be n > 0 numbers",
                half_width.len()
            ));
        }
        if stored.coefficients.len() != expected {
            return Err(format!(
                "degree {} in {dim} coordinates takes {expected} coefficients, {} are given",
                stored.degree,
                stored.coefficients.len()
            ));
        }
        if !half_width.iter().all(|w| w.is_finite() && *w > 0.0)
            || !centre.iter().chain(&stored.coefficients).all(|v| v.is_finite())
        {
            return Err("coefficients and scaling must be finite, half widths positive".into());
        }
        let basis = Basis::new(dim, stored.degree);
        Ok(Self { basis, scaling: stored.scaling, coefficients: stored.coefficients })
    }
}

impl PolynomialModel {
    /// The zero polynomial in `basis`.
    #[must_use]
    pub fn zero(basis: Basis, scaling: Scaling) -> Self {
        let coefficients = vec![0.0; basis.len()];
        Self { basis, scaling, coefficients }
    }

    /// The same basis and scaling with other coefficients; missing ones are 0.
    #[must_use]
    pub fn with_coefficients(mut self, coefficients: &[f64]) -> Self {
        self.coefficients.iter_mut().enumerate().for_each(|(k, c)| {
            *c = coefficients.get(k).copied().unwrap_or(0.0);
        });
        self
    }

    /// The basis.
    #[must_use]
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The normalisation of the inputs.
    #[must_use]
    pub fn scaling(&self) -> &Scaling {
        &self.scaling
    }

    /// The coefficients c_k, in the order of [`Basis::terms`].
    #[must_use]
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// ∂φ_k/∂p_j at `p` for every basis function: `row[k·n + j]`, `row` of length len·n.
    pub fn basis_gradients(&self, p: &[f64], row: &mut [f64]) {
        let tables = self.tables(p);
        for (term, out) in self.basis.terms().zip(row.chunks_exact_mut(self.basis.dim())) {
            for (j, entry) in out.iter_mut().enumerate() {
                *entry = tables.product(term, [j, usize::MAX]) / self.scaling.half_width[j];
            }
        }
    }

    /// φ_k(p) for every basis function.
    pub fn basis_values(&self, p: &[f64], row: &mut [f64]) {
        let tables = self.tables(p);
        for (term, out) in self.basis.terms().zip(row) {
            *out = tables.product(term, [usize::MAX; 2]);
        }
    }

    fn tables(&self, p: &[f64]) -> super::basis::Tables {
        self.basis.tables(p.iter().enumerate().map(|(i, &v)| self.scaling.normalise(i, v)))
    }
}

impl MomentumFunction for PolynomialModel {
    fn dim(&self) -> usize {
        self.basis.dim()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let tables = self.tables(p);
        let terms = self.basis.terms().zip(&self.coefficients);
        terms.map(|(term, c)| c * tables.product(term, [usize::MAX; 2])).sum()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let tables = self.tables(p);
        gradient.fill(0.0);
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            for j in (0..term.len()).filter(|&j| term[j] != 0) {
                gradient[j] += c * tables.product(term, [j, usize::MAX]);
            }
        }
        gradient.iter_mut().zip(&self.scaling.half_width).for_each(|(entry, w)| *entry /= w);
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let (tables, dim) = (self.tables(p), self.basis.dim());
        let width = &self.scaling.half_width;
        hessian.fill(0.0);
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            for a in (0..dim).filter(|&a| term[a] != 0) {
                for b in (0..=a).filter(|&b| term[b] != 0) {
                    hessian[a * dim + b] += c * tables.product(term, [a, b]);
                }
            }
        }
        for a in 0..dim {
            for b in 0..=a {
                let entry = hessian[a * dim + b] / (width[a] * width[b]);
                (hessian[a * dim + b], hessian[b * dim + a]) = (entry, entry);
            }
        }
    }
}
