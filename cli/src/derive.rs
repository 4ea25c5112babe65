//! `coadjoint derive`: the exact series.

use coadjoint_codegen::system::Parameters;
use coadjoint_run::series::{Series, json, latex, text};

use crate::arguments::DeriveOptions;
use crate::error::CliError;
use crate::load;
use crate::named::Names;

/// Prints a series.
pub(crate) type Form = fn(&Series) -> String;

/// Formats of a series.
pub(crate) const FORMS: &Names<Form> = &[
    ("text", "One line per term", text),
    ("json", "One object with group, chart and S", |series| json(series) + "\n"),
    ("latex", "An aligned display", latex),
];

/// Prints S₁ … S_K.
pub(crate) fn run(options: &DeriveOptions) -> Result<(), CliError> {
    let source = &options.source;
    let system = match source.truncation {
        Some(_) => load::source(source, Parameters::Substituted)?,
        None => load::settled(source, None, Parameters::Substituted)?.0,
    };
    let series = Series::derive(&source.file, system.problem)?;
    out!("{}", (options.format)(&series));
    Ok(())
}
