//! `coadjoint-paper NAME`: runs experiments of the paper, prints their tables, and writes a page.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use coadjoint_paper::experiment::run;
use coadjoint_paper::outcome::{Fallible, Options, write};
use coadjoint_paper::page::page;

/// Run the experiments of the paper and print its figures beside ours
#[derive(Parser, Debug)]
#[command(name = "coadjoint-paper")]
struct Arguments {
    /// The experiment: simulation, orders, work, table-2, hamiltonian, geometrize, hamilton-jacobi, reduction-error,
    /// learned, noise, table-1, harder-truths, or all
    name: String,
    /// Fewer samples and steps, smaller networks: seconds in place of minutes
    #[arg(long)]
    quick: bool,
    /// The seed everything follows from
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write outcomes as JSON and curves as CSV to this folder; `all` goes on where it stopped
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write everything as one page: figures, tables, the numbers that judge them
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

fn main() -> ExitCode {
    match all(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", error.to_string().trim_end());
            ExitCode::FAILURE
        }
    }
}

fn all(arguments: Arguments) -> Fallible<()> {
    let Arguments { name, quick, seed, out, html } = arguments;
    // Mistakes are reported before anything is computed.
    if let Some(html) = &html {
        let file = std::fs::OpenOptions::new().append(true).create(true).open(html);
        file.map_err(|e| format!("--html {}: cannot write there: {e}", html.display()))?;
    }
    let reports = run(&name, &Options { quick, seed, out })?;
    for report in &reports {
        println!("{}", report.text());
    }
    if let Some(html) = &html {
        write(html, &page(&reports))?;
        eprintln!("{}", html.display());
    }
    Ok(())
}
