//! Where the chart's canonical momentum folds on the data.
//!
//! The data lie on {x = ∂S/∂p(p)} only as long as μ′ ↦ p = (d^Rτ_x)ᵀ μ′ is one to one: past the
//! first zero of det ∂p/∂μ′ two increments share one p. Where that happens depends on the flow, so
//! it is looked for in the data: x is a smooth function of μ′ whatever p does, and its derivative
//! follows from a polynomial fitted to the samples.
//!
//! Measured on free rigid bodies (smallest angle of the increment over all directions of μ′; see
//! `tests/fold.rs`). Cayley: 1.31 rad for the ball, where θ tan(θ/2) = 1, 1.27 for the paper's body
//! (1.5, 2, 2.5), 1.12 for a plate (1, 2, 3), 0.96 for a rod (0.2, 1, 1). Exponential: none short
//! of the half turn for the ball and the paper's body, 1.99 for the plate, 1.7 for the rod.

use coadjoint::LieGroup;
use coadjoint::groups::Chart;
use nalgebra::{DMatrix, DVector};

use super::samples::ReducedData;
use crate::function::{MomentumFunction, vector};
use crate::least_squares::Reduced;
use crate::polynomial::{Basis, PolynomialModel, Scaling};

/// The highest degree x is fitted with, and how many samples each coefficient must have.
const DEGREE: usize = 5;
const SAMPLES: usize = 4;

/// Samples beyond the fold, with det ∂p/∂μ′ there; none where the samples are too few to tell.
pub(super) fn beyond<G, C>(group: &G, data: &ReducedData) -> Vec<(usize, f64)>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let (dim, samples) = data.x.shape();
    let fits = |degree: &usize| SAMPLES * (Basis::size(dim, *degree) + 1) <= samples;
    let Some(degree) = (1..=DEGREE).rev().find(fits) else { return Vec::new() };
    let before = &data.momenta.before;
    let Some(models) = increments(before, &data.x, degree) else { return Vec::new() };
    let chart = C::default();
    let mut slope = vec![0.0; dim];
    let mut found = Vec::new();
    for i in 0..samples {
        let (mu, x) = (before.column(i), data.x.column(i));
        let (mu_vector, x) = (vector::<G>(mu.as_slice()), vector::<G>(x.as_slice()));
        // ∂p/∂μ′ = (d^Rτ_x)ᵀ + ∂/∂x[(d^Rτ_x)ᵀ μ′] ∂x/∂μ′.
        let (_, by_x) = chart.pull_back_with_derivative(group, &x, &mu_vector);
        let mut motion = DMatrix::zeros(dim, dim);
        for (j, model) in models.iter().enumerate() {
            model.gradient(mu.as_slice(), &mut slope);
            motion.row_mut(j).copy_from_slice(&slope);
        }
        let mut matrix = DMatrix::from_fn(dim, dim, |a, b| by_x[(a, b)]) * motion;
        for j in 0..dim {
            let unit: Vec<f64> = (0..dim).map(|k| if k == j { 1.0 } else { 0.0 }).collect();
            let column = chart.pull_back(group, &x, &vector::<G>(&unit));
            (0..dim).for_each(|k| matrix[(k, j)] += column[k]);
        }
        let determinant = matrix.determinant();
        if determinant <= 0.0 {
            found.push((i, determinant));
        }
    }
    found
}

/// x as a polynomial in μ′, a model per coordinate (without its constant).
fn increments(
    before: &DMatrix<f64>,
    x: &DMatrix<f64>,
    degree: usize,
) -> Option<Vec<PolynomialModel>> {
    let (dim, samples) = before.shape();
    let model = PolynomialModel::zero(Basis::new(dim, degree), Scaling::of(before));
    let terms = model.basis().len();
    let mut matrix = DMatrix::from_element(samples, terms + 1, 1.0);
    let mut row = vec![0.0; terms];
    for (i, mu) in before.column_iter().enumerate() {
        model.basis_values(mu.as_slice(), &mut row);
        (0..terms).for_each(|k| matrix[(i, k)] = row[k]);
    }
    (0..dim)
        .map(|j| {
            let right = DVector::from_iterator(samples, x.row(j).iter().copied());
            let coefficients = Reduced::new(matrix.clone(), right).solve(1e-14)?;
            Some(model.clone().with_coefficients(&coefficients.as_slice()[..terms]))
        })
        .collect()
}
