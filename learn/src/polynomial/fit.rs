//! The fit of a polynomial to gradients by linear least squares, its degree and ridge chosen by cross-validation.

use std::ops::RangeInclusive;

use coadjoint_codegen::cancel;
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::model::{Basis, PolynomialModel, Scaling};
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::function::MomentumFunction;
use crate::least_squares::Reduced;

/// The least-squares problem of fitting ∂S/∂p(pᵢ) = xᵢ with S in `model`'s basis.
///
/// Row order: all coordinates of sample 0, then of sample 1, …
fn gradient_problem(
    model: &PolynomialModel,
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
) -> Reduced {
    let (dim, samples) = points.shape();
    let terms = model.basis().terms().len();
    let mut matrix = DMatrix::zeros(dim * samples, terms);
    let mut row = vec![0.0; terms * dim];
    for (i, point) in points.column_iter().enumerate() {
        cancel::check();
        model.basis_gradients(point.as_slice(), &mut row);
        for k in 0..terms {
            for j in 0..dim {
                matrix[(i * dim + j, k)] = row[k * dim + j];
            }
        }
    }
    Reduced::new(matrix, DVector::from_column_slice(gradients.as_slice()))
}

/// The polynomial f of total degree `degree` with the least Σ|∂f/∂p(pᵢ) − xᵢ|² + ridge·s²|c|².
///
/// `points` and `gradients` hold a sample per column; `ridge` is relative to the mean squared
/// norm s² of a column of the design matrix (0: plain least squares).
///
/// # Errors
/// [`LearnError::NotDetermined`] when the samples do not determine the coefficients, and
/// [`LearnError::InvalidOption`] for a degree with too many of them.
pub fn fit_gradients(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    degree: usize,
    ridge: f64,
) -> Result<PolynomialModel, LearnError> {
    let (dim, samples) = points.shape();
    Basis::check_fit(dim, degree, samples)?;
    let model = PolynomialModel::zero(Basis::new(dim, degree), Scaling::of(points));
    let terms = model.basis().terms().len();
    let coefficients = gradient_problem(&model, points, gradients)
        .solve(ridge)
        .ok_or(LearnError::NotDetermined { degree, terms, samples, ridge })?;
    Ok(model.with_coefficients(coefficients.as_slice()))
}

/// Fits S to reduced data, min Σ|xᵢ − ∂S/∂p(pᵢ)|²: the paper's optimisation problem, linear here.
///
/// # Errors
/// As [`fit_gradients`].
pub fn fit_polynomial(
    data: &ReducedData,
    degree: usize,
    ridge: f64,
) -> Result<PolynomialModel, LearnError> {
    fit_gradients(&data.p, &data.x, degree, ridge)
}

/// Ridge weights to try.
const RIDGES: [f64; 5] = [0.0, 1e-14, 1e-10, 1e-6, 1e-3];
/// The folds of the cross-validation.
const FOLDS: usize = 5;
/// The maximum number of basis functions of a candidate, which bounds time and memory.
const LARGEST_BASIS: usize = 300;

/// One candidate of a cross-validation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// The candidate, as a user would ask for it: `polynomial degree 6, ridge 0`.
    pub name: String,
    /// The total degree.
    pub degree: usize,
    /// The ridge weight.
    pub ridge: f64,
    /// The mean squared error of x over the samples left out.
    pub mse: f64,
}

/// The outcome of a cross-validation.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// The best candidate, fitted to all samples.
    pub model: PolynomialModel,
    /// The best candidate.
    pub best: Candidate,
    /// Every candidate that could be fitted, in the order tried.
    pub candidates: Vec<Candidate>,
}

/// Which samples each fold leaves out: a seeded shuffle dealt out in turn.
pub(crate) fn folds(samples: usize, count: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..samples).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
    let count = count.clamp(2, samples.max(2));
    (0..count).map(|f| order.iter().copied().skip(f).step_by(count).collect()).collect()
}

/// The columns of `matrix` in the fold, and the ones outside it.
pub(crate) fn split(matrix: &DMatrix<f64>, fold: &[usize]) -> (DMatrix<f64>, DMatrix<f64>) {
    let mut inside = vec![false; matrix.ncols()];
    fold.iter().for_each(|&i| inside[i] = true);
    let outside: Vec<usize> = (0..matrix.ncols()).filter(|&i| !inside[i]).collect();
    (matrix.select_columns(fold), matrix.select_columns(&outside))
}

/// The mean squared error of ∂f/∂p against `gradients`, over samples and coordinates.
pub(crate) fn gradient_error(
    function: &impl MomentumFunction,
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
) -> f64 {
    let mut found = vec![0.0; points.nrows()];
    let mut sum = 0.0;
    for (point, expected) in points.column_iter().zip(gradients.column_iter()) {
        cancel::check();
        function.gradient(point.as_slice(), &mut found);
        sum += found.iter().zip(expected.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    }
    sum / points.len().max(1) as f64
}

/// Chooses degree and ridge by cross-validation, over folds shuffled by the seed, and fits the winner to all samples.
///
/// Among candidates within one part in 20 of the best, the one with fewer coefficients and then
/// the larger ridge wins.
///
/// # Errors
/// [`LearnError::NotDetermined`] when no candidate can be fitted: too few samples.
pub fn select_polynomial(
    data: &ReducedData,
    degrees: RangeInclusive<usize>,
    seed: u64,
) -> Result<Selection, LearnError> {
    let (dim, samples) = data.p.shape();
    let parts: Vec<_> = folds(samples, FOLDS, seed)
        .iter()
        .map(|fold| (split(&data.p, fold), split(&data.x, fold)))
        .collect();
    let mut candidates = Vec::new();
    for degree in degrees.clone() {
        // Fewer equations than coefficients are met by any number of polynomials, and say nothing of which is right.
        let rest = samples - samples.div_ceil(parts.len().max(1));
        if Basis::size(dim, degree) > LARGEST_BASIS.min(dim * rest) {
            continue;
        }
        let basis = Basis::new(dim, degree);
        let problems: Vec<_> = parts
            .iter()
            .map(|((_, p), (_, x))| {
                let model = PolynomialModel::zero(basis.clone(), Scaling::of(p));
                let problem = gradient_problem(&model, p, x);
                (model, problem)
            })
            .collect();
        for ridge in RIDGES {
            let errors: Option<Vec<f64>> = problems
                .iter()
                .zip(&parts)
                .map(|((model, problem), ((p, _), (x, _)))| {
                    let fitted = model.clone().with_coefficients(problem.solve(ridge)?.as_slice());
                    Some(gradient_error(&fitted, p, x))
                })
                .collect();
            if let Some(errors) = errors {
                let mse = errors.iter().sum::<f64>() / errors.len() as f64;
                let name = format!("polynomial degree {degree}, ridge {ridge:e}");
                candidates.push(Candidate { name, degree, ridge, mse });
            }
        }
    }
    let least = candidates.iter().map(|c| c.mse).fold(f64::INFINITY, f64::min);
    let best = candidates
        .iter()
        .filter(|c| c.mse <= least * 1.05)
        .min_by(|a, b| a.degree.cmp(&b.degree).then(b.ridge.total_cmp(&a.ridge)))
        .cloned();
    let Some(best) = best else {
        let degree = *degrees.start();
        let terms = Basis::size(dim, degree);
        return Err(LearnError::NotDetermined { degree, terms, samples, ridge: 0.0 });
    };
    let model = fit_polynomial(data, best.degree, best.ridge)?;
    Ok(Selection { model, best, candidates })
}
