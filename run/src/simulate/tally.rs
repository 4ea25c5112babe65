//! The measurements of a run: at a moment, the largest so far, and warnings that follow from them.

use coadjoint_codegen::step::Drift;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::engine::{Observed, STEEP};
use crate::number::{brief, shortest};

/// The measurements at a moment.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// H_red(μ), plus V(g) where there is a potential; none where no energy is known.
    pub energy: Option<f64>,
    /// The differences at this moment.
    pub drift: Drift,
}

/// A state that was measured: the first of those observed.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    pub moment: Moment,
    pub observed: Observed,
}

/// The solves of a run.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Effort {
    /// The most Newton iterations, or evaluations of the fixed point, of a step.
    pub most_iterations: u64,
    /// The largest residual left, relative to the momentum.
    pub max_residual: f64,
    /// The steps that the programs refused and the generic solver made, which takes hundreds of times as long.
    #[serde(default)]
    pub rescued: u64,
}

/// The fields of a [`Drift`], for `#[serde(with = "DriftFields")]`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Drift")]
pub struct DriftFields {
    spatial_momentum: Option<f64>,
    casimirs: Option<f64>,
    energy: Option<f64>,
}

/// The maxima and sums so far. Numbers in files are decimals that read back as the same numbers.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Tally {
    /// The largest drifts.
    #[serde(with = "DriftFields")]
    pub drift: Drift,
    /// From these times on drifts cannot be measured: of the spatial momentum, the Casimirs, the energy.
    pub unmeasured: [Option<f64>; 3],
    /// Statistics of the solves, if residuals were measured.
    pub solver: Option<Effort>,
    /// The first step before which the last terms of the series had a ratio worth a warning.
    pub steep: Option<Steep>,
}

/// The first step at which the last two terms of the series came near to each other.
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
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Warning {
    /// The series hardly converges.
    #[serde(rename = "series_ratio")]
    Steep(Steep),
    /// A map learned from momenta alone moves no attitude.
    NoAttitude,
    /// The series gave way to collocation, for this reason.
    Method {
        /// The reason, for people.
        #[serde(skip)]
        text: String,
    },
    /// A velocity or a torque has a kink.
    Kink {
        /// The expressions that have one.
        expressions: String,
    },
    /// The error estimated at the end is large.
    #[serde(rename = "estimated_error")]
    Inaccurate {
        /// The estimate.
        error: f64,
    },
    /// A quantity that the symmetry conserves has moved by more than rounding explains.
    Drift {
        /// Its name.
        quantity: &'static str,
        /// The largest drift, relative.
        drift: f64,
        /// The drift that rounding explains.
        bound: f64,
    },
    /// Many steps were made by the generic solver, which takes hundreds of times as long as the programs that refused them.
    #[serde(rename = "slow_steps")]
    Slow {
        /// Such steps.
        rescued: u64,
        /// All steps.
        steps: u64,
        /// A smaller step, with which the programs make all steps of the run; none where none was found.
        #[serde(skip_serializing_if = "Option::is_none")]
        step: Option<f64>,
    },
    /// The error estimated at the end is above the tolerance asked for.
    AboveTolerance {
        /// The estimate.
        error: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// Runs in steps of other sizes end elsewhere.
    Unresolved {
        /// Until this time they go together.
        #[serde(rename = "trusted_until")]
        until: f64,
    },
    /// An event that was to end the run did not occur.
    NoEvent {
        /// Its name.
        #[serde(rename = "event")]
        name: String,
        /// The values of its function at the start and at the end.
        values: [f64; 2],
    },
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
                "learned from momenta alone: the attitude is not known and not written, \
                since the data leave it open up to a rotation about the momentum"
                    .to_owned()
            }
            Self::Method { text } => text.clone(),
            Self::Kink { expressions } => format!(
                "a kink where the argument is zero, of {expressions}: a step across it is less accurate than the order says, as the \
                 estimate shows"
            ),
            Self::Inaccurate { error } => format!(
                "the error at the end is about {:.0} %: take a smaller step or a larger truncation",
                error * 100.0
            ),
            Self::Drift { quantity, drift, bound } => format!(
                "the {quantity} drifted by {drift:.1e}, relatively, where rounding explains {bound:.1e}: every step \
                 should conserve it, so the end may be wrong; take a smaller step, and please report it"
            ),
            Self::Slow { rescued, steps, step } => {
                let share = 100.0 * *rescued as f64 / (*steps).max(1) as f64;
                let advice = match step {
                    Some(step) => format!("a step of {} avoids it", shortest(*step)),
                    None => "a smaller step may avoid it".to_owned(),
                };
                format!(
                    "{rescued} of {steps} steps ({share:.0} %) are too long for the compiled step, and the generic solver made \
                     them, which takes far longer: {advice}"
                )
            }
            Self::AboveTolerance { error, tolerance } => format!(
                "the error at the end is about {error:.1e}, above the tolerance {tolerance:e}: give a smaller step"
            ),
            Self::Unresolved { until } => format!(
                "the end is not resolved: runs in steps of other sizes end elsewhere, and go with this one until time {}; \
                 take a smaller step, a larger truncation or a shorter run",
                brief(*until)
            ),
            Self::NoEvent { name, values: [start, end] } => format!(
                "the event `{name}` did not occur; its function was {} at the start and is {} at the end",
                shortest(*start),
                shortest(*end)
            ),
        }
    }

    /// For programs: its kind, its numbers, and the text for people.
    pub fn object(&self) -> Value {
        let mut object = json!(self);
        object["text"] = json!(self.text());
        object
    }
}
