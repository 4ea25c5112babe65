//! Weights as tensors, and the loops that lower a loss: Adam, then L-BFGS.

use burn::module::{Module, Param};
use burn::optim::{AdamConfig, GradientsParams};
use burn::optim::{LBFGSConfig, LineSearchFn};
use burn::tensor::{DType, Device, Tensor, TensorData};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::activation::Activation;
use super::dense::Layer;
use super::train::{Progress, TrainingOptions};
use crate::error::LearnError;

/// All unknowns of a fit, as matrices (biases are 1×k).
#[derive(Module, Debug)]
pub(super) struct Unknowns {
    pub(super) matrices: Vec<Param<Tensor<2>>>,
}

/// The device: the CPU, differentiating.
pub(super) fn device() -> Device {
    Device::flex().autodiff()
}

/// A rows×columns matrix of 64-bit floats, constant.
pub(super) fn matrix(values: &[f64], rows: usize, columns: usize, device: &Device) -> Tensor<2> {
    Tensor::from_data(TensorData::new(values.to_vec(), [rows, columns]), (device, DType::F64))
}

/// The entries, row by row.
pub(super) fn values(tensor: Tensor<2>) -> Result<Vec<f64>, LearnError> {
    let failed = |reason: String| LearnError::NotConverged { reason };
    let data = tensor.try_into_data().map_err(|e| failed(e.to_string()))?;
    data.try_to_vec::<f64>().map_err(|e| failed(format!("{e:?}")))
}

impl Unknowns {
    /// The unknowns with the shapes (rows, columns) and entries given.
    pub(super) fn new(parts: &[(Vec<f64>, usize, usize)], device: &Device) -> Self {
        let matrices = parts
            .iter()
            .map(|(v, r, c)| Param::from_tensor(matrix(v, *r, *c, device).require_grad()))
            .collect();
        Self { matrices }
    }

    pub(super) fn at(&self, index: usize) -> Tensor<2> {
        self.matrices[index].val()
    }
}

/// Where the weights of a network stand among the unknowns: two matrices per hidden layer (W as
/// inputs×outputs, b), then the last layer (width×outputs).
#[derive(Clone, Debug)]
pub(super) struct Architecture {
    pub(super) first: usize,
    pub(super) inputs: usize,
    pub(super) widths: Vec<usize>,
    pub(super) outputs: usize,
    pub(super) activation: Activation,
}

impl Architecture {
    /// Weights drawn uniformly with the variance of Glorot and Bengio (2010), biases 0.
    pub(super) fn draw(&self, seed: u64) -> Vec<(Vec<f64>, usize, usize)> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut parts = Vec::new();
        let mut inputs = self.inputs;
        let mut uniform = |rows: usize, columns: usize| {
            let limit = (6.0 / (rows + columns) as f64).sqrt();
            (0..rows * columns).map(|_| limit * (2.0 * rng.random::<f64>() - 1.0)).collect()
        };
        for &width in &self.widths {
            parts.push((uniform(inputs, width), inputs, width));
            parts.push((vec![0.0; width], 1, width));
            inputs = width;
        }
        parts.push((uniform(inputs, self.outputs), inputs, self.outputs));
        parts
    }

    /// The number of matrices.
    pub(super) fn len(&self) -> usize {
        2 * self.widths.len() + 1
    }

    fn activate(&self, z: Tensor<2>) -> (Tensor<2>, Tensor<2>) {
        match self.activation {
            Activation::Tanh => {
                let a = z.tanh();
                let slope = a.clone().mul(a.clone()).neg().add_scalar(1.0);
                (a, slope)
            }
            Activation::Logistic => {
                let a = burn::tensor::activation::sigmoid(z);
                let slope = a.clone().mul(a.clone().neg().add_scalar(1.0));
                (a, slope)
            }
        }
    }

    /// N(u), a row per sample.
    pub(super) fn value(&self, unknowns: &Unknowns, u: Tensor<2>) -> Tensor<2> {
        let mut a = u;
        for k in 0..self.widths.len() {
            let at = self.first + 2 * k;
            a = self.activate(a.matmul(unknowns.at(at)).add(unknowns.at(at + 1))).0;
        }
        a.matmul(unknowns.at(self.first + self.len() - 1))
    }

    /// ∂N/∂u of a network with one output, a row per sample: written as forward operations,
    /// because the framework does not differentiate twice.
    pub(super) fn slope(&self, unknowns: &Unknowns, u: Tensor<2>) -> Tensor<2> {
        let samples = u.dims()[0];
        let mut a = u;
        let mut slopes = Vec::with_capacity(self.widths.len());
        for k in 0..self.widths.len() {
            let at = self.first + 2 * k;
            let (next, slope) = self.activate(a.matmul(unknowns.at(at)).add(unknowns.at(at + 1)));
            a = next;
            slopes.push(slope);
        }
        let last = unknowns.at(self.first + self.len() - 1).transpose();
        let mut back = last.repeat_dim(0, samples);
        for (k, slope) in slopes.into_iter().enumerate().rev() {
            back = back.mul(slope).matmul(unknowns.at(self.first + 2 * k).transpose());
        }
        back
    }

    /// The trained layers and last weights (of the first output).
    pub(super) fn layers(&self, unknowns: &Unknowns) -> Result<(Vec<Layer>, Vec<f64>), LearnError> {
        let mut hidden = Vec::new();
        let mut inputs = self.inputs;
        for (k, &width) in self.widths.iter().enumerate() {
            let at = self.first + 2 * k;
            let weights = values(unknowns.at(at).transpose())?;
            hidden.push(Layer { inputs, weights, biases: values(unknowns.at(at + 1))? });
            inputs = width;
        }
        let last = values(unknowns.at(self.first + self.len() - 1).transpose())?;
        Ok((hidden, last[..inputs].to_vec()))
    }
}

