//! A run: flows, or flows and kicks, from the initial state to the end.

use std::cell::RefCell;

use coadjoint::{
    Chart, GeneratingFunction, Phase, StepError, solve::Solution, solve::solve, steps::reconstruct,
    tune::fit,
};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_program::Trajectories;
use nalgebra::DVector;

use super::header::Header;
use super::march::{Made, March, Stepper, each};
use super::number::largest;
use super::setup::Setup;
use super::subject::Subject;
use super::trajectory::{Trajectory, Watched};
use super::warning::Warning;
use crate::engine::{Compiled, Energy, Forces, Interpreter, Numbers, Restore, Steepness, advise};
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
        let problem = &self.integrator.problem;
        let (algebra, coordinates) = (&problem.algebra, problem.coordinates.as_slice());
        Watched { algebra, coordinates, energy: Some(self.energy), attitude: true, symmetries }
    }

    /// The run as its driver knows it.
    fn subject(&self, warnings: Vec<Warning>) -> Subject<'a> {
        warnings.iter().for_each(|warning| eprintln!("warning: {}", warning.text()));
        Subject {
            setup: self.setup,
            label: self.label(),
            header: self.header(),
            truncation: Some(self.integrator.problem.truncation),
            watched: self.watched(),
            warnings,
        }
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
    pub fn integrate<G: Restore, C: Chart<G>>(&self, group: &G) -> Result<Trajectory, CliError> {
        match self.forces {
            Some(forces) => self.kicked::<G, C>(group, forces),
            None => self.flow::<G, C>(group),
        }
    }

    /// Flows and kicks.
    fn kicked<G: Restore, C: Chart<G>>(
        &self,
        group: &G,
        forces: &Forces,
    ) -> Result<Trajectory, CliError> {
        let h = self.setup.schedule.step;
        let make = |h| forces.step::<G, C>(self.integrator, group, h);
        let step = make(h).map_err(at_start)?;
        let longest = h * forces.longest_flow();
        let flow = Interpreter::<G, C>::new(self.integrator, group.clone(), longest);
        let flow = flow.map_err(at_start)?;
        let steepness = Steepness::new(&flow);
        let subject = self.subject(Vec::new());
        March { subject: &subject, group }.run(&Stepper {
            steps: &each(&self.setup.schedule, |time, phase| {
                step(phase, time).map_err(|error| {
                    let works = |h| make(h).is_ok_and(|s| s(&mut phase.clone(), time).is_ok());
                    advise(error, h, works)
                })?;
                Ok(Made { solve: None })
            }),
            side: &|time, part, phase| make(part)?(phase, time),
            ratio: &|mu| steepness.ratio(mu),
            kept: None,
        })
    }

    /// The flow alone.
    fn flow<G: Restore, C: Chart<G>>(&self, group: &G) -> Result<Trajectory, CliError> {
        let Setup { schedule, tuned, fitted, momentum, .. } = self.setup;
        let h = schedule.step;
        let series = |h| Interpreter::<G, C>::new(self.integrator, group.clone(), h);
        let mut warnings = Vec::new();
        let step = match fitted {
            Some(duration) => {
                let _phase = progress::phase("fitting the coefficients to the motion");
                let fit = fit(h, series, [momentum.clone()], *duration);
                let fit = fit.map_err(|error| CliError::Option(format!("--fitted: {error}")))?;
                // What is no number is not better either.
                if !fit.unseen.lt(&fit.before) {
                    warnings.push(Warning::FellBack { option: "--fitted" });
                }
                fit.integrator
            }
            None if *tuned => {
                let _phase = progress::phase("summing the tail of the series");
                let tuned = Interpreter::tuned(self.integrator, group.clone(), h, momentum);
                let (step, tail) = tuned.map_err(at_start)?;
                if tail.is_plain() {
                    warnings.push(Warning::FellBack { option: "--tuned" });
                }
                step
            }
            None => series(h).map_err(at_start)?,
        };
        let count = if *tuned || fitted.is_some() { SIDE_STEPS } else { 1 };
        let steepness = Steepness::new(&step);
        let subject = self.subject(warnings);
        let one = |step: &Interpreter<'_, G, C>, phase: &mut Phase<G>| {
            let solution = solve(step, &phase.momentum)?;
            let residual = residual(step, &phase.momentum, &solution);
            reconstruct(step, phase, &solution.x)?;
            Ok((solution, residual))
        };
        let side = |_: f64, part: f64, phase: &mut Phase<G>| {
            let step = series(part / f64::from(count))?;
            (0..count).try_for_each(|_| one(&step, phase).map(drop))
        };
        let advised = |error, phase: &Phase<G>| {
            advise(error, h, |h| series(h).is_ok_and(|step| one(&step, &mut phase.clone()).is_ok()))
        };
        let (backend, steps) = (self.setup.backend, schedule.steps as f64);
        let Some(compiled) = Compiled::new(&step, backend, steps, Trajectories::One)? else {
            return March { subject: &subject, group }.run(&Stepper {
                steps: &each(schedule, |_, phase| {
                    let (solution, residual) =
                        one(&step, phase).map_err(|error| advised(error, phase))?;
                    Ok(Made { solve: Some((solution.iterations, residual)) })
                }),
                side: &side,
                ratio: &|mu| steepness.ratio(mu),
                kept: None,
            });
        };
        let kept = RefCell::new(None);
        let trajectory = March { subject: &subject, group }.run(&Stepper {
            steps: &|_, phase, count| {
                let mut kept = kept.borrow_mut();
                let numbers = kept.get_or_insert_with(|| compiled.numbers(group, phase));
                let rescue = |numbers: &mut Numbers| compiled.rescue(&step, numbers);
                let made = compiled.advance(numbers, count, rescue);
                *phase = compiled.phase(group, numbers);
                let made = made.map_err(|(done, error)| (done, advised(error, phase)))?;
                // A bound, which may be far below what rounding leaves.
                Ok(Made { solve: Some((made.corrections, made.residual.max(f64::EPSILON))) })
            },
            side: &side,
            ratio: &|mu| steepness.ratio(mu),
            kept: Some(&kept),
        })?;
        Ok(Trajectory { backend: Some(compiled.code().used()), ..trajectory })
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
