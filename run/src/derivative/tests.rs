#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::{DoubleDouble, Judge};
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_codegen::step::Origin;
use coadjoint_codegen::system::Options;
use num_traits::ToPrimitive;

use super::ending::{coordinates, difference};
use super::*;
use crate::grid::Grid;
use crate::load::read_varying;

/// The time at which runs start: derivatives of inputs and of times are those there.
const START: f64 = 1.5;

/// A system, the parameters in which it is differentiated, a momentum, and a step.
#[derive(Clone)]
struct Case {
    text: &'static str,
    varied: Vec<String>,
    momentum: Vec<f64>,
    step: f64,
}

/// The systems of `tests.cases`; the first is a free body, the first two have series without a frame.
fn cases() -> Vec<Case> {
    let all = include_str!("tests.cases").split("==== ").skip(1);
    let case = |text: &'static str| {
        let (head, text) = text.split_once('\n').unwrap();
        let [varied, momentum, step] = head.split('|').collect::<Vec<_>>()[..] else {
            panic!("{head}")
        };
        let number = |word: &str| word.trim().parse().unwrap();
        Case {
            text,
            varied: varied.split_whitespace().map(str::to_owned).collect(),
            momentum: momentum.split_whitespace().map(number).collect(),
            step: number(step),
        }
    };
    let all: Vec<Case> = all.map(case).collect();
    assert!(all.len() >= 15, "{}", all.len());
    all
}

impl Case {
    fn system(&self) -> Derived {
        let read = read_varying("case", self.text, Options::default(), &self.varied);
        Derived::of(read.unwrap()).unwrap()
    }

    fn setup(&self, steps: u64) -> Setup {
        let grid = Grid { start: START, step: self.step };
        let schedule = Schedule::of(grid, self.step * steps as f64).unwrap();
        Setup {
            backend: crate::Backend::Interpreter,
            ..Setup::new(schedule, self.momentum.clone())
        }
    }
}

/// The state after steps by the generic solver, its matrix by rows, with other values of the parameters.
fn end(case: &Case, system: &Derived, parameters: &[f64], start: Numbers, steps: u64) -> Numbers {
    let grid = Grid { start: START, step: case.step };
    let motion = system.with_parameters(grid, parameters, None).unwrap();
    let mut state = start;
    motion.advance(&mut state, 0, steps).unwrap();
    state
}

/// All changes, a column each: those of the state, then those of the parameters, then those of the samples of inputs.
fn all(derivatives: &Derivatives<'_>) -> Changes {
    let samples = derivatives.signals.iter().map(|signal| signal.table()[0].len());
    let (n, q) = (2 * derivatives.dim(), derivatives.parameters());
    let k = n + q + samples.clone().sum::<usize>();
    let units = |first: usize, rows| {
        DMatrix::from_fn(rows, k, |i, j| if first + i == j { 1.0 } else { 0.0 })
    };
    let mut first = n + q;
    let mut input = |rows: usize| {
        first += rows;
        units(first - rows, rows)
    };
    let inputs = samples.map(&mut input).collect();
    Changes { state: units(0, n), parameters: units(n, q), inputs }
}

/// The tangents of all changes at the end.
fn whole(derivatives: &Derivatives<'_>) -> DMatrix<f64> {
    let end = [derivatives.schedule.steps];
    derivatives.forward(&all(derivatives), &end).unwrap().remove(0)
}

/// The system with this sample of its inputs, which are counted one after the other, changed by so much.
fn with_sample(case: &Case, mut sample: usize, change: f64) -> Derived {
    let mut system = case.system();
    if let Origin::Collocation(smooth) = Arc::make_mut(&mut system.origin) {
        for signal in &mut smooth.signals {
            let mut values = signal.table()[1].to_vec();
            if let Some(value) = values.get_mut(sample) {
                *value += change;
            }
            sample = sample.wrapping_sub(values.len());
            *signal = signal.with_values(&values);
        }
    }
    system
}

