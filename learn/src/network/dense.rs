//! A dense network as a function of momenta, with exact gradient and Hessian.

use nalgebra::{DMatrix, DMatrixView, DVector};
use serde::{Deserialize, Serialize};

use super::activation::Activation;
use crate::function::MomentumFunction;
use crate::polynomial::Scaling;

/// One layer z = W a + b.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layer {
    /// The number of inputs.
    pub inputs: usize,
    /// W, row by row: a row per output.
    pub weights: Vec<f64>,
    /// b, one per output.
    pub biases: Vec<f64>,
}

impl Layer {
    /// The number of outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.biases.len()
    }

    /// Wᵀ, of which a column is a row of W.
    fn transpose(&self) -> DMatrixView<'_, f64> {
        DMatrixView::from_slice(&self.weights, self.inputs, self.outputs())
    }
}

/// S(p) = mean·p + scale · N(u), u the normalised momenta, N hidden layers of one activation and
/// a linear last layer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct DenseNetwork {
    stored: Stored,
}

/// The fields, unchecked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Stored {
    activation: Activation,
    scaling: Scaling,
    mean: Vec<f64>,
    scale: f64,
    hidden: Vec<Layer>,
    output: Vec<f64>,
}

impl From<DenseNetwork> for Stored {
    fn from(network: DenseNetwork) -> Self {
        network.stored
    }
}

impl TryFrom<Stored> for DenseNetwork {
    type Error = String;

    fn try_from(stored: Stored) -> Result<Self, String> {
        let Stored { scaling, mean, scale, hidden, output, .. } = &stored;
        let dim = scaling.centre.len();
        let mut width = dim;
        if dim == 0 || scaling.half_width.len() != dim || mean.len() != dim {
            return Err("centre, half_width and mean must be n > 0 numbers each".into());
        }
        for (number, layer) in hidden.iter().enumerate() {
            if layer.inputs != width || layer.weights.len() != width * layer.outputs() {
                return Err(format!("layer {} must take {width} inputs", number + 1));
            }
            width = layer.outputs();
        }
        if output.len() != width {
            return Err(format!("the last layer must have {width} weights"));
        }
        let layers = hidden.iter().flat_map(|l| l.weights.iter().chain(&l.biases));
        let numbers = layers.chain(output).chain(mean).chain(&scaling.centre).chain([scale]);
        let finite = numbers.into_iter().all(|v| v.is_finite());
        if !finite || !scaling.half_width.iter().all(|w| w.is_finite() && *w > 0.0) {
            return Err("weights and scaling must be finite, half widths positive".into());
        }
        Ok(Self { stored })
    }
}

/// A layer's a = σ(z), with σ′ and σ″ there.
struct State {
    value: DVector<f64>,
    slope: DVector<f64>,
    bend: DVector<f64>,
}

impl DenseNetwork {
    /// The network of the parts given.
    ///
    /// # Errors
    /// A sentence, when the sizes do not fit together or a number is not finite.
    pub fn new(
        activation: Activation,
        scaling: Scaling,
        mean: Vec<f64>,
        scale: f64,
        hidden: Vec<Layer>,
        output: Vec<f64>,
    ) -> Result<Self, String> {
        Stored { activation, scaling, mean, scale, hidden, output }.try_into()
    }

    /// The widths of the hidden layers.
    #[must_use]
    pub fn widths(&self) -> Vec<usize> {
        self.stored.hidden.iter().map(Layer::outputs).collect()
    }

    fn normalise(&self, p: &[f64]) -> DVector<f64> {
        DVector::from_fn(p.len(), |i, _| self.stored.scaling.normalise(i, p[i]))
    }

    fn forward(&self, p: &[f64]) -> Vec<State> {
        let mut input = self.normalise(p);
        let mut states = Vec::with_capacity(self.stored.hidden.len());
        for layer in &self.stored.hidden {
            let z = layer.transpose().tr_mul(&input) + DVector::from_column_slice(&layer.biases);
            let value = z.map(|z| self.stored.activation.value(z));
            let slope = value.map(|a| self.stored.activation.slope(a));
            let bend = value.map(|a| self.stored.activation.bend(a));
            input.clone_from(&value);
            states.push(State { value, slope, bend });
        }
        states
    }

    /// ∂N/∂a for the outputs a of every hidden layer, and ∂N/∂u first.
    fn backward(&self, states: &[State]) -> Vec<DVector<f64>> {
        let mut slopes = vec![DVector::from_column_slice(&self.stored.output)];
        for (layer, state) in self.stored.hidden.iter().zip(states).rev() {
            let above = &slopes[slopes.len() - 1];
            slopes.push(layer.transpose() * above.component_mul(&state.slope));
        }
        slopes.reverse();
        slopes
    }

    /// Writes ∂S/∂p, from ∂N/∂u.
    fn scaled(&self, slope: &DVector<f64>, gradient: &mut [f64]) {
        for (i, entry) in gradient.iter_mut().enumerate() {
            let factor = self.stored.scale / self.stored.scaling.half_width[i];
            *entry = self.stored.mean[i] + factor * slope[i];
        }
    }
}

impl MomentumFunction for DenseNetwork {
    fn dim(&self) -> usize {
        self.stored.mean.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let last = self.forward(p).pop().map_or_else(|| self.normalise(p), |state| state.value);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let Stored { mean, scale, output, .. } = &self.stored;
        dot(mean, p) + scale * dot(output, last.as_slice())
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        self.scaled(&self.backward(&self.forward(p))[0], gradient);
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        let dim = self.dim();
        let states = self.forward(p);
        let slopes = self.backward(&states);
        self.scaled(&slopes[0], gradient);
        let times = |m: DMatrix<f64>, factors: &DVector<f64>| {
            DMatrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)] * factors[i])
        };
        // The tangents of the forward pass along every u_j, then of the backward pass.
        let mut tangent = DMatrix::identity(dim, dim);
        let mut moved = Vec::with_capacity(states.len());
        for (layer, state) in self.stored.hidden.iter().zip(&states) {
            let z = layer.transpose().tr_mul(&tangent);
            tangent = times(z.clone(), &state.slope);
            moved.push(z);
        }
        let mut change = DMatrix::zeros(self.stored.output.len(), dim);
        for (k, layer) in self.stored.hidden.iter().enumerate().rev() {
            let bent = times(moved[k].clone(), &states[k].bend.component_mul(&slopes[k + 1]));
            change = layer.transpose() * (times(change, &states[k].slope) + bent);
        }
        let width = &self.stored.scaling.half_width;
        for i in 0..dim {
            for j in 0..dim {
                // Symmetric up to rounding; made so exactly.
                let mean = 0.5 * (change[(i, j)] + change[(j, i)]);
                hessian[i * dim + j] = self.stored.scale / (width[i] * width[j]) * mean;
            }
        }
    }
}
