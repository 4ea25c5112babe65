//! The misfit of a network's slope on some samples, and its derivative in the weights, by hand.
//!
//! With Z_k = M_k A_{k−1} + b_k, A_k = σ(Z_k) upwards and C_k = B_k∘σ′(Z_k), B_{k−1} = M_kᵀ C_k
//! downwards from the last weights, B₀ is the slope ∂N/∂u: the forward pass already contains a
//! backward one, and its derivative is two passes more. Samples are cut into pieces of a fixed size
//! which threads share, and the pieces are added up in their order: the bits do not depend on how
//! many threads there are.

use coadjoint_codegen::cancel;
use nalgebra::{DMatrix, DMatrixView};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::activation::Activation;
use super::dense::Layer;

/// Samples of a piece. More would leave threads idle on a few hundred samples, fewer make the
/// products of matrices slower.
const PIECE: usize = 64;

/// The network N in training, and what its slope is to fit: pieces of points, and of the slopes
/// wanted there, a sample per column.
///
/// Its unknowns in a row: per hidden layer W row by row as inputs×outputs, and b; then the last
/// weights.
pub(super) struct SlopeFit {
    pub(super) inputs: usize,
    pub(super) widths: Vec<usize>,
    pub(super) activation: Activation,
    pub(super) pieces: Vec<(DMatrix<f64>, DMatrix<f64>)>,
}

/// A layer's M, its transpose, and b.
type Layers<'a> = Vec<(DMatrixView<'a, f64>, DMatrix<f64>, &'a [f64])>;

impl SlopeFit {
    pub(super) fn new(
        (widths, activation): (&[usize], Activation),
        points: &DMatrix<f64>,
        slopes: &DMatrix<f64>,
    ) -> Self {
        let piece = |from| {
            let count = PIECE.min(points.ncols() - from);
            let cut = |m: &DMatrix<f64>| m.columns(from, count).into_owned();
            (cut(points), cut(slopes))
        };
        let pieces = (0..points.ncols()).step_by(PIECE).map(piece).collect();
        Self { inputs: points.nrows(), widths: widths.to_vec(), activation, pieces }
    }

