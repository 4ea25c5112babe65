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
    /// The same on validation data, where there are any; looked at every tenth step of Adam.
    pub validation: Option<f64>,
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
    fit_network_to_gradients(&data.p, &data.x, None, options, progress)
}

/// As [`fit_network`], for any function f of which ∂f/∂p is known at points: a sample per column.
/// `validation` points and gradients are watched, not fitted.
///
/// # Errors
/// As [`fit_network`].
pub fn fit_network_to_gradients(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    validation: Option<(&DMatrix<f64>, &DMatrix<f64>)>,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(DenseNetwork, Vec<f64>), LearnError> {
    options.check()?;
    if points.ncols() == 0 {
        return Err(LearnError::NoSamples);
    }
    let dim = points.nrows();
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
    // The column-major entries of a dim×samples matrix are the row-major ones of its transpose.
    let normalised = |points: &DMatrix<f64>| {
        DMatrix::from_fn(dim, points.ncols(), |j, i| scaling.normalise(j, points[(j, i)]))
    };

    let device = device();
    let architecture = Architecture {
        first: 0,
        inputs: dim,
        widths: options.widths.clone(),
        outputs: 1,
        activation: options.activation,
    };
    let unknowns = Unknowns::new(&architecture.draw(options.seed), &device);
    let tensors = |points: &DMatrix<f64>, gradients: &DMatrix<f64>| {
        let targets = weighted(gradients) / scale;
        let rows = points.ncols();
        let u = matrix(normalised(points).as_slice(), rows, dim, &device);
        (u, matrix(targets.as_slice(), rows, dim, &device))
    };
    let miss = |unknowns: &Unknowns, (u, y): &(Tensor<2>, Tensor<2>)| -> Tensor<1> {
        let miss = architecture.slope(unknowns, u.clone()).sub(y.clone());
        miss.clone().mul(miss).mean()
    };
    let train = tensors(points, gradients);
    let held_out = validation.map(|(points, gradients)| tensors(points, gradients));
    let loss = |unknowns: &Unknowns| miss(unknowns, &train);
    let watched = held_out.as_ref().map(|data| |unknowns: &Unknowns| miss(unknowns, data));
    let watch = watched.as_ref().map(|w| w as &dyn Fn(&Unknowns) -> Tensor<1>);
    let (unknowns, history) = minimise(unknowns, options, loss, watch, progress)?;
    let (hidden, output) = architecture.layers(&unknowns)?;
    let network = DenseNetwork::new(options.activation, scaling, mean, scale, hidden, output)
        .map_err(|reason| LearnError::NotConverged { reason })?;
    Ok((network, history))
}
