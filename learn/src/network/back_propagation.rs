//! The misfit of a network's slope on some samples, and its derivative in the weights, by hand.
//!
//! With Z_k = M_k A_{k−1} + b_k, A_k = σ(Z_k) upwards and C_k = B_k∘σ′(Z_k), B_{k−1} = M_kᵀ C_k
//! downwards from the last weights, B₀ is the slope ∂N/∂u: the forward pass already contains a
//! backward one, and its derivative is two passes more. Six products of matrices per pair of hidden
//! layers, and little else that grows with the square of the width. Matrices live as long as the fit:
//! at the paper's size, memory costs as much as arithmetic.

use nalgebra::{DMatrix, DMatrixView, DMatrixViewMut, Dyn, MatrixView};

use super::activation::Activation;
use super::architecture::Architecture;
use super::pass;

/// A layer's M, its transpose, and b.
pub(super) struct Layer<'a> {
    matrix: DMatrixView<'a, f64>,
    transpose: DMatrix<f64>,
    bias: &'a [f64],
}

impl<'a> Layer<'a> {
    /// The layer whose M has these entries, column by column.
    pub(super) fn new(entries: &'a [f64], bias: &'a [f64], inputs: usize) -> Self {
        let matrix = DMatrixView::from_slice(entries, bias.len(), inputs);
        Self { matrix, transpose: matrix.transpose(), bias }
    }
}

/// The transpose, without a copy. Only for the right factor: nalgebra 0.35 writes out of bounds
/// where the left one is such a view and a side is too short for its fast product.
fn transposed(m: &DMatrix<f64>) -> MatrixView<'_, f64, Dyn, Dyn, Dyn, Dyn> {
    let (rows, columns) = (Dyn(m.nrows()), Dyn(m.ncols()));
    MatrixView::from_slice_with_strides_generic(m.as_slice(), columns, rows, rows, Dyn(1))
}

/// What is known of a layer's outputs, a sample per column.
struct State {
    /// A = σ(Z).
    value: DMatrix<f64>,
    /// B = ∂N/∂A; on the way back the derivative of the misfit in A.
    above: DMatrix<f64>,
    /// C = B∘σ′(Z).
    inner: DMatrix<f64>,
    /// The derivative of the misfit in B.
    by_above: DMatrix<f64>,
    /// The derivative of the misfit in Z.
    by_input: DMatrix<f64>,
}

/// Samples, and what is computed for them.
pub(super) struct Piece {
    points: DMatrix<f64>,
    slopes: DMatrix<f64>,
    states: Vec<State>,
    /// Slope minus the slope wanted.
    miss: DMatrix<f64>,
    /// The sum of squares.
    pub(super) squares: f64,
    /// Half its derivative in the weights.
    pub(super) gradient: Vec<f64>,
}

impl Piece {
    pub(super) fn new(
        points: DMatrix<f64>,
        slopes: DMatrix<f64>,
        architecture: &Architecture,
    ) -> Self {
        let samples = points.ncols();
        let zeros = |&width: &usize| DMatrix::zeros(width, samples);
        let state = |width| State {
            value: zeros(width),
            above: zeros(width),
            inner: zeros(width),
            by_above: zeros(width),
            by_input: zeros(width),
        };
        let states = architecture.widths.iter().map(state).collect();
        let miss = DMatrix::zeros(points.nrows(), samples);
        Self { points, slopes, states, miss, squares: 0.0, gradient: Vec::new() }
    }

