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
    /// The hyperbolic tangent tanh z.
    #[default]
    Tanh,
    /// The logistic function 1/(1 + e⁻ᶻ).
    Logistic,
}

/// An activation as a type.
pub(super) trait Curve {
    /// The value a = σ(z).
    fn value(z: f64) -> f64;
    /// The derivative σ′, given the value a.
    fn slope(a: f64) -> f64;
    /// The second derivative σ″, given the value a.
    fn bend(a: f64) -> f64;
}

pub(super) struct Tanh;

impl Curve for Tanh {
    #[inline(always)]
    fn value(z: f64) -> f64 {
        // 1e-16 off near zero: absolute accuracy is all a network needs.
        1.0 - 2.0 / (exp(2.0 * z) + 1.0)
    }

    #[inline(always)]
    fn slope(a: f64) -> f64 {
        1.0 - a * a
    }

    #[inline(always)]
    fn bend(a: f64) -> f64 {
        -2.0 * a * (1.0 - a * a)
    }
}

pub(super) struct Logistic;

impl Curve for Logistic {
    #[inline(always)]
    fn value(z: f64) -> f64 {
        1.0 / (1.0 + exp(-z))
    }

    #[inline(always)]
    fn slope(a: f64) -> f64 {
        a * (1.0 - a)
    }

    #[inline(always)]
    fn bend(a: f64) -> f64 {
        a * (1.0 - a) * (1.0 - 2.0 * a)
    }
}

impl Activation {
    /// σ(z), σ′(z), σ″(z).
    #[must_use]
    pub fn derivatives(self, z: f64) -> (f64, f64, f64) {
        fn of<C: Curve>(z: f64) -> (f64, f64, f64) {
            let a = C::value(z);
            (a, C::slope(a), C::bend(a))
        }
        match self {
            Self::Tanh => of::<Tanh>(z),
            Self::Logistic => of::<Logistic>(z),
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
