//! The laws of the method, tried on a system at random points near its own run.
// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod course;
mod law;
mod limit;
mod order;
mod trial;

use std::sync::Arc;

use coadjoint::groups::Exponential;
use coadjoint::{LieGroup, Phase, StepError, laws};
use coadjoint_codegen::drive::Drive;
use coadjoint_codegen::step::{Seen, rounding};
use coadjoint_program::Trajectories;
use course::{Course, Start, starts as starts_in};
use limit::{LATE, Limit};
use order::measured;

use crate::backend::Backend;
use crate::engine::{Compiled, Interpreter, Motion, STEEP, Tables, entries_of};
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
    let alone = system.without_kicks();
    let (mut laws, ratio) = laws_of_steps(alone.as_ref().unwrap_or(system), trial, &course)?;
    if system.drive().is_some() {
        return Ok((laws, ratio));
    }
    if system.kicks().is_some() {
        laws.extend(kicked(system, trial, &course)?);
    }
    if let Some((drift, steps)) = course.drift {
        let statement = "J_L along the run, as far as it is conserved";
        laws.push(Law::at_most("drift", statement, drift, rounding(steps)));
    }
    Ok((laws, ratio))
}

/// About the steps that are made of each size.
const STEPS: f64 = 1e4;

/// The laws of [`coadjoint::laws::check_map`] that are printed: its name, ours, and what it says.
const LAWS: [(&str, &str, &str); 6] = [
    ("poisson", "Poisson", "DΦ B(μ) DΦᵀ = B(Φ(μ))"),
    ("symplectic", "symplectic", "Φ*ω = ω on T*G"),
    ("equivariant", "equivariant", "Φ(k·α) = k·Φ(α)"),
    ("momentum", "momentum", "J_L(Φ(α)) = J_L(α)"),
    ("diagram", "diagram", "J_R(Φ(α)) = Φ(J_R(α))"),
    ("symmetric", "symmetric", "Φ₋ₕ(Φₕ(α)) = α"),
];

/// A step of a state.
type Step<'a> = dyn Fn(&mut Phase<Tables>) -> Result<(), StepError> + 'a;
/// The symplectic law of a map on a group without logarithm.
type InChart<'a> = dyn Fn(&Phase<Tables>, &mut Vec<laws::Law>) -> Result<(), StepError> + 'a;

/// The laws that are printed of a step there and back, at these points; those of derivatives at as many of them as there is time for.
fn tried(
    (group, points): (&Tables, &[Phase<Tables>]),
    (there, back): (&Step<'_>, &Step<'_>),
    in_chart: Option<&InChart<'_>>,
) -> Result<Vec<Law>, StepError> {
    let mut tried: Vec<laws::Law> = Vec::new();
    let limit = Limit::new();
    for point in points {
        let mut further = tried.clone();
        let mut step = |state: &mut _| limit.within(|| there(state));
        let made = laws::check_derivatives(group, &mut step, point, &mut further);
        if limit.is_over() {
            break;
        }
        made?;
        if let Some(in_chart) = in_chart {
            in_chart(point, &mut further)?;
        }
        tried = further;
    }
    let (mut there, mut back) = (|state: &mut _| there(state), |state: &mut _| back(state));
    tried.extend(laws::check_exact(group, &mut there, Some(&mut back), points)?);
    let printed = LAWS.iter().filter_map(|&(known, name, statement)| {
        if let Some(law) = tried.iter().find(|law| law.name == known) {
            return Some(limit.said(Law::at_most(name, statement, law.value, law.bound)));
        }
        let why = match known {
            "poisson" if group.dim() > laws::MANY => {
                "too many dimensions: it follows from the two laws below"
            }
            "poisson" | "symplectic" if limit.is_over() => LATE,
            _ => return None,
        };
        let verdict = Verdict::NotMeasured(why);
        Some(Law { name, statement, value: f64::NAN, bound: f64::NAN, verdict })
    });
    Ok(printed.collect())
}

/// The steps of a trial and those back, and their programs, where there are any.
struct Roundtrip<'a> {
    system: &'a Derived,
    there: Motion<'a>,
    back: Motion<'a>,
    compiled: Option<Arc<Compiled>>,
}

