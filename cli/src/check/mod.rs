//! `coadjoint check`: the laws of the method, tried on this system at random points.

mod differences;
mod laws;
mod order;
mod report;

use std::path::Path;

use coadjoint::{Cayley, Chart, Exponential};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_codegen::system::{Parameters, System};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::arguments::CheckOptions;
use crate::engine::{Group, matrix_group};
use crate::error::CliError;
use crate::load;

/// The step of a file that names none.
const DEFAULT_STEP: f64 = 0.1;

/// A law and how well it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Its name.
    pub name: &'static str,
    /// What it says.
    pub statement: &'static str,
    /// What was measured: the largest relative violation, or the order of accuracy.
    pub value: f64,
    /// What it is compared with.
    pub bound: f64,
    /// Whether it holds.
    pub pass: bool,
}

/// Tries all laws, prints them, and fails if one does not hold.
pub fn run(options: &CheckOptions) -> Result<(), CliError> {
    let path = &options.source.file;
    let System { problem, run } =
        load::source(&options.source, options.truncation, Parameters::Substituted)?;
    let step = options.step.or(run.step).unwrap_or(DEFAULT_STEP);
    if step == 0.0 || !step.is_finite() {
        let what = "--step must be finite and other than zero; try --step 0.1";
        return Err(CliError::Option(what.to_owned()));
    }
    if options.points == 0 {
        return Err(CliError::Option("--points counts from 1; try --points 3".to_owned()));
    }
    let size = run.momentum.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    let group = matrix_group(path, &problem.algebra)?;
    let integrator = load::integrator(path, problem)?;
    let trial = Trial {
        integrator: &integrator,
        step,
        size: if size > 0.0 { size } else { 1.0 },
        points: options.points,
        seed: options.seed,
    };
    let laws = match integrator.problem.chart {
        lie::Chart::Exponential => trial.laws::<_, Exponential>(group)?,
        lie::Chart::Cayley => trial.laws::<_, Cayley>(cayley(path, group)?)?,
    };
    print!("{}", report::report(&trial, &laws, options.format));
    let failed: Vec<&str> = laws.iter().filter(|law| !law.pass).map(|law| law.name).collect();
    if failed.is_empty() {
        return Ok(());
    }
    Err(CliError::Laws(format!("these laws do not hold: {}", failed.join(", "))))
}

fn cayley(
    path: &Path,
    group: coadjoint::MatrixGroup,
) -> Result<coadjoint::CayleyMatrixGroup, CliError> {
    group.into_cayley().map_err(|source| CliError::Group { file: path.into(), source })
}

/// What is tried: a system, a step size, and points of a size.
#[derive(Debug)]
pub struct Trial<'a> {
    integrator: &'a Integrator,
    step: f64,
    size: f64,
    points: usize,
    seed: u64,
}

impl Trial<'_> {
    fn laws<G: Group, C: Chart<G>>(&self, group: G) -> Result<Vec<Law>, CliError> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut laws = laws::try_all::<G, C>(self, &group, &mut random)?;
        laws.push(order::measure::<G, C>(self, &group, &mut random)?);
        Ok(laws)
    }
}
