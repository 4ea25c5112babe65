//! `coadjoint derive`: the exact series.

use clap::Args;
use coadjoint_codegen::system::Parameters;
use coadjoint_run::series::{Series, json, latex, text};

use crate::error::CliError;
use crate::load;
use crate::named::{Names, named};
use crate::source::Source;

/// Prints a series.
pub(crate) type Form = fn(&Series) -> String;

/// Formats of a series.
pub(crate) const FORMS: &Names<Form> = &[
    ("text", "One line per term", text),
    ("json", "One object with group, chart and S", |series| json(series) + "\n"),
    ("latex", "An aligned display", latex),
];

/// Options of `derive`.
#[derive(Args, Debug)]
pub(crate) struct DeriveOptions {
    /// The system.
    #[command(flatten)]
    pub source: Source,
    /// How to print
    #[arg(long, value_parser = named(FORMS), default_value = "text")]
    pub format: Form,
}

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
