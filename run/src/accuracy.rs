//! From a tolerance to a truncation and a step.

use std::path::Path;
use std::sync::Arc;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::in_other_frame;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::tolerance::{Choice, Region, Target, ToleranceError};
use coadjoint_program::Trajectories;

use crate::asked::Accuracy;
use crate::backend::Backend;
use crate::derivations::Derivations;
use crate::engine::{Compiled, Numbers, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::{Derived, System};
use crate::simulate::{Maker, error_of};

/// The limit of a series while a frame is chosen.
const GLANCE: TermLimit = TermLimit { terms: 2_000, products: 50_000 };
/// The limits while a truncation is chosen, of short runs and of long ones: choosing takes some ten milliseconds or about a
/// tenth of the run.
const AFFORDABLE: [TermLimit; 2] = [
    TermLimit { terms: 20_000, products: 500_000 },
    TermLimit { terms: 20_000, products: 2_000_000 },
];
/// Operations of a long run.
const LONG: f64 = 1e9;

/// Picks truncation, step and, where the system leaves the choice, frame where a tolerance is asked for, by the settings
/// or in the text, and puts them into the system; what was picked. Parameters that are kept have the values of the text for
/// that, in a frame that there is for all values. What was `kept` of the same text is used again.
///
/// # Errors
/// Fails if nothing can be picked.
pub fn meet_tolerance(
    path: &Path,
    system: &mut System,
    asked: &Accuracy,
    kept: &Derivations,
) -> Result<Option<(Choice, Arc<Derived>)>, RunError> {
    let System { problem, potential, run, .. } = &mut *system;
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
    if potential.is_some() {
        let what = "a tolerance says nothing of the kicks of a potential: give the step instead, or splitting = \"none\", with \
                    which the potential acts within the step";
        return Err(RunError::Option(what.to_owned()));
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
        match by_series(own, &target, kept) {
            Ok((chosen, found)) => {
                **own = chosen;
                choice = Some(found);
            }
            Err(error) if error.is_of_size() && open.is_some() => {}
            Err(error) => return Err(RunError::of(path)(error)),
        }
        let open = open.clone();
        let stays = choice.is_some() && problem.clone().settled().0.polynomial().is_some();
        if let Some(open) = open.filter(|_| !stays) {
            *problem = Hamiltonian::from(*open);
            choice = None;
        }
    }
    let choice = match choice {
        Some(choice) => choice,
        None => nodes(&target, system.problem.facts().algebra.dim()).map_err(RunError::of(path))?,
    };
    system.problem.set_truncation(choice.truncation);
    let derived = kept.derive(path, system.clone(), false)?;
    let choice = verified(&derived, asked.start(&system.run), &target, choice)?;
    system.run.step = Some(choice.step);
    Ok(Some((choice, derived)))
}

/// The choice for a polynomial: of the frames that the system leaves the choice of, the one in which steps are cheaper.
fn by_series(
    problem: &Problem,
    target: &Target,
    kept: &Derivations,
) -> Result<(Problem, Choice), ToleranceError> {
    // A tolerance that makes no sense is refused whatever was kept.
    target.check(problem.algebra.dim())?;
    let choose = |problem: &Problem, limit| {
        let choice = kept.prospects(problem, target, limit)?.choose(target.tolerance)?;
        Ok((Problem { truncation: choice.truncation, ..problem.clone() }, choice))
    };
    let other = in_other_frame(problem);
    type Found = Result<(Problem, Choice), ToleranceError>;
    let operations =
        |found: &Found| found.as_ref().map_or(f64::INFINITY, |(_, choice)| choice.operations);
    // Low orders tell about how long the run takes and, where they meet the target in both frames, which one is cheaper.
    let glance = |own| (operations(&choose(own, GLANCE)), own);
    let mut frames: Vec<(f64, &Problem)> =
        [problem].into_iter().chain(&other).map(glance).collect();
    frames.sort_by(|a, b| a.0.total_cmp(&b.0));
    let limit = AFFORDABLE[usize::from(frames[0].0 * target.duration > LONG)];
    if frames.iter().all(|(cost, _)| cost.is_finite()) {
        frames.truncate(1);
    }
    let found = frames.into_iter().map(|(_, own)| choose(own, limit));
    let found = found.min_by(|a, b| operations(a).total_cmp(&operations(b)));
    found.unwrap_or_else(|| choose(problem, limit))
}

/// The most steps of a run that is tried: a minute for a small system.
const MOST_STEPS: f64 = 2e7;
/// As long as steps are refused, or the end is not resolved: an input may jump.
const MOST_REFUSED: f64 = 1e6;
/// A step that meets a tolerance is confirmed by one that is shorter by this factor.
const CONFIRMING: f64 = 0.93;
/// Errors that hardly fall, this many times in a row, are made of rounding.
const STUCK: u32 = 3;
/// Steps of a run from which on errors must fall with at least half the order: until then a motion may be steeper than the steps
/// see, and beyond it jumps.
const STEEPEST: f64 = 2e4;
/// The fewest steps of a run whose equations depend on the time: no pulse of half a step's width is passed over.
const SEEN: f64 = 512.0;
/// The starts in a region, at which errors are estimated.
const STARTS: usize = 6;
/// Runs that are tried, about, in terms of the first one.
const TRIED: f64 = 4.0;
/// Steps of the runs that are tried, about, where nothing is known of the step.
const MANY: f64 = 1e6;

/// The nodes of collocation for a tolerance, and the longest step: no series says how large its errors are.
fn nodes(target: &Target, dim: usize) -> Result<Choice, ToleranceError> {
    target.check(dim)?;
    let fit = || (1.0 - 0.5 * target.tolerance.log10()).round() as usize;
    let nodes = target.truncation.map_or_else(fit, |truncation| truncation.div_ceil(2));
    let size = |mu: &Vec<f64>| mu.iter().map(|x| x * x).sum::<f64>().sqrt();
    let ball = || Region::Ball(target.start.as_ref().map_or(0.0, size));
    Ok(Choice {
        tolerance: target.tolerance,
        truncation: 2 * nodes - 1,
        comoving: false,
        step: target.duration,
        next_term: None,
        error: f64::INFINITY,
        region: target.region.clone().unwrap_or_else(ball),
        along_run: target.region.is_none(),
        operations: nodes as f64 / target.duration,
    })
}

/// The choice after runs with it: where the error estimated over the whole run is above the tolerance, or a step is refused on
/// the way, with a smaller step.
fn verified(
    derived: &Derived,
    t0: f64,
    target: &Target,
    choice: Choice,
) -> Result<Choice, RunError> {
    let steps = choice.next_term.map_or(MANY, |_| TRIED * target.duration / choice.step);
    let trial = Pilot::new(derived, t0, target, steps);
    let found = trial.step(&choice, target.tolerance);
    let (step, error) = found.ok_or_else(|| unmet(&derived.file, target))?;
    let shorter = step / choice.step;
    let next_term = choice.next_term.map(|term| term * shorter.powi(choice.truncation as i32 + 1));
    Ok(Choice { step, error, next_term, operations: choice.operations / shorter, ..choice })
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
struct Pilot<'a> {
    derived: &'a Derived,
    /// The programs of its steps, where there are any.
    compiled: Option<Arc<Compiled>>,
    /// The values of the parameters that are kept.
    parameters: Vec<f64>,
    starts: Vec<Vec<f64>>,
    t0: f64,
    duration: f64,
}

impl<'a> Pilot<'a> {
    /// From the start of the target, and from points of its region; about `steps` steps are going to be made.
    fn new(derived: &'a Derived, t0: f64, target: &Target, steps: f64) -> Self {
        let dim = derived.facts().algebra.dim();
        let inside = target.region.as_ref().map(|region| region.points(dim, STARTS));
        let starts = target.start.iter().cloned().chain(inside.into_iter().flatten()).collect();
        let duration = target.duration;
        // A step that makes no sense is none that is picked.
        let compiled = derived.compiled(duration, Backend::Auto, steps, Trajectories::One);
        let (compiled, parameters) = (compiled.ok().flatten(), derived.values.clone());
        Self { derived, compiled, parameters, starts, t0, duration }
    }

    /// A step that divides the duration, from that of the choice on downwards, whose error meets the goal as that of the one tried
    /// before it does; and the error. If there is none, the step of the smallest error. Errors of motions that are steep somewhere
    /// depend on where steps end there, so that a single run may meet the goal by chance.
    fn step(&self, choice: &Choice, goal: f64) -> Option<(f64, f64)> {
        let order = f64::from(self.derived.order());
        let longest = if self.derived.moves() { self.duration / SEEN } else { self.duration };
        let (mut next, mut before) = (choice.step.min(longest), choice.error);
        let (mut nearest, mut stuck): (Option<(f64, f64)>, _) = (None, 0);
        let most = |made: bool| if made { MOST_STEPS } else { MOST_REFUSED };
        while self.duration / next <= most(nearest.is_some()) && stuck < STUCK {
            let step = self.duration / (self.duration / next * (1.0 - 1e-12)).ceil();
            let error = self.error(step).unwrap_or(f64::INFINITY);
            if error.max(before) <= goal {
                return Some((step, error));
            }
            let (longer, least) = nearest.unwrap_or((step, f64::INFINITY));
            let smooth = (step / longer).powf(0.5 * order);
            let falls = if self.duration / step < STEEPEST { 0.8 } else { smooth.min(0.8) };
            stuck = if error.is_infinite() || error < falls * least { 0 } else { stuck + 1 };
            if error < least {
                nearest = Some((step, error));
            }
            next = step
                * match error <= goal {
                    true => CONFIRMING,
                    false => (0.5 * goal / error).powf(1.0 / order).clamp(0.5, 0.9),
                };
            before = error;
        }
        nearest
    }

    /// The largest error of the starts at the end; none where steps are refused, or the end is not resolved.
    fn error(&self, step: f64) -> Option<f64> {
        let (compiled, grid) = (self.compiled.as_ref(), Grid { start: self.t0, step });
        let maker = Maker { system: self.derived, parameters: &self.parameters, compiled };
        let steps = (self.duration / step).round() as u64;
        let motion = maker.steps(grid).ok()?;
        let g = motion.space().numbers(&identity(motion.space().size()));
        let mut worst = 0.0;
        for mu in &self.starts {
            let start = Numbers { g: g.clone(), mu: mu.clone() };
            let error = error_of(maker, &start, (steps, grid), false);
            worst = f64::max(worst, error.ok()?);
        }
        Some(worst)
    }
}