#[test]
fn tangents_are_the_derivatives_of_runs() {
    for case in &cases() {
        let system = case.system();
        let algebra = system.facts().algebra;
        let (theta, n) = (system.facts().defaults(), algebra.dim());
        let mut derivatives = Derivatives::new(&system, &case.setup(4)).unwrap();
        // From an attitude other than the identity.
        let mut moved = derivatives.start.clone();
        derivatives.motion.advance(&mut moved, 0, 3).unwrap();
        let matrix = derivatives.motion.space().matrix(&moved.g);
        derivatives.start = moved.clone();
        let size = matrix.len().isqrt();
        let found = whole(&derivatives);
        let at = |column: usize, s: f64| {
            let (mut theta, mut mu) = (theta.clone(), moved.mu.clone());
            let mut g = DMatrix::from_row_slice(size, size, &matrix);
            let mut other = None;
            match column {
                j if j < n => {
                    let e = &algebra.matrices()[j];
                    g *= DMatrix::from_fn(size, size, |a, b| s * e.get(a, b).to_f64().unwrap())
                        .exp();
                }
                j if j < 2 * n => mu[j - n] += s,
                j if j < 2 * n + theta.len() => theta[j - 2 * n] += s,
                j => other = Some(with_sample(case, j - 2 * n - theta.len(), s)),
            }
            let g = g.transpose().as_slice().to_vec();
            end(case, other.as_ref().unwrap_or(&system), &theta, Numbers { g, mu }, 4)
        };
        let here = at(0, 0.0);
        for (column, found) in found.column_iter().enumerate() {
            let less = |a: &Numbers, b: &Numbers| {
                let (a, b) = ([&a.g[..], &a.mu].concat(), [&b.g[..], &b.mu].concat());
                DVector::from_vec(a) - DVector::from_vec(b)
            };
            let change = difference(0.005, less, |s| Ok::<_, ()>(at(column, s))).unwrap();
            let (entries, nu) = change.as_slice().split_at(size * size);
            let xi = coordinates(algebra, &here.g, entries);
            let wanted = DVector::from_iterator(2 * n, xi.iter().chain(nu).copied());
            let off = (found - &wanted).amax() / (1.0 + wanted.amax());
            assert!(off < 1e-12, "{}, column {column}: {off:e}", case.text);
        }
    }
}

#[test]
fn tangents_of_a_step_are_those_in_doubled_precision() {
    for case in &cases()[..2] {
        let system = case.system();
        let problem = &system.series().unwrap().problem;
        let (theta, n) = (system.facts().defaults(), problem.algebra.dim());
        let judge = Judge::of_problem(problem, TermLimit::default()).unwrap();
        let at = |column: usize, s: f64| {
            let (mut theta, mut mu) = (theta.clone(), case.momentum.clone());
            match column {
                j if j < n => mu[j] += s,
                j => theta[j - n] += s,
            }
            let symbols: Vec<f64> =
                problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&theta)).collect();
            let mut setting = judge.at(case.step, &symbols).unwrap();
            let step = setting.step(&mu).unwrap();
            let end = step.end(&step.right_solution().unwrap(), f64::EPSILON).unwrap();
            let momentum = end.momentum.iter().map(|mu| mu.scaled(end.scale));
            let entries = end.element.transpose();
            entries.iter().copied().chain(momentum).collect::<Vec<DoubleDouble>>()
        };
        let here: Vec<f64> = at(0, 0.0).iter().map(|number| number.to_f64()).collect();
        let found = whole(&Derivatives::new(&system, &case.setup(1)).unwrap());
        for (column, found) in found.column_iter().skip(n).enumerate() {
            let less = |a: &Vec<DoubleDouble>, b: &Vec<DoubleDouble>| {
                DVector::from_iterator(a.len(), a.iter().zip(b).map(|(&a, &b)| (a - b).to_f64()))
            };
            let change = difference(1.0 / 64.0, less, |s| Ok::<_, ()>(at(column, s))).unwrap();
            let (entries, nu) = change.as_slice().split_at(change.len() - n);
            let xi = coordinates(&problem.algebra, &here[..entries.len()], entries);
            let wanted = DVector::from_iterator(2 * n, xi.iter().chain(nu).copied());
            let off = (found - &wanted).amax() / (1.0 + wanted.amax());
            assert!(off < 1e-13, "{}, column {column}: {off:e}", case.text);
        }
    }
}

/// ω((ξ, ν), (ξ′, ν′)) = ⟨ν′, ξ⟩ − ⟨ν, ξ′⟩ + ⟨μ, [ξ, ξ′]⟩ as a matrix.
fn symplectic_form(algebra: &LieAlgebra, mu: &[f64]) -> DMatrix<f64> {
    let n = algebra.dim();
    let mut form = DMatrix::zeros(2 * n, 2 * n);
    for i in 0..n {
        form[(i, n + i)] = 1.0;
        form[(n + i, i)] = -1.0;
    }
    for c in algebra.structure() {
        form[(c.i, c.j)] += c.value.to_f64().unwrap() * mu[c.k];
    }
    form
}

