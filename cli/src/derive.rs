//! `coadjoint derive`: the exact series.

use coadjoint_codegen::system::Parameters;
use coadjoint_run::series::{Series, json, latex, text};

use crate::arguments::{DeriveOptions, SeriesFormat};
use crate::error::CliError;
use crate::load;

/// Prints S₁ … S_K.
pub fn run(options: &DeriveOptions) -> Result<(), CliError> {
    let (system, _) = match options.truncation {
        Some(_) => {
            (load::source(&options.source, options.truncation, Parameters::Substituted)?, None)
        }
        None => load::settled(&options.source, None, None, Parameters::Substituted)?,
    };
    let series = Series::derive(&options.source.file, system.problem)?;
    match options.format {
        SeriesFormat::Text => out!("{}", text(&series)),
        SeriesFormat::Json => outln!("{}", json(&series)),
        SeriesFormat::Latex => out!("{}", latex(&series)),
    }
    Ok(())
}