    /// The sum of squares, with A, B and C on the way.
    pub(super) fn misfit(
        &mut self,
        activation: Activation,
        layers: &[Layer<'_>],
        last: &[f64],
    ) -> f64 {
        for (k, layer) in layers.iter().enumerate() {
            let (below, states) = self.states.split_at_mut(k);
            let input = below.last().map_or(&self.points, |state| &state.value);
            let value = &mut states[0].value;
            for mut column in value.column_iter_mut() {
                column.copy_from_slice(layer.bias);
            }
            value.gemm(1.0, &layer.matrix, input, 1.0);
            pass::apply(activation, value.as_mut_slice());
        }
        if let Some(top) = self.states.last_mut() {
            for mut column in top.above.column_iter_mut() {
                column.copy_from_slice(last);
            }
        }
        for (k, layer) in layers.iter().enumerate().rev() {
            let (below, states) = self.states.split_at_mut(k);
            let State { value, above, inner, .. } = &mut states[0];
            pass::inner(activation, value.as_slice(), above.as_slice(), inner.as_mut_slice());
            let target = below.last_mut().map_or(&mut self.miss, |state| &mut state.above);
            target.gemm(1.0, &layer.transpose, inner, 0.0);
        }
        self.miss -= &self.slopes;
        self.miss.norm_squared()
    }

    /// The sum of squares and half its derivative.
    pub(super) fn differentiate(
        &mut self,
        activation: Activation,
        layers: &[Layer<'_>],
        last: &[f64],
    ) {
        self.squares = self.misfit(activation, layers, last);
        let unknowns = layers.iter().map(|l| l.matrix.len() + l.bias.len()).sum::<usize>();
        self.gradient.resize(unknowns + last.len(), 0.0);
        let mut rest = self.gradient.as_mut_slice();
        let mut by_layers = Vec::with_capacity(layers.len());
        for layer in layers {
            let (by_matrix, after) = rest.split_at_mut(layer.matrix.len());
            let (by_bias, after) = after.split_at_mut(layer.bias.len());
            let (rows, columns) = layer.matrix.shape();
            by_layers.push((DMatrixViewMut::from_slice(by_matrix, rows, columns), by_bias));
            rest = after;
        }
        // Upwards: the derivatives by C_k = B_k∘σ′ and by M_k in B_{k−1} = M_kᵀ C_k.
        for (k, (layer, (by_matrix, _))) in layers.iter().zip(&mut by_layers).enumerate() {
            let (below, states) = self.states.split_at_mut(k);
            let by_below = below.last().map_or(&self.miss, |state| &state.by_above);
            let State { value, above, inner, by_above, by_input } = &mut states[0];
            by_matrix.gemm(1.0, inner, &transposed(by_below), 0.0);
            by_above.gemm(1.0, &layer.matrix, by_below, 0.0);
            let (value, above) = (value.as_slice(), above.as_slice());
            pass::upwards(
                activation,
                value,
                above,
                by_above.as_mut_slice(),
                by_input.as_mut_slice(),
            );
        }
        sum_columns(self.states.last().map_or(&self.miss, |state| &state.by_above), rest);
        // Downwards: through σ and σ′ to Z_k, and by M_k and b_k in Z_k = M_k A_{k−1} + b_k.
        let highest = layers.len().saturating_sub(1);
        for (k, (layer, (by_matrix, by_bias))) in layers.iter().zip(by_layers).enumerate().rev() {
            let (below, states) = self.states.split_at_mut(k);
            let State { value, above, by_input, .. } = &mut states[0];
            if k < highest {
                let (value, by_value) = (value.as_slice(), above.as_slice());
                pass::downwards(activation, value, by_value, by_input.as_mut_slice());
            }
            let input = below.last().map_or(&self.points, |state| &state.value);
            let mut by_matrix = by_matrix;
            by_matrix.gemm(1.0, by_input, &transposed(input), 1.0);
            sum_columns(by_input, by_bias);
            if let Some(state) = below.last_mut() {
                state.above.gemm(1.0, &layer.transpose, by_input, 0.0);
            }
        }
    }
}

fn sum_columns(m: &DMatrix<f64>, sum: &mut [f64]) {
    sum.fill(0.0);
    for column in m.column_iter() {
        sum.iter_mut().zip(column.as_slice()).for_each(|(s, c)| *s += c);
    }
}
