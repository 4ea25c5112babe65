//! The misfit of a network's slope and its derivative in the weights, by hand.
//!
//! With Z_k = M_k A_{k−1} + b_k, A_k = σ(Z_k) upwards and C_k = B_k∘σ′(Z_k), B_{k−1} = M_kᵀ C_k
//! downwards from the last weights, B₀ is the slope ∂N/∂u: the forward pass already contains a
//! backward one, and its derivative is two passes more. Six products of matrices per pair of hidden
//! layers, and nothing else that grows with the square of the width.
//!
//! Samples are cut into pieces of a fixed size which threads share, and the pieces are added up in
//! their order: the bits do not depend on how many threads there are.

use nalgebra::{DMatrix, DMatrixView, DVector};

use super::activation::Activation;
use super::architecture::Architecture;

/// Samples of a piece.
const PIECE: usize = 125;

/// Points and the slopes wanted there, a sample per column.
pub(super) struct SlopeFit {
    architecture: Architecture,
    pieces: Vec<(DMatrix<f64>, DMatrix<f64>)>,
    entries: f64,
}

/// What a piece adds: the sum of squares, and half its derivative.
struct Share {
    squares: f64,
    gradient: Vec<f64>,
}

/// A layer's M, its transpose, and b.
struct Weights<'a> {
    matrix: DMatrixView<'a, f64>,
    transpose: DMatrix<f64>,
    bias: &'a [f64],
}

/// A layer's σ(Z), σ′(Z) and σ″(Z).
struct State {
    value: DMatrix<f64>,
    slope: DMatrix<f64>,
    bend: DMatrix<f64>,
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
                (cut(points), cut(slopes))
            })
            .collect();
        Self { architecture, pieces, entries: points.len() as f64 }
    }

    /// The network.
    pub(super) fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// The mean squared misfit.
    pub(super) fn value(&self, flat: &[f64]) -> f64 {
        let (layers, last) = self.cut(flat);
        let squares = |(u, y): &(DMatrix<f64>, DMatrix<f64>)| {
            let states = forward(self.architecture.activation, &layers, u);
            let (_, slope) = downward(&layers, &states, last, u.ncols());
            (slope - y).norm_squared()
        };
        self.pieces.iter().map(squares).sum::<f64>() / self.entries
    }

    /// The mean squared misfit and its derivative.
    pub(super) fn value_and_gradient(&self, flat: &[f64]) -> (f64, Vec<f64>) {
        let (layers, last) = self.cut(flat);
        let activation = self.architecture.activation;
        let share = |piece: &(DMatrix<f64>, DMatrix<f64>)| {
            share(activation, &layers, last, piece, flat.len())
        };
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = threads.min(self.pieces.len()).max(1);
        let mut shares: Vec<Option<Share>> = Vec::new();
        shares.resize_with(self.pieces.len(), || None);
        let portion = self.pieces.len().div_ceil(threads).max(1);
        std::thread::scope(|scope| {
            let mut work = self.pieces.chunks(portion).zip(shares.chunks_mut(portion));
            let own = work.next();
            for (pieces, places) in work {
                let share = &share;
                scope.spawn(move || {
                    pieces
                        .iter()
                        .zip(places)
                        .for_each(|(piece, place)| *place = Some(share(piece)));
                });
            }
            if let Some((pieces, places)) = own {
                pieces.iter().zip(places).for_each(|(piece, place)| *place = Some(share(piece)));
            }
        });
        let mut squares = 0.0;
        let mut gradient = vec![0.0; flat.len()];
        for share in shares.into_iter().flatten() {
            squares += share.squares;
            gradient.iter_mut().zip(&share.gradient).for_each(|(g, s)| *g += s);
        }
        gradient.iter_mut().for_each(|g| *g *= 2.0 / self.entries);
        (squares / self.entries, gradient)
    }

    /// The layers, and the last weights.
    fn cut<'a>(&self, flat: &'a [f64]) -> (Vec<Weights<'a>>, &'a [f64]) {
        let mut inputs = self.architecture.inputs;
        let mut rest = flat;
        let mut layers = Vec::new();
        for &width in &self.architecture.widths {
            let (matrix, after) = rest.split_at(inputs * width);
            let (bias, after) = after.split_at(width);
            // Row by row inputs×outputs is column by column outputs×inputs.
            let matrix = DMatrixView::from_slice(matrix, width, inputs);
            layers.push(Weights { matrix, transpose: matrix.transpose(), bias });
            (inputs, rest) = (width, after);
        }
        (layers, rest)
    }
}

/// A·B.
fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut result = DMatrix::zeros(a.nrows(), b.ncols());
    result.gemm(1.0, a, b, 0.0);
    result
}

