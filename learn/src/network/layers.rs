//! A dense network N(u) of one activation with a linear last layer, and its passes over some points.

use nalgebra::{DMatrix, DVector};

use super::activation::Activation;

/// The hidden layers and the last weights of N.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layers {
    pub(super) activation: Activation,
    pub(super) hidden: Vec<Hidden>,
    pub(super) last: DVector<f64>,
}

/// A hidden layer a = σ(W a′ + b): W, Wᵀ and b.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hidden {
    pub(super) matrix: DMatrix<f64>,
    pub(super) transpose: DMatrix<f64>,
    pub(super) biases: DVector<f64>,
}

/// A point per column: in each layer its values a = σ(z), the derivative ∂N/∂a, and ∂N/∂z = ∂N/∂a∘σ′; then the slope
/// ∂N/∂u.
pub(super) struct Passes {
    pub(super) values: Vec<DMatrix<f64>>,
    pub(super) by_value: Vec<DMatrix<f64>>,
    pub(super) by_sum: Vec<DMatrix<f64>>,
    pub(super) slope: DMatrix<f64>,
}

impl Layers {
    /// The network of unknowns in a row: per hidden layer W column by column, and b; then the last weights.
    pub(super) fn of(
        unknowns: &[f64],
        mut inputs: usize,
        widths: &[usize],
        activation: Activation,
    ) -> Self {
        let mut rest = unknowns;
        let mut hidden = Vec::with_capacity(widths.len());
        for &width in widths {
            let (entries, after) = rest.split_at(inputs * width);
            let (biases, after) = after.split_at(width);
            let matrix = DMatrix::from_column_slice(width, inputs, entries);
            let (transpose, biases) = (matrix.transpose(), DVector::from_column_slice(biases));
            hidden.push(Hidden { matrix, transpose, biases });
            (inputs, rest) = (width, after);
        }
        Self { activation, hidden, last: DVector::from_column_slice(rest) }
    }

    /// The outputs of the hidden layers.
    pub(super) fn forward(&self, points: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
        let mut values: Vec<DMatrix<f64>> = Vec::with_capacity(self.hidden.len());
        for Hidden { matrix, biases, .. } in &self.hidden {
            let mut z = matrix * values.last().unwrap_or(points);
            for mut column in z.column_iter_mut() {
                let pairs = column.iter_mut().zip(biases);
                pairs.for_each(|(z, b)| *z = self.activation.value(*z + b));
            }
            values.push(z);
        }
        values
    }

    /// Forwards, and backwards from the last weights.
    pub(super) fn passes(&self, points: &DMatrix<f64>) -> Passes {
        let values = self.forward(points);
        let mut above = DMatrix::from_fn(self.last.len(), points.ncols(), |i, _| self.last[i]);
        let (mut by_value, mut by_sum) = (Vec::new(), Vec::new());
        for (Hidden { transpose, .. }, value) in self.hidden.iter().zip(&values).rev() {
            let inner = above.zip_map(value, |b, a| b * self.activation.slope(a));
            let below = transpose * &inner;
            by_value.push(std::mem::replace(&mut above, below));
            by_sum.push(inner);
        }
        by_value.reverse();
        by_sum.reverse();
        Passes { values, by_value, by_sum, slope: above }
    }
}
