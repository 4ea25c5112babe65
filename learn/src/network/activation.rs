//! Smooth activations.

use std::f64::consts::LOG2_E;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

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

impl Activation {
    /// The value a = σ(z).
    #[inline(always)]
    pub(super) fn value(self, z: f64) -> f64 {
        match self {
            // 1e-16 off near zero: absolute accuracy is all a network needs.
            Self::Tanh => 1.0 - 2.0 / (exp(2.0 * z) + 1.0),
            Self::Logistic => 1.0 / (1.0 + exp(-z)),
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
        Err(LearnError::InvalidOption {
            option: "activation",
            value: name.into(),
            requirement: requirement.into(),
        })
    }
}

/// ln 2 in two parts; the first ends in zeros, so that its multiples by integers are exact.
const LN_2: (f64, f64) = (6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10);
/// Adding it rounds to an integer, which then stands in the last bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// 1/k! from k = 13 down.
const INVERSE_FACTORIALS: [f64; 14] = [
    1.605_904_383_682_161_5e-10,
    2.087_675_698_786_81e-9,
    2.505_210_838_544_172e-8,
    2.755_731_922_398_589_3e-7,
    2.755_731_922_398_589e-6,
    2.480_158_730_158_730_2e-5,
    1.984_126_984_126_984e-4,
    1.388_888_888_888_889e-3,
    8.333_333_333_333_333e-3,
    4.166_666_666_666_666_4e-2,
    1.666_666_666_666_666_6e-1,
    0.5,
    1.0,
    1.0,
];

/// eˣ to a few units in the last place, for |x| ≤ 700 (beyond, that of ±700): by arithmetic alone,
/// so that it has the same bits on every machine and compilers do several at a time.
#[inline(always)]
fn exp(x: f64) -> f64 {
    let x = x.clamp(-700.0, 700.0);
    // x = n ln 2 + r, |r| ≤ (ln 2)/2: the first term left out is below 5e-18.
    let shifted = x * LOG2_E + ROUND;
    let n = shifted - ROUND;
    let r = (x - n * LN_2.0) - n * LN_2.1;
    let sum = INVERSE_FACTORIALS.iter().fold(0.0, |sum, c| sum * r + c);
    sum * f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_agrees_with_the_standard_library() {
        for k in -70_000..=70_000 {
            let x = f64::from(k) * 9.999e-3;
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-15, "{x}");
        }
        assert_eq!(exp(0.0), 1.0);
        assert!(exp(f64::NAN).is_nan());
        assert_eq!((exp(1e300), exp(-1e300)), (exp(700.0), exp(-700.0)));
    }

    #[test]
    fn relu_is_refused_with_the_reason() {
        let message = "ReLU".parse::<Activation>().unwrap_err().to_string();
        assert!(message.contains("piecewise constant"), "{message}");
    }
}