#[test]
fn tangents_are_symplectic_and_adjoints_are_their_transposes() {
    for case in &cases() {
        let system = case.system();
        let steps = 20;
        let mut derivatives = Derivatives::new(&system, &case.setup(steps)).unwrap();
        let (n, q) = (derivatives.dim(), derivatives.parameters());
        let found = whole(&derivatives);
        let all = all(&derivatives);
        // Sums over three states.
        let weights = |at: u64| {
            DMatrix::from_fn(2 * n, 3, |i, j| ((1 + 3 * i + 7 * j) as f64 + at as f64).sin())
        };
        let at = [0, 7, steps];
        let adjoint = derivatives.backward(&at.map(|at| (at, weights(at)))).unwrap();
        let tangents = derivatives.forward(&all, &at).unwrap();
        let sums = tangents.iter().zip(at).map(|(tangent, at)| tangent.tr_mul(&weights(at)));
        let wanted = sums.reduce(|a, b| a + b).unwrap();
        let off = (&adjoint.state - wanted.rows(0, 2 * n)).amax() / wanted.amax();
        assert!(off < 1e-13, "{}: {off:e}", case.text);
        if q > 0 {
            let off = (&adjoint.parameters - wanted.rows(2 * n, q)).amax() / wanted.amax();
            assert!(off < 1e-13, "{}: {off:e}", case.text);
        }
        let mut first = 2 * n + q;
        for own in &adjoint.inputs {
            let off = (own - wanted.rows(first, own.nrows())).amax() / wanted.amax();
            assert!(off < 1e-13, "{}: {off:e}", case.text);
            first += own.nrows();
        }
        assert_eq!(adjoint.kept as u64, steps);
        // A run for whose states there is no room.
        derivatives.room = 0;
        let twice = derivatives.backward(&at.map(|at| (at, weights(at)))).unwrap();
        assert!(twice.kept as u64 <= 2 * steps.isqrt() + 2, "{} states", twice.kept);
        assert!(twice.state == adjoint.state && twice.parameters == adjoint.parameters);

        if system.drive().is_some() {
            continue;
        }
        let algebra = system.facts().algebra;
        let mut state = derivatives.start.clone();
        derivatives.motion.advance(&mut state, 0, steps).unwrap();
        let tangent = found.columns(0, 2 * n).into_owned();
        let after = tangent.tr_mul(&(symplectic_form(algebra, &state.mu) * &tangent));
        let before = symplectic_form(algebra, &derivatives.start.mu);
        let off = (after - before).amax() / (1.0 + tangent.amax().powi(2));
        assert!(off < 1e-13, "{}: {off:e}", case.text);
    }
}

/// A free body with the moments of inertia 1, 2 and 4.
fn free(momentum: [f64; 3]) -> Case {
    let text = "group = 'SO3'\nhamiltonian = 'mu[0]^2/2 + mu[1]^2/4 + mu[2]^2/8'\n[integrator]\ntruncation = 9";
    Case { text, varied: Vec::new(), momentum: momentum.to_vec(), step: 0.05 }
}

#[test]
fn a_body_leaves_its_middle_axis_at_the_known_rate() {
    let body = free([0.0, 2.0, 0.0]);
    let system = body.system();
    let derivatives = Derivatives::new(&system, &body.setup(1000)).unwrap();
    let exponent = derivatives.largest_exponent(900).unwrap();
    let rate = (1.0 * 2.0 / (1.0 * 4.0_f64)).sqrt();
    assert!((exponent - rate).abs() < 1e-10, "{:e}", exponent - rate);
    assert!(matches!(derivatives.largest_exponent(1000), Err(RunError::Option(_))));
}

#[test]
fn multipliers_of_a_steady_rotation_are_known() {
    let case = free([0.0, 0.0, 5.0]);
    let (velocity, time) = (1.25, 2.0);
    let system = case.system();
    let derivatives = Derivatives::new(&system, &case.setup(40)).unwrap();
    let monodromy = derivatives.monodromy().unwrap();
    // The body's motion about the steady rotation, and the rotation itself; 1 twice, with one eigenvector.
    let wobble = velocity * (3.0 * 2.0 / (1.0 * 2.0_f64)).sqrt();
    let mut power = monodromy.clone();
    for k in 1..=3 {
        let angle = f64::from(k) * time;
        let wanted = 2.0 + 2.0 * (angle * wobble).cos() + 2.0 * (angle * velocity).cos();
        let off = power.trace() - wanted;
        assert!(off.abs() < 1e-11, "power {k}: {off:e}");
        power *= &monodromy;
    }
}

/// The run of a case up to the first change of sign of z, with the samples and the momentum changed: when it ends, and its momentum there.
fn until(case: &Case, system: &Derived, momentum: Vec<f64>) -> (Event, f64, u64, Vec<f64>) {
    let event = Event {
        name: "fallen".into(),
        function: std::sync::Arc::new(|t, g, mu| Ok(mu[2] - 0.25 * g[8] - 0.125 * t + 0.25)),
        direction: crate::simulate::Direction::Both,
        terminal: true,
    };
    let setup = Setup { momentum, events: vec![event.clone()], ..case.setup(400) };
    let outcome = crate::simulate::run(system, &setup, &mut Nothing).unwrap();
    assert_eq!(outcome.events.len(), 1);
    (event, outcome.time, outcome.steps, outcome.momentum)
}

