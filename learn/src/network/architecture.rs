//! The shape of a dense network in training: its first weights, and where they stand.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::activation::Activation;
use super::dense::Layer;

/// A network's unknowns are two matrices per hidden layer (W as inputs×outputs, b), then the last
/// layer (width×outputs).
#[derive(Clone, Debug)]
pub(super) struct Architecture {
    pub(super) inputs: usize,
    pub(super) widths: Vec<usize>,
    pub(super) outputs: usize,
    pub(super) activation: Activation,
}

impl Architecture {
    /// First weights, drawn uniformly: in the first layer from ±1/inputs, with biases from ±1, so
    /// that inputs in [−1, 1] move every neuron through the bend of its activation; in the others
    /// with the variance of Glorot and Bengio (2010), biases 0.
    ///
    /// Their variance in the first layer too, and no biases, leave a network of tanh odd and nearly
    /// linear: after 300 evaluations the loss of a hybrid was fourteen times as high.
    pub(super) fn draw(&self, seed: u64) -> Vec<(Vec<f64>, usize, usize)> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut parts = Vec::new();
        let mut inputs = self.inputs;
        let mut draw = |limit: f64, count: usize| -> Vec<f64> {
            (0..count).map(|_| limit * (2.0 * rng.random::<f64>() - 1.0)).collect()
        };
        let glorot = |rows: usize, columns: usize| (6.0 / (rows + columns) as f64).sqrt();
        for &width in &self.widths {
            let first = parts.is_empty();
            let limit = if first { 1.0 / inputs as f64 } else { glorot(inputs, width) };
            parts.push((draw(limit, inputs * width), inputs, width));
            parts.push((draw(if first { 1.0 } else { 0.0 }, width), 1, width));
            inputs = width;
        }
        let last = draw(glorot(inputs, self.outputs), inputs * self.outputs);
        parts.push((last, inputs, self.outputs));
        parts
    }

    /// The number of matrices.
    #[cfg(feature = "neural")]
    pub(super) fn len(&self) -> usize {
        2 * self.widths.len() + 1
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
