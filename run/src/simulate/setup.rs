//! The settings of a run.

use std::path::Path;

use coadjoint::groups::ElementError;

use super::schedule::Schedule;
use super::times::Times;
use crate::backend::Backend;
use crate::engine::{Numbers, Restore, entries_of};
use crate::error::RunError;

/// The settings of a run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// In which steps the run reaches its end.
    pub schedule: Schedule,
    /// Whether records are wanted at all.
    pub recording: bool,
    /// Every n-th step is recorded, and the last; `None` where only the times of `at` are. Not 0.
    pub every: Option<u64>,
    /// Times recorded besides.
    pub at: Option<Times>,
    /// The backend that evaluates the programs of a step.
    pub backend: Backend,
    /// μ at the start.
    pub momentum: Vec<f64>,
    /// g at the start, row by row; the identity if it is not given.
    pub group_element: Option<Vec<Vec<f64>>>,
}

impl Setup {
    /// A run from this momentum and the identity, of which no records are kept.
    pub fn new(schedule: Schedule, momentum: Vec<f64>) -> Self {
        Self {
            schedule,
            recording: false,
            every: Some(1),
            at: None,
            backend: Backend::Auto,
            momentum,
            group_element: None,
        }
    }

    /// The state at the start, with the matrix of g, row by row.
    ///
    /// # Errors
    /// Where the matrix given is no element of the group.
    pub fn start<G: Restore>(&self, file: &Path, group: &G) -> Result<Numbers, RunError> {
        let element = match &self.group_element {
            None => group.identity(),
            Some(rows) => {
                let size = group.matrix_size();
                if rows.len() != size || rows.iter().any(|row| row.len() != size) {
                    return Err(RunError::Option(format!(
                        "the group element must be a matrix of {size} rows and columns"
                    )));
                }
                group
                    .element_from_matrix(|i, j| rows[i][j])
                    .map_err(|error| not_an_element(file, &error))?
            }
        };
        Ok(Numbers { g: entries_of(group, &element), mu: self.momentum.clone() })
    }
}

/// The error of a matrix that is no element of the group.
pub fn not_an_element(file: &Path, why: &ElementError) -> RunError {
    RunError::of(file)(format!("`group_element` in [initial]: {why}"))
}
