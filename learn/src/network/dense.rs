//! A dense network as a function of momenta, with exact gradient and Hessian.

use serde::{Deserialize, Serialize};

use super::activation::Activation;
use super::row::dot;
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

    fn row(&self, output: usize) -> &[f64] {
        &self.weights[output * self.inputs..(output + 1) * self.inputs]
    }

    /// W a.
    fn apply(&self, a: &[f64]) -> Vec<f64> {
        (0..self.outputs()).map(|o| dot(self.row(o), a)).collect()
    }

    /// Wᵀ b.
    fn apply_transpose(&self, b: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.inputs];
        for (o, factor) in b.iter().enumerate() {
            for (entry, w) in result.iter_mut().zip(self.row(o)) {
                *entry += factor * w;
            }
        }
        result
    }
}

fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x * y).collect()
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
        let dim = stored.scaling.centre.len();
        let mut width = dim;
        if dim == 0 || stored.scaling.half_width.len() != dim || stored.mean.len() != dim {
            return Err("centre, half_width and mean must be n > 0 numbers each".into());
        }
        for (number, layer) in stored.hidden.iter().enumerate() {
            if layer.inputs != width || layer.weights.len() != width * layer.outputs() {
                return Err(format!("layer {} must take {width} inputs", number + 1));
            }
            width = layer.outputs();
        }
        if stored.output.len() != width {
            return Err(format!("the last layer must have {width} weights"));
        }
        let numbers = stored
            .hidden
            .iter()
            .flat_map(|l| l.weights.iter().chain(&l.biases))
            .chain(&stored.output)
            .chain(&stored.mean)
            .chain(&stored.scaling.centre)
            .chain([&stored.scale]);
        if !numbers.into_iter().all(|v| v.is_finite())
            || !stored.scaling.half_width.iter().all(|w| w.is_finite() && *w > 0.0)
        {
            return Err("weights and scaling must be finite, half widths positive".into());
        }
        Ok(Self { stored })
    }
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

    fn normalise(&self, p: &[f64]) -> Vec<f64> {
        p.iter().enumerate().map(|(i, &v)| self.stored.scaling.normalise(i, v)).collect()
    }

    /// Per hidden layer σ, σ′, σ″ at its inputs.
    fn forward(&self, u: Vec<f64>) -> Vec<[Vec<f64>; 3]> {
        let mut layers: Vec<[Vec<f64>; 3]> = Vec::with_capacity(self.stored.hidden.len());
        for layer in &self.stored.hidden {
            let input = layers.last().map_or(&u, |[a, _, _]| a);
            let z = layer.apply(input);
            let mut state: [Vec<f64>; 3] = Default::default();
            for (z, b) in z.iter().zip(&layer.biases) {
                let (a, slope, bend) = self.stored.activation.derivatives(z + b);
                state[0].push(a);
                state[1].push(slope);
                state[2].push(bend);
            }
            layers.push(state);
        }
        layers
    }

    /// ∂N/∂a for the outputs a of every hidden layer, and ∂N/∂u first.
    fn backward(&self, layers: &[[Vec<f64>; 3]]) -> Vec<Vec<f64>> {
        let mut slopes = vec![self.stored.output.clone()];
        for (layer, state) in self.stored.hidden.iter().zip(layers).rev() {
            let above = &slopes[slopes.len() - 1];
            slopes.push(layer.apply_transpose(&times(&state[1], above)));
        }
        slopes.reverse();
        slopes
    }
}

impl MomentumFunction for DenseNetwork {
    fn dim(&self) -> usize {
        self.stored.mean.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let u = self.normalise(p);
        let layers = self.forward(u.clone());
        let last = layers.last().map_or(&u, |[a, _, _]| a);
        dot(&self.stored.mean, p) + self.stored.scale * dot(&self.stored.output, last)
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let layers = self.forward(self.normalise(p));
        let slopes = self.backward(&layers);
        for (i, entry) in gradient.iter_mut().enumerate() {
            let factor = self.stored.scale / self.stored.scaling.half_width[i];
            *entry = self.stored.mean[i] + factor * slopes[0][i];
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        let dim = self.dim();
        let layers = self.forward(self.normalise(p));
        let slopes = self.backward(&layers);
        let width = &self.stored.scaling.half_width;
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.stored.mean[i] + self.stored.scale / width[i] * slopes[0][i];
        }
        for j in 0..dim {
            // The tangent of the forward pass along u_j, then of the backward pass.
            let mut tangents: Vec<Vec<f64>> = Vec::with_capacity(layers.len());
            let mut tangent = vec![0.0; dim];
            tangent[j] = 1.0;
            for (layer, state) in self.stored.hidden.iter().zip(&layers) {
                let moved = layer.apply(&tangent);
                tangent = times(&state[1], &moved);
                tangents.push(moved);
            }
            let mut change = vec![0.0; self.stored.output.len()];
            for (k, layer) in self.stored.hidden.iter().enumerate().rev() {
                let [_, slope, bend] = &layers[k];
                let above = &slopes[k + 1];
                let inner: Vec<f64> = (0..layer.outputs())
                    .map(|o| slope[o] * change[o] + bend[o] * tangents[k][o] * above[o])
                    .collect();
                change = layer.apply_transpose(&inner);
            }
            for i in 0..dim {
                hessian[i * dim + j] = self.stored.scale / (width[i] * width[j]) * change[i];
            }
        }
        // Symmetric up to rounding; make it so exactly.
        for i in 0..dim {
            for j in 0..i {
                let mean = 0.5 * (hessian[i * dim + j] + hessian[j * dim + i]);
                hessian[i * dim + j] = mean;
                hessian[j * dim + i] = mean;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use super::*;

    fn network(activation: Activation) -> DenseNetwork {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let mut draw =
            |count: usize| -> Vec<f64> { (0..count).map(|_| rng.random::<f64>() - 0.5).collect() };
        let hidden = vec![
            Layer { inputs: 3, weights: draw(21), biases: draw(7) },
            Layer { inputs: 7, weights: draw(35), biases: draw(5) },
        ];
        let scaling = Scaling { centre: draw(3), half_width: vec![0.5, 1.0, 2.0] };
        DenseNetwork::new(activation, scaling, draw(3), 1.7, hidden, draw(5)).unwrap()
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for activation in [Activation::Tanh, Activation::Logistic] {
            let network = network(activation);
            let p = [0.3, -0.8, 0.5];
            let (mut gradient, mut hessian) = ([0.0; 3], [0.0; 9]);
            network.gradient_and_hessian(&p, &mut gradient, &mut hessian);
            let h = 1e-5;
            for j in 0..3 {
                let (mut up, mut down) = (p, p);
                up[j] += h;
                down[j] -= h;
                let slope = (network.value(&up) - network.value(&down)) / (2.0 * h);
                assert!((slope - gradient[j]).abs() < 1e-9);
                let (mut above, mut below) = ([0.0; 3], [0.0; 3]);
                network.gradient(&up, &mut above);
                network.gradient(&down, &mut below);
                for i in 0..3 {
                    let bend = (above[i] - below[i]) / (2.0 * h);
                    assert!((bend - hessian[i * 3 + j]).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn relu_is_refused_with_the_reason() {
        let message = "ReLU".parse::<Activation>().unwrap_err().to_string();
        assert!(message.contains("piecewise constant"), "{message}");
    }
}
