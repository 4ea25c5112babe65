//! The settings of a trial.

use coadjoint_codegen::system::Run;

use crate::asked::Accuracy;
use crate::error::RunError;

/// The step of a system that names none.
const DEFAULT_STEP: f64 = 0.1;

/// A trial: a step size, and random points.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The time from which steps are made.
    pub start: f64,
    /// The step size.
    pub step: f64,
    /// The momentum that the run of the file starts from; without one each coordinate of a point is between −1 and 1.
    pub about: Option<Vec<f64>>,
    /// The group element there, row by row; the identity if it is not given.
    pub element: Option<Vec<Vec<f64>>>,
    /// The length of that run.
    pub time: Option<f64>,
    /// The number of points.
    pub points: usize,
    /// The seed of the points.
    pub seed: u64,
}

impl Trial {
    /// With this step and from this time, else those of the system, and points near its run.
    ///
    /// # Errors
    /// A setting makes no sense; the error names it.
    pub fn new(asked: &Accuracy, run: &Run, points: usize, seed: u64) -> Result<Self, RunError> {
        let (start, step) = (asked.start(run), asked.step.or(run.step));
        let step = step.unwrap_or(DEFAULT_STEP);
        if step == 0.0 || !step.is_finite() {
            let what = "--step must be finite and other than zero; try --step 0.1";
            return Err(RunError::Option(what.to_owned()));
        }
        if points == 0 {
            return Err(RunError::Option("--points counts from 1; try --points 3".to_owned()));
        }
        let about = run.momentum.clone().filter(|mu| mu.iter().any(|x| *x != 0.0));
        let (element, time) = (run.group_element.clone(), run.time);
        Ok(Self { start, step, about, element, time, points, seed })
    }

    /// The points in words.
    pub fn place(&self) -> &'static str {
        match self.about {
            Some(_) => "near the run of the file",
            None => "with coordinates from -1 to 1",
        }
    }
}
