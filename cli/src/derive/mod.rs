//! `coadjoint derive`: the exact series.

mod coefficient;
mod json;
mod latex;
mod text;

use coadjoint_codegen::hamilton_jacobi::{self, GeneratingSeries, TermLimit};
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::system::Parameters;

use crate::arguments::{DeriveOptions, SeriesFormat};
use crate::error::CliError;
use crate::load;

pub use text::polynomial;

/// Prints S₁ … S_K.
pub fn run(options: &DeriveOptions) -> Result<(), CliError> {
    let system = load::source(&options.source, options.truncation, Parameters::Substituted)?;
    let problem = system.problem;
    let series = hamilton_jacobi::derive(
        &problem.algebra,
        problem.chart,
        problem.generated(),
        problem.truncation,
        TermLimit::default(),
    )
    .map_err(|source| CliError::Derive { file: options.source.file.clone(), source })?;
    let derived = Derived { problem, series };
    match options.format {
        SeriesFormat::Text => out!("{}", text::series(&derived)),
        SeriesFormat::Json => outln!("{}", json::series(&derived)),
        SeriesFormat::Latex => out!("{}", latex::series(&derived)),
    }
    Ok(())
}

/// A system with its series.
pub struct Derived {
    /// The system.
    pub problem: Problem,
    /// S₁ … S_K.
    pub series: GeneratingSeries,
}
