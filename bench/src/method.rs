//! What a row of the comparison is: a method, its settings and its runs.

use crate::{problem::Problem, state::State};

/// The one number by which a run of a method is made more or less accurate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// A fixed step, in the problem's unit of time; shortened so that whole steps reach the end.
    Step(f64),
    /// A tolerance of an adaptive method, relative and absolute.
    Tolerance(f64),
}

impl Setting {
    /// The number of equal steps and their length over `[0, end]`.
    #[must_use]
    pub fn steps(step: f64, end: f64) -> (usize, f64) {
        let count = (end / step).round().max(1.0) as usize;
        (count, end / count as f64)
    }

    /// The step, for a method that takes no tolerance.
    ///
    /// # Errors
    /// [`RunError::Setting`] in the name of `method` for a tolerance.
    pub fn fixed_step(self, method: &str) -> Result<f64, RunError> {
        match self {
            Self::Step(step) => Ok(step),
            given @ Self::Tolerance(_) => {
                Err(RunError::Setting { method: method.to_owned(), wanted: "a step", given })
            }
        }
    }
}

impl std::fmt::Display for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Step(h) => write!(f, "h = {h:.4}"),
            Self::Tolerance(tolerance) => write!(f, "tol = {tolerance:.1e}"),
        }
    }
}

/// Why a run gave no end state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The method does not solve such problems.
    #[error("{method} does not apply to {problem}")]
    NotApplicable {
        /// The method.
        method: String,
        /// The problem.
        problem: String,
    },
    /// The method takes the other kind of setting.
    #[error("{method} takes {wanted}, not {given}")]
    Setting {
        /// The method.
        method: String,
        /// `a step` or `a tolerance`.
        wanted: &'static str,
        /// What was given.
        given: Setting,
    },
    /// An implicit equation was not solved, or an adaptive step became too small.
    #[error("no convergence; take a smaller step")]
    NotConverged,
    /// A crate's own error.
    #[error("{0}")]
    Foreign(String),
}

/// A row of the comparison. Ours and the peers implement it alike.
pub trait Method {
    /// Its name, unique among the methods.
    fn name(&self) -> &str;

    /// The name under which its kin are drawn as one curve.
    fn family(&self) -> &str;

    /// The order of accuracy that the tests verify; `None` for the exact solution.
    fn order(&self) -> Option<u32>;

    /// Whether it solves this problem.
    fn applies(&self, problem: &Problem) -> bool;

    /// The settings to try, from the cheapest to the most accurate.
    fn settings(&self, problem: &Problem) -> Vec<Setting>;

    /// Integrates from the initial state to the end.
    ///
    /// # Errors
    /// When the method does not apply, or the setting is of the other kind or too coarse.
    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError>;
}

/// Steps from four times the problem's scale of time down, by factors 2^(−1/4).
#[must_use]
pub fn step_sweep(problem: &Problem) -> Vec<Setting> {
    step_sweep_about(problem.time_scale)
}

/// Steps from four times a scale of time down, by factors 2^(−1/8): finer than the differences that count, or
/// luck would decide them.
#[must_use]
pub fn step_sweep_about(time_scale: f64) -> Vec<Setting> {
    (-16..88).map(|k| Setting::Step(time_scale * 2f64.powf(-f64::from(k) / 8.0))).collect()
}

/// Tolerances from 1e−3 down to 1e−16, eight to a decade.
#[must_use]
pub fn tolerance_sweep() -> Vec<Setting> {
    (24..=128).map(|k| Setting::Tolerance(10f64.powf(-f64::from(k) / 8.0))).collect()
}
