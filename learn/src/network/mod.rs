//! Dense networks: their evaluation and their training.

mod dense;
mod descent;
mod options;
mod slope;

use coadjoint_codegen::file;
use nalgebra::DMatrix;

use crate::error::LearnError;
use crate::polynomial::Scaling;
use descent::minimise;
use slope::SlopeFit;

pub use dense::DenseNetwork;
pub use options::{Progress, TrainingOptions};

/// Fits f = mean·p + scale·N(u) to the gradients of a function at points, a sample per column:
/// min Σ|gᵢ − ∂f/∂p(pᵢ)|² with inputs and targets normalised. Returns the network and the loss after every evaluation.
/// The loss on `validation` points and gradients is watched, not fitted.
///
/// # Errors
/// [`LearnError::InvalidOption`] for no hidden layer, [`LearnError::NotConverged`] when the loss is not finite.
pub fn fit_network(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    validation: Option<(&DMatrix<f64>, &DMatrix<f64>)>,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(DenseNetwork, Vec<f64>), LearnError> {
    if options.widths.is_empty() || options.widths.contains(&0) {
        let requirement = "give at least one hidden layer of at least one neuron";
        return Err(LearnError::option("widths", format!("{:?}", options.widths), requirement));
    }
    if points.ncols() == 0 {
        return Err(LearnError::NoSamples);
    }
    let scaling = Scaling::of(points);
    let mean: Vec<f64> = gradients.row_iter().map(|row| row.mean()).collect();
    // Targets ∂N/∂u_j = (x_j − mean_j) w_j / scale, of unit variance together.
    let weighted = |gradients: &DMatrix<f64>| {
        DMatrix::from_fn(gradients.nrows(), gradients.ncols(), |j, i| {
            (gradients[(j, i)] - mean[j]) * scaling.half_width[j]
        })
    };
    let targets = weighted(gradients);
    let spread = (targets.norm_squared() / targets.len() as f64).sqrt();
    let scale = if spread > 0.0 { spread } else { 1.0 };
    let fit = |points: &DMatrix<f64>, gradients: &DMatrix<f64>| {
        let u = DMatrix::from_fn(points.nrows(), points.ncols(), |j, i| {
            scaling.normalise(j, points[(j, i)])
        });
        SlopeFit::new(&options.widths, &u, &(weighted(gradients) / scale))
    };
    let train = fit(points, gradients);
    let watched = validation.map(|(points, gradients)| fit(points, gradients));
    // The fingerprint of the task: checkpoints of other tasks are refused.
    let words = serde_json::to_vec(options).unwrap_or_default();
    let numbers = points.iter().chain(gradients).flat_map(|v| v.to_le_bytes());
    let task = file::crc32(&words.into_iter().chain(numbers).collect::<Vec<u8>>());
    let (flat, history) = minimise((&train, watched.as_ref()), task, options, progress)?;
    let network = DenseNetwork::new(train.layers(&flat), scaling, mean, scale);
    Ok((network.map_err(LearnError::NotConverged)?, history))
}
