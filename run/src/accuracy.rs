//! From a tolerance to a truncation and a step.

use std::path::Path;

use coadjoint::StepError;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::in_other_frame;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::system::Run;
use coadjoint_codegen::tolerance::{self, Choice, Region, Target};

use crate::asked::Accuracy;
use crate::engine::{Motion, Numbers, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::{Derived, System};
use crate::simulate::estimate_from;

/// Where a truncation is picked, series may become this large.
const AFFORDABLE: TermLimit = TermLimit { terms: 20_000, products: 2_000_000 };

/// Picks truncation, step and, where the system leaves the choice, frame where a tolerance is asked for, by the settings
/// or in the text, and puts them into the system; what was picked. Parameters that are kept have the values of the text for
/// that, in a frame that there is for all values.
///
/// # Errors
/// Where nothing can be picked.
pub fn meet_tolerance(
    path: &Path,
    system: &mut System,
    asked: &Accuracy,
) -> Result<Option<Choice>, RunError> {
    let System { problem, potential, damping, run, .. } = &mut *system;
    if let Hamiltonian::Polynomial(problem, _) = problem
        && let Some(other) =
            in_other_frame(problem).filter(|other| asked.comoving == Some(other.comoving.is_some()))
    {
        **problem = other;
    }
    let replaced = asked.tolerance.is_none() && asked.step.is_some();
    let Some(tolerance) = asked.tolerance.or(run.tolerance).filter(|_| !replaced) else {
        return Ok(None);
    };
    let what = match (potential, damping) {
        (Some(_), _) => "the kicks of a potential",
        (None, Some(_)) => "damping",
        (None, None) => "",
    };
    if !what.is_empty() {
        let what = format!("a tolerance says nothing of {what}: give the step instead");
        return Err(RunError::Option(what));
    }
    let duration = asked.time.or(run.time).ok_or_else(|| RunError::no_time(path))?;
    let target = Target {
        tolerance,
        duration,
        start: run.momentum.clone(),
        region: asked.region.map(Region::Ball).or_else(|| run.region.clone()),
        truncation: asked.truncation.or(run.truncation),
    };
    let mut choice = None;
    if let Hamiltonian::Polynomial(own, open) = problem {
        match by_series(own, &target) {
            Ok((chosen, found)) => {
                **own = chosen;
                choice = Some(found);
            }
            Err(error) if error.is_of_size() && open.is_some() => {}
            Err(error) => return Err(RunError::of(path)(error)),
        }
        let open = open.clone();
        let kept =
            choice.is_some() && matches!(problem.clone().settled().0, Hamiltonian::Polynomial(..));
        if let Some(open) = open.filter(|_| !kept) {
            *problem = Hamiltonian::Smooth(open);
            choice = None;
        }
    }
    let choice = match choice {
        Some(choice) => choice,
        None => {
            let choice = by_running(path, system, asked.start(&system.run), &target)?;
            system.problem.set_truncation(choice.truncation);
            choice
        }
    };
    system.run = Run { step: Some(choice.step), ..system.run.clone() };
    Ok(Some(choice))
}

/// The choice for a polynomial: of the frames that the system leaves the choice of, the one in which steps are cheaper.
fn by_series(
    problem: &Problem,
    target: &Target,
) -> Result<(Problem, Choice), tolerance::ToleranceError> {
    let choose = |problem: Problem| {
        let choice = tolerance::choose(&problem.with_defaults(), target, AFFORDABLE);
        choice.map(|choice| (Problem { truncation: choice.truncation, ..problem }, choice))
    };
    match (choose(problem.clone()), in_other_frame(problem).map(choose)) {
        (Ok(one), Some(Ok(other))) if one.1.operations <= other.1.operations => Ok(one),
        (_, Some(Ok(other))) => Ok(other),
        (one, _) => one,
    }
}

/// The nodes of collocation that are tried.
const NODES: std::ops::RangeInclusive<usize> = 2..=8;
/// The share of the tolerance that the estimate may use up.
const SAFETY: f64 = 0.5;
/// The runs that are tried for each number of nodes.
const TRIALS: usize = 14;
/// The starts in a region, at which errors are estimated.
const STARTS: usize = 6;
/// Steps by which sweeps are counted.
const COUNTED: u32 = 24;

/// The choice for collocation, where no series says how large its errors are. They are estimated as those of a run are, by
/// steps of another size beside it, and follow h^(2m); from m nodes on, m + 1 are taken as long as they need fewer gradients
/// per unit time.
fn by_running(path: &Path, system: &System, t0: f64, target: &Target) -> Result<Choice, RunError> {
    let facts = system.problem.facts();
    let dim = facts.algebra.dim();
    target.check(dim).map_err(RunError::of(path))?;
    let inside = target.region.as_ref().map(|region| region.points(dim, STARTS));
    let starts: Vec<Vec<f64>> =
        target.start.iter().cloned().chain(inside.into_iter().flatten()).collect();
    let size = |mu: &Vec<f64>| mu.iter().map(|x| x * x).sum::<f64>().sqrt();
    let radius = starts.iter().map(size).fold(0.0, f64::max);
    let nodes = target.truncation.map_or(NODES, |k| k.div_ceil(2)..=k.div_ceil(2));
    let mut best: Option<Choice> = None;
    let mut first = target.duration;
    for m in nodes {
        let mut system = system.clone();
        system.problem.set_truncation(2 * m - 1);
        let derived = Derived::of_file(path, system)?;
        let trial = Trial { derived: &derived, starts: &starts, t0, duration: target.duration };
        let Some((step, error)) = trial.step(first, SAFETY * target.tolerance) else { continue };
        // More nodes allow at least this step.
        first = step;
        let operations = m as f64 * trial.sweeps(step) / step;
        if best.as_ref().is_some_and(|best| best.operations <= operations) {
            break;
        }
        best = Some(Choice {
            tolerance: target.tolerance,
            truncation: 2 * m - 1,
            comoving: false,
            step,
            next_term: None,
            error,
            region: target.region.clone().unwrap_or(Region::Ball(radius)),
            along_run: target.region.is_none(),
            operations,
        });
    }
    best.ok_or_else(|| {
        RunError::Option(format!(
            "{}: no step was found that meets the tolerance {:e} over {}: ask for a larger tolerance or a shorter run, or give \
             truncation and step instead, and see with `check` what they are worth",
            path.display(),
            target.tolerance,
            target.duration
        ))
    })
}

/// Runs by which a step is picked.
struct Trial<'a> {
    derived: &'a Derived,
    starts: &'a [Vec<f64>],
    t0: f64,
    duration: f64,
}

