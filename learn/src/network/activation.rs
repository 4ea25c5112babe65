//! Smooth activations.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::exponential::exp;
use crate::error::LearnError;

/// An activation with a continuous second derivative: the map needs the Hessian of S, and the
/// data fit its gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Activation {
    /// tanh z.
    #[default]
    Tanh,
    /// The logistic function 1/(1 + e⁻ᶻ).
    Logistic,
}

impl Activation {
    /// σ(z), σ′(z), σ″(z).
    #[must_use]
    pub fn derivatives(self, z: f64) -> (f64, f64, f64) {
        let mut value = [z];
        self.apply(&mut value);
        (value[0], self.slope(value[0]), self.bend(value[0]))
    }

    /// Puts σ(z) in the place of every z.
    pub(super) fn apply(self, values: &mut [f64]) {
        match self {
            // 1e-16 off near zero: absolute accuracy is all a network needs.
            Self::Tanh => values.iter_mut().for_each(|z| *z = 1.0 - 2.0 / (exp(2.0 * *z) + 1.0)),
            Self::Logistic => values.iter_mut().for_each(|z| *z = 1.0 / (1.0 + exp(-*z))),
        }
    }

    /// σ′ where σ is a.
    #[inline]
    pub(super) fn slope(self, a: f64) -> f64 {
        match self {
            Self::Tanh => 1.0 - a * a,
            Self::Logistic => a * (1.0 - a),
        }
    }

    /// σ″ where σ is a.
    #[inline]
    pub(super) fn bend(self, a: f64) -> f64 {
        match self {
            Self::Tanh => -2.0 * a * (1.0 - a * a),
            Self::Logistic => a * (1.0 - a) * (1.0 - 2.0 * a),
        }
    }
}

impl FromStr for Activation {
    type Err = LearnError;

    fn from_str(name: &str) -> Result<Self, LearnError> {
        let requirement = match name.to_ascii_lowercase().as_str() {
            "tanh" => return Ok(Self::Tanh),
            "logistic" | "sigmoid" => return Ok(Self::Logistic),
            "relu" | "leaky_relu" | "leaky-relu" => {
                "a network of this activation is piecewise linear, so its gradient, which is what \
                 the data fit, is piecewise constant, and its Hessian, which the step needs, is \
                 zero; use tanh or logistic"
            }
            _ => "use tanh or logistic",
        };
        Err(LearnError::InvalidOption {
            option: "activation",
            value: name.into(),
            requirement: requirement.into(),
        })
    }
}
