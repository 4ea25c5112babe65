//! A run: flows, or flows and kicks, from the initial state to the end.

use coadjoint::{
    Chart, GeneratingFunction, StepError, solve::Solution, solve::solve, steps::reconstruct,
    tune::fit,
};
use coadjoint_codegen::integrator::Integrator;
use nalgebra::DVector;

use super::header::Header;
use super::march::{March, Stepper};
use super::number::largest;
use super::restore::Restore;
use super::setup::Setup;
use super::trajectory::{Trajectory, Watched};
use crate::engine::{Energy, Forces, Interpreter};
use crate::error::CliError;
use crate::progress;

/// A step between grid points is made in so many where S was adjusted to the step of the grid: the plain
/// series is then no less accurate.
const SIDE_STEPS: u32 = 8;

/// What is run.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The flow.
    pub integrator: &'a Integrator,
    /// The kicks.
    pub forces: Option<&'a Forces>,
    /// The energy of both.
    pub energy: &'a Energy,
    /// From where, how far, in which steps.
    pub setup: &'a Setup,
}

impl<'a> Task<'a> {
    /// What is watched.
    pub fn watched(&self) -> Watched<'a> {
        let symmetries = self.forces.map(|forces| forces.symmetries.as_slice());
        Watched { energy: self.energy, symmetries }
    }

    /// What the run is.
    pub fn header(&self) -> Header {
        let splitting = self.forces.map(|forces| forces.splitting);
        Header::new(self.setup, &self.integrator.problem, splitting)
    }

    /// What makes the run, in a few words.
    pub fn label(&self) -> String {
        let (setup, problem) = (self.setup, &self.integrator.problem);
        let mut label = format!("K = {}, {}", problem.truncation, problem.chart);
        if problem.comoving.is_some() {
            label.push_str(", comoving");
        }
        if setup.tuned {
            label.push_str(", tuned");
        }
        if setup.fitted.is_some() {
            label.push_str(", fitted");
        }
        if let Some(forces) = self.forces {
            label = format!("{label}, {}", forces.splitting.name());
        }
        label
    }

    /// Advances from the initial state to the end.
    pub fn integrate<G: Restore, C: Chart<G>>(&self, group: G) -> Result<Trajectory, CliError> {
        let h = self.setup.schedule.step;
        if let Some(forces) = self.forces {
            let step = forces.step::<G, C>(self.integrator, &group, h).map_err(at_start)?;
            return March { task: self, group: &group }.run(&Stepper {
                step: &|time, phase| step(phase, time).map(|()| None),
                side: &|time, part, phase| {
                    forces.step::<G, C>(self.integrator, &group, part)?(phase, time)
                },
            });
        }
        self.flow::<G, C>(group)
    }

    /// The flow alone.
    fn flow<G: Restore, C: Chart<G>>(&self, group: G) -> Result<Trajectory, CliError> {
        let Setup { schedule, tuned, fitted, momentum, .. } = self.setup;
        let h = schedule.step;
        let series = |h| Interpreter::<G, C>::new(self.integrator, group.clone(), h);
        let step = match fitted {
            Some(duration) => {
                let _phase = progress::phase("fitting the coefficients to the motion");
                let fit = fit(h, series, [momentum.clone()], *duration);
                fit.map_err(|error| CliError::Option(format!("--fitted: {error}")))?.integrator
            }
            None if *tuned => {
                let _phase = progress::phase("summing the tail of the series");
                Interpreter::tuned(self.integrator, group.clone(), h, momentum).map_err(at_start)?
            }
            None => series(h).map_err(at_start)?,
        };
        let count = if *tuned || fitted.is_some() { SIDE_STEPS } else { 1 };
        March { task: self, group: &group }.run(&Stepper {
            step: &|_, phase| {
                let solution = solve(&step, &phase.momentum)?;
                let residual = residual(&step, &phase.momentum, &solution);
                reconstruct(&step, phase, &solution.x)?;
                Ok(Some((solution.iterations, residual)))
            },
            side: &|_, part, phase| {
                let step = series(part / f64::from(count))?;
                for _ in 0..count {
                    let solution = solve(&step, &phase.momentum)?;
                    reconstruct(&step, phase, &solution.x)?;
                }
                Ok(())
            },
        })
    }
}

fn at_start(source: StepError) -> CliError {
    CliError::Step { time: 0.0, source }
}

/// What the solve leaves of J_L(x, p) = μ, relative to the largest coordinate of μ: measured, where
/// the step itself reports an estimate. NaN where anything is NaN.
fn residual<G: Restore, C: Chart<G>>(
    step: &Interpreter<'_, G, C>,
    mu: &DVector<f64>,
    solution: &Solution<DVector<f64>, f64>,
) -> f64 {
    let reached = C::default().left_momentum(step.group(), &solution.x, &solution.p);
    let left = largest((reached - mu).iter().copied());
    let size = largest(mu.iter().copied());
    if size == 0.0 { left } else { left / size }
}
