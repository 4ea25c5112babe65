//! Cost against error for ours and the peers, on every problem.

use std::{error::Error, fs, path::PathBuf};

use clap::Parser;
use coadjoint_bench::{
    measure::{Effort, work_precision},
    ours, peers,
    problem::{self, Problem},
    report::{Machine, Report, csv, diagram, markdown},
};

/// Measures every method at its best settings, interleaved, and writes tables and diagrams.
#[derive(Parser)]
struct Arguments {
    /// Few rounds: a look, not figures to keep.
    #[arg(long)]
    quick: bool,
    /// Only this problem (free-body-a, free-body-b, heavy-top, kirchhoff, kovalevskaya, kirchhoff-long,
    /// kovalevskaya-long); may be repeated.
    #[arg(long, value_name = "NAME")]
    problem: Vec<String>,
    /// Only methods whose name contains this; may be repeated.
    #[arg(long, value_name = "TEXT")]
    method: Vec<String>,
    /// Where the tables (Markdown, CSV, JSON) and diagrams (SVG) go; without it the table is only printed.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let problems: Vec<Problem> = if arguments.problem.is_empty() {
        problem::all()?
    } else {
        arguments.problem.iter().map(|name| problem::named(name)).collect::<Result<_, _>>()?
    };
    let mut methods = ours::all();
    methods.extend(peers::all());
    if !arguments.method.is_empty() {
        methods.retain(|method| arguments.method.iter().any(|text| method.name().contains(text)));
        if methods.is_empty() {
            return Err(
                format!("no method's name contains {}", arguments.method.join(" or ")).into()
            );
        }
    }
    let effort = if arguments.quick { Effort::quick() } else { Effort::full() };
    if let Some(directory) = &arguments.out {
        fs::create_dir_all(directory)?;
    }
    let machine = Machine::here();
    let mut tables = String::new();
    for problem in &problems {
        let measurements = work_precision(problem, &methods, &effort)?;
        let report = Report::new(problem, machine.clone(), measurements);
        let table = markdown(&report);
        println!("{table}");
        if let Some(directory) = &arguments.out {
            fs::write(directory.join(format!("{}.csv", problem.name)), csv(&report))?;
            fs::write(
                directory.join(format!("{}.json", problem.name)),
                serde_json::to_string_pretty(&report)?,
            )?;
            diagram(&report, &directory.join(format!("{}.svg", problem.name)))?;
        }
        tables.push_str(&table);
        tables.push('\n');
    }
    if let Some(directory) = &arguments.out {
        fs::write(directory.join("work-precision.md"), tables)?;
    }
    Ok(())
}
