//! `coadjoint-paper NAME`: runs experiments of the paper, prints their tables, and writes a page.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use coadjoint_paper::experiment::run;
use coadjoint_paper::outcome::{Config, Fallible, files, write};
use coadjoint_paper::{gallery, page};

/// Run the experiments of the paper and print its figures beside ours
#[derive(Parser, Debug)]
#[command(name = "coadjoint-paper")]
struct Invocation {
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
    /// The system files of the page's gallery; with `all` those in examples, if there is such a folder
    #[arg(long, value_name = "DIR", requires = "html")]
    gallery: Option<PathBuf>,
}

fn main() -> ExitCode {
    match all(Invocation::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", error.to_string().trim_end());
            ExitCode::FAILURE
        }
    }
}

fn all(arguments: Invocation) -> Fallible<()> {
    let Invocation { name, quick, seed, out, html, gallery } = arguments;
    // Mistakes are reported before anything is computed; the gallery takes seconds.
    if let Some(html) = &html {
        let file = std::fs::OpenOptions::new().append(true).create(true).open(html);
        file.map_err(|e| format!("--html {}: cannot write there: {e}", html.display()))?;
    }
    let examples = Path::new("examples");
    let mut systems = Vec::new();
    if let Some(folder) = &gallery {
        systems = files(folder, "toml")?;
        if systems.is_empty() {
            return Err(format!("--gallery {}: no file NAME.toml in it", folder.display()).into());
        }
    } else if html.is_some() && name == "all" {
        if examples.is_dir() {
            systems = files(examples, "toml")?;
        } else {
            eprintln!("no folder examples here: the page has no gallery (--gallery DIR)");
        }
    }
    let mut pictures = Vec::new();
    for (i, file) in systems.iter().enumerate() {
        eprintln!("gallery, {} of {}: {}", i + 1, systems.len(), file.display());
        pictures.push(gallery::picture(file)?);
    }
    let reports = run(&name, &Config { quick, seed, out })?;
    for report in &reports {
        println!("{}", report.text());
    }
    if let Some(html) = &html {
        write(html, &page::page(&reports, &pictures))?;
        eprintln!("{}", html.display());
    }
    Ok(())
}
