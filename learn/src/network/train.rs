//! Training S on reduced data.

use std::path::PathBuf;

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::activation::Activation;
use super::dense::DenseNetwork;
use super::descent::{Watch, minimise};
use super::slope::SlopeFit;
use crate::error::LearnError;
use crate::polynomial::Scaling;

/// How a network is trained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingOptions {
    /// Widths of the hidden layers; the paper's are 500, 500.
    pub widths: Vec<usize>,
    /// The activation.
    pub activation: Activation,
    /// Full-batch steps of Adam; the paper's are 1000.
    pub adam_steps: usize,
    /// Adam's first step size; the paper's is 0.001.
    pub rate: f64,
    /// The step size falls along half a cosine to this fraction of the first (1: constant, as in
    /// the paper).
    pub final_fraction: f64,
    /// Evaluations of the loss by L-BFGS after Adam.
    pub lbfgs_steps: usize,
    /// Seed of the first weights.
    pub seed: u64,
    /// Where training keeps its state. If there is one of the same task, training goes on from it
    /// and ends with the bits of an uninterrupted run; one of another task is refused.
    #[serde(skip)]
    pub checkpoint: Option<PathBuf>,
}

impl Default for TrainingOptions {
    /// The paper's net and budget of 1000 evaluations, spent as 50 of Adam, enough to come near,
    /// and 950 of L-BFGS.
    fn default() -> Self {
        Self {
            widths: vec![500, 500],
            activation: Activation::Tanh,
            adam_steps: 50,
            rate: 1e-3,
            final_fraction: 0.01,
            lbfgs_steps: 950,
            seed: 0,
            checkpoint: None,
        }
    }
}

impl TrainingOptions {
    /// Adam's step size at a step.
    #[must_use]
    pub fn rate(&self, step: usize) -> f64 {
        let phase = step as f64 / self.adam_steps.max(1) as f64 * std::f64::consts::PI;
        let fraction =
            self.final_fraction + (1.0 - self.final_fraction) * 0.5 * (1.0 + phase.cos());
        self.rate * fraction
    }
}

/// Where training stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Evaluations made.
    pub step: usize,
    /// Evaluations allowed.
    pub total: usize,
    /// The loss, in normalised units: 1 is the variance of the data.
    pub loss: f64,
    /// The same on validation data, where there are any; looked at every tenth step of Adam.
    pub validation: Option<f64>,
}

/// Fits f = mean·p + scale·N(u) to the gradients of a function at points, a sample per column:
/// min Σ|gᵢ − ∂f/∂p(pᵢ)|² with inputs and targets normalised. Returns the network and the loss after every evaluation.
/// The loss on `validation` points and gradients is watched, not fitted.
///
/// # Errors
/// [`LearnError::InvalidOption`] for no hidden layer, [`LearnError::NotConverged`] when the loss
/// is not finite.
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
        SlopeFit::new((&options.widths, options.activation), &u, &(weighted(gradients) / scale))
    };
    let train = fit(points, gradients);
    let watched = validation.map(|(points, gradients)| fit(points, gradients));
    let watch = watched.as_ref().map(|fit| move |unknowns: &[f64]| fit.value(unknowns));
    let watch = watch.as_ref().map(|watch| watch as &Watch<'_>);
    let words = format!("gradients {}", serde_json::to_string(options).unwrap_or_default());
    let task = super::checkpoint::task(&words, &[points.as_slice(), gradients.as_slice()]);
    let mut evaluate = |unknowns: &[f64]| Ok(train.value_and_gradient(unknowns));
    let start = train.draw(options.seed);
    let (flat, history) = minimise(start, task, options, &mut evaluate, watch, progress)?;
    let (hidden, output) = train.layers(&flat);
    let network = DenseNetwork::new(options.activation, scaling, mean, scale, hidden, output)
        .map_err(|reason| LearnError::NotConverged { reason })?;
    Ok((network, history))
}
