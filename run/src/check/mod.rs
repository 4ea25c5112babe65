//! The laws of the method, tried on a system at random points near its own run.
// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod course;
mod law;
mod order;
mod trial;

use coadjoint::groups::{Cayley, Chart, DirectProduct, Exponential, MatrixGroup};
use coadjoint::steps::advance;
use coadjoint::{Phase, StepError, laws};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::{Convergence, rounding};
use course::{Course, starts as starts_in};
use nalgebra::DVector;
use order::measured;

use crate::engine::{
    Group, Interpreter, Motion, Numbers, Restore, STEEP, advise, entries_of, phase_of,
};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::Derived;
use crate::number::maximum;

pub use law::{Law, Verdict};
pub use trial::Trial;

/// A warning of a series whose last two terms have this ratio.
pub fn steep(ratio: f64) -> String {
    format!(
        "the series hardly converges at the points tried: its terms have the ratio {ratio:.3}, above {STEEP}; \
         take a smaller step"
    )
}

/// The reason if the order of whole steps is not measured.
pub fn unmeasured(system: &Derived) -> Option<String> {
    let signal = system.signals().first()?;
    Some(format!(
        "the order is not measured: the input `{}` may have fewer derivatives than that takes, a table has two everywhere",
        signal.name
    ))
}

/// Tries all laws; and the largest ratio of the last two terms of the series at the points, where it is worth a warning.
///
/// # Errors
/// A step cannot be made.
pub fn check(system: &Derived, trial: &Trial) -> Result<(Vec<Law>, Option<f64>), RunError> {
    let course = Course::new(system, trial)?;
    if system.damping.is_some() {
        return Ok((laws_of_steps(system, trial, &course)?, None));
    }
    let (mut laws, ratio) = match (system.series(), &system.group.cayley) {
        (None, _) => {
            let alone = system.without_kicks();
            (laws_of_steps(alone.as_ref().unwrap_or(system), trial, &course)?, None)
        }
        (Some(series), None) => {
            laws_of::<_, Exponential>(series, trial, &course, &*system.group.exponential)?
        }
        (Some(series), Some(group)) => laws_of::<_, Cayley>(series, trial, &course, &**group)?,
    };
    if let Some(kicks) = system.kicks() {
        laws.extend(kicked(system, kicks.torque().is_none(), trial, &course)?);
    }
    if let Some((drift, steps)) = course.drift {
        let statement = "J_L along the run, as far as it is conserved";
        laws.push(Law::at_most("drift", statement, drift, rounding(steps)));
    }
    Ok((laws, ratio))
}

/// The laws of [`coadjoint::laws::check_map`] that are printed: its name, ours, and what it says.
const LAWS: [(&str, &str, &str); 6] = [
    ("poisson", "Poisson", "DΦ B(μ) DΦᵀ = B(Φ(μ))"),
    ("symplectic", "symplectic", "Φ*ω = ω on T*G"),
    ("equivariant", "equivariant", "Φ(k·α) = k·Φ(α)"),
    ("momentum", "momentum", "J_L(Φ(α)) = J_L(α)"),
    ("diagram", "diagram", "J_R(Φ(α)) = Φ(J_R(α))"),
    ("symmetric", "symmetric", "Φ₋ₕ(Φₕ(α)) = α"),
];

fn laws_of<G: Group + Restore, C: Chart<G> + Send + Sync>(
    integrator: &Integrator,
    trial: &Trial,
    course: &Course,
    group: &G,
) -> Result<(Vec<Law>, Option<f64>), RunError> {
    let h = trial.step;
    let make = |h| Interpreter::<G, C>::new(integrator, group.clone(), h, &[]);
    let there = make(h).map_err(RunError::unmade)?;
    let back = make(-h).map_err(RunError::unmade)?;
    let both = |point: &Phase<G>| {
        advance(&there, &mut point.clone())?;
        advance(&back, &mut point.clone()).map(drop)
    };
    let refused = |error| {
        let momentum = trial.about.clone().unwrap_or_else(|| vec![1.0; group.dim()]);
        let start = Phase::<G>::new(group.identity(), DVector::from_vec(momentum));
        let works = |h| make(h).is_ok_and(|step| advance(&step, &mut start.clone()).is_ok());
        RunError::at(trial.start)(advise(error, h, works))
    };
    let (points, starts) = course.states(trial, (group, false), both).map_err(refused)?;
    let convergence = Convergence::new(integrator);
    let ratio = Convergence::fold(integrator, h, &[], STEEP).ok().map(|folded| {
        let momenta: Vec<&[f64]> = points.iter().map(|point| point.momentum.as_slice()).collect();
        convergence.ratios(&folded, &momenta).into_iter().fold(0.0, maximum)
    });
    let ratio = ratio.filter(|ratio| *ratio > STEEP);
    let tried = laws::check(&there, Some(&back), &points).map_err(RunError::at(trial.start))?;
    let mut laws = printed(&tried);
    let expected = integrator.order() as f64;
    laws.push(measured(h, expected, group, &starts, &mut |(h, steps), _, state| {
        let map = make(h)?;
        (0..steps).try_for_each(|_| advance(&map, state).map(|_| ()))
    }));
    Ok((laws, ratio))
}

