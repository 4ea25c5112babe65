//! The laws of maps for the steps of kernels, on every group and chart, through every back end of the machine: the
//! interpreter, C where there is a compiler, and with the feature `jit` Cranelift.
//!
//! All back ends make the same bits, which is tested here on every group and chart, in scalars and lanes, of steps that
//! are made and steps that are refused. So the laws are measured on one of them, the interpreter, whose steps are judged, too.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::groups::MatrixGroup;
use coadjoint::laws::check_map;
use coadjoint::{LieGroup, Phase, StepError};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::{Enclosure, Judge};
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::step::{Origin, Step};
use coadjoint_program::{Kernel, Precision, Stepper, WIDTH};
use coadjoint_tests::backends::{AnyStepper, Backend, matrix_of, numbers_of, phase_of};
use coadjoint_tests::bridge::matrix_group;
use coadjoint_tests::kernels::{SYSTEMS, integrator_by, smooth};
use coadjoint_tests::order;
use coadjoint_tests::stress::Random;
use nalgebra::DVector;

const STEP: f64 = 0.2;
/// The time at which steps begin.
const TIME: f64 = 0.1;

/// Groups beside those of [`SYSTEMS`], and these in other bases, each with a Hamiltonian that differs on every axis; on larger
/// groups the squares of coordinates whose brackets generate the algebra.
const MORE: [(&str, &str); 13] = [
    ("SO3", "a^2/3 + b^2/4 + c^2/5 + a*c/9 + a/4"),
    ("SE3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*f/9 + a/4"),
    ("U2", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + a*d/9 + a/4"),
    ("U3", "a^2/3 + c^2/5 + e^2/7 + g^2/9 + h^2/10"),
    ("SO5", "a^2/3 + e^2/7 + h^2/10 + j^2/12"),
    ("SU4", "a^2/3 + g^2/9 + k^2/13 + m^2/15"),
    ("SO3*SE3", "sum(n, 0..9, mu[n]^2/(n + 3))"),
    ("SO3^3", "sum(n, 0..9, mu[n]^2/(n + 3))"),
    ("SO3 |x R3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*f/9 + a/4"),
    ("SO3 |x Sym3", "sum(n, 0..9, mu[n]^2/(n + 3))"),
    // so(2, 1) in a skewed basis: a boost, a rotation plus half that boost, another boost.
    (
        "[algebra]\nbasis = [[[0, 0, 1], [0, 0, 0], [1, 0, 0]], [[0, -1, 0.5], [1, 0, 0], [0.5, 0, 0]], \
         [[0, 0, 0], [0, 0, 1], [0, 1, 0]]]",
        "mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5 + mu[0]*mu[2]/9 + mu[0]/4",
    ),
    // Rotations and translations of the plane with a central charge: its adjoint matrices do not see the centre.
    (
        "[algebra]\ngenerators = [\"r\", \"p\", \"q\", \"c\"]\nbrackets = [\"[r, p] = q\", \"[r, q] = -p\", \"[p, q] = c/2\"]",
        "r^2/3 + p^2/4 + q^2/5 + c^2/6 + r*c/9 + r/4",
    ),
    ("SO3*SE2", "sum(n, 0..6, mu[n]^2/(n + 3))"),
];

/// A system as a kernel, and as the runtime's group.
struct Subject {
    name: String,
    step: Step,
    group: MatrixGroup,
    order: usize,
    system: Hamiltonian,
}

impl Subject {
    fn new(name: &str, step: Step, system: Hamiltonian, truncation: usize) -> Self {
        let group = matrix_group(system.facts().algebra).unwrap();
        Self {
            name: format!("{name}, K = {truncation}"),
            step,
            group,
            order: truncation + 1,
            system,
        }
    }

    /// By a series, in each chart that the group has; the fixed point is tried with formulas of each kind.
    fn by_series(group: &str, hamiltonian: &str, truncation: usize) -> Vec<Self> {
        let algebra = integrator_by(Solver::Newton, group, hamiltonian, "exp", 1).problem.algebra;
        let cayley = lie::Chart::Cayley.check(&algebra).is_ok();
        assert_eq!(cayley, matrix_group(&algebra).unwrap().into_cayley().is_ok(), "{group}");
        let none = ["SU3", "SU4", "SO3 |x Sym3"].contains(&group) || group.contains("c/2");
        assert_eq!(cayley, !none, "{group}");
        let fixed_point = matches!(group, "SO3" | "SE3" | "SO4" | "SO3^2") && truncation == 3;
        let mut all = Vec::new();
        for chart in if cayley { &["exp", "cayley"][..] } else { &["exp"] } {
            for solver in [Solver::Newton, Solver::FixedPoint] {
                if solver == Solver::Newton || fixed_point {
                    let integrator = integrator_by(solver, group, hamiltonian, chart, truncation);
                    let step = Step::build(&integrator).unwrap();
                    let name = format!("{hamiltonian} on {group}, {chart}, {solver:?}");
                    all.push(Self::new(&name, step, integrator.problem.into(), truncation));
                }
            }
        }
        all
    }

    fn by_collocation(group: &str, hamiltonian: &str, truncation: usize) -> Self {
        let smooth = smooth(group, hamiltonian, truncation);
        let step = Origin::from(smooth.clone()).step(Precision::Double).unwrap();
        let name = format!("{hamiltonian} on {group}, collocation");
        Self::new(&name, step, Hamiltonian::Smooth(Box::new(smooth)), truncation)
    }

    /// All groups with all charts they have, and by collocation, a polynomial and functions of other kinds.
    fn all(truncation: usize) -> Vec<Self> {
        let series = SYSTEMS.into_iter().flat_map(|(g, h)| Self::by_series(g, h, truncation));
        // Without a frame, the motion of the one in a comoving frame is too fast for the step.
        let polynomials = SYSTEMS.into_iter().filter(|(_, h)| !h.ends_with("9*g"));
        let others = [
            ("SO3", "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + exp(b/3)"),
            ("SO3", "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + cos(t)*a/5 + sin(2*t)*b/7"),
            ("SE3", "ln(2 + a^2 + b^2/2) + cos(c)/3 + (3 + d^2)^(2/3) + atan(e)*f"),
        ];
        let smooth = polynomials.chain(others).map(|(g, h)| Self::by_collocation(g, h, truncation));
        let all: Vec<Self> = series.chain(smooth).collect();
        assert!(all.len() > 40, "{}", all.len());
        all
    }

    /// The coefficients of a step from a time, that takes the series seriously at any momentum.
    fn slots(&self, h: f64, time: f64) -> Vec<f64> {
        let mut slots = self.step.fold(h, &[]).unwrap();
        slots[self.step.radius_at()] = f64::MAX;
        self.step.set_time(&mut slots, h, time);
        slots
    }

    /// An element near the identity and a momentum of at most this size.
    fn draw(&self, random: &mut Random, size: f64) -> Phase<MatrixGroup> {
        let n = self.group.dim();
        let x = DVector::from_fn(n, |_, _| random.between(-0.4, 0.4));
        let mu = DVector::from_fn(n, |_, _| random.between(-size, size));
        Phase::<MatrixGroup>::new(self.group.exp(&x), mu)
    }

    fn advance(&self, slots: &[f64], phase: &mut Phase<MatrixGroup>) -> Result<(), StepError> {
        let mut g = numbers_of(&self.step, &self.group, &phase.group_element);
        let mut mu = phase.momentum.as_slice().to_vec();
        let made = self.step.kernel().advance(slots, &mut g, &mut mu, 1);
        *phase = phase_of(self.step.kernel(), &self.group, &g, &mu);
        // A refusal has no reason of its own.
        if made.steps == 1 { Ok(()) } else { Err(StepError::NonFiniteState) }
    }
}

fn laws_hold(subject: &Subject, random: &mut Random) {
    let Subject { name, group, .. } = subject;
    let [forward, backward] =
        [(STEP, TIME), (-STEP, TIME + STEP)].map(|(h, t)| subject.slots(h, t));
    let points = [(); 2].map(|()| subject.draw(random, 0.7));
    let mut there = |state: &mut Phase<MatrixGroup>| subject.advance(&forward, state);
    let mut back = |state: &mut Phase<MatrixGroup>| subject.advance(&backward, state);
    let laws = check_map(group, &mut there, Some(&mut back), &points);
    let laws = laws.unwrap_or_else(|_| panic!("{name}: refused"));
    // Adjoint matrices that do not see the centre have no logarithm, by which `symplectic` is measured.
    assert_eq!(laws.len(), if name.contains("c/2") { 6 } else { 7 }, "{name}: {laws:?}");
    for law in laws {
        assert!(law.pass(), "{name}: {law:?}");
    }
    for point in &points {
        let mut image = point.clone();
        there(&mut image).unwrap();
        assert!((&image.momentum - &point.momentum).amax() > 1e-4, "{name}: nothing moves");
        back(&mut image).unwrap();
        let scale = point.group_element.amax().max(1.0);
        let off = (&image.group_element - &point.group_element).amax() / scale;
        assert!(off <= 1e-12, "{name}: {off:e} from the start, there and back");
    }
}

/// A step is the judge's to rounding, momentum and element, and keeps the Casimirs that the kernel itself watches, and its energy as
/// far as the truncation does. On large groups long series take the judge long.
fn is_judged_right(subject: &Subject, random: &mut Random) {
    let Subject { name, step, group, .. } = subject;
    if group.dim() > 6 && subject.order > 4 {
        return;
    }
    let judge = Judge::of(&subject.system, TermLimit::default()).unwrap();
    let (slots, point) = (subject.slots(STEP, TIME), subject.draw(random, 0.7));
    let mut setting = judge.at(STEP, &[]).unwrap();
    setting.start(TIME, 0);
    let mut g = numbers_of(step, group, &point.group_element);
    let start = point.momentum.as_slice();
    let mut mu = start.to_vec();
    let (kernel, before) = (step.kernel(), matrix_of(step.kernel(), &g));
    let watched = kernel.watch(&slots, &g, &mu);
    let made = kernel.advance(&slots, &mut g, &mut mu, 1);
    assert!(made.steps == 1 && made.corrections <= 12, "{name}: {} corrections", made.corrections);
    let mut motion = Enclosure::new(start);
    motion
        .step(&mut setting, None, f64::EPSILON / 2.0)
        .unwrap_or_else(|stop| panic!("{name}: {stop:?}"));
    let off = motion.momentum_deviation(&mu);
    assert!(off < 1.0, "{name}: μ is {off:e} times the bound away");
    let off = motion.element_deviation(&before, &matrix_of(kernel, &g));
    assert!(off < 1.0, "{name}: g is {off:e} times the bound away");
    let now = kernel.watch(&slots, &g, &mu);
    let moves = step.moves() || (now[0] - watched[0]).abs() < 1e-2 * watched[0].abs();
    assert!(moves, "{name}: energy {watched:?} {now:?}");
    for (before, now) in watched.iter().zip(&now).skip(1) {
        assert!((before - now).abs() < 1e-13 * before.abs().max(1.0), "{name}: Casimir");
    }
}

fn order_holds(subject: &Subject, random: &mut Random) {
    let name = &subject.name;
    // Some motions are slow.
    let order = (0..5).find_map(|_| {
        let start = subject.draw(random, 0.9);
        order::seen(&subject.group, &start, 64, |h, steps, state| {
            let mut slots = subject.slots(h, TIME);
            (0..steps).try_for_each(|number| {
                subject.step.set_time(&mut slots, h, TIME + f64::from(number) * h);
                subject.advance(&slots, state)
            })
        })
    });
    let order = order.unwrap_or_else(|| panic!("{name}: no order seen"));
    let expected = subject.order as f64;
    // Few steps of order 8 lie between those refused and rounding.
    let within = if subject.order < 8 { 0.3 } else { 0.4 };
    assert!((order - expected).abs() < within, "{name}: order {order:.2}, not {expected}");
}

fn obey_the_laws(truncation: usize) {
    let mut random = Random::new(17);
    let more = MORE.into_iter().flat_map(|(g, h)| Subject::by_series(g, h, truncation));
    for subject in Subject::all(truncation).into_iter().chain(more) {
        laws_hold(&subject, &mut random);
        is_judged_right(&subject, &mut random);
        order_holds(&subject, &mut random);
    }
}

#[test]
fn steps_of_kernels_obey_the_laws_at_order_2() {
    obey_the_laws(1);
}

#[test]
fn steps_of_kernels_obey_the_laws_at_order_4() {
    obey_the_laws(3);
}

#[test]
fn steps_of_kernels_obey_the_laws_at_order_6() {
    obey_the_laws(5);
}

#[test]
fn steps_of_kernels_obey_the_laws_at_order_8() {
    obey_the_laws(7);
}

fn bits(list: &[f64]) -> Vec<u64> {
    // Which of the many NaNs comes out is left open by IEEE 754.
    list.iter().map(|x| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }).collect()
}

