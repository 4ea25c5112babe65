//! The exact series, and how it is written.

mod json;
mod latex;
mod terms;
mod text;

use std::path::Path;

use coadjoint_codegen::hamilton_jacobi::{self, GeneratingSeries, TermLimit};
use coadjoint_codegen::problem::Problem;

use crate::error::RunError;

pub use json::series as json;
pub use latex::{polynomial as latex_polynomial, series as latex};
pub use text::{learned, polynomial, series as text, sum};

/// A system with its series.
pub struct Series {
    /// The system.
    pub problem: Problem,
    /// S₁ … S_K.
    pub series: GeneratingSeries,
}

impl Series {
    /// Derives S₁ … S_K of a system, which is called `file` in messages.
    ///
    /// # Errors
    /// Where the series is too large.
    pub fn derive(file: &Path, problem: Problem) -> Result<Self, RunError> {
        let series = hamilton_jacobi::derive(
            &problem.algebra,
            problem.chart,
            problem.generated(),
            problem.truncation,
            TermLimit::default(),
        )
        .map_err(RunError::of(file))?;
        Ok(Self { problem, series })
    }
}