impl Trial<'_> {
    /// The largest step found that divides the duration with an error of at most `goal`, and the error.
    fn step(&self, first: f64, goal: f64) -> Option<(f64, f64)> {
        let power = 1.0 / f64::from(self.derived.order());
        let (mut found, mut next, mut most) = (None, first, self.duration);
        for _ in 0..TRIALS {
            let step = self.duration / (self.duration / next).ceil();
            match self.error(step) {
                Some(error) if error <= goal => {
                    found = Some((step, error));
                    if error > 0.1 * goal || step > 0.8 * most {
                        break;
                    }
                    let larger = (0.5 * goal / error).powf(power).min(4.0);
                    next = f64::min(step * larger, 0.9 * most);
                }
                Some(error) => {
                    most = most.min(step);
                    next = step * (0.5 * goal / error).powf(power).clamp(0.02, 0.9);
                }
                None => {
                    most = most.min(step);
                    next = 0.4 * step;
                }
            }
        }
        found
    }

    /// The largest error of the starts at the end; none where steps are refused.
    fn error(&self, step: f64) -> Option<f64> {
        let mut worst = 0.0;
        for start in self.starts {
            let error = estimate_from(
                |size| self.motion(size),
                &self.state(start, step).ok()?,
                (step, self.duration),
                self.derived.order(),
            );
            worst = f64::max(worst, error.ok()?);
        }
        Some(worst)
    }

    /// Steps of this size.
    fn motion(&self, step: f64) -> Result<Box<dyn Motion + '_>, StepError> {
        Ok(self.derived.steps(Grid { start: self.t0, step }, None)?)
    }

    /// The state with this momentum at the identity.
    fn state(&self, mu: &[f64], step: f64) -> Result<Numbers, StepError> {
        let motion = self.motion(step)?;
        let space = motion.space();
        Ok(Numbers { g: space.numbers(&identity(space.size())), mu: mu.to_vec() })
    }

    /// The mean number of sweeps of a step.
    fn sweeps(&self, step: f64) -> f64 {
        let mut sum = 0;
        for start in self.starts {
            let made = (self.motion(step), self.state(start, step));
            let (Ok(motion), Ok(mut state)) = made else { continue };
            for number in 0..2 * COUNTED {
                let made = motion.advance(&mut state, number.into(), 1).ok().flatten();
                // The first steps have no steps before them to go by.
                sum += made.filter(|_| number >= COUNTED).map_or(0, |made| made.iterations);
            }
        }
        f64::from(sum) / f64::from(COUNTED) / self.starts.len() as f64
    }
}
