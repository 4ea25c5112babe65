//! The misfit of a network's slope and its derivative in the weights.
//!
//! Samples are cut into pieces of a fixed size which threads share, and the pieces are added up in
//! their order: the bits do not depend on how many threads there are.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::architecture::Architecture;
use super::back_propagation::{Layer, Piece};
use super::row;

/// Samples of a piece. More would leave threads idle on a few hundred samples, fewer make the
/// products of matrices slower.
const PIECE: usize = 64;

/// Points and the slopes wanted there, a sample per column.
pub(super) struct SlopeFit {
    architecture: Architecture,
    pieces: Vec<Piece>,
    entries: f64,
}

impl SlopeFit {
    pub(super) fn new(
        architecture: Architecture,
        points: &DMatrix<f64>,
        slopes: &DMatrix<f64>,
    ) -> Self {
        let samples = points.ncols();
        let pieces = (0..samples)
            .step_by(PIECE)
            .map(|from| {
                let count = PIECE.min(samples - from);
                let cut = |m: &DMatrix<f64>| m.columns(from, count).into_owned();
                Piece::new(cut(points), cut(slopes), &architecture)
            })
            .collect();
        Self { architecture, pieces, entries: points.len() as f64 }
    }

    /// The network.
    pub(super) fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// The mean squared misfit.
    pub(super) fn value(&mut self, flat: &[f64]) -> f64 {
        let (layers, last) = cut(&self.architecture, flat);
        let activation = self.architecture.activation;
        let squares = self.pieces.iter_mut().map(|piece| piece.misfit(activation, &layers, last));
        squares.sum::<f64>() / self.entries
    }

    /// The mean squared misfit and its derivative.
    pub(super) fn value_and_gradient(&mut self, flat: &[f64]) -> (f64, Vec<f64>) {
        let (layers, last) = cut(&self.architecture, flat);
        let activation = self.architecture.activation;
        self.pieces.par_iter_mut().for_each(|piece| {
            piece.differentiate(activation, &layers, last);
        });
        let squares: f64 = self.pieces.iter().map(|piece| piece.squares).sum();
        let gradients: Vec<&[f64]> = self.pieces.iter().map(|piece| &*piece.gradient).collect();
        let gradient = row::sum(&gradients, 2.0 / self.entries, flat.len());
        (squares / self.entries, gradient)
    }
}

/// The layers, and the last weights.
fn cut<'a>(architecture: &Architecture, flat: &'a [f64]) -> (Vec<Layer<'a>>, &'a [f64]) {
    let mut inputs = architecture.inputs;
    let mut rest = flat;
    let mut layers = Vec::new();
    for &width in &architecture.widths {
        let (matrix, after) = rest.split_at(inputs * width);
        let (bias, after) = after.split_at(width);
        // Row by row inputs×outputs is column by column outputs×inputs.
        layers.push(Layer::new(matrix, bias, inputs));
        (inputs, rest) = (width, after);
    }
    (layers, rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::Activation;

    #[test]
    fn the_gradient_agrees_with_differences() {
        for (activation, widths) in [
            (Activation::Tanh, vec![7]),
            (Activation::Tanh, vec![6, 5]),
            (Activation::Logistic, vec![4, 6, 5]),
        ] {
            let architecture = Architecture { inputs: 3, widths, outputs: 1, activation };
            let parts = architecture.draw(3);
            let mut flat: Vec<f64> = parts.into_iter().flat_map(|(entries, ..)| entries).collect();
            // Biases too.
            flat.iter_mut().enumerate().for_each(|(i, w)| *w += 0.1 * (i as f64).sin());
            let wave = |seed: f64, count| {
                DMatrix::from_fn(3, count, |i, j| (seed + 1.7 * i as f64 + 0.9 * j as f64).sin())
            };
            // More than one piece.
            let mut fit = SlopeFit::new(architecture, &wave(0.3, 270), &wave(1.1, 270));
            let (value, gradient) = fit.value_and_gradient(&flat);
            assert!((value - fit.value(&flat)).abs() <= 1e-14 * value);
            for index in 0..flat.len() {
                let mut at = |change: f64| {
                    let before = flat[index];
                    flat[index] += change;
                    let value = fit.value(&flat);
                    flat[index] = before;
                    value
                };
                let slope = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!(
                    (slope - gradient[index]).abs() < 1e-8,
                    "{index}: {slope} {}",
                    gradient[index]
                );
            }
        }
    }
}
