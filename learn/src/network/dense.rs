//! A dense network as a function of momenta, with exact gradient and Hessian.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::function::MomentumFunction;
use crate::polynomial::Scaling;

/// The activation σ = tanh by `libm`, which has the same bits on every machine. 1e-16 off near zero: a network needs
/// absolute accuracy only. A network of logistic functions is one of these with other weights: 1/(1 + e⁻ᶻ) = ½ + ½ tanh ½z.
#[inline(always)]
fn activation(z: f64) -> f64 {
    1.0 - 2.0 / (libm::exp(2.0 * z) + 1.0)
}

#[inline(always)]
pub(super) fn slope(a: f64) -> f64 {
    1.0 - a * a
}

#[inline(always)]
pub(super) fn bend(a: f64) -> f64 {
    -2.0 * a * (1.0 - a * a)
}

/// The hidden layers and the last weights of N.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layers {
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
    pub(super) fn of(unknowns: &[f64], mut inputs: usize, widths: &[usize]) -> Self {
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
        Self { hidden, last: DVector::from_column_slice(rest) }
    }

    pub(super) fn forward(&self, points: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
        let mut values: Vec<DMatrix<f64>> = Vec::with_capacity(self.hidden.len());
        for Hidden { matrix, biases, .. } in &self.hidden {
            let mut z = matrix * values.last().unwrap_or(points);
            for mut column in z.column_iter_mut() {
                let pairs = column.iter_mut().zip(biases);
                pairs.for_each(|(z, b)| *z = activation(*z + b));
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
            let inner = above.zip_map(value, |b, a| b * slope(a));
            let below = transpose * &inner;
            by_value.push(std::mem::replace(&mut above, below));
            by_sum.push(inner);
        }
        by_value.reverse();
        by_sum.reverse();
        Passes { values, by_value, by_sum, slope: above }
    }
}

/// One layer z = W a + b on disk.
#[derive(Serialize, Deserialize)]
struct Layer {
    inputs: usize,
    /// W, row by row: a row per output.
    weights: Vec<f64>,
    biases: Vec<f64>,
}

/// S(p) = mean·p + scale · N(u), u the normalised momenta, N hidden layers of one activation and
/// a linear last layer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct DenseNetwork {
    layers: Layers,
    scaling: Scaling,
    mean: Vec<f64>,
    scale: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Activation {
    Tanh,
}

/// The form on disk.
#[derive(Serialize, Deserialize)]
struct Stored {
    activation: Activation,
    scaling: Scaling,
    mean: Vec<f64>,
    scale: f64,
    hidden: Vec<Layer>,
    output: Vec<f64>,
}

impl From<DenseNetwork> for Stored {
    fn from(DenseNetwork { layers, scaling, mean, scale }: DenseNetwork) -> Self {
        let layer = |Hidden { matrix, transpose, biases }: &Hidden| Layer {
            inputs: matrix.ncols(),
            weights: transpose.as_slice().to_vec(),
            biases: biases.as_slice().to_vec(),
        };
        let hidden = layers.hidden.iter().map(layer).collect();
        let (activation, output) = (Activation::Tanh, layers.last.as_slice().to_vec());
        Self { activation, scaling, mean, scale, hidden, output }
    }
}

impl TryFrom<Stored> for DenseNetwork {
    type Error = String;

    fn try_from(stored: Stored) -> Result<Self, String> {
        let Stored { scaling, mean, scale, hidden, output, .. } = stored;
        let mut width = scaling.centre.len();
        let mut layers = Layers { hidden: Vec::new(), last: output.into() };
        for (number, Layer { inputs, weights, biases }) in hidden.into_iter().enumerate() {
            if inputs != width || weights.len() != width * biases.len() {
                return Err(format!("layer {} must take {width} inputs", number + 1));
            }
            width = biases.len();
            let matrix = DMatrix::from_row_slice(width, inputs, &weights);
            let transpose = matrix.transpose();
            layers.hidden.push(Hidden { matrix, transpose, biases: biases.into() });
        }
        if layers.last.len() != width {
            return Err(format!("the last layer must have {width} weights"));
        }
        Self::new(layers, scaling, mean, scale)
    }
}

impl DenseNetwork {
    /// The network of layers that fit together.
    pub(super) fn new(
        layers: Layers,
        scaling: Scaling,
        mean: Vec<f64>,
        scale: f64,
    ) -> Result<Self, String> {
        let dim = scaling.centre.len();
        if dim == 0 || scaling.half_width.len() != dim || mean.len() != dim {
            return Err("centre, half_width and mean must be n > 0 numbers each".into());
        }
        let hidden = layers.hidden.iter().flat_map(|l| l.matrix.iter().chain(&l.biases));
        let numbers = hidden.chain(&layers.last).chain(&mean).chain(&scaling.centre);
        let finite = numbers.chain([&scale]).all(|v| v.is_finite());
        if !finite || !scaling.half_width.iter().all(|w| w.is_finite() && *w > 0.0) {
            return Err("weights and scaling must be finite, half widths positive".into());
        }
        Ok(Self { layers, scaling, mean, scale })
    }

    fn normalise(&self, p: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(p.len(), 1, |i, _| self.scaling.normalise(i, p[i]))
    }

    /// Writes ∂S/∂p, from ∂N/∂u.
    fn scaled(&self, slope: &DMatrix<f64>, gradient: &mut [f64]) {
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.mean[i] + self.scale / self.scaling.half_width[i] * slope[i];
        }
    }
}

impl MomentumFunction for DenseNetwork {
    fn dim(&self) -> usize {
        self.mean.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let u = self.normalise(p);
        let value = self.layers.forward(&u).pop().unwrap_or(u).dot(&self.layers.last);
        self.mean.iter().zip(p).map(|(mean, p)| mean * p).sum::<f64>() + self.scale * value
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        self.scaled(&self.layers.passes(&self.normalise(p)).slope, gradient);
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        let (dim, layers) = (self.dim(), &self.layers);
        let passes = layers.passes(&self.normalise(p));
        self.scaled(&passes.slope, gradient);
        let times = |mut rows: DMatrix<f64>, factors: &DMatrix<f64>| {
            rows.column_iter_mut().for_each(|mut column| column.component_mul_assign(factors));
            rows
        };
        // The tangents of the forward pass along every u_j, then of the backward pass.
        let mut tangent = DMatrix::identity(dim, dim);
        let mut moved = Vec::with_capacity(layers.hidden.len());
        for (layer, value) in layers.hidden.iter().zip(&passes.values) {
            let z = &layer.matrix * &tangent;
            tangent = times(z.clone(), &value.map(slope));
            moved.push(z);
        }
        let mut change = DMatrix::zeros(layers.last.len(), dim);
        for (k, layer) in layers.hidden.iter().enumerate().rev() {
            let (value, by_value) = (&passes.values[k], &passes.by_value[k]);
            let bend = value.zip_map(by_value, |a, by| bend(a) * by);
            let slope = value.map(slope);
            change = &layer.transpose * (times(change, &slope) + times(moved[k].clone(), &bend));
        }
        let width = &self.scaling.half_width;
        for i in 0..dim {
            for j in 0..dim {
                // Symmetric up to rounding; made so exactly.
                let mean = 0.5 * (change[(i, j)] + change[(j, i)]);
                hessian[i * dim + j] = self.scale / (width[i] * width[j]) * mean;
            }
        }
    }
}
