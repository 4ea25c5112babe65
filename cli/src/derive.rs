//! `coadjoint derive`: the exact series.

use clap::Args;
use coadjoint_codegen::system::Parameters;
use coadjoint_learn::ModelFile;
use coadjoint_run::series::{Expansion, json, latex, learned, text};
use coadjoint_run::{Accuracy, polynomial};

use crate::error::CliError;
use crate::named::{Names, named};
use crate::source::Input;
use crate::{load, progress};

/// Prints a series.
pub(crate) type Form = fn(&Expansion) -> String;

/// Formats of a series.
pub(crate) const FORMS: &Names<Form> = &[
    ("text", "One line per term", text),
    ("json", "One object with group, chart and S", |series| json(series) + "\n"),
    ("latex", "An aligned display", latex),
];

/// Options of `derive`.
#[derive(Args, Debug)]
pub(crate) struct DeriveOptions {
    /// The system or the model.
    #[command(flatten)]
    pub input: Input,
    /// The truncation K, odd, instead of the file's
    #[arg(long, value_name = "K")]
    pub truncation: Option<usize>,
    /// The output format; S of a model is always printed as text
    #[arg(long, value_parser = named(FORMS), default_value = "text", conflicts_with = "model")]
    pub format: Form,
}

/// Prints S₁ … S_K, or S of a model.
pub(crate) fn run(options: &DeriveOptions) -> Result<(), CliError> {
    if let Some(path) = &options.input.model {
        outln!("{}", learned(&ModelFile::load(path)?)?);
        return Ok(());
    }
    let source = options.input.source(options.truncation);
    let system = match source.truncation {
        Some(_) => load::source(&source, Parameters::Substituted)?,
        None => load::settled(&source, &Accuracy::default(), Parameters::Substituted)?.0,
    };
    let system = polynomial(
        &source.file,
        system,
        "there is no series",
        "`check` tries the laws of these steps",
    )?;
    let phase = progress::phase("deriving the series");
    let series = Expansion::derive(&source.file, system.problem)?;
    drop(phase);
    out!("{}", (options.format)(&series));
    Ok(())
}
