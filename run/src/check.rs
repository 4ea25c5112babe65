//! The laws of the method, tried on a system at random points.

use coadjoint::groups::{Cayley, Chart, DirectProduct, Exponential, MatrixGroup};
use coadjoint::laws::{OrderError, measured_order};
use coadjoint::steps::advance;
use coadjoint::{Phase, StepError, laws};
use coadjoint_codegen::lie;
use coadjoint_codegen::system::Run;
use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::asked::Accuracy;
use crate::engine::{
    Group, Interpreter, Motion, Numbers, STEEP, advise, cayley_group, entries_of, phase_of,
    product_group,
};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::{Derived, Expansion, Flow};
use crate::number::maximum;

/// The step of a system that names none.
const DEFAULT_STEP: f64 = 0.1;

/// A law and how well it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Its name.
    pub name: &'static str,
    /// Its statement.
    pub statement: &'static str,
    /// The value measured: the largest relative violation, or the order of accuracy.
    pub value: f64,
    /// The bound it is compared with.
    pub bound: f64,
    /// Whether it holds.
    pub pass: bool,
}

/// A warning of a series whose last two terms have this ratio.
pub fn steep(ratio: f64) -> String {
    format!(
        "the series hardly converges at the points tried: its terms have the ratio {ratio:.3}, above {STEEP}; \
         take a smaller step"
    )
}

/// Why the order of whole steps is not measured, where it is not.
pub fn unmeasured(system: &Derived) -> Option<String> {
    let signal = system.signals().first()?;
    Some(format!(
        "the order is not measured: the input `{}` may have fewer derivatives than that takes, a table has two everywhere",
        signal.name
    ))
}

/// A trial: a step size, and random points.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The time from which steps are made.
    pub start: f64,
    /// The step size.
    pub step: f64,
    /// The momentum that the points are about; without one each coordinate is between −1 and 1.
    pub about: Option<Vec<f64>>,
    /// How many points.
    pub points: usize,
    /// The seed of the points.
    pub seed: u64,
}

impl Trial {
    /// With this step and from this time, else those of the system, and points about its initial momentum.
    ///
    /// # Errors
    /// Where a setting makes no sense: by its name.
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
        Ok(Self { start, step, about, points, seed })
    }

    /// Points at which laws are tried, and starts from which the order is measured.
    fn states<G: Group>(&self, group: &G) -> (Vec<Phase<G>>, [Phase<G>; STARTS]) {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut phase = || random_phase(group, self, &mut random);
        ((0..self.points).map(|_| phase()).collect(), [(); STARTS].map(|()| phase()))
    }

    /// The points in words.
    pub fn place(&self) -> &'static str {
        match self.about {
            Some(_) => "about the initial momentum",
            None => "with coordinates from -1 to 1",
        }
    }
}

