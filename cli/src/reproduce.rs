//! `coadjoint reproduce`: the experiments of the paper, as tables, curves, and one page.

use std::path::{Path, PathBuf};

use clap::Args;
use coadjoint_draw::run::Picture;
use coadjoint_learn::experiment::{self, RunOptions};
use coadjoint_report::{Page, page, read_benchmarks};

use crate::arguments::Format;
use crate::error::CliError;
use crate::{progress, simulate};

/// Options of `reproduce`.
#[derive(Args, Debug)]
pub struct ReproduceOptions {
    /// The experiment: simulation, orders, work, table-2, hamiltonian, geometrize, hamilton-jacobi,
    /// reduction-error, learned, noise, table-1, harder-truths, or all
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
    /// Write everything as one page: figures, tables, the numbers that judge them
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// The system files of the page's gallery; with `all` those in examples, if there is such a folder
    #[arg(long, value_name = "DIR", requires = "html")]
    gallery: Option<PathBuf>,
    /// Show what the benchmark wrote to this folder: coadjoint-bench work --out DIR
    #[arg(long, value_name = "DIR", requires = "html")]
    work_precision: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// Runs the experiments.
pub fn run(options: &ReproduceOptions) -> Result<(), CliError> {
    // What can be refused is, before anything is computed.
    if let Some(html) = &options.html {
        writable(html)?;
    }
    let benchmarks = match &options.work_precision {
        Some(folder) => read_benchmarks(folder).map_err(|e| CliError::Option(e.to_string()))?,
        None => Vec::new(),
    };
    // Seconds, and mistakes in system files are seen before minutes have passed.
    let gallery = pictures(&systems(options)?)?;
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
    let Some(html) = &options.html else { return Ok(()) };
    write(html, &page(&Page { reports, gallery, benchmarks }))?;
    eprintln!("{}", html.display());
    Ok(())
}

/// The system files of the gallery, by their names.
fn systems(options: &ReproduceOptions) -> Result<Vec<PathBuf>, CliError> {
    let folder = match &options.gallery {
        Some(folder) => folder.clone(),
        None if options.html.is_none() || options.name != "all" => return Ok(Vec::new()),
        None if Path::new("examples").is_dir() => PathBuf::from("examples"),
        None => {
            eprintln!("no folder examples here: the page has no gallery (--gallery DIR)");
            return Ok(Vec::new());
        }
    };
    let fail = |source| CliError::Read { path: folder.clone(), source };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            files.push(path);
        }
    }
    if files.is_empty() {
        let what = format!("--gallery {}: no file NAME.toml in it", folder.display());
        return Err(CliError::Option(what));
    }
    files.sort();
    Ok(files)
}

/// Runs the systems of the gallery.
fn pictures(systems: &[PathBuf]) -> Result<Vec<Picture>, CliError> {
    let count = systems.len();
    let one = |(i, file): (usize, &PathBuf)| {
        eprintln!("gallery, {} of {count}: {}", i + 1, file.display());
        let _phase = progress::phase("running");
        simulate::pictured(file)
    };
    systems.iter().enumerate().map(one).collect()
}

/// Refuses a page that cannot be written where it is asked for.
fn writable(html: &Path) -> Result<(), CliError> {
    let folder = html.parent().filter(|folder| !folder.as_os_str().is_empty());
    let refuse = |why: &str| Err(CliError::Option(format!("--html {}: {why}", html.display())));
    match folder {
        Some(folder) if !folder.is_dir() => refuse("there is no such folder; make it first"),
        _ if html.is_dir() => refuse("this is a folder; give the name of a file"),
        _ => Ok(()),
    }
}

fn write(path: &Path, text: &str) -> Result<(), CliError> {
    std::fs::write(path, text)
        .map_err(|error| CliError::Write { path: path.to_owned(), message: error.to_string() })
}
