//! What is run, whatever makes its steps.

use super::header::Header;
use super::setup::Setup;
use super::trajectory::Watched;
use super::warning::Warning;

/// A run as its driver knows it: of a system, or of a learned map.
#[derive(Clone)]
pub struct Subject<'a> {
    /// From where, how far, in which steps.
    pub setup: &'a Setup,
    /// What makes the run, in a few words.
    pub label: String,
    /// What the run is.
    pub header: Header,
    /// K, where S is a truncated series.
    pub truncation: Option<usize>,
    /// What is watched.
    pub watched: Watched<'a>,
    /// What is known to be worth telling before the first step.
    pub warnings: Vec<Warning>,
}
