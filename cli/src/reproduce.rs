//! `coadjoint reproduce`: the experiments of the paper.

use std::path::PathBuf;

use clap::Args;
use coadjoint_learn::experiment::{self, RunOptions};

use crate::arguments::Format;
use crate::error::CliError;

/// Options of `reproduce`.
#[derive(Args, Debug)]
pub struct ReproduceOptions {
    /// The experiment: simulation, table-1, noise, table-2, hamiltonian, geometrize,
    /// hamilton-jacobi, reduction-error, harder-truths, or all
    #[arg(value_name = "NAME")]
    name: String,
    /// Fewer samples and steps, smaller networks: seconds in place of minutes
    #[arg(long)]
    quick: bool,
    /// The seed everything follows from
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the report as JSON and the curves as CSV to this folder; `all` goes on where it
    /// stopped
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// Runs the experiments.
pub fn run(options: &ReproduceOptions) -> Result<(), CliError> {
    let settings =
        RunOptions { quick: options.quick, seed: options.seed, out: options.out.clone() };
    let reports = experiment::run(&options.name, &settings, &mut |line| eprintln!("{line}"))?;
    match options.format {
        Format::Text => {
            for report in &reports {
                outln!("{}", report.text());
            }
        }
        Format::Json => {
            let text = serde_json::to_string_pretty(&reports)
                .map_err(|e| CliError::Option(format!("the report cannot be printed: {e}")))?;
            outln!("{text}");
        }
    }
    Ok(())
}