/// The laws of those tried that are printed.
fn printed(tried: &[laws::Law]) -> Vec<Law> {
    let printed = LAWS.iter().filter_map(|&(known, name, statement)| {
        let law = tried.iter().find(|law| law.name == known);
        if law.is_none() && known == "poisson" {
            let why = "too many dimensions: it follows from the two laws below";
            let verdict = Verdict::NotMeasured(why);
            return Some(Law { name, statement, value: f64::NAN, bound: f64::NAN, verdict });
        }
        law.map(|law| Law::at_most(name, statement, law.value, law.bound))
    });
    printed.collect()
}

/// The laws of steps by collocation. Each is made as the first of a run: only then is it a map of the state alone.
fn laws_of_steps(system: &Derived, trial: &Trial, course: &Course) -> Result<Vec<Law>, RunError> {
    let (&Trial { start, step: h, .. }, group) = (trial, &*system.group.exponential);
    let grids = [Grid { start, step: h }, Grid { start: start + h, step: -h }];
    let [forward, backward] = grids.map(|grid| system.steps(grid, None).map_err(RunError::unmade));
    let (forward, backward) = (forward?, backward?);
    let one = |motion: &dyn Motion, state: &mut Phase<_>| {
        moved(motion, group, state, |motion, state| {
            motion.advance(state, 0, 1).map(drop).map_err(|(_, error)| error)
        })
    };
    let (mut there, mut back) =
        (|state: &mut _| one(&*forward, state), |state: &mut _| one(&*backward, state));
    // With damping a potential is a part of these steps, which then have no law of [`LAWS`] to keep; back in time there may be
    // none where the run has one.
    let kicked = system.kicks().is_some();
    let states = course.states(trial, (group, kicked), |point| {
        one(&*forward, &mut point.clone())?;
        if kicked { Ok(()) } else { one(&*backward, &mut point.clone()) }
    });
    let (points, starts) = states.map_err(RunError::at(start))?;
    let mut laws = Vec::new();
    if !kicked {
        let tried = laws::check_map(group, &mut there, Some(&mut back), &points);
        laws = printed(&tried.map_err(RunError::at(start))?);
    }
    let expected = f64::from(system.order());
    laws.push(measured(h, expected, group, &starts, &mut |steps, from, state| {
        advanced(system, group, state, steps, from)
    }));
    if system.damping.is_some() {
        laws.retain(|law| !["Poisson", "symplectic"].contains(&law.name));
        laws.iter_mut().filter(|law| law.name == "order").for_each(|law| {
            law.statement = "steps and damping: error ∝ h²";
        });
        let energy = |time: f64, state: &Phase<DirectProduct<MatrixGroup>>| {
            let matrix = || entries_of(group, &state.group_element);
            system.invariants.conserved(time, state.momentum.as_slice(), &[], matrix).energy
        };
        if points.first().and_then(|point| energy(start, point)).is_some() {
            let mut rise = f64::NEG_INFINITY;
            for point in &points {
                let mut end = point.clone();
                one(&*forward, &mut end).map_err(RunError::at(start))?;
                let [before, after] = [(start, point), (start + h, &end)]
                    .map(|(time, state)| energy(time, state).unwrap_or(f64::NAN));
                rise = maximum(rise, (after - before) * h.signum() / before.abs());
            }
            let statement = match (&system.invariants.potential, h < 0.0) {
                (Some(_), false) => "(H + V)(Φ(α)) ≤ (H + V)(α)",
                (Some(_), true) => "(H + V)(Φ(α)) ≥ (H + V)(α), back in time",
                (None, false) => "H(Φ(α)) ≤ H(α)",
                (None, true) => "H(Φ(α)) ≥ H(α), back in time",
            };
            let name = "dissipative";
            laws.push(Law::at_most(name, statement, rise, 1e-14));
        }
    }
    laws.retain(|law| law.name != "order" || unmeasured(system).is_none());
    Ok(laws)
}