struct Nothing;

impl crate::simulate::Sink for Nothing {}

/// A body with held samples of its torque, whose event lies within a step.
fn held() -> Case {
    let text = "group = 'SO3'\nhamiltonian = 'a*mu[0]^2 + mu[1]^2/3 + mu[2]^2/4'\ntorque = ['u', '0', '-mu[2]/2 + u/8']\n\
                [parameters]\na = 0.5\n[inputs]\ntimes = [0, 1.9, 2.6, 40]\nu = [0.25, 0.5, -0.25, 0.25]\n\
                hold = 'previous'\n[integrator]\ntruncation = 7";
    Case { text, varied: vec!["a".into()], momentum: vec![0.25, 0.5, 1.0], step: 0.0625 }
}

#[test]
fn events_that_end_runs_move_as_their_derivatives_say() {
    let case = held();
    let system = case.system();
    let (event, time, steps, _) = until(&case, &system, case.momentum.clone());
    assert!(time > 2.65 && time < 10.0, "{time}");
    let derivatives = Derivatives::new(&system, &case.setup(steps)).unwrap().until(event, time);
    let found = derivatives.forward(&all(&derivatives), &[steps, steps + 1]).unwrap().remove(1);
    let n = 3;
    let wanted = |column: usize| {
        let less = |a: &DVector<f64>, b: &DVector<f64>| a - b;
        let run = |s: f64| {
            let mut momentum = case.momentum.clone();
            let mut other = None;
            match column {
                j if j < n => momentum[j] += s,
                j => other = Some(with_sample(&case, j - n, s)),
            }
            let (_, time, _, mu) = until(&case, other.as_ref().unwrap_or(&system), momentum);
            Ok::<_, ()>(DVector::from_vec([&mu[..], &[time]].concat()))
        };
        difference(0.002, less, run).unwrap()
    };
    // The momenta at the start, and the samples, after the parameter.
    for (number, column) in (n..2 * n).chain(2 * n + 1..2 * n + 4).enumerate() {
        let wanted = wanted(number);
        let off = (found.column(column).rows(n, n + 1) - &wanted).amax() / (1.0 + wanted.amax());
        assert!(off < 1e-10, "column {column}: {off:e}");
    }
    let weights =
        |rows: usize| DMatrix::from_fn(rows, 2, |i, j| ((1 + 3 * i + 7 * j) as f64).sin());
    let adjoint = derivatives.backward(&[(steps + 1, weights(2 * n + 1))]).unwrap();
    let wanted = found.tr_mul(&weights(2 * n + 1));
    let own = [&adjoint.state, &adjoint.parameters, &adjoint.inputs[0]];
    let rows: usize = own.iter().map(|own| own.nrows()).sum();
    assert_eq!(rows, wanted.nrows());
    let mut first = 0;
    for own in own {
        let off = (own - wanted.rows(first, own.nrows())).amax() / wanted.amax();
        assert!(off < 1e-12, "{off:e}");
        first += own.nrows();
    }
    assert!(matches!(derivatives.backward(&[(steps + 1, weights(6))]), Err(RunError::Option(_))));
}

#[test]
fn shapes_that_do_not_fit_and_runs_that_stop_are_told() {
    let body = cases().remove(0);
    let system = body.system();
    let derivatives = Derivatives::new(&system, &body.setup(4)).unwrap();
    let [zeros, none, fits] = [5, 4, 6].map(|rows| DMatrix::zeros(rows, 1));
    let forward = |state: &DMatrix<f64>, parameters: &DMatrix<f64>, inputs: usize, at: &[u64]| {
        let inputs = vec![DMatrix::zeros(3, 1); inputs];
        let changes = Changes { state: state.clone(), parameters: parameters.clone(), inputs };
        derivatives.forward(&changes, at).map(drop)
    };
    for failed in [
        forward(&zeros, &none, 0, &[4]),
        forward(&fits, &zeros, 0, &[4]),
        forward(&fits, &none, 0, &[4, 2]),
        forward(&fits, &none, 0, &[5]),
        forward(&fits, &none, 1, &[4]),
        derivatives.backward(&[(4, zeros.clone())]).map(drop),
        derivatives.backward(&[(5, fits.clone())]).map(drop),
    ] {
        assert!(matches!(failed, Err(RunError::Option(_))));
    }
    let far = Case { momentum: vec![40.0, 10.0, 20.0], ..body.clone() };
    let derivatives = Derivatives::new(&system, &far.setup(4)).unwrap();
    let stopped = derivatives.monodromy();
    assert!(matches!(stopped, Err(RunError::Run { step: 1, .. })));
    assert!(matches!(derivatives.backward(&[(4, fits)]), Err(RunError::Run { .. })));
}
