//! Warnings about a run that went to its end.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::engine::STEEP;
use crate::number::shortest;

/// Where the last two terms of the series came near to each other first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Steep {
    /// The number of the step, from 1.
    pub step: u64,
    /// The time from which it went.
    pub time: f64,
    /// The ratio of S_K to S_{K−2}, in their gradients.
    pub ratio: f64,
}

/// A warning about a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// The series hardly converges.
    Steep(Steep),
    /// A map learned from momenta alone moves no attitude.
    NoAttitude,
}

impl Warning {
    /// For people.
    pub fn text(&self) -> String {
        match self {
            Self::Steep(Steep { step, time, ratio }) => format!(
                "the series hardly converges: from step {step}, at time {}, its terms have the ratio \
                 {ratio:.3}, above {STEEP}; the motion may be inaccurate: take a smaller step",
                shortest(*time)
            ),
            Self::NoAttitude => {
                "learned from momenta alone: the attitude is not known and not written, since the \
                                 data leave it open up to a rotation about the momentum"
                    .to_owned()
            }
        }
    }

    /// For programs.
    pub fn object(&self) -> Value {
        match self {
            Self::Steep(Steep { step, time, ratio }) => json!({
                "kind": "series_ratio",
                "step": step,
                "time": time,
                "ratio": ratio,
                "text": self.text(),
            }),
            Self::NoAttitude => json!({ "kind": "no_attitude", "text": self.text() }),
        }
    }
}
