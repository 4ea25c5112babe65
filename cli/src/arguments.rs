//! The command line itself.

use std::path::PathBuf;

use clap::error::{ContextKind, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand};
use coadjoint_codegen::lie::Chart;
use coadjoint_native::cards::Device;
use coadjoint_program::Precision;
use coadjoint_run::Backend;

use crate::derive::DeriveOptions;
use crate::ensemble::Shard;
use crate::learn::LearnOptions;
use crate::named::{BACKENDS, CHARTS, FORMATS, Format, LANGUAGES, PRECISIONS, Target, named};
use crate::reproduce::ReproduceOptions;
use crate::source::{Accuracy, Input, Source};

/// Momentum-preserving integrators from a Hamiltonian.
///
/// FILE is a system file in TOML: a Hamiltonian, a group, and a run. Exit codes: 0 success,
/// 1 a failure while running, 2 bad input, 3 not verified, 130 interrupted.
#[derive(Debug, Parser)]
#[command(name = "coadjoint", version)]
pub(crate) struct Arguments {
    /// The verb to run.
    #[command(subcommand)]
    pub verb: Verb,
}

/// Options of earlier versions.
const REMOVED: [&str; 2] = ["--tuned", "--fitted"];

/// The arguments of this process; ends it with a message where they make no sense.
pub(crate) fn parse() -> Arguments {
    Arguments::try_parse().unwrap_or_else(|error| {
        let unknown = error.get(ContextKind::InvalidArg).map(ToString::to_string);
        match REMOVED.iter().find(|name| unknown.as_deref() == Some(name)) {
            Some(name) => {
                let message = format!(
                    "{name} was removed: for a smaller error at the same step give a larger --truncation, or write \
                     frame = \"comoving\" under [integrator] in the system file"
                );
                Arguments::command().error(ErrorKind::UnknownArgument, message).exit()
            }
            None => error.exit(),
        }
    })
}

/// The verb to run.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Print the exact series S₁ … S_K of the generating function, or S of a learned polynomial
    Derive(DeriveOptions),
    /// Write the integrator as code: Rust, C, C++, OpenCL or CUDA
    Emit(EmitOptions),
    /// Run the system and report the drifts of momentum, Casimirs and energy
    #[command(
        after_help = "The format of FILE is described in docs/book/src/file-format.md; `coadjoint groups` lists groups."
    )]
    Simulate(SimulateOptions),
    /// Advance many states at once, from a file to a file
    Ensemble(EnsembleOptions),
    /// Test the conservation laws and the order of the steps on this system, at random momenta
    Check(CheckOptions),
    /// Verify the output of simulate or ensemble, step by step in doubled precision
    Verify(VerifyOptions),
    /// Find the polynomial Casimirs of the system's algebra
    Casimirs(CasimirOptions),
    /// List the groups that have a name, or print basis, brackets, Casimirs and charts of one
    Groups(GroupOptions),
    /// Learn the map behind pairs of states
    Learn(LearnOptions),
    /// Name the program that runs the experiments of the paper
    Reproduce(ReproduceOptions),
}

/// Options of `emit`.
#[derive(Args, Debug)]
pub(crate) struct EmitOptions {
    /// The system or the model.
    #[command(flatten)]
    pub input: Input,
    /// The truncation K, odd, instead of the file's
    #[arg(long, value_name = "K")]
    pub truncation: Option<usize>,
    /// Write to this file instead of the standard output
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Keep the parameters as arguments of the integrator instead of putting in their values; in Rust, C and C++
    #[arg(long)]
    pub keep_parameters: bool,
    /// The language to write
    #[arg(long, value_parser = named(LANGUAGES), default_value = "rust")]
    pub language: Target,
    /// The prefix of all names in C and C++; from the system's name if not given
    #[arg(long, value_name = "NAME")]
    pub prefix: Option<String>,
    /// The step size h of a kernel in OpenCL or CUDA, instead of the file's. Other languages take h when the integrator is
    /// constructed
    #[arg(long, value_name = "h", allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// The precision of a kernel in OpenCL or CUDA
    #[arg(long, value_parser = named(PRECISIONS), default_value = "double")]
    pub precision: Precision,
}