/// σ and its derivatives at every layer.
fn forward(activation: Activation, layers: &[Weights<'_>], u: &DMatrix<f64>) -> Vec<State> {
    let mut states: Vec<State> = Vec::with_capacity(layers.len());
    for layer in layers {
        let input = states.last().map_or(u, |state| &state.value);
        let mut value = DMatrix::zeros(layer.matrix.nrows(), u.ncols());
        value.gemm(1.0, &layer.matrix, input, 0.0);
        let (mut slope, mut bend) = (value.clone(), value.clone());
        let rows = value.nrows().max(1);
        let targets = value.iter_mut().zip(slope.iter_mut()).zip(bend.iter_mut());
        for (index, ((value, slope), bend)) in targets.enumerate() {
            (*value, *slope, *bend) = activation.derivatives(*value + layer.bias[index % rows]);
        }
        states.push(State { value, slope, bend });
    }
    states
}

/// B_k for every layer, from the first, and the slope B₀.
fn downward(
    layers: &[Weights<'_>],
    states: &[State],
    last: &[f64],
    samples: usize,
) -> (Vec<DMatrix<f64>>, DMatrix<f64>) {
    let mut above = DMatrix::from_fn(last.len(), samples, |i, _| last[i]);
    let mut all = Vec::with_capacity(layers.len());
    for (layer, state) in layers.iter().zip(states).rev() {
        let below = product(&layer.transpose, &above.component_mul(&state.slope));
        all.push(std::mem::replace(&mut above, below));
    }
    all.reverse();
    (all, above)
}

/// The share of a piece.
fn share(
    activation: Activation,
    layers: &[Weights<'_>],
    last: &[f64],
    (u, y): &(DMatrix<f64>, DMatrix<f64>),
    unknowns: usize,
) -> Share {
    let states = forward(activation, layers, u);
    let (above, slope) = downward(layers, &states, last, u.ncols());
    let miss = slope - y;
    let squares = miss.norm_squared();
    // Upwards: the derivatives by C_k = B_k∘σ′ and by M_k in B_{k−1} = M_kᵀ C_k.
    let mut by_below = miss;
    let mut by_slopes = Vec::with_capacity(layers.len());
    let mut by_matrices = Vec::with_capacity(layers.len());
    for ((layer, state), above) in layers.iter().zip(&states).zip(&above) {
        let mut by_product = DMatrix::zeros(layer.matrix.nrows(), u.ncols());
        by_product.gemm(1.0, &layer.matrix, &by_below, 0.0);
        by_matrices.push(product(&above.component_mul(&state.slope), &by_below.transpose()));
        by_slopes.push(by_product.component_mul(above));
        by_below = by_product.component_mul(&state.slope);
    }
    let by_last: DVector<f64> = by_below.column_sum();
    // Downwards: through σ and σ′ to Z_k, and by M_k and b_k in Z_k = M_k A_{k−1} + b_k.
    let mut biases = Vec::with_capacity(layers.len());
    let mut by_value: Option<DMatrix<f64>> = None;
    for (k, layer) in layers.iter().enumerate().rev() {
        let mut by_input = by_slopes[k].component_mul(&states[k].bend);
        if let Some(by_value) = &by_value {
            by_input += by_value.component_mul(&states[k].slope);
        }
        let below = if k == 0 { u } else { &states[k - 1].value };
        by_matrices[k].gemm(1.0, &by_input, &below.transpose(), 1.0);
        biases.push(by_input.column_sum());
        if k > 0 {
            by_value = Some(product(&layer.transpose, &by_input));
        }
    }
    let mut gradient = Vec::with_capacity(unknowns);
    for (matrix, bias) in by_matrices.iter().zip(biases.iter().rev()) {
        gradient.extend_from_slice(matrix.as_slice());
        gradient.extend_from_slice(bias.as_slice());
    }
    gradient.extend_from_slice(by_last.as_slice());
    Share { squares, gradient }
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
            let architecture = Architecture { inputs: 3, widths, outputs: 1, activation };
            let parts = architecture.draw(3);
            let mut flat: Vec<f64> = parts.into_iter().flat_map(|(entries, ..)| entries).collect();
            // Biases too.
            flat.iter_mut().enumerate().for_each(|(i, w)| *w += 0.1 * (i as f64).sin());
            let wave = |seed: f64, count| {
                DMatrix::from_fn(3, count, |i, j| (seed + 1.7 * i as f64 + 0.9 * j as f64).sin())
            };
            // More than one piece.
            let fit = SlopeFit::new(architecture, &wave(0.3, 140), &wave(1.1, 140));
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
