//! From a tolerance to a truncation and a step.

use std::path::Path;
use std::sync::Arc;

use coadjoint::StepError;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::in_other_frame;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::system::Run;
use coadjoint_codegen::tolerance::{self, Choice, Region, Target};
use coadjoint_program::Trajectories;

use crate::asked::Accuracy;
use crate::backend::Backend;
use crate::engine::{Compiled, Motion, Numbers, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::{Derived, System};
use crate::simulate::error_of;

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
        Some(choice) => verified(path, system, asked.start(&system.run), &target, choice)?,
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

/// The nodes of collocation that are tried: more and more from the first on, or less and less.
const NODES: [&[usize]; 2] = [&[4, 6, 8], &[3, 2]];
/// The share of the tolerance that the estimate may use up.
const SAFETY: f64 = 0.5;
/// The runs that are tried for each number of nodes.
const TRIALS: usize = 30;
/// The most steps of a run that is tried: a minute for a small system.
const MOST_STEPS: f64 = 2e7;
/// A step is confirmed by one that is longer by this factor, at most this many times.
const CONFIRMING: f64 = 0.93;
const CONFIRMED: usize = 6;
/// The fewest steps of a run whose equations depend on the time: no pulse of half a step's width is passed over.
const SEEN: f64 = 512.0;
/// The starts in a region, at which errors are estimated.
const STARTS: usize = 6;
/// Steps by which sweeps are counted.
const COUNTED: u32 = 24;
/// Steps of the runs that are tried, about, for which it pays to compile.
const MANY: f64 = 1e6;

/// The choice for a series after runs with it: where the error estimated over the whole run is above the tolerance, or a step is
/// refused on the way, with a smaller step.
fn verified(
    path: &Path,
    system: &System,
    t0: f64,
    target: &Target,
    choice: Choice,
) -> Result<Choice, RunError> {
    let derived = Derived::of_file(path, system.clone())?;
    let trial = Trial::new(&derived, t0, target);
    let (step, error) =
        trial.step(choice.step, target.tolerance, false).ok_or_else(|| unmet(path, target))?;
    let shorter = step / choice.step;
    let next_term = choice.next_term.map(|term| term * shorter.powi(choice.truncation as i32 + 1));
    Ok(Choice { step, error, next_term, operations: choice.operations / shorter, ..choice })
}

/// The choice for collocation, where no series says how large its errors are, by runs: from some nodes on, more or fewer are taken
/// as long as they need fewer gradients per unit time.
fn by_running(path: &Path, system: &System, t0: f64, target: &Target) -> Result<Choice, RunError> {
    target.check(system.problem.facts().algebra.dim()).map_err(RunError::of(path))?;
    let (mut best, mut first): (Option<Choice>, _) = (None, target.duration);
    let try_nodes = |m: usize, first: f64| -> Result<Option<Choice>, RunError> {
        let mut system = system.clone();
        system.problem.set_truncation(2 * m - 1);
        let derived = Derived::of_file(path, system)?;
        let trial = Trial::new(&derived, t0, target);
        let size = |mu: &Vec<f64>| mu.iter().map(|x| x * x).sum::<f64>().sqrt();
        let radius = trial.starts.iter().map(size).fold(0.0, f64::max);
        let goal = SAFETY * target.tolerance;
        let found = trial.step(first, goal, true).and_then(|found| trial.confirmed(found, goal));
        Ok(found.map(|(step, error)| Choice {
            tolerance: target.tolerance,
            truncation: 2 * m - 1,
            comoving: false,
            step,
            next_term: None,
            error,
            region: target.region.clone().unwrap_or(Region::Ball(radius)),
            along_run: target.region.is_none(),
            operations: m as f64 * trial.sweeps(step) / step,
        }))
    };
    let met = |choice: &Choice| choice.error <= target.tolerance;
    let better = |one: &Choice, other: &Option<Choice>| {
        other.as_ref().is_none_or(|other| match (met(one), met(other)) {
            (true, true) => one.operations < other.operations,
            (false, false) => one.error < other.error,
            (one, _) => one,
        })
    };
    let given = target.truncation.map(|k| [k.div_ceil(2)]);
    let [more, fewer] = given.as_ref().map_or(NODES, |given| [given.as_slice(), &[]]);
    for nodes in [more, fewer] {
        for &m in nodes {
            let Some(choice) = try_nodes(m, first)? else { continue };
            if !better(&choice, &best) {
                break;
            }
            first = choice.step;
            best = Some(choice);
        }
    }
    best.ok_or_else(|| unmet(path, target))
}

fn unmet(path: &Path, target: &Target) -> RunError {
    RunError::Option(format!(
        "{}: no step was found that meets the tolerance {:e} over {}: ask for a larger tolerance or a shorter run, or give \
         truncation and step instead, and see with `check` what they are worth",
        path.display(),
        target.tolerance,
        target.duration
    ))
}

/// Runs by which a step is picked.
struct Trial<'a> {
    derived: &'a Derived,
    /// The programs of its steps, where there are any.
    compiled: Option<Arc<Compiled>>,
    /// The values of the parameters that are kept.
    parameters: Vec<f64>,
    starts: Vec<Vec<f64>>,
    t0: f64,
    duration: f64,
}