/// Tries all laws; and the largest ratio of the last two terms of the series at the points, where it is worth a warning.
///
/// # Errors
/// Where a step cannot be made.
pub fn check(system: &Derived, trial: &Trial) -> Result<(Vec<Law>, Option<f64>), RunError> {
    if system.damping.is_some() {
        return Ok((laws_of_steps(system, trial, &system.group()?)?, None));
    }
    let group = product_group(&system.file, system.facts().algebra)?;
    let (mut laws, ratio) = match &system.flow {
        Flow::Collocation(..) => {
            let alone = system.without_kicks();
            (laws_of_steps(alone.as_ref().unwrap_or(system), trial, &group)?, None)
        }
        Flow::Series(series) => match series.integrator.problem.chart {
            lie::Chart::Exponential => laws_of::<_, Exponential>(series, trial, group)?,
            lie::Chart::Cayley => {
                laws_of::<_, Cayley>(series, trial, cayley_group(&system.file, &group)?)?
            }
        },
    };
    if let Some(kicks) = system.kicks() {
        laws.extend(kicked(system, kicks.torque().is_none(), trial)?);
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

fn laws_of<G: Group, C: Chart<G> + Send + Sync>(
    series: &Expansion,
    trial: &Trial,
    group: G,
) -> Result<(Vec<Law>, Option<f64>), RunError> {
    let (integrator, h) = (&series.integrator, trial.step);
    let (points, starts) = trial.states(&group);
    let make = |h| Interpreter::<G, C>::new(integrator, group.clone(), h, &[]);
    let there = make(h).map_err(RunError::unmade)?;
    let ratios = points.iter().map(|point| there.ratio(&point.momentum));
    let ratio = Some(ratios.fold(0.0, maximum)).filter(|ratio| *ratio > STEEP);
    let back = make(-h).map_err(RunError::unmade)?;
    let tried = laws::check(&there, Some(&back), &points).map_err(|error| {
        let works = |step: &Interpreter<'_, G, C>| {
            points.iter().all(|point| advance(step, &mut point.clone()).is_ok())
        };
        RunError::at(trial.start)(advise(error, h, |h| make(h).is_ok_and(|step| works(&step))))
    })?;
    let mut laws = printed(&tried);
    let expected = integrator.order() as f64;
    laws.push(measured(h, expected, &group, &starts, |h, steps, state| {
        let map = make(h)?;
        (0..steps).try_for_each(|_| advance(&map, state).map(|_| ()))
    }));
    Ok((laws, ratio))
}

/// The laws of those tried that are printed.
fn printed(tried: &[laws::Law]) -> Vec<Law> {
    let printed = LAWS.iter().filter_map(|&(known, name, statement)| {
        let law = tried.iter().find(|law| law.name == known)?;
        let (value, bound, pass) = (law.value, law.bound, law.pass());
        Some(Law { name, statement, value, bound, pass })
    });
    printed.collect()
}

/// The laws of steps by collocation. Each is made as the first of a run: only then is it a map of the state alone.
fn laws_of_steps(
    system: &Derived,
    trial: &Trial,
    group: &DirectProduct<MatrixGroup>,
) -> Result<Vec<Law>, RunError> {
    let &Trial { start, step: h, .. } = trial;
    let (points, starts) = trial.states(group);
    let from = |start: f64, step: f64, count: u32, phase: &mut _| {
        advanced(system, group, phase, (Grid { start, step }, count))
    };
    let step = |h: f64, count: u32, phase: &mut _| from(start, h, count, phase);
    let (mut there, mut back) =
        (|phase: &mut _| step(h, 1, phase), |phase: &mut _| from(start + h, -h, 1, phase));
    let tried = laws::check_map(group, &mut there, Some(&mut back), &points);
    let tried = tried.map_err(RunError::at(start))?;
    let mut laws = printed(&tried);
    let expected = f64::from(system.order());
    laws.push(measured(h, expected, group, &starts, step));
    if system.damping.is_some() {
        let kept = |law: &Law| match system.invariants.directions {
            None => !["Poisson", "symplectic"].contains(&law.name),
            // A torque acts too.
            Some(_) => law.name == "order",
        };
        laws.retain(kept);
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
                step(h, 1, &mut end).map_err(RunError::at(start))?;
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
            laws.push(Law { name, statement, value: rise, bound: 1e-14, pass: rise <= 1e-14 });
        }
    }
    laws.retain(|law| law.name != "order" || unmeasured(system).is_none());
    Ok(laws)
}

/// The laws that are left to the whole step where a potential breaks the symmetry; where a torque does that is not Hamiltonian,
/// the order alone.
fn kicked(system: &Derived, hamiltonian: bool, trial: &Trial) -> Result<Vec<Law>, RunError> {
    let (&Trial { start, step: h, .. }, group) = (trial, system.group()?);
    let (points, starts) = trial.states(&group);
    let grids = [Grid { start, step: h }, Grid { start: start + h, step: -h }];
    let [there, back] = grids.map(|grid| system.steps(grid, None).map_err(RunError::unmade));
    let (there, back) = (there?, back?);
    let made = |motion: &dyn Motion, state: &mut Phase<_>, time| {
        moved(motion, &group, state, |motion, state| motion.one_at(state, time))
    };
    let (mut symplectic, mut symmetric) = (None, 0.0_f64);
    for point in points.iter().filter(|_| hamiltonian) {
        let mut step = |state: &mut _| made(&*there, state, start);
        let defect = laws::symplectic_defect_of(&group, point, &mut step);
        let defect = defect.map_err(RunError::at(start))?;
        symplectic = defect.map(|defect| maximum(symplectic.unwrap_or(0.0), defect));
        let mut state = point.clone();
        made(&*there, &mut state, start).map_err(RunError::at(start))?;
        made(&*back, &mut state, start + h).map_err(RunError::at(start + h))?;
        let difference = (&state.momentum - &point.momentum).amax() / point.momentum.amax();
        symmetric = maximum(symmetric, difference);
    }
    let law = |name, statement, value: f64, bound: f64| {
        let pass = value <= bound;
        Law { name, statement, value, bound, pass }
    };
    let statement = "flows and kicks: Φ*ω = ω on T*G";
    let symplectic = symplectic.map(|value| law("symplectic+V", statement, value, 1e-9));
    let statement = "flows and kicks: Φ₋ₕ(Φₕ(α)) = α";
    let symmetric = law("symmetric+V", statement, symmetric, 1e-11);
    let expected = f64::from(system.order());
    let order = unmeasured(system).is_none().then(|| {
        let order = measured(h, expected, &group, &starts, |step, steps, state| {
            advanced(system, &group, state, (Grid { start, step }, steps))
        });
        let statement = "flows and kicks: that of the splitting";
        Law { name: "order+V", statement, ..order }
    });
    let symmetric = hamiltonian.then_some(symmetric);
    Ok(symplectic.into_iter().chain(symmetric).chain(order).collect())
}

