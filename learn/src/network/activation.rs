//! Smooth activations.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

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
        match self {
            Self::Tanh => {
                let a = z.tanh();
                let slope = 1.0 - a * a;
                (a, slope, -2.0 * a * slope)
            }
            Self::Logistic => {
                let a = 1.0 / (1.0 + (-z).exp());
                let slope = a * (1.0 - a);
                (a, slope, slope * (1.0 - 2.0 * a))
            }
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
