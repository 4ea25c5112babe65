//! Judges trajectories and ensembles afterwards, step by step in doubled precision.
// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod follow;
mod found;
mod invariants;
mod record;
mod twins;

use std::path::Path;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::problem::Problem;

use crate::error::RunError;

pub use follow::{Follower, Sample};
pub use found::Found;
pub use invariants::Invariants;
pub use record::Columns;

/// Rows that are judged, and what is said of them.
pub trait Rows {
    /// Why a row cannot be read.
    type Error: From<RunError>;

    /// The next row, if there is one.
    ///
    /// # Errors
    /// Where it cannot be read.
    fn next_row(&mut self) -> Result<Option<Vec<f64>>, Self::Error>;

    /// The entry of this name.
    fn value(&self, name: &str) -> Option<&str>;

    /// The numbers that are said under this name.
    fn numbers(&self, name: &str) -> Option<Vec<f64>>;
}

/// Derives the exact judge of a problem, which is called `file` in messages.
///
/// # Errors
/// Where the series is too large.
pub fn judge_of(file: &Path, problem: &Problem) -> Result<Judge, RunError> {
    Judge::of_problem(problem, TermLimit::default())
        .map_err(|error| RunError::Option(format!("{}: {error}", file.display())))
}

/// A follower of a motion in steps of this size, by the judge.
///
/// # Errors
/// Where the step makes no sense.
pub fn follower<'a>(
    judge: &'a Judge,
    problem: &Problem,
    step: f64,
) -> Result<Follower<'a>, RunError> {
    if step == 0.0 || !step.is_finite() {
        return Err(RunError::Option("--step must be finite and other than zero".into()));
    }
    // Parameters are substituted; what symbols are left (sqrt(2)) need none.
    let symbols = problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect();
    Follower::new(judge, Invariants::new(problem), step, symbols)
}