/// Steps of Adam between two looks at the validation data.
const WATCH: usize = 10;

/// Lowers `loss` from `unknowns`: Adam with a cosine schedule, then L-BFGS.
pub(super) fn minimise(
    mut unknowns: Unknowns,
    options: &TrainingOptions,
    loss: impl Fn(&Unknowns) -> Tensor<1>,
    watch: Option<&dyn Fn(&Unknowns) -> Tensor<1>>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Unknowns, Vec<f64>), LearnError> {
    let mut history = Vec::new();
    let mut adam = AdamConfig::new().with_epsilon(1e-8).init();
    let total = options.adam_steps + options.lbfgs_steps;
    for step in 0..options.adam_steps {
        let now = loss(&unknowns);
        let gradients = GradientsParams::from_grads(now.backward(), &unknowns);
        let value: f64 = now.into_scalar();
        let validation =
            watch.filter(|_| step % WATCH == 0).map(|watch| watch(&unknowns).into_scalar::<f64>());
        report(&mut history, Progress { step, total, loss: value, validation }, progress)?;
        unknowns = adam.step(options.rate(step), unknowns, gradients);
    }
    // The L-BFGS of the framework has absolute thresholds (curvature 1e-10): the loss is put on a
    // scale where they are below rounding, anew in every round.
    const ROUND: usize = 100;
    let mut done = 0;
    while done < options.lbfgs_steps {
        let start: f64 = loss(&unknowns).into_scalar();
        if !(start.is_finite() && start > 0.0) {
            break;
        }
        let scale = 1e4 / start;
        let steps = ROUND.min(options.lbfgs_steps - done);
        let mut evaluations = 0;
        let mut lbfgs = LBFGSConfig::new()
            .with_max_iter(steps)
            .with_max_eval(Some(steps))
            .with_history_size(10)
            .with_tolerance_grad(0.0)
            .with_tolerance_change(1e-12)
            .with_line_search_fn(LineSearchFn::StrongWolfe)
            .init();
        let mut seen = Vec::new();
        let (next, _) = lbfgs.step(1.0, unknowns.clone(), |current: Unknowns| {
            evaluations += 1;
            let now = loss(&current).mul_scalar(scale);
            let gradients = GradientsParams::from_grads(now.backward(), &current);
            let value: f64 = now.into_scalar();
            seen.push(value / scale);
            (value, gradients)
        });
        let end: f64 = loss(&next).into_scalar();
        for value in seen {
            let step = options.adam_steps + done;
            let now = Progress { step, total, loss: value, validation: None };
            report(&mut history, now, progress)?;
            done += 1;
        }
        if end.is_finite() && end < start {
            unknowns = next;
        }
        // Stuck: nothing more to gain from here.
        if end.is_nan() || end >= start * (1.0 - 1e-6) {
            break;
        }
    }
    history.push(loss(&unknowns).into_scalar());
    Ok((unknowns, history))
}

fn report(
    history: &mut Vec<f64>,
    now: Progress,
    progress: &mut dyn FnMut(Progress),
) -> Result<(), LearnError> {
    if !now.loss.is_finite() && now.step == 0 {
        let reason = "the loss is not finite at the first weights".into();
        return Err(LearnError::NotConverged { reason });
    }
    history.push(now.loss);
    progress(now);
    Ok(())
}