impl<'a> Roundtrip<'a> {
    fn new(system: &'a Derived, &Trial { start, step: h, .. }: &Trial) -> Result<Self, RunError> {
        let compiled = system.compiled(h, Backend::Auto, STEPS, Trajectories::One)?;
        let steps = |start, step| {
            let steps = system.steps(Grid { start, step }, compiled.as_ref());
            steps.map_err(RunError::unmade)
        };
        let (there, back) = (steps(start, h)?, steps(start + h, -h)?);
        Ok(Self { system, there, back, compiled })
    }

    /// The rise of an energy in a step from each of these points, relative to it, in the direction of time.
    fn rises(
        &self,
        points: &[Phase<Tables>],
        energy: &dyn Fn(f64, &Phase<Tables>) -> Option<f64>,
    ) -> Result<Vec<f64>, RunError> {
        let Grid { start, step: h } = self.there.grid();
        let rise = |point: &Phase<Tables>| {
            let mut end = point.clone();
            one(&self.there, &mut end).map_err(RunError::at(start))?;
            let [before, after] = [(start, point), (start + h, &end)]
                .map(|(time, state)| energy(time, state).unwrap_or(f64::NAN));
            Ok((after - before) * h.signum() / before.abs())
        };
        points.iter().map(rise).collect()
    }

    /// The order of accuracy from these starts.
    fn order(&self, starts: &[Start]) -> Law {
        let Self { system, there, compiled, .. } = self;
        let (step, expected) = (there.grid().step, f64::from(system.order()));
        measured(
            step,
            expected,
            &there.space().group,
            starts,
            &mut |(step, steps), start, phase| {
                let motion = system.steps(Grid { start, step }, compiled.as_ref())?;
                let mut state = motion.space().state(phase);
                motion.advance(&mut state, 0, steps.into()).map_err(|(_, error)| error)?;
                *phase = motion.space().phase(&state);
                Ok(())
            },
        )
    }
}

/// Makes a step of a state from the start of the motion's grid. It is made as the first of a run: only then is one by collocation a
/// map of the state alone.
fn one(motion: &Motion<'_>, phase: &mut Phase<Tables>) -> Result<(), StepError> {
    let mut state = motion.space().state(phase);
    motion.one_at(&mut state, motion.grid().start)?;
    *phase = motion.space().phase(&state);
    Ok(())
}