    /// First weights, drawn uniformly: in the first layer from ±1/inputs, with biases from ±1, so
    /// that inputs in [−1, 1] move every neuron through the bend of its activation; in the others
    /// with the variance of Glorot and Bengio (2010), biases 0.
    ///
    /// Their variance in the first layer too, and no biases, leave a network of tanh odd and nearly
    /// linear: after 300 evaluations the loss of a hybrid was fourteen times as high.
    pub(super) fn draw(&self, seed: u64) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut unknowns = Vec::new();
        let mut draw = |limit: f64, count: usize| {
            unknowns.extend((0..count).map(|_| limit * (2.0 * rng.random::<f64>() - 1.0)));
        };
        let glorot = |rows: usize, columns: usize| (6.0 / (rows + columns) as f64).sqrt();
        let mut inputs = self.inputs;
        for (k, &width) in self.widths.iter().enumerate() {
            let first = [1.0 / inputs as f64, 1.0];
            let [weights, biases] = if k == 0 { first } else { [glorot(inputs, width), 0.0] };
            draw(weights, inputs * width);
            draw(biases, width);
            inputs = width;
        }
        draw(glorot(inputs, 1), inputs);
        unknowns
    }

    /// The layers and the last weights of a row of unknowns.
    pub(super) fn layers(&self, unknowns: &[f64]) -> (Vec<Layer>, Vec<f64>) {
        let (layers, last) = self.cut(unknowns);
        let layer =
            |(matrix, transpose, biases): (DMatrixView<'_, f64>, DMatrix<f64>, &[f64])| Layer {
                inputs: matrix.ncols(),
                weights: transpose.as_slice().to_vec(),
                biases: biases.to_vec(),
            };
        (layers.into_iter().map(layer).collect(), last.to_vec())
    }

    fn cut<'a>(&self, unknowns: &'a [f64]) -> (Layers<'a>, &'a [f64]) {
        let (mut inputs, mut rest) = (self.inputs, unknowns);
        let mut layers = Vec::new();
        for &width in &self.widths {
            let (entries, after) = rest.split_at(inputs * width);
            let (biases, after) = after.split_at(width);
            // Row by row inputs×outputs is column by column outputs×inputs.
            let matrix = DMatrixView::from_slice(entries, width, inputs);
            layers.push((matrix, matrix.transpose(), biases));
            (inputs, rest) = (width, after);
        }
        (layers, rest)
    }

    fn entries(&self) -> f64 {
        self.pieces.iter().map(|(points, _)| points.len()).sum::<usize>() as f64
    }

    /// The mean squared misfit.
    pub(super) fn value(&self, unknowns: &[f64]) -> f64 {
        let (layers, last) = self.cut(unknowns);
        let square = |(points, slopes): &(DMatrix<f64>, DMatrix<f64>)| {
            cancel::check();
            self.misfit(&layers, last, points, slopes).miss.norm_squared()
        };
        self.pieces.iter().map(square).sum::<f64>() / self.entries()
    }

    /// The mean squared misfit and its derivative.
    pub(super) fn value_and_gradient(&self, unknowns: &[f64]) -> (f64, Vec<f64>) {
        let (layers, last) = self.cut(unknowns);
        let token = cancel::token();
        let one = |(points, slopes): &(DMatrix<f64>, DMatrix<f64>)| {
            token.check();
            let passes = self.misfit(&layers, last, points, slopes);
            let squares = passes.miss.norm_squared();
            (squares, self.half_gradient(&layers, points, passes))
        };
        let parts: Vec<(f64, Vec<f64>)> = self.pieces.par_iter().map(one).collect();
        let (mut squares, mut gradient) = (0.0, vec![0.0; unknowns.len()]);
        for (own, part) in &parts {
            squares += own;
            gradient.iter_mut().zip(part).for_each(|(sum, entry)| *sum += entry);
        }
        gradient.iter_mut().for_each(|entry| *entry *= 2.0 / self.entries());
        (squares / self.entries(), gradient)
    }

    /// The forward pass: A, B, C and the misfit.
    fn misfit(
        &self,
        layers: &Layers<'_>,
        last: &[f64],
        points: &DMatrix<f64>,
        slopes: &DMatrix<f64>,
    ) -> Passes {
        let mut values: Vec<DMatrix<f64>> = Vec::with_capacity(layers.len());
        for (matrix, _, biases) in layers {
            let mut z = matrix * values.last().unwrap_or(points);
            for mut column in z.column_iter_mut() {
                let pairs = column.iter_mut().zip(*biases);
                pairs.for_each(|(z, b)| *z = self.activation.value(*z + b));
            }
            values.push(z);
        }
        let mut above = DMatrix::from_fn(last.len(), points.ncols(), |i, _| last[i]);
        let (mut aboves, mut inners) = (Vec::new(), Vec::new());
        for ((_, transpose, _), value) in layers.iter().zip(&values).rev() {
            let inner = above.zip_map(value, |b, a| b * self.activation.slope(a));
            let below = transpose * &inner;
            aboves.push(std::mem::replace(&mut above, below));
            inners.push(inner);
        }
        aboves.reverse();
        inners.reverse();
        Passes { values, aboves, inners, miss: above - slopes }
    }

    /// Half the derivative of the sum of squares in the unknowns.
    fn half_gradient(
        &self,
        layers: &Layers<'_>,
        points: &DMatrix<f64>,
        passes: Passes,
    ) -> Vec<f64> {
        let Passes { values, aboves, inners, miss } = passes;
        let activation = self.activation;
        // Upwards: the derivatives in C_k = B_k∘σ′ and in B_{k−1} = M_kᵀ C_k.
        let mut by_below = miss;
        let (mut by_matrices, mut by_inputs) = (Vec::new(), Vec::new());
        for (k, (matrix, _, _)) in layers.iter().enumerate() {
            by_matrices.push(&inners[k] * by_below.transpose());
            let by_inner = matrix * by_below;
            let bent = by_inner.zip_map(&values[k], |by, a| by * activation.bend(a));
            by_inputs.push(bent.component_mul(&aboves[k]));
            by_below = by_inner.zip_map(&values[k], |by, a| by * activation.slope(a));
        }
        // Downwards: through σ and σ′ to Z_k, and in M_k and b_k of Z_k = M_k A_{k−1} + b_k.
        let mut by_value: Option<DMatrix<f64>> = None;
        let mut parts = vec![by_below.column_sum().as_slice().to_vec()];
        for (k, (_, transpose, _)) in layers.iter().enumerate().rev() {
            let mut by_input = std::mem::take(&mut by_inputs[k]);
            if let Some(by_value) = by_value {
                by_input += by_value.zip_map(&values[k], |by, a| by * activation.slope(a));
            }
            let below = if k == 0 { points } else { &values[k - 1] };
            let mut by_matrix = std::mem::take(&mut by_matrices[k]);
            by_matrix.gemm(1.0, &by_input, &below.transpose(), 1.0);
            parts.push(by_input.column_sum().as_slice().to_vec());
            parts.push(by_matrix.as_slice().to_vec());
            by_value = Some(transpose * by_input);
        }
        parts.into_iter().rev().flatten().collect()
    }
}

/// The results of a forward pass: per layer A, B and C, and slope minus the slope wanted.
struct Passes {
    values: Vec<DMatrix<f64>>,
    aboves: Vec<DMatrix<f64>>,
    inners: Vec<DMatrix<f64>>,
    miss: DMatrix<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_agrees_with_differences() {
        for (activation, widths) in [
            (Activation::Tanh, vec![7]),
            (Activation::Tanh, vec![6, 5]),
            (Activation::Logistic, vec![4, 6, 5]),
        ] {
            let wave = |seed: f64, count| {
                DMatrix::from_fn(3, count, |i, j| (seed + 1.7 * i as f64 + 0.9 * j as f64).sin())
            };
            // More than one piece.
            let fit = SlopeFit::new((&widths, activation), &wave(0.3, 270), &wave(1.1, 270));
            let mut flat = fit.draw(3);
            // Biases too.
            flat.iter_mut().enumerate().for_each(|(i, w)| *w += 0.1 * (i as f64).sin());
            let (value, gradient) = fit.value_and_gradient(&flat);
            assert!((value - fit.value(&flat)).abs() <= 1e-14 * value);
            for index in 0..flat.len() {
                let at = |change: f64| {
                    let mut moved = flat.clone();
                    moved[index] += change;
                    fit.value(&moved)
                };
                let (slope, found) = ((at(1e-5) - at(-1e-5)) / 2e-5, gradient[index]);
                assert!((slope - found).abs() < 1e-8, "{index}: {slope} {found}");
            }
        }
    }
}
