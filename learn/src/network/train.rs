//! Training S on reduced data.

use nalgebra::DMatrix;

use super::architecture::Architecture;
use super::dense::DenseNetwork;
use super::gradient::SlopeFit;
use super::minimise::{Watch, minimise};
use super::options::{Progress, TrainingOptions};
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::polynomial::Scaling;

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
    let fit = |points: &DMatrix<f64>, gradients: &DMatrix<f64>| {
        let u = DMatrix::from_fn(dim, points.ncols(), |j, i| scaling.normalise(j, points[(j, i)]));
        let architecture = Architecture {
            inputs: dim,
            widths: options.widths.clone(),
            outputs: 1,
            activation: options.activation,
        };
        SlopeFit::new(architecture, &u, &(weighted(gradients) / scale))
    };
    let mut train = fit(points, gradients);
    let mut held_out = validation.map(|(points, gradients)| fit(points, gradients));
    let start =
        train.architecture().draw(options.seed).into_iter().flat_map(|part| part.0).collect();
    let mut evaluate = |flat: &[f64]| Ok(train.value_and_gradient(flat));
    let mut watch = held_out.as_mut().map(|data| |flat: &[f64]| Ok(data.value(flat)));
    let watch = watch.as_mut().map(|w| w as &mut Watch<'_>);
    let task = options.task("gradients", &[points.as_slice(), gradients.as_slice()]);
    let (flat, history) = minimise(start, task, options, &mut evaluate, watch, progress)?;
    let (hidden, output) = train.architecture().layers(&flat);
    let network = DenseNetwork::new(options.activation, scaling, mean, scale, hidden, output)
        .map_err(|reason| LearnError::NotConverged { reason })?;
    Ok((network, history))
}