/// Options of `simulate`.
#[derive(Args, Debug)]
pub(crate) struct SimulateOptions {
    /// The system or the model.
    #[command(flatten)]
    pub input: Input,
    /// The truncation K, odd; several, such as 3,5,7, run one after the other
    #[arg(long, value_name = "K", value_delimiter = ',')]
    pub truncation: Vec<usize>,
    /// The step, or the tolerance.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// The duration T
    #[arg(long, value_name = "T")]
    pub time: Option<f64>,
    /// The initial time; by default the file's, or 0
    #[arg(long, value_name = "t0", allow_negative_numbers = true, conflicts_with = "model")]
    pub t0: Option<f64>,
    /// The initial momentum of a learned model, separated by commas
    #[arg(long, value_name = "mu", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(requires = "model")]
    pub start: Vec<f64>,
    /// Record every n-th step, and the last
    #[arg(long, value_name = "n")]
    pub every: Option<usize>,
    /// Record these times within the run, separated by commas or in a file; with --every, also every n-th step
    #[arg(long, value_name = "TIMES", allow_hyphen_values = true)]
    #[arg(requires = "out", conflicts_with = "model")]
    pub at: Option<String>,
    /// End the run where this function of the coordinates, `g[i][j]` and t changes sign
    #[arg(long, value_name = "FUNCTION", allow_hyphen_values = true, conflicts_with = "model")]
    pub until: Option<String>,
    /// Write the records to this .csv or .npy file as they are made (- for the standard output).
    /// Until the run is complete the file is named FILE.partial
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write the spins of a lattice at the end to this .npy file, an array (sites, 3)
    #[arg(long = "final", value_name = "FILE")]
    pub last: Option<PathBuf>,
    /// Keep the state in this file, so that the same command resumes a run that was stopped
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Seconds between two checkpoints
    #[arg(long, value_name = "SECONDS", default_value_t = 20.0)]
    pub checkpoint_interval: f64,
    /// Draw the drift of energy, momentum and Casimirs
    #[arg(long, value_name = "SVG", conflicts_with = "model")]
    pub plot: Option<PathBuf>,
    /// Skip the estimate of the error at the end, which takes about half as long as the run
    #[arg(long)]
    pub no_estimate: bool,
    /// The backend that evaluates the steps
    #[arg(long, value_parser = named(BACKENDS), default_value = "auto", conflicts_with = "model")]
    pub backend: Backend,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    pub format: Format,
}

/// Options of `ensemble`.
#[derive(Args, Debug)]
pub(crate) struct EnsembleOptions {
    /// The system or the model.
    #[command(flatten)]
    pub input: Input,
    /// The truncation K, odd, instead of the file's
    #[arg(long, value_name = "K")]
    pub truncation: Option<usize>,
    /// The initial states, .csv, .npy or .parquet: columns mu_1 … mu_n, and optionally the attitude,
    /// g_11 … g_dd or q_w, q_x, q_y, q_z
    #[arg(long, value_name = "FILE")]
    pub initial: PathBuf,
    /// Write the final states, in the same columns, to this .csv, .npy or .parquet file. A row that
    /// fails is NaN and is listed in FILE.rejected.csv
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// The step, or the tolerance.
    #[command(flatten)]
    pub accuracy: Accuracy,
    /// The duration T
    #[arg(long, value_name = "T")]
    pub time: Option<f64>,
    /// The initial time; by default the file's, or 0
    #[arg(long, value_name = "t0", allow_negative_numbers = true, conflicts_with = "model")]
    pub t0: Option<f64>,
    /// Write the states at these times (given as in simulate's --at) instead of the final ones: to .npy as an array of rows,
    /// times and columns, to .parquet as a line for each row and time
    #[arg(long, value_name = "TIMES", allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["device", "model"])]
    pub at: Option<String>,
    /// Estimate the error at the end of n rows, evenly spread, as simulate does for its run
    #[arg(long, value_name = "n", value_parser = clap::value_parser!(u64).range(1..))]
    #[arg(conflicts_with = "model")]
    pub estimate: Option<u64>,
    /// Advance only share i of n of the rows, i from 1 to n: for job arrays
    #[arg(long, value_name = "i/n", default_value_t = Shard::WHOLE)]
    pub shard: Shard,
    /// The backend that evaluates the steps
    #[arg(long, value_parser = named(BACKENDS), default_value = "auto")]
    pub backend: Backend,
    /// Make the steps on a device: opencl, opencl:N, cuda or cuda:N. Steps that it refuses are made by --backend
    #[arg(long, value_name = "DEVICE")]
    pub device: Option<Device>,
    /// The precision of the device's numbers
    #[arg(long, value_parser = named(PRECISIONS), default_value = "double", requires = "device")]
    pub precision: Precision,
    /// The number of threads; all processors if not given. It does not change the result
    #[arg(long, value_name = "n")]
    pub threads: Option<usize>,
    /// Start over instead of resuming an earlier run that was stopped
    #[arg(long)]
    pub restart: bool,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    pub format: Format,
}

