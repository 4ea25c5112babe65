//! Arguments that name a system and what replaces its settings.

use std::path::PathBuf;

use clap::Args;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::problem::{Method, Solver};
use coadjoint_codegen::system::{Options, Parameters};

use crate::named::{CHARTS, METHODS, SOLVERS, named};

/// Settings that replace those of a system file.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct Instead {
    /// The chart, instead of the file's
    #[arg(long, value_parser = named(CHARTS))]
    pub chart: Option<Chart>,
    /// The solver of each step, instead of the file's
    #[arg(long, value_parser = named(SOLVERS))]
    pub solver: Option<Solver>,
    /// The method of the steps, instead of the file's
    #[arg(long, value_parser = named(METHODS))]
    pub method: Option<Method>,
}

/// A system file, with settings that replace its own.
#[derive(Args, Clone, Debug)]
pub(crate) struct Source {
    /// The system file
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Settings that replace the file's.
    #[command(flatten)]
    pub instead: Instead,
    /// The truncation K, odd, instead of the file's
    #[arg(long, value_name = "K")]
    pub truncation: Option<usize>,
}

impl Source {
    /// The options of reading the file.
    pub(crate) fn options(&self, parameters: Parameters) -> Options {
        let Instead { chart, solver, method } = self.instead;
        let truncation = self.truncation;
        Options { parameters, truncation, chart, solver, method, frame: None }
    }
}

/// A system file, or a learned model.
#[derive(Args, Debug)]
pub(crate) struct Input {
    /// The system file
    #[arg(value_name = "FILE", required_unless_present = "model")]
    pub file: Option<PathBuf>,
    /// Settings that replace the file's.
    #[command(flatten)]
    pub instead: Instead,
    /// A model learned by `coadjoint learn`, instead of a system file
    #[arg(long, value_name = "MODEL", conflicts_with_all = ["file", "chart", "solver", "method", "truncation"])]
    pub model: Option<PathBuf>,
}

impl Input {
    /// The system file; clap has seen to it that there is one without a model.
    pub(crate) fn source(&self, truncation: Option<usize>) -> Source {
        let file = self.file.clone().unwrap_or_default();
        Source { file, instead: self.instead, truncation }
    }
}

/// A step size, or the tolerance by which one is chosen.
#[derive(Args, Clone, Debug)]
pub(crate) struct Accuracy {
    /// The step size h
    #[arg(long, value_name = "h", allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// Choose the step, and the truncation if none is given, for this error at the end of the run
    #[arg(long, value_name = "error", conflicts_with = "step")]
    pub tolerance: Option<f64>,
    /// Meet the tolerance for all momenta up to this norm; by default along the run
    #[arg(long, value_name = "radius")]
    pub region: Option<f64>,
}

impl Accuracy {
    /// The settings of a run with this truncation, start and duration, as far as the command line gives them.
    pub(crate) fn of_run(
        &self,
        truncation: Option<usize>,
        t0: Option<f64>,
        time: Option<f64>,
    ) -> coadjoint_run::Accuracy {
        let Self { step, tolerance, region } = *self;
        let comoving = None;
        coadjoint_run::Accuracy { step, tolerance, region, truncation, t0, time, comoving }
    }
}
