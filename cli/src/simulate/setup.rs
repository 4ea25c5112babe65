//! Where a run starts, how far it goes, and in which steps.

use std::path::{Path, PathBuf};

use coadjoint_codegen::system::Run;
use nalgebra::DVector;

use crate::arguments::SimulateOptions;
use crate::engine::Group;
use crate::error::CliError;

/// The most steps of a run: beyond, the time is surely a slip.
const MOST_STEPS: f64 = 1e12;

/// The step size h and how many steps reach the time T: of the options, else of the file.
pub fn schedule(
    file: &Path,
    step: Option<f64>,
    time: Option<f64>,
    run: &Run,
) -> Result<(f64, u64), CliError> {
    let missing =
        |key, example, option| CliError::Missing { file: file.into(), key, example, option };
    let step = step.or(run.step);
    let step = step.ok_or_else(|| missing("[integrator] step", "step = 0.1", "--step 0.1"))?;
    let time = time.or(run.time);
    let time = time.ok_or_else(|| missing("[run] time", "time = 100.0", "--time 100"))?;
    let refuse = |what: &str| Err(CliError::Option(what.to_owned()));
    if step == 0.0 || !step.is_finite() {
        return refuse("--step must be finite and other than zero; try --step 0.1");
    }
    if time <= 0.0 || !time.is_finite() {
        return refuse("--time must be finite and positive; try --time 100");
    }
    // Rounding of T/h must not add a step.
    let steps = (time / step.abs() * (1.0 - 1e-12)).ceil().max(1.0);
    if steps > MOST_STEPS {
        return refuse("more than 1e12 steps; take a larger --step or a smaller --time");
    }
    Ok((step, steps as u64))
}

/// The settings of a run, from the file and the options that replace them.
#[derive(Clone, Debug)]
pub struct Setup {
    file: PathBuf,
    /// h.
    pub step: f64,
    /// How many steps reach the time asked for.
    pub steps: u64,
    /// Every n-th step is recorded.
    pub every: u64,
    /// Whether the tail of the series is summed for the motion from the initial momentum.
    pub tuned: bool,
    /// How long the motion is followed to which the coefficients are fitted, if they are.
    pub fitted: Option<f64>,
    /// μ at the start.
    pub momentum: DVector<f64>,
    group_element: Option<Vec<Vec<f64>>>,
}

impl Setup {
    /// Puts the settings together, or says which one is missing.
    pub fn new(options: &SimulateOptions, run: &Run, dim: usize) -> Result<Self, CliError> {
        let file = options.input.source().file;
        let missing = |key, example, option| CliError::Missing {
            file: options.input.source().file,
            key,
            example,
            option,
        };
        let (step, steps) = schedule(&file, options.accuracy.step, options.time, run)?;
        let momentum = run.momentum.clone().ok_or_else(|| {
            missing("[initial] momentum", "momentum = [2.0, 0.5, 1.0]", "another file")
        })?;
        let refuse = |what: &str| Err(CliError::Option(what.to_owned()));
        let every = options.every.or(run.every).unwrap_or(1);
        if every == 0 {
            return refuse("--every counts steps from 1; try --every 1");
        }
        if momentum.len() != dim {
            return refuse("the momentum does not fit the group");
        }
        Ok(Self {
            file,
            step,
            steps,
            every: every as u64,
            tuned: options.tuned,
            fitted: options.fitted,
            momentum: DVector::from_vec(momentum),
            group_element: run.group_element.clone(),
        })
    }

    /// g at the start.
    pub fn element<G: Group>(&self, group: &G) -> Result<G::Element, CliError> {
        match &self.group_element {
            None => Ok(group.identity()),
            Some(rows) => group
                .element_from_matrix(|i, j| rows[i][j])
                .map_err(|source| CliError::Element { file: self.file.clone(), source }),
        }
    }
}
