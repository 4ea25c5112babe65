//! Smooth activations.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::error::LearnError;

/// An activation with a continuous second derivative: the data fit the gradient of S, and the step needs its Hessian.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Activation {
    /// The hyperbolic tangent tanh z.
    #[default]
    Tanh,
    /// The logistic function 1/(1 + e⁻ᶻ).
    Logistic,
}

impl Activation {
    /// The value a = σ(z).
    #[inline(always)]
    pub(super) fn value(self, z: f64) -> f64 {
        match self {
            // By `libm`, which has the same bits on every machine. 1e-16 off near zero: a network needs absolute
            // accuracy only.
            Self::Tanh => 1.0 - 2.0 / (libm::exp(2.0 * z) + 1.0),
            Self::Logistic => 1.0 / (1.0 + libm::exp(-z)),
        }
    }

    /// The derivative σ′, given the value a.
    #[inline(always)]
    pub(super) fn slope(self, a: f64) -> f64 {
        match self {
            Self::Tanh => 1.0 - a * a,
            Self::Logistic => a * (1.0 - a),
        }
    }

    /// The second derivative σ″, given the value a.
    #[inline(always)]
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
        Err(LearnError::option("activation", name, requirement))
    }
}
