//! States along motions: of the exact flow, of steps derived from a system file, and of RK45.

use coadjoint::{Phase, SO3};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::{Options, Parameters, read};
use coadjoint_learn::truth::{Separable, exact_flow};
use coadjoint_learn::{DataGroup, MomentumFunction, matrix_of};
use coadjoint_program::{Kernel, Stepper};
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::{Matrix3, Vector3};

use crate::outcome::{Curve, Fallible};

/// The initial momentum of most runs of the paper's rigid body; they begin at the identity.
pub const START: [f64; 3] = [2.0, 0.5, 1.0];

/// A momentum, and the matrix of a group element row by row.
#[derive(Clone, Debug)]
pub struct State {
    pub momentum: Vec<f64>,
    pub matrix: Vec<f64>,
}

impl State {
    pub fn of<G: DataGroup>(group: &G, phase: &Phase<G>) -> Self {
        let matrix = matrix_of(group, &phase.group_element).transpose().iter().copied().collect();
        Self { momentum: (0..group.dim()).map(|i| phase.momentum[i]).collect(), matrix }
    }

    /// The spatial momentum of a rigid body, R Π.
    pub fn spatial_momentum(&self) -> [f64; 3] {
        (Matrix3::from_row_slice(&self.matrix) * Vector3::from_row_slice(&self.momentum)).into()
    }

    pub fn energy(&self) -> f64 {
        Separable::paper().value(&self.momentum)
    }

    fn differences(&self, other: &Self) -> impl Iterator<Item = f64> {
        let pairs = self.momentum.iter().zip(&other.momentum);
        pairs.chain(self.matrix.iter().zip(&other.matrix)).map(|(a, b)| (a - b).abs())
    }

    /// The largest difference of a coordinate of the momentum or of an entry of the matrix.
    pub fn largest_difference(&self, other: &Self) -> f64 {
        self.differences(other).fold(0.0, f64::max)
    }

    /// The root of the sum of the squares of all differences.
    pub fn distance(&self, other: &Self) -> f64 {
        self.differences(other).map(|d| d * d).sum::<f64>().sqrt()
    }
}

pub fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}

/// Errors along a motion of the paper's rigid body: of the energy, relative; the largest of a component of the spatial
/// momentum, or the relative one of the Casimir |Π|² where there are momenta alone; the distance from the exact motion.
pub struct Errors(pub [Vec<f64>; 3]);

impl Errors {
    pub fn of(states: &[State], exact: &[State]) -> Self {
        let start = &exact[0];
        let norm = |state: &State| state.momentum.iter().map(|v| v * v).sum::<f64>();
        let conserved = |state: &State| {
            if state.matrix.is_empty() {
                return (norm(state) / norm(start) - 1.0).abs();
            }
            let pairs = state.spatial_momentum().into_iter().zip(start.spatial_momentum());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        Self([
            states.iter().map(|state| state.energy() / start.energy() - 1.0).collect(),
            states.iter().map(conserved).collect(),
            states.iter().zip(exact).map(|(state, exact)| state.distance(exact)).collect(),
        ])
    }

    pub fn largest(&self) -> [f64; 3] {
        self.0.each_ref().map(|values| largest(values))
    }

    /// Adds them to a curve, as columns whose names begin with `key`.
    pub fn enter(self, curve: &mut Curve, key: &str, conserved: &str) {
        for (quantity, values) in ["energy", conserved, "distance"].iter().zip(self.0) {
            curve.add(format!("{key}_{quantity}"), values);
        }
    }
}

/// Momenta along a map, as states without a matrix.
pub fn momenta(
    start: &State,
    count: usize,
    mut step: impl FnMut(&Vector3<f64>) -> Fallible<Vector3<f64>>,
) -> Fallible<Vec<State>> {
    let mut mu = Vector3::from_row_slice(&start.momentum);
    let mut states = vec![start.clone()];
    for _ in 0..count {
        mu = step(&mu)?;
        states.push(State { momentum: mu.as_slice().to_vec(), matrix: Vec::new() });
    }
    Ok(states)
}

pub fn exact_momenta(start: [f64; 3], h: f64, count: usize) -> Vec<State> {
    let states = exact(start, h, count).into_iter();
    states.map(|state| State { matrix: Vec::new(), ..state }).collect()
}

/// A momentum of the paper's rigid body after this time.
pub fn exact_momentum(mu: &Vector3<f64>, time: f64) -> Vector3<f64> {
    exact_flow(&SO3::new(), &Separable::paper(), &Phase::<SO3>::at_identity(*mu), time).momentum
}

/// Phase points of the exact flow from the identity and this momentum, the start first.
pub fn exact_phases<G: DataGroup>(
    group: &G,
    body: &impl MomentumFunction,
    start: G::Vector,
    h: f64,
    count: usize,
) -> Vec<Phase<G>> {
    let mut phases = vec![Phase::new(group.identity(), start)];
    for i in 0..count {
        phases.push(exact_flow(group, body, &phases[i], h));
    }
    phases
}

pub fn exact(start: [f64; 3], h: f64, count: usize) -> Vec<State> {
    let group = SO3::new();
    let phases = exact_phases(&group, &Separable::paper(), Vector3::from(start), h, count);
    phases.iter().map(|phase| State::of(&group, phase)).collect()
}

/// The paper's rigid body from [`START`].
pub const RIGID_BODY: &str = r#"
name = "rigid-body"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "x^2/3 + y^2/4 + z^2/5"
"#;

/// Steps of one size, as programs, from the text of a system.
pub struct Timestep {
    step: Step,
}

impl Timestep {
    pub fn new(system: &str, chart: Chart, truncation: usize) -> Fallible<Self> {
        let options = Options {
            parameters: Parameters::Substituted,
            truncation: Some(truncation),
            chart: Some(chart),
            solver: None,
            ..Options::default()
        };
        let system = read(system, options).map_err(|e| e.render("system", system))?;
        let integrator = Integrator::build(system.problem, TermLimit::default())?;
        Ok(Self { step: Step::build(&integrator)? })
    }