/// Makes the first steps of a grid.
fn advanced(
    system: &Derived,
    group: &DirectProduct<MatrixGroup>,
    state: &mut Phase<DirectProduct<MatrixGroup>>,
    (grid, steps): (Grid, u32),
) -> Result<(), StepError> {
    moved(&*system.steps(grid, None)?, group, state, |motion, state| {
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

/// Steps of the coarsest run.
const STEPS: u32 = 4;
/// How far the measured order may fall below K + 1.
const SLACK: f64 = 0.3;

/// The order of accuracy, measured by step halving: the median over these starts, from one of which the leading term of the
/// error may happen to cancel.
///
/// Runs h, h/2 and h/4 over the same time; the differences shrink by 2^order. Among the steps
/// h·2^j tried, it takes the smallest whose differences are above rounding, where the leading term
/// of the error dominates best. Where all differences are rounding the map is exact, and the order
/// counts as infinite.
fn measured<G: Group>(
    step: f64,
    expected: f64,
    group: &G,
    starts: &[Phase<G>],
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Law {
    let mut orders: Vec<f64> =
        starts.iter().map(|start| order_from(step, group, start, &mut run)).collect();
    orders.sort_by(f64::total_cmp);
    let order = orders.get(orders.len() / 2).copied().unwrap_or(f64::INFINITY);
    Law {
        name: "order",
        statement: "error ∝ h^(K+1), by step halving",
        value: order,
        bound: expected - SLACK,
        pass: order >= expected - SLACK,
    }
}

/// The order from one start: infinite where all differences are rounding.
fn order_from<G: Group>(
    step: f64,
    group: &G,
    start: &Phase<G>,
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> f64 {
    for exponent in -6..=12 {
        let time = f64::from(STEPS) * step * 2_f64.powi(exponent);
        match measured_order(group, start, time, STEPS, &mut run) {
            Ok(value) => return value,
            // Too small to be seen: try larger steps.
            Err(OrderError::OutOfRange { coarse, .. }) if coarse < 0.5 => {}
            // Beyond the step where the solve fails nothing is to be measured.
            Err(_) => break,
        }
    }
    f64::INFINITY
}

/// The number of starts from which the order is measured.
const STARTS: usize = 5;
/// Coordinates of random points differ from those given by up to this part of their size.
const SPREAD: f64 = 0.1;

/// A group element within the chart, and a momentum: about the one given, coordinate by coordinate, since coordinates may
/// have different units. One that is 0 is as large as the smallest of the others.
fn random_phase<G: Group>(group: &G, trial: &Trial, random: &mut ChaCha8Rng) -> Phase<G> {
    let mut vector = || DVector::from_fn(group.dim(), |_, _| 2.0 * random.random::<f64>() - 1.0);
    let x = vector();
    let mut momentum = vector();
    if let Some(about) = trial.about.as_ref().filter(|about| about.len() == group.dim()) {
        let sizes = about.iter().map(|x| x.abs());
        let least = sizes.filter(|size| *size > 0.0).fold(f64::INFINITY, f64::min);
        for (own, given) in momentum.iter_mut().zip(about) {
            let size = if *given == 0.0 { least } else { given.abs() };
            *own = given + SPREAD * size * *own;
        }
    }
    Phase::new(group.exp(&x), momentum)
}
