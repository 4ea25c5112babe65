//! The truncated Hamilton–Jacobi series as a generating function, evaluated term by term.
//!
//! The plainest implementation there can be: no expression graph, no predictor, no truncated
//! Hessian. What is emitted or interpreted elsewhere must agree with it.

use std::collections::BTreeMap;

use coadjoint::GeneratingFunction;
use coadjoint::groups::{Exponential, MatrixGroup};
use coadjoint::solve::Integrator;
use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::lie::{Chart, LieAlgebra};
use coadjoint_codegen::poly::Polynomial;
use nalgebra::{DMatrix, DVector};
use num_traits::ToPrimitive;

/// A polynomial with f64 coefficients: terms c·∏ pᵢ^e.
type Terms = Vec<(f64, Vec<(usize, u32)>)>;

/// S_h(p) = Σ hᵏ S_k(p), with its derivatives.
pub struct Series {
    group: MatrixGroup,
    value: Terms,
    gradient: Vec<Terms>,
    hessian: Vec<Vec<Terms>>,
}

/// S₁ … S_K of a Hamiltonian without parameters, exponential chart.
#[must_use]
pub fn orders(
    algebra: &LieAlgebra,
    hamiltonian: &Polynomial,
    truncation: usize,
) -> Vec<Polynomial> {
    let limit = TermLimit::default();
    let series =
        derive(algebra, Chart::Exponential, hamiltonian, truncation, limit).expect("a derivation");
    (1..=truncation).map(|k| series.order(k).clone()).collect()
}

/// The run-time group of an algebra: its matrices, or adjoint matrices.
#[must_use]
pub fn group(algebra: &LieAlgebra) -> MatrixGroup {
    let structure: Vec<(usize, usize, usize, f64)> = algebra
        .structure()
        .iter()
        .map(|s| (s.i, s.j, s.k, s.value.to_f64().expect("finite")))
        .collect();
    match algebra.basis() {
        Some(basis) => {
            let basis: Vec<DMatrix<f64>> = basis
                .iter()
                .map(|m| {
                    DMatrix::from_fn(m.rows(), m.columns(), |i, j| {
                        m.get(i, j).to_f64().expect("finite")
                    })
                })
                .collect();
            MatrixGroup::from_structure_and_basis(&structure, &basis).expect("a matrix group")
        }
        None => MatrixGroup::from_structure_constants(algebra.dim(), &structure)
            .expect("a group of adjoint matrices"),
    }
}

impl Series {
    /// The series with these S₁, S₂, … at the step h.
    #[must_use]
    pub fn new(group: MatrixGroup, orders: &[Polynomial], step: f64) -> Self {
        let mut sum: BTreeMap<Vec<u32>, f64> = BTreeMap::new();
        let mut power = 1.0;
        for order in orders {
            power *= step;
            for (exponents, c) in order.terms() {
                *sum.entry(exponents).or_default() += power * c.to_f64().expect("finite");
            }
        }
        let value: Terms = sum
            .into_iter()
            .map(|(exponents, c)| {
                let factors = exponents.into_iter().enumerate().filter(|&(_, e)| e > 0);
                (c, factors.collect())
            })
            .collect();
        let dim = orders.first().map_or(0, Polynomial::variables);
        let gradient: Vec<Terms> = (0..dim).map(|i| derivative(&value, i)).collect();
        let hessian =
            gradient.iter().map(|g| (0..dim).map(|j| derivative(g, j)).collect()).collect();
        Self { group, value, gradient, hessian }
    }

    /// The number of terms of S_h.
    #[must_use]
    pub fn len(&self) -> usize {
        self.value.len()
    }

    /// Whether S_h = 0.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.value.is_empty()
    }
}

fn derivative(terms: &Terms, i: usize) -> Terms {
    let mut result = Terms::new();
    for (c, factors) in terms {
        if let Some(at) = factors.iter().position(|&(index, _)| index == i) {
            let mut factors = factors.clone();
            let exponent = factors[at].1;
            if exponent == 1 {
                factors.remove(at);
            } else {
                factors[at].1 -= 1;
            }
            result.push((c * f64::from(exponent), factors));
        }
    }
    result
}

/// The value of a polynomial at p.
fn evaluate(terms: &Terms, p: &DVector<f64>) -> f64 {
    let monomial = |factors: &[(usize, u32)]| -> f64 {
        factors.iter().map(|&(i, e)| p[i].powi(e as i32)).product()
    };
    terms.iter().map(|(c, factors)| c * monomial(factors)).sum()
}

impl GeneratingFunction for Series {
    type Group = MatrixGroup;
    type Chart = Exponential;

    fn group(&self) -> &MatrixGroup {
        &self.group
    }

    fn value(&self, p: &DVector<f64>) -> f64 {
        evaluate(&self.value, p)
    }

    fn gradient(&self, p: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(p.len(), |i, _| evaluate(&self.gradient[i], p))
    }

    fn gradient_and_hessian(&self, p: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let hessian = DMatrix::from_fn(p.len(), p.len(), |i, j| {
            evaluate(&self.hessian[i.max(j)][i.min(j)], p)
        });
        (self.gradient(p), hessian)
    }
}

impl Integrator for Series {}
