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
        let dim = self.basis.dim();
        let tables = self.tables(p);
        for (term, out) in self.basis.terms().zip(row.chunks_exact_mut(dim)) {
            for (j, entry) in out.iter_mut().enumerate() {
                let mut product = tables.at(j, 1, term[j]) / self.scaling.half_width[j];
                for (i, &k) in term.iter().enumerate() {
                    if i != j && k != 0 {
                        product *= tables.at(i, 0, k);
                    }
                }
                *entry = product;
            }
        }
    }

    /// φ_k(p) for every basis function.
    pub fn basis_values(&self, p: &[f64], row: &mut [f64]) {
        let tables = self.tables(p);
        for (term, out) in self.basis.terms().zip(row) {
            *out = term.iter().enumerate().map(|(i, &k)| tables.at(i, 0, k)).product();
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
        let mut sum = 0.0;
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            let product: f64 = term.iter().enumerate().map(|(i, &k)| tables.at(i, 0, k)).product();
            sum += c * product;
        }
        sum
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let tables = self.tables(p);
        gradient.fill(0.0);
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            for (j, entry) in gradient.iter_mut().enumerate() {
                if term[j] != 0 {
                    let mut product = c * tables.at(j, 1, term[j]);
                    for (i, &k) in term.iter().enumerate() {
                        if i != j && k != 0 {
                            product *= tables.at(i, 0, k);
                        }
                    }
                    *entry += product;
                }
            }
        }
        for (entry, width) in gradient.iter_mut().zip(&self.scaling.half_width) {
            *entry /= width;
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let tables = self.tables(p);
        let dim = self.basis.dim();
        let width = &self.scaling.half_width;
        hessian.fill(0.0);
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            for a in 0..dim {
                if term[a] == 0 {
                    continue;
                }
                for b in 0..=a {
                    if term[b] == 0 {
                        continue;
                    }
                    let mut product = if a == b {
                        c * tables.at(a, 2, term[a])
                    } else {
                        c * tables.at(a, 1, term[a]) * tables.at(b, 1, term[b])
                    };
                    for (i, &k) in term.iter().enumerate() {
                        if i != a && i != b && k != 0 {
                            product *= tables.at(i, 0, k);
                        }
                    }
                    hessian[a * dim + b] += product;
                }
            }
        }
        for a in 0..dim {
            for b in 0..=a {
                let entry = hessian[a * dim + b] / (width[a] * width[b]);
                hessian[a * dim + b] = entry;
                hessian[b * dim + a] = entry;
            }
        }
    }
}