/// The laws that are left to the whole step where a potential breaks the symmetry; where a torque does that is not Hamiltonian,
/// the order alone.
fn kicked(
    system: &Derived,
    hamiltonian: bool,
    trial: &Trial,
    course: &Course,
) -> Result<Vec<Law>, RunError> {
    let (&Trial { start, step: h, .. }, group) = (trial, &*system.group.exponential);
    let grids = [Grid { start, step: h }, Grid { start: start + h, step: -h }];
    let [there, back] = grids.map(|grid| system.steps(grid, None).map_err(RunError::unmade));
    let (there, back) = (there?, back?);
    let made = |motion: &dyn Motion, state: &mut Phase<_>, time| {
        moved(motion, group, state, |motion, state| motion.one_at(state, time))
    };
    let states = course.states(trial, (group, true), |point| {
        made(&*there, &mut point.clone(), start)?;
        made(&*back, &mut point.clone(), start + h)
    });
    let (points, starts) = states.map_err(RunError::at(start))?;
    let (mut symplectic, mut symmetric): (Option<f64>, _) = (None, 0.0_f64);
    for point in points.iter().filter(|_| hamiltonian) {
        let mut step = |state: &mut _| made(&*there, state, start);
        let defect = laws::symplectic_defect_of(group, point, &mut step);
        let defect = defect.map_err(RunError::at(start))?;
        // Differences may not settle; the other points then decide.
        symplectic = match (symplectic, defect) {
            (Some(worst), Some(defect)) => Some(worst.max(defect)),
            (worst, defect) => defect.or(worst),
        };
        let mut state = point.clone();
        made(&*there, &mut state, start).map_err(RunError::at(start))?;
        made(&*back, &mut state, start + h).map_err(RunError::at(start + h))?;
        let difference = (&state.momentum - &point.momentum).amax() / point.momentum.amax();
        symmetric = maximum(symmetric, difference);
    }
    let statement = "flows and kicks: Φ*ω = ω on T*G";
    let symplectic = symplectic.map(|value| Law::at_most("symplectic+V", statement, value, 1e-9));
    let statement = "flows and kicks: Φ₋ₕ(Φₕ(α)) = α";
    let symmetric = Law::at_most("symmetric+V", statement, symmetric, 1e-11);
    let order = unmeasured(system).is_none().then(|| {
        let starts = match course.is_known() {
            true => course.forced(group, h, starts_in(system.facts().algebra.dim())),
            false => starts,
        };
        let expected = f64::from(system.order());
        let mut order = measured(h, expected, group, &starts, &mut |steps, from, state| {
            advanced(system, group, state, steps, from)
        });
        if starts.is_empty() {
            let why = "the force does not act on the part of the run that is looked at";
            order.verdict = Verdict::NotMeasured(why);
        }
        let statement = "flows and kicks: that of the splitting";
        Law { name: "order+V", statement, ..order }
    });
    let symmetric = hamiltonian.then_some(symmetric);
    Ok(symplectic.into_iter().chain(symmetric).chain(order).collect())
}

/// Makes steps of this size and number of a state from this time on.
fn advanced(
    system: &Derived,
    group: &DirectProduct<MatrixGroup>,
    state: &mut Phase<DirectProduct<MatrixGroup>>,
    (step, steps): (f64, u32),
    start: f64,
) -> Result<(), StepError> {
    moved(&*system.steps(Grid { start, step }, None)?, group, state, |motion, state| {
        motion.advance(state, 0, steps.into()).map(drop).map_err(|(_, error)| error)
    })
}

/// Moves a state by steps of a motion.
fn moved(
    motion: &dyn Motion,
    group: &DirectProduct<MatrixGroup>,
    phase: &mut Phase<DirectProduct<MatrixGroup>>,
    by: impl Fn(&dyn Motion, &mut Numbers) -> Result<(), StepError>,
) -> Result<(), StepError> {
    let g = motion.space().numbers(&entries_of(group, &phase.group_element));
    let mut state = Numbers { g, mu: phase.momentum.as_slice().to_vec() };
    by(motion, &mut state)?;
    *phase = phase_of(group, &motion.space().matrix(&state.g), &state.mu);
    Ok(())
}