/// The laws of steps, and the ratio that is worth a warning.
fn laws_of_steps(
    system: &Derived,
    trial: &Trial,
    course: &Course,
) -> Result<(Vec<Law>, Option<f64>), RunError> {
    let (&Trial { start, step: h, .. }, group) = (trial, &*system.group.exponential);
    let steps = Roundtrip::new(system, trial)?;
    let Roundtrip { there: forward, back: backward, .. } = &steps;
    let (there, back) = (|state: &mut _| one(forward, state), |state: &mut _| one(backward, state));
    // With a torque steps have no law of [`LAWS`] to keep; back in time there may be none where the run has one.
    let forced = system.drive().is_some_and(|drive| drive.torque.is_some());
    let states = course.states(trial, (group, forced), |point| {
        one(forward, &mut point.clone())?;
        if forced { Ok(()) } else { one(backward, &mut point.clone()) }
    });
    let (points, starts) = states.map_err(RunError::at(start))?;
    let mut laws = Vec::new();
    if !forced {
        // Of groups without logarithm the function S tells the symplectic law; they have the exponential chart alone.
        let series = system.series().filter(|_| group.log(&group.identity()).is_none());
        let map = series.map(|series| Interpreter::new(series, group.clone(), h, &[])).transpose();
        let map: Option<Interpreter<'_, _, Exponential>> = map.map_err(RunError::unmade)?;
        let in_chart = map.as_ref().map(|map| {
            move |point: &Phase<_>, laws: &mut Vec<_>| laws::check_in_chart(map, point, laws)
        });
        let in_chart = in_chart.as_ref().map(|law| law as &InChart<'_>);
        let tried = tried((group, &points), (&there, &back), in_chart);
        laws = tried.map_err(RunError::at(start))?;
    }
    laws.push(steps.order(&starts));
    if let Some(drive) = system.drive() {
        let of_element: &[&str] =
            if drive.reads_element() { &["equivariant", "diagram"] } else { &[] };
        let broken = [&["Poisson", "symplectic"][..], of_element].concat();
        laws.retain(|law| !broken.contains(&law.name));
    }
    if let Some(undamped) = system.without_velocity()
        && system.drive().is_some_and(Drive::is_dissipative)
    {
        let energy = |time: f64, state: &Phase<Tables>| {
            let matrix = entries_of(group, &state.group_element);
            let seen = Seen { spatial: &[], matrix: &matrix, momentum: state.momentum.as_slice() };
            let conserved = system.invariants.conserved(time, &[seen]);
            system.invariants.energy_of(&conserved)
        };
        if points.first().and_then(|point| energy(start, point)).is_some() {
            let undamped = Roundtrip::new(&undamped, trial)?.rises(&points, &energy)?;
            let rises = steps.rises(&points, &energy)?;
            let rise = rises.into_iter().fold(f64::NEG_INFINITY, maximum);
            // The energy of a step without damping is not exact either.
            let own = undamped.into_iter().fold(0.0, |most, rise| maximum(most, rise.abs()));
            let statement = match (system.invariants.potential, h < 0.0) {
                (true, false) => "(H + V)(Φ(α)) ≤ (H + V)(α)",
                (true, true) => "(H + V)(Φ(α)) ≥ (H + V)(α), back in time",
                (false, false) => "H(Φ(α)) ≤ H(α)",
                (false, true) => "H(Φ(α)) ≥ H(α), back in time",
            };
            let name = "dissipative";
            laws.push(Law::at_most(name, statement, rise, 1e-14 + own));
        }
    }
    laws.retain(|law| law.name != "order" || unmeasured(system).is_none());
    let ratios = points.iter().map(|point| forward.ratio(point.momentum.as_slice()));
    let ratio = ratios.fold(0.0, maximum);
    Ok((laws, Some(ratio).filter(|ratio| *ratio > STEEP)))
}

/// The laws that are left to the whole step where a potential breaks the symmetry.
fn kicked(system: &Derived, trial: &Trial, course: &Course) -> Result<Vec<Law>, RunError> {
    let (&Trial { start, step: h, .. }, group) = (trial, &*system.group.exponential);
    let steps = Roundtrip::new(system, trial)?;
    let Roundtrip { there, back, .. } = &steps;
    let states = course.states(trial, (group, true), |point| {
        one(there, &mut point.clone())?;
        one(back, &mut point.clone())
    });
    let (points, starts) = states.map_err(RunError::at(start))?;
    let (mut symplectic, mut symmetric): (Option<f64>, _) = (None, 0.0_f64);
    let limit = Limit::new();
    for point in &points {
        let mut step = |state: &mut _| limit.within(|| one(there, state));
        let defect = laws::symplectic_defect_of(group, point, &mut step);
        let defect = match limit.is_over() {
            true => Some(f64::NAN),
            false => defect.map_err(RunError::at(start))?,
        };
        // Differences may not settle; the other points then decide.
        symplectic = match (symplectic, defect) {
            (Some(worst), Some(defect)) => Some(worst.max(defect)),
            (worst, defect) => defect.or(worst),
        };
        let mut state = point.clone();
        one(there, &mut state).map_err(RunError::at(start))?;
        one(back, &mut state).map_err(RunError::at(start + h))?;
        let difference = (&state.momentum - &point.momentum).amax() / point.momentum.amax();
        symmetric = maximum(symmetric, difference);
    }
    let statement = "flows and kicks: Φ*ω = ω on T*G";
    let symplectic =
        symplectic.map(|value| limit.said(Law::at_most("symplectic+V", statement, value, 1e-9)));
    let statement = "flows and kicks: Φ₋ₕ(Φₕ(α)) = α";
    let symmetric = Law::at_most("symmetric+V", statement, symmetric, 1e-11);
    let order = unmeasured(system).is_none().then(|| {
        let starts = match course.is_known() {
            true => course.forced(group, h, starts_in(system.facts().algebra.dim())),
            false => starts,
        };
        let mut order = steps.order(&starts);
        if starts.is_empty() {
            let why = "the force does not act on the part of the run that is looked at";
            order.verdict = Verdict::NotMeasured(why);
        }
        let statement = "flows and kicks: that of the splitting";
        Law { name: "order+V", statement, ..order }
    });
    Ok(symplectic.into_iter().chain([symmetric]).chain(order).collect())
}
