//! The cost of a step, and the cost of other methods for the same error.
//!
//! `cargo run --release -p coadjoint-bench -- step|backends|ensembles|work|lattice`

// Indices name components as in the formulas; iterators over three arrays at once would hide them.
#![allow(clippy::needless_range_loop)]

mod command;
mod lattice;
mod systems;
mod timing;
mod work;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use timing::{Failure, machine};

/// Measures steps by the attribute, from files, and against peers; every row is one interleaved run.
#[derive(Parser)]
#[command(name = "coadjoint-bench")]
struct Opts {
    #[command(subcommand)]
    table: Benchmark,
}

#[derive(Subcommand)]
enum Benchmark {
    /// Nanoseconds a step of six systems by the attribute: `advance`, `advance_by`, and lanes
    Step(Common),
    /// The systems by the command, `simulate --backend …`, beside `advance`
    Backends(FromFile),
    /// 100 000 trajectories on one core, by the attribute in lanes and by the command's `ensemble`
    Ensembles(FromFile),
    /// The cheapest time for an error, beside DOP853, DMV10 and the exact solution; of Hamiltonians that are no polynomials,
    /// beside DOP853
    Work(Work),
    /// Spins on a cubic lattice beside the classical Runge–Kutta method and the spherical midpoint rule: `--only` hot, cold, laws, sizes
    Lattice(Common),
}

#[derive(Args)]
struct Common {
    /// Few rounds: a look, not figures to keep
    #[arg(long)]
    quick: bool,
    /// Only systems whose name contains this
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
}

#[derive(Args)]
struct FromFile {
    #[command(flatten)]
    common: Common,
    /// The command; by default the one beside this program
    #[arg(long, value_name = "FILE")]
    command: Option<PathBuf>,
    /// Back ends of the command
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "c")]
    backend: Vec<String>,
    /// A device for `ensembles`: opencl, cuda, cuda:1, …
    #[arg(long, value_name = "DEVICE")]
    device: Option<String>,
}

#[derive(Args)]
struct Work {
    #[command(flatten)]
    common: Common,
    /// Only methods whose name contains this
    #[arg(long, value_name = "TEXT", default_value = "")]
    method: String,
}

fn run(table: &Benchmark) -> Result<(), Failure> {
    println!("{}\n", machine());
    match table {
        Benchmark::Step(common) => systems::table(common.quick, &common.only),
        Benchmark::Backends(given) => {
            let command = command::find(given.command.as_ref())?;
            command::single(&command, &given.backend, given.common.quick, &given.common.only)
        }
        Benchmark::Ensembles(given) => {
            let command = command::find(given.command.as_ref())?;
            let mut ways: Vec<Vec<String>> =
                given.backend.iter().map(|name| vec!["--backend".into(), name.clone()]).collect();
            for precision in given.device.iter().flat_map(|_| ["double", "single"]) {
                let device = given.device.clone().unwrap_or_default();
                ways.push(vec!["--device".into(), device, "--precision".into(), precision.into()]);
            }
            command::ensembles(&command, &ways, given.common.quick, &given.common.only)
        }
        Benchmark::Lattice(common) => lattice::tables(common.quick, &common.only),
        Benchmark::Work(Work { common, method }) => {
            work::tables(common.quick, &common.only, method)
        }
    }
}

fn main() -> ExitCode {
    match run(&Opts::parse().table) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
