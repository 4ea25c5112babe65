//! A run that has ended, for reports and pictures.

use std::path::PathBuf;

use coadjoint_run::simulate::{Drift, DriftFields, Outcome};
use serde::{Deserialize, Serialize};

use super::header::Header;

/// A moment kept for pictures.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub(crate) struct Record {
    /// t.
    pub time: f64,
    /// μ.
    pub momentum: Vec<f64>,
    /// The largest differences since the record before.
    #[serde(with = "DriftFields")]
    pub drift: Drift,
}

/// A whole run.
#[derive(Clone, Debug)]
pub(crate) struct Trajectory {
    /// The method, for tables and pictures.
    pub label: String,
    /// The description of the run.
    pub header: Header,
    /// K; `None` for a method beside ours.
    pub truncation: Option<usize>,
    /// Names of the momentum's coordinates.
    pub coordinates: Vec<String>,
    /// A bounded choice of the moments of the run, the start first and the end last; empty where no picture is
    /// asked for.
    pub records: Vec<Record>,
    /// A line about the step, where another was used than was asked for.
    pub announcement: Option<String>,
    /// The end, and the maxima over all steps.
    pub outcome: Outcome,
    /// The file with the records, and how many there are.
    pub out: Option<(PathBuf, u64)>,
}