/// The states of one lane after the other as numbers side by side.
fn side_by_side(lists: &[Vec<f64>]) -> Vec<f64> {
    let length = lists.first().map_or(0, Vec::len);
    (0..length).flat_map(|i| lists.iter().map(move |list| list[i])).collect()
}

/// Trajectories from random states, the last ones driven too hard, by one back end and the kernel itself; lanes have the bits of
/// scalars.
fn has_the_bits(subject: &Subject, compiled: &AnyStepper, random: &mut Random) {
    const STEPS: u64 = 300;
    let Subject { name, step, group, .. } = subject;
    let kernel: &Kernel = step.kernel();
    let slots = subject.slots(STEP, TIME);
    let (mut elements, mut momenta) = (Vec::new(), Vec::new());
    for lane in 0..WIDTH {
        let size = if lane + 2 < WIDTH { 0.2 + 0.15 * lane as f64 } else { 1e3 };
        let phase = subject.draw(random, size);
        elements.push(numbers_of(step, group, &phase.group_element));
        momenta.push(phase.momentum.as_slice().to_vec());
    }
    let mut live = [true; WIDTH];
    live[random.below(WIDTH)] = false;
    let run = |stepper: &dyn Stepper| {
        let (mut g, mut mu) = (side_by_side(&elements), side_by_side(&momenta));
        let made = stepper.advance_lanes(&slots, &mut g, &mut mu, STEPS, live);
        (made, bits(&g), bits(&mu))
    };
    let together = run(kernel);
    assert_eq!(together, run(&**compiled), "{name}: lanes");
    assert!(together.0.contains(&STEPS) && together.0.contains(&0), "{name}: {:?}", together.0);
    for lane in 0..WIDTH {
        let run = |stepper: &dyn Stepper| {
            let (mut g, mut mu) = (elements[lane].clone(), momenta[lane].clone());
            let made = stepper.advance(&slots, &mut g, &mut mu, STEPS);
            (made, bits(&g), bits(&mu))
        };
        let alone = run(kernel);
        assert_eq!(alone, run(&**compiled), "{name}, lane {lane}");
        if live[lane] {
            assert_eq!(alone.0.steps, together.0[lane], "{name}, lane {lane}");
            let of = |list: &[u64]| list.iter().skip(lane).step_by(WIDTH).copied().collect();
            let own: [Vec<u64>; 2] = [&together.1, &together.2].map(|list| of(list));
            assert_eq!(own, [alone.1, alone.2], "{name}, lane {lane}");
        }
    }
}

#[test]
fn every_back_end_makes_the_same_bits() {
    let subjects = Subject::all(3);
    for backend in Backend::ALL {
        for (seed, subject) in subjects.iter().enumerate() {
            let Some(compiled) = backend.stepper(subject.step.kernel()) else { break };
            has_the_bits(subject, &compiled, &mut Random::new(seed as u64));
        }
    }
}