/// Options of `verify`.
#[derive(Args, Debug)]
pub(crate) struct VerifyOptions {
    /// The system file and the output, .csv, .npy, .parquet or the .json report of simulate; the output
    /// alone if it names its system. Exit code 1: a row is wrong; 3: a row could not be judged
    #[arg(value_name = "FILE", num_args = 1..=2, required = true)]
    pub files: Vec<PathBuf>,
    /// The initial states of the ensemble
    #[arg(long, value_name = "STATES", requires = "steps")]
    pub input: Option<PathBuf>,
    /// The number of steps that the ensemble made
    #[arg(long, value_name = "n", requires = "input")]
    pub steps: Option<u64>,
    /// Judge only n rows, evenly spread over the file; the report says so
    #[arg(long, value_name = "n", value_parser = clap::value_parser!(u64).range(1..))]
    pub sample: Option<u64>,
    /// The initial time of the ensemble; by default the file's, or 0
    #[arg(long, value_name = "t0", allow_negative_numbers = true, requires = "input")]
    pub t0: Option<f64>,
    /// The step size h, if the output does not give it
    #[arg(long, value_name = "h", allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// The truncation K, if the output does not give it
    #[arg(long, value_name = "K")]
    pub truncation: Option<usize>,
    /// The chart, if the output does not give it
    #[arg(long, value_parser = named(CHARTS))]
    pub chart: Option<Chart>,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    pub format: Format,
}

/// Options of `check`.
#[derive(Args, Debug)]
pub(crate) struct CheckOptions {
    /// The system.
    #[command(flatten)]
    pub source: Source,
    /// The step size h; by default the file's, or 0.1
    #[arg(long, value_name = "h", allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// The initial time; by default the file's, or 0
    #[arg(long, value_name = "t0", allow_negative_numbers = true)]
    pub t0: Option<f64>,
    /// The number of random momenta
    #[arg(long, value_name = "n", default_value_t = 3)]
    pub points: usize,
    /// The seed of the random momenta
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    pub format: Format,
}

/// Options of `casimirs`.
#[derive(Args, Debug)]
pub(crate) struct CasimirOptions {
    /// The system file
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The highest degree to search
    #[arg(long, value_name = "d", default_value_t = 3)]
    pub degree: u32,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    pub format: Format,
}

/// Options of `groups`.
#[derive(Args, Debug)]
pub(crate) struct GroupOptions {
    /// A group or a product of groups, such as SO3, "SO3^4" or "SO3 |x R3"; all names if not given
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
    /// The highest degree of Casimirs to search; by default as high as is quick, 4 at most
    #[arg(long, value_name = "d", default_value_t = 0, hide_default_value = true)]
    pub degree: u32,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    pub format: Format,
}
