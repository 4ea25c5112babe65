//! The states at which laws are tried: those of the file's own run, and others near to them.

use coadjoint::{LieGroup, Phase, StepError, laws};
use coadjoint_program::Trajectories;
use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::trial::Trial;
use crate::backend::Backend;
use crate::engine::{Tables, Torque, phase_of};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::Derived;
use crate::number::maximum;
use crate::simulate;

/// Steps of the run that are looked at, at most; of more dimensions than a dozen fewer.
const LONGEST: f64 = 2000.0;
const DIMENSIONS: f64 = 12.0;
/// Steps where the file has no time.
const STEPS: f64 = 100.0;
/// The largest distance of a point from a state of the run, in coordinates of the group.
const SPREAD: f64 = 0.1;
/// The number of starts from which the order is measured, in this number of dimensions: in many of them a leading term of the
/// error hardly cancels.
pub(super) fn starts(dim: usize) -> usize {
    if dim > laws::MANY { 1 } else { 5 }
}

/// Attempts to find a point from which steps can be made, each four times as near to the run as the one before.
const ATTEMPTS: i32 = 8;

/// A state of the run.
struct Waypoint {
    time: f64,
    /// The matrix of the group element, row by row.
    element: Vec<f64>,
    momentum: Vec<f64>,
    /// The size of the torque there.
    force: f64,
}

/// The run of the file, as far as it is looked at; without places where the file gives no start.
pub(super) struct Course {
    places: Vec<Waypoint>,
    /// The largest drift of the spatial momentum as `simulate` measures it, and after how many steps; none where it is not
    /// known or cannot be measured.
    pub(super) drift: Option<(f64, u64)>,
}

/// A state from which a step of this size and one back can be made, and its time.
pub(super) type Start = (Phase<Tables>, f64);
/// Points at which laws are tried, and starts from which the order is measured.
pub(super) type Tried = (Vec<Phase<Tables>>, Vec<Start>);

/// Makes a step of a state, as a trial.
pub(super) type Attempt<'a> = dyn FnMut(&Phase<Tables>) -> Result<(), StepError> + 'a;

impl Course {
    /// Follows the run of the file in steps of the trial's size, until one cannot be made.
    pub(super) fn new(system: &Derived, trial: &Trial) -> Result<Self, RunError> {
        let mut course = Self { places: Vec::new(), drift: None };
        let dim = system.facts().algebra.dim();
        let Some(about) = trial.about.as_ref().filter(|about| about.len() == dim) else {
            return Ok(course);
        };
        let h = trial.step;
        let longest = LONGEST * (DIMENSIONS / dim as f64).min(1.0);
        let count = trial.time.map_or(STEPS, |time| (time / h).abs().floor()).min(longest) as u64;
        let compiled = system.compiled(h, Backend::Auto, count as f64, Trajectories::One)?;
        let grid = Grid { start: trial.start, step: h };
        let motion = system.steps(grid, compiled.as_ref()).map_err(RunError::unmade)?;
        let space = motion.space();
        let group = &system.group.exponential;
        let torque = system.kicks().map(|kicks| Torque::new(&kicks.kick, group, &system.values));
        let torque = torque.transpose().map_err(RunError::unmade)?;
        let mut state = simulate::start(&system.file, space, trial.element.as_deref(), about)?;
        let observed = space.observe(&[state.parts()]);
        let start = system.invariants.start(trial.start, observed.seen(0, &state.mu));
        let known = !start.momenta().is_empty();
        for n in 0..=count {
            let (time, element) = (grid.time(n), space.matrix(&state.g));
            let force = torque.as_ref().map_or(0.0, |torque| {
                let phase = phase_of(group, &element, &state.mu);
                let found = torque.torque(&phase.group_element, time);
                found.map_or(0.0, |torque| torque.amax())
            });
            course.places.push(Waypoint { time, element, momentum: state.mu.clone(), force });
            if n == count || motion.advance(&mut state, n, 1).is_err() {
                break;
            }
            let (invariants, time) = (&system.invariants, grid.time(n + 1));
            let (_, conserved) = space.conserved(invariants, time, &[state.parts()]);
            let measured = conserved.each().next().map(|[now, beside]| start.measured(now, beside));
            let measured = measured.and_then(|drift| drift.spatial_momentum).filter(|_| known);
            if let Some(now) = measured {
                let largest = course.drift.map_or(now, |(drift, _)| maximum(drift, now));
                course.drift = Some((largest, n + 1));
            }
        }
        Ok(course)
    }

    /// A point near a state of the run: moved by the group, so that it stays on the orbit of its momentum; without a run any.
    /// A flow alone is the same wherever the group element is; with kicks this is near that of the run too.
    ///
    /// # Errors
    /// The reason if no step can be made there.
    fn point(
        &self,
        (group, kicked): (&Tables, bool),
        random: &mut ChaCha8Rng,
        attempt: &mut Attempt<'_>,
    ) -> Result<Start, StepError> {
        let mut refused = StepError::NonFiniteState;
        for number in 0..ATTEMPTS {
            let mut vector =
                || DVector::from_fn(group.dim(), |_, _| 2.0 * random.random::<f64>() - 1.0);
            let [turn, by, momentum] = [vector(), vector(), vector()];
            let spread = if number == ATTEMPTS - 1 { 0.0 } else { SPREAD * 0.25_f64.powi(number) };
            let (phase, time) = match self.places.len() {
                0 => (Phase::new(group.exp(&turn), momentum), 0.0),
                count => {
                    let place = &self.places[random.random_range(0..count)];
                    let own = phase_of(group, &place.element, &place.momentum);
                    let moved = group.coadjoint(&group.exp(&(by * spread)), &own.momentum);
                    let element = match kicked {
                        true => group.compose(&own.group_element, &group.exp(&(turn * spread))),
                        false => group.exp(&turn),
                    };
                    (Phase::new(element, moved), place.time)
                }
            };
            match attempt(&phase) {
                Ok(()) => return Ok((phase, time)),
                Err(error) => refused = error,
            }
        }
        Err(refused)
    }

    /// Points at which laws are tried, and starts from which the order is measured.
    pub(super) fn states(
        &self,
        trial: &Trial,
        (group, kicked): (&Tables, bool),
        mut attempt: impl FnMut(&Phase<Tables>) -> Result<(), StepError>,
    ) -> Result<Tried, StepError> {
        let mut random = ChaCha8Rng::seed_from_u64(trial.seed);
        let mut point = || self.point((group, kicked), &mut random, &mut attempt);
        let points = (0..trial.points).map(|_| point().map(|(phase, _)| phase));
        let points = points.collect::<Result<_, _>>()?;
        let starts = (0..starts(group.dim())).map(|_| point()).collect::<Result<_, _>>()?;
        Ok((points, starts))
    }

    /// The states of the run where the torque is largest, of which a step turns the momentum by more than rounding.
    pub(super) fn forced(&self, group: &Tables, step: f64, count: usize) -> Vec<Start> {
        let acts = |place: &&Waypoint| {
            let size = place.momentum.iter().fold(0.0_f64, |size, mu| size.max(mu.abs()));
            (step * place.force).abs() > 1e-10 * size
        };
        let mut places: Vec<&Waypoint> = self.places.iter().filter(acts).collect();
        places.sort_by(|a, b| b.force.total_cmp(&a.force));
        let start =
            |place: &&Waypoint| (phase_of(group, &place.element, &place.momentum), place.time);
        places.iter().take(count).map(start).collect()
    }

    /// True if the file gives a start.
    pub(super) fn is_known(&self) -> bool {
        !self.places.is_empty()
    }
}
