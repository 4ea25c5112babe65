//! The measurements of a run: at a moment, and the largest so far.

use coadjoint_codegen::step::Drift;
use serde::{Deserialize, Serialize};

use super::warning::Steep;

/// The measurements at a moment.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// H_red(μ), plus V(g) where there is a potential; none where no energy is known.
    pub energy: Option<f64>,
    /// The differences at this moment.
    pub drift: Drift,
}

/// The solves of a run.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Solver {
    /// The most Newton iterations, or evaluations of the fixed point, of a step.
    pub most_iterations: u64,
    /// The largest residual left, relative to the momentum.
    pub max_residual: f64,
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
pub struct Tally {
    /// The largest drifts.
    #[serde(with = "DriftFields")]
    pub drift: Drift,
    /// From these times on drifts cannot be measured: of the spatial momentum, the Casimirs, the energy.
    pub unmeasured: [Option<f64>; 3],
    /// How the solves went, where residuals were measured.
    pub solver: Option<Solver>,
    /// The first step before which the last terms of the series had a ratio worth a warning.
    pub steep: Option<Steep>,
}
