//! `coadjoint reproduce`: names the program that has its place.

use clap::Args;

use crate::error::CliError;

/// Whatever was asked of the verb.
#[derive(Args, Debug)]
pub(crate) struct ReproduceOptions {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<String>,
}

/// Refuses, with the command to use.
pub(crate) fn run(options: &ReproduceOptions) -> Result<(), CliError> {
    let rest = if options.rest.is_empty() {
        "all --quick --html report.html".into()
    } else {
        options.rest.join(" ")
    };
    Err(CliError::Option(format!(
        "the experiments of the paper are a program of their own: in a clone of the repository, run `cargo run --release -p coadjoint-paper -- {rest}`"
    )))
}
