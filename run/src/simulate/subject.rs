//! The subject of a run, whatever makes its steps.

use std::path::Path;

use super::recorder::Watched;
use super::setup::Setup;
use super::warning::Warning;

/// A run as its driver knows it: of a system, or of a learned map.
#[derive(Clone)]
pub struct Subject<'a> {
    /// The name of the system in messages.
    pub file: &'a Path,
    /// From where, how far, in which steps.
    pub setup: &'a Setup,
    /// The quantities watched.
    pub watched: Watched<'a>,
    /// Warnings known before the first step.
    pub warnings: Vec<Warning>,
}
