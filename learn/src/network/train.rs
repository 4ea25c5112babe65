//! Training S on reduced data.

use burn::tensor::Tensor;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::activation::Activation;
use super::dense::DenseNetwork;
use super::objective::{Architecture, Unknowns, device, matrix, minimise};
use crate::data::ReducedData;
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
}

impl Default for TrainingOptions {
    /// The paper's net and budget of 1000 evaluations, spent as 300 of Adam and 700 of L-BFGS.
    fn default() -> Self {
        Self {
            widths: vec![500, 500],
            activation: Activation::Tanh,
            adam_steps: 300,
            rate: 1e-3,
            final_fraction: 0.01,
            lbfgs_steps: 700,
            seed: 0,
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

    pub(super) fn check(&self) -> Result<(), LearnError> {
        if self.widths.is_empty() || self.widths.contains(&0) {
            return Err(LearnError::InvalidOption {
                option: "widths",
                value: format!("{:?}", self.widths),
                requirement: "give at least one hidden layer of at least one neuron".into(),
            });
        }
        Ok(())
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
}

/// Fits S = mean·p + scale·N(u) to reduced data, min Σ|xᵢ − ∂S/∂p(pᵢ)|² with inputs and targets
/// normalised; returns the network and the loss after every evaluation.
///
/// # Errors
/// [`LearnError::InvalidOption`] for no hidden layer, [`LearnError::NotConverged`] when the loss
/// is not finite.
pub fn fit_network(
    data: &ReducedData,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(DenseNetwork, Vec<f64>), LearnError> {
    fit_network_to_gradients(&data.p, &data.x, options, progress)
}

/// As [`fit_network`], for any function f of which ∂f/∂p is known at points: a sample per column.
///
/// # Errors
/// As [`fit_network`].
pub fn fit_network_to_gradients(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(DenseNetwork, Vec<f64>), LearnError> {
    options.check()?;
    if points.ncols() == 0 {
        return Err(LearnError::NoSamples);
    }
    let (dim, samples) = points.shape();
    let scaling = Scaling::of(points);
    let mean: Vec<f64> = gradients.row_iter().map(|row| row.mean()).collect();
    // Targets ∂N/∂u_j = (x_j − mean_j) w_j / scale, of unit variance together.
    let mut targets = gradients.transpose();
    for (j, mean) in mean.iter().enumerate() {
        for entry in targets.column_mut(j).iter_mut() {
            *entry = (*entry - mean) * scaling.half_width[j];
        }
    }
    let spread = (targets.norm_squared() / targets.len() as f64).sqrt();
    let scale = if spread > 0.0 { spread } else { 1.0 };
    // Row-major values of a samples×dim matrix are the column-major ones of its transpose.
    let inputs: Vec<f64> = points
        .column_iter()
        .flat_map(|p| (0..dim).map(|j| scaling.normalise(j, p[j])).collect::<Vec<_>>())
        .collect();
    let targets: Vec<f64> = targets.transpose().iter().map(|t| t / scale).collect();

    let device = device();
    let architecture = Architecture {
        first: 0,
        inputs: dim,
        widths: options.widths.clone(),
        outputs: 1,
        activation: options.activation,
    };
    let unknowns = Unknowns::new(&architecture.draw(options.seed), &device);
    let u = matrix(&inputs, samples, dim, &device);
    let y = matrix(&targets, samples, dim, &device);
    let loss = |unknowns: &Unknowns| -> Tensor<1> {
        let miss = architecture.slope(unknowns, u.clone()).sub(y.clone());
        miss.clone().mul(miss).mean()
    };
    let (unknowns, history) = minimise(unknowns, options, loss, progress)?;
    let (hidden, output) = architecture.layers(&unknowns)?;
    let network = DenseNetwork::new(options.activation, scaling, mean, scale, hidden, output)
        .map_err(|reason| LearnError::NotConverged { reason })?;
    Ok((network, history))
}