impl<'a> Trial<'a> {
    /// From the start of the target, and from points of its region.
    fn new(derived: &'a Derived, t0: f64, target: &Target) -> Self {
        let dim = derived.facts().algebra.dim();
        let inside = target.region.as_ref().map(|region| region.points(dim, STARTS));
        let starts = target.start.iter().cloned().chain(inside.into_iter().flatten()).collect();
        let duration = target.duration;
        // A step that makes no sense is none that is picked.
        let compiled = derived.compiled(duration, Backend::Auto, MANY, Trajectories::One);
        let (compiled, parameters) = (compiled.ok().flatten(), derived.facts().defaults());
        Self { derived, compiled, parameters, starts, t0, duration }
    }

    /// Steps of this size.
    fn motion(&self, step: f64) -> Result<Box<dyn Motion + '_>, StepError> {
        let grid = Grid { start: self.t0, step };
        self.derived.varied(grid, &self.parameters, self.compiled.as_ref())
    }

    /// The largest step found that divides the duration with an error of at most `goal`, and the error; where none is, that of
    /// the smallest error. Steps become larger than the first only if `larger`.
    fn step(&self, first: f64, goal: f64, larger: bool) -> Option<(f64, f64)> {
        let order = f64::from(self.derived.order());
        let mut found: Option<(f64, f64)> = None;
        let mut nearest: Option<(f64, f64)> = None;
        let (mut next, mut most, mut tried) = (first, self.longest(), Vec::new());
        for _ in 0..TRIALS {
            let step = self.whole(next.min(most));
            let close = found.is_some_and(|(low, _)| step < 1.2 * low && most < 1.5 * low);
            if close || tried.contains(&step) || self.duration / step > MOST_STEPS {
                break;
            }
            tried.push(step);
            match self.error(step) {
                Some(error) if error <= goal => {
                    found = Some((step, error));
                    if !larger || error > 0.1 * goal || step > 0.8 * most {
                        break;
                    }
                    let by = (0.5 * goal / error).powf(1.0 / order).min(4.0);
                    next = f64::min(step * by, 0.9 * most);
                }
                Some(error) => {
                    most = most.min(step);
                    // The power of the step that errors follow, which is less than the order where the motion is not smooth.
                    let power = match nearest {
                        Some((_, least)) if error >= 0.8 * least && found.is_none() => break,
                        Some((before, least)) if step < before => {
                            ((error / least).ln() / (step / before).ln()).clamp(0.5, order)
                        }
                        _ => order,
                    };
                    nearest = Some((step, error));
                    next = step * (0.5 * goal / error).powf(1.0 / power).clamp(0.02, 0.9);
                }
                None => {
                    most = most.min(step);
                    next = 0.5 * step;
                }
            }
            // Between a step that does and one that does not.
            if let Some((low, _)) = found
                && next <= low
            {
                next = (low * most).sqrt();
            }
        }
        found.or(nearest)
    }

    /// A step found with its error, or a smaller one after another run: errors of motions that are steep somewhere depend on where
    /// steps end there, so that a single run may meet the goal by chance.
    fn confirmed(&self, (mut step, mut error): (f64, f64), goal: f64) -> Option<(f64, f64)> {
        for _ in 0..CONFIRMED {
            step = self.whole(CONFIRMING * step);
            let again = self.error(step)?;
            if again.max(error) <= goal {
                return Some((step, again.max(error)));
            }
            error = again;
            if again > goal {
                let by = (0.5 * goal / again).powf(1.0 / f64::from(self.derived.order()));
                step *= by.clamp(0.3, 0.9);
            }
        }
        Some((step, error))
    }

    /// A step of at most this size that divides the duration.
    fn whole(&self, step: f64) -> f64 {
        self.duration / (self.duration / step * (1.0 - 1e-12)).ceil()
    }

    /// The longest step that is tried: where the equations depend on the time, one that does not pass over what happens in it.
    fn longest(&self) -> f64 {
        if self.derived.moves() { self.duration / SEEN } else { self.duration }
    }

    /// The largest error of the starts at the end; none where steps are refused, or the end is not resolved.
    fn error(&self, step: f64) -> Option<f64> {
        let steps = (self.duration / step).round() as u64;
        let other = |size: f64| self.motion(step * size);
        let method = (self.derived.order(), self.derived.moves(), false);
        let mut worst = 0.0;
        for start in &self.starts {
            let start = self.state(start, step).ok()?;
            let error = error_of(&other, &start, (steps, Grid { start: self.t0, step }), method);
            worst = f64::max(worst, error.ok()?);
        }
        Some(worst)
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
        for start in &self.starts {
            let (Ok(motion), Ok(mut state)) = (self.motion(step), self.state(start, step)) else {
                continue;
            };
            for number in 0..2 * COUNTED {
                let made = motion.advance(&mut state, number.into(), 1).ok().flatten();
                // The first steps have no steps before them to go by.
                sum += made.filter(|_| number >= COUNTED).map_or(0, |made| made.iterations);
            }
        }
        f64::from(sum) / f64::from(COUNTED) / self.starts.len() as f64
    }
}
