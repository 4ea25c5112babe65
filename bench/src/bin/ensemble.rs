//! Many free bodies on one core, or ours on several.

use std::{error::Error, fs, path::PathBuf};

use clap::Parser;
use coadjoint_bench::{
    ensemble::{bodies, compare, markdown, ours, peers},
    problem,
    report::Machine,
};

/// Measures nanoseconds per trajectory and unit of time for an ensemble of free bodies, interleaved.
#[derive(Parser)]
struct Arguments {
    /// How many bodies.
    #[arg(long, default_value_t = 4096)]
    bodies: usize,
    /// The end time.
    #[arg(long, default_value_t = 100.0)]
    end: f64,
    /// Rounds over all methods and settings.
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// Threads for ours; the peers take one.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Only methods whose name contains this; may be repeated.
    #[arg(long, value_name = "TEXT")]
    method: Vec<String>,
    /// Where the tables (Markdown, JSON) go; without it the table is only printed.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.bodies == 0
        || arguments.rounds == 0
        || !(arguments.end > 0.0 && arguments.end.is_finite())
    {
        return Err("--bodies, --rounds and --end must be positive".into());
    }
    rayon::ThreadPoolBuilder::new().num_threads(arguments.threads).build_global()?;
    let mut template = problem::named("free-body-a")?;
    template.end = arguments.end;
    let mut methods = ours();
    methods.extend(peers());
    if !arguments.method.is_empty() {
        methods.retain(|method| arguments.method.iter().any(|text| method.name().contains(text)));
    }
    let machine = Machine::here();
    let rows = compare(&template, &bodies(arguments.bodies), &methods, arguments.rounds)?;
    let table = markdown(&template, arguments.bodies, &machine, &rows);
    println!("{table}");
    if let Some(directory) = &arguments.out {
        fs::create_dir_all(directory)?;
        fs::write(directory.join("ensemble.md"), table)?;
        fs::write(
            directory.join("ensemble.json"),
            serde_json::to_string_pretty(&(machine, rows))?,
        )?;
    }
    Ok(())
}