    pub fn kernel(&self) -> &Kernel {
        self.step.kernel()
    }

    /// Makes `steps` steps of size `h` from the identity and this momentum; returns the states, the start first, and how many
    /// corrections were made. `None` where a step is refused.
    pub fn walk(&self, h: f64, steps: usize, start: &[f64]) -> Option<(Vec<State>, u64)> {
        // Steps are made at any momentum, since the convergence of the series is the question here.
        let mut slots = self.step.fold(h, &[]).ok()?;
        slots[self.step.radius_at()] = 1e200;
        let kernel = self.kernel();
        let matrix = &kernel.programs.matrix;
        let size = matrix.outputs().len().isqrt();
        let unit = |i| if i % (size + 1) == 0 { 1.0 } else { 0.0 };
        let identity: Vec<f64> = (0..size * size).map(unit).collect();
        let (mut g, mut momentum) = (self.step.element_of(&identity), start.to_vec());
        let (mut states, mut corrections) = (Vec::new(), 0);
        for n in 0..=steps {
            if n > 0 {
                let made = kernel.advance(&slots, &mut g, &mut momentum, 1);
                if made.steps == 0 {
                    return None;
                }
                corrections += u64::from(made.corrections);
            }
            states.push(State { momentum: momentum.clone(), matrix: matrix.run(&g, &slots) });
        }
        Some((states, corrections))
    }
}

/// The paper's rigid body from [`START`] by Dormand and Prince's method (RK45) with these tolerances: the states at these
/// times, how many steps were tried, and how often the field was evaluated.
pub fn rk45(times: &[f64], relative: f64, absolute: f64) -> Fallible<(Vec<State>, usize, usize)> {
    let mut start: Vec<f64> = Matrix3::<f64>::identity().as_slice().to_vec();
    start.extend(START);
    let flow = |_: f64, y: &Vec<f64>, rate: &mut Vec<f64>| {
        let (g, mu) = (Matrix3::from_row_slice(&y[..9]), Vector3::from_row_slice(&y[9..]));
        let xi = Vector3::new(mu.x / 1.5, mu.y / 2.0, mu.z / 2.5);
        rate[..9].copy_from_slice((g * xi.cross_matrix()).transpose().as_slice());
        rate[9..].copy_from_slice(mu.cross(&xi).as_slice());
    };
    let end = times.last().copied().unwrap_or(0.0);
    let solution = IVP::ode_from_fn(flow, 0.0, end, start)
        .method(ExplicitRungeKutta::dopri5().max_steps(usize::MAX))
        .rtol(relative)
        .atol(absolute)
        .t_eval(times)
        .solve()
        .map_err(|error| format!("RK45: {error:?}"))?;
    let state = |y: &Vec<f64>| State { momentum: y[9..].to_vec(), matrix: y[..9].to_vec() };
    let states: Vec<State> = solution.y.iter().map(state).collect();
    if states.len() != times.len() {
        return Err(format!("RK45 gave {} of {} states", states.len(), times.len()).into());
    }
    let steps = solution.steps.accepted + solution.steps.rejected;
    Ok((states, steps, solution.evals.function))
}
