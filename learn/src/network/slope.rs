//! The misfit of a network's slope on some samples, and its derivative in the weights, by hand.
//!
//! With Z_k = W_k A_{k−1} + b_k, A_k = σ(Z_k) upwards and C_k = B_k∘σ′(Z_k), B_{k−1} = W_kᵀ C_k downwards from the last
//! weights, B₀ is the slope ∂N/∂u: the forward pass already contains a backward one, and its derivative is two passes
//! more. Threads share pieces of a fixed number of samples, which are added up in their order: the bits do not depend on
//! the number of threads.

use coadjoint_codegen::cancel;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::dense::{Hidden, Layers, Passes, bend, slope};

/// Samples of a piece. More would leave threads idle on a few hundred samples, fewer make products of matrices slower.
const PIECE: usize = 64;

/// The shape of a network in training, and the slopes that it is to fit.
pub(super) struct SlopeFit {
    inputs: usize,
    widths: Vec<usize>,
    /// Points, and the slopes wanted there, a sample per column.
    pieces: Vec<(DMatrix<f64>, DMatrix<f64>)>,
}

impl SlopeFit {
    pub(super) fn new(widths: &[usize], points: &DMatrix<f64>, slopes: &DMatrix<f64>) -> Self {
        let piece = |from| {
            let count = PIECE.min(points.ncols() - from);
            let cut = |m: &DMatrix<f64>| m.columns(from, count).into_owned();
            (cut(points), cut(slopes))
        };
        let pieces = (0..points.ncols()).step_by(PIECE).map(piece).collect();
        Self { inputs: points.nrows(), widths: widths.to_vec(), pieces }
    }

    /// First weights, drawn uniformly: in the first layer from ±1/inputs, with biases from ±1, so that inputs in [−1, 1]
    /// move every neuron through the bend of its activation; in the others with the variance of Glorot and Bengio (2010),
    /// biases 0. Their variance in the first layer too, without biases, leaves a network of tanh odd and nearly linear:
    /// after 300 evaluations the loss of a hybrid was fourteen times as high.
    pub(super) fn draw(&self, seed: u64) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut unknowns = Vec::new();
        let mut draw = |limit: f64, count: usize| {
            unknowns.extend((0..count).map(|_| limit * (2.0 * rng.random::<f64>() - 1.0)));
        };
        let glorot = |rows: usize, columns: usize| (6.0 / (rows + columns) as f64).sqrt();
        let mut inputs = self.inputs;
        for (k, &width) in self.widths.iter().enumerate() {
            let later = [glorot(inputs, width), 0.0];
            let [weights, biases] = if k == 0 { [1.0 / inputs as f64, 1.0] } else { later };
            draw(weights, inputs * width);
            draw(biases, width);
            inputs = width;
        }
        draw(glorot(inputs, 1), inputs);
        unknowns
    }

    /// The network of a row of unknowns.
    pub(super) fn layers(&self, unknowns: &[f64]) -> Layers {
        Layers::of(unknowns, self.inputs, &self.widths)
    }

    /// The mean squared misfit and its derivative.
    pub(super) fn value_and_gradient(&self, unknowns: &[f64]) -> (f64, Vec<f64>) {
        let layers = self.layers(unknowns);
        let token = cancel::token();
        let one = |(points, slopes): &(DMatrix<f64>, DMatrix<f64>)| {
            token.check();
            let passes = layers.passes(points);
            let miss = &passes.slope - slopes;
            (miss.norm_squared(), half_gradient(&layers, points, &passes, miss))
        };
        let parts: Vec<(f64, Vec<f64>)> = self.pieces.par_iter().map(one).collect();
        let (mut squares, mut gradient) = (0.0, vec![0.0; unknowns.len()]);
        for (own, part) in &parts {
            squares += own;
            gradient.iter_mut().zip(part).for_each(|(sum, entry)| *sum += entry);
        }
        let entries = self.pieces.iter().map(|(points, _)| points.len()).sum::<usize>() as f64;
        gradient.iter_mut().for_each(|entry| *entry *= 2.0 / entries);
        (squares / entries, gradient)
    }
}

/// Half the derivative of the sum of the squares of `miss` in the unknowns.
fn half_gradient(
    Layers { hidden, .. }: &Layers,
    points: &DMatrix<f64>,
    Passes { values, by_value, by_sum, .. }: &Passes,
    miss: DMatrix<f64>,
) -> Vec<f64> {
    // Upwards: the derivatives in C_k = B_k∘σ′ and in B_{k−1} = W_kᵀ C_k.
    let mut by_below = miss;
    let (mut by_matrices, mut by_inputs) = (Vec::new(), Vec::new());
    for (k, Hidden { matrix, .. }) in hidden.iter().enumerate() {
        by_matrices.push(&by_sum[k] * by_below.transpose());
        let by_inner = matrix * by_below;
        let bent = by_inner.zip_map(&values[k], |by, a| by * bend(a));
        by_inputs.push(bent.component_mul(&by_value[k]));
        by_below = by_inner.zip_map(&values[k], |by, a| by * slope(a));
    }
    // Downwards: through σ and σ′ to Z_k, and in W_k and b_k of Z_k = W_k A_{k−1} + b_k.
    let mut from_above: Option<DMatrix<f64>> = None;
    let mut parts = vec![by_below.column_sum().as_slice().to_vec()];
    let layers = hidden.iter().zip(by_matrices).zip(by_inputs).enumerate().rev();
    for (k, ((Hidden { transpose, .. }, mut by_matrix), mut by_input)) in layers {
        if let Some(above) = from_above {
            by_input += above.zip_map(&values[k], |by, a| by * slope(a));
        }
        let below = if k == 0 { points } else { &values[k - 1] };
        by_matrix.gemm(1.0, &by_input, &below.transpose(), 1.0);
        parts.push(by_input.column_sum().as_slice().to_vec());
        parts.push(by_matrix.as_slice().to_vec());
        from_above = Some(transpose * by_input);
    }
    parts.into_iter().rev().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_agrees_with_differences() {
        for widths in [&[7][..], &[6, 5], &[4, 6, 5]] {
            let wave = |seed: f64, count| {
                DMatrix::from_fn(3, count, |i, j| (seed + 1.7 * i as f64 + 0.9 * j as f64).sin())
            };
            // More than one piece.
            let fit = SlopeFit::new(widths, &wave(0.3, 270), &wave(1.1, 270));
            let mut flat = fit.draw(3);
            // Biases too.
            flat.iter_mut().enumerate().for_each(|(i, w)| *w += 0.1 * (i as f64).sin());
            let gradient = fit.value_and_gradient(&flat).1;
            for index in 0..flat.len() {
                let at = |change: f64| {
                    let mut moved = flat.clone();
                    moved[index] += change;
                    fit.value_and_gradient(&moved).0
                };
                let (slope, found) = ((at(1e-5) - at(-1e-5)) / 2e-5, gradient[index]);
                assert!((slope - found).abs() < 1e-8, "{index}: {slope} {found}");
            }
        }
    }
}
