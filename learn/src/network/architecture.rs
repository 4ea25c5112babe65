//! A dense network over tensors: its first weights, its value and its slope.

use burn::tensor::Tensor;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::activation::Activation;
use super::dense::Layer;
use super::objective::Unknowns;

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

    /// The layers and last weights (of one output) of a network that stands first in a row of
    /// unknowns.
    pub(super) fn layers(&self, flat: &[f64]) -> (Vec<Layer>, Vec<f64>) {
        let mut hidden = Vec::new();
        let mut inputs = self.inputs;
        let mut rest = flat;
        for &width in &self.widths {
            let (matrix, after) = rest.split_at(inputs * width);
            let (biases, after) = after.split_at(width);
            let entry = |index: usize| matrix[(index % inputs) * width + index / inputs];
            let weights = (0..inputs * width).map(entry).collect();
            hidden.push(Layer { inputs, weights, biases: biases.to_vec() });
            (inputs, rest) = (width, after);
        }
        (hidden, rest[..inputs].to_vec())
    }
}
