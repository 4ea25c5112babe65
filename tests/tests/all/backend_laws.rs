//! The laws of maps for the steps of kernels, on every group and chart, through every back end of the machine: the
//! interpreter, C where there is a compiler, and with the feature `jit` Cranelift.
//!
//! All back ends make the same bits, which is tested here on every group and chart, in scalars and lanes, of steps that
//! are made and steps that are refused. So the laws are measured on one of them, the interpreter.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::groups::MatrixGroup;
use coadjoint::laws::check_map;
use coadjoint::{LieGroup, Phase, StepError};
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::step::{Origin, Step};
use coadjoint_program::{Kernel, Precision, Stepper, WIDTH};
use coadjoint_tests::backends::{AnyStepper, Backend, numbers_of, phase_of};
use coadjoint_tests::bridge::matrix_group;
use coadjoint_tests::kernels::{SYSTEMS, integrator_by, smooth, unlimited};
use coadjoint_tests::order;
use coadjoint_tests::stress::Random;
use nalgebra::DVector;

/// The truncation of all series, and the step that laws are tried with.
const TRUNCATION: usize = 3;
const STEP: f64 = 0.2;

/// A system as a kernel, and as the runtime's group.
struct Subject {
    name: String,
    step: Step,
    group: MatrixGroup,
}

impl Subject {
    /// All groups with all charts they have.
    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for (group, hamiltonian) in SYSTEMS {
            let algebra = lie::catalogue::lookup(group).unwrap();
            for chart in ["exp", "cayley"] {
                if chart == "cayley" && lie::Chart::Cayley.check(&algebra).is_err() {
                    continue;
                }
                for solver in [Solver::Newton, Solver::FixedPoint] {
                    // The fixed point is tried once with formulas of each kind.
                    let tried = matches!(group, "SO3" | "SE3" | "SO4" | "SO3^2");
                    if solver == Solver::FixedPoint && !tried {
                        continue;
                    }
                    let integrator = integrator_by(solver, group, hamiltonian, chart, TRUNCATION);
                    let step = Step::build(&integrator).unwrap();
                    let group = matrix_group(&algebra).unwrap();
                    let name = format!("{hamiltonian} on {}, {chart}, {solver:?}", algebra.name());
                    all.push(Self { name, step, group });
                }
            }
        }
        // By collocation, a polynomial and a function of other kinds.
        // Without a frame, the motion of the one in a comoving frame is too fast for the step.
        let systems = SYSTEMS.into_iter().filter(|(_, hamiltonian)| !hamiltonian.ends_with("9*g"));
        for (group, hamiltonian) in systems.chain([
            ("SO3", "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + exp(b/3)"),
            ("SE3", "ln(2 + a^2 + b^2/2) + cos(c)/3 + (3 + d^2)^(2/3) + atan(e)*f"),
        ]) {
            let smooth = smooth(group, hamiltonian, TRUNCATION);
            let step = Origin::from(smooth.clone()).step(Precision::Double).unwrap();
            let group = matrix_group(&smooth.algebra).unwrap();
            let name = format!("{hamiltonian} on {}, collocation", smooth.algebra.name());
            all.push(Self { name, step, group });
        }
        assert!(all.len() > 40, "{}", all.len());
        all
    }

    fn slots(&self, h: f64) -> Vec<f64> {
        unlimited(&self.step, h)
    }

    /// An element near the identity and a momentum of at most this size.
    fn draw(&self, random: &mut Random, size: f64) -> Phase<MatrixGroup> {
        let n = self.group.dim();
        let x = DVector::from_fn(n, |_, _| random.between(-0.4, 0.4));
        let mu = DVector::from_fn(n, |_, _| random.between(-size, size));
        Phase::<MatrixGroup>::new(self.group.exp(&x), mu)
    }

    fn advance(
        &self,
        stepper: &dyn Stepper,
        slots: &[f64],
        phase: &mut Phase<MatrixGroup>,
        steps: u64,
    ) -> Result<(), StepError> {
        let mut g = numbers_of(&self.step, &self.group, &phase.group_element);
        let mut mu = phase.momentum.as_slice().to_vec();
        let made = stepper.advance(slots, &mut g, &mut mu, steps);
        *phase = phase_of(self.step.kernel(), &self.group, &g, &mu);
        // A refusal has no reason of its own.
        if made.steps == steps { Ok(()) } else { Err(StepError::NonFiniteState) }
    }
}

fn laws_hold(subject: &Subject, stepper: &dyn Stepper, random: &mut Random) {
    let Subject { name, group, .. } = subject;
    let (forward, backward) = (subject.slots(STEP), subject.slots(-STEP));
    let points = [(); 2].map(|()| subject.draw(random, 0.7));
    let mut there = |state: &mut Phase<MatrixGroup>| subject.advance(stepper, &forward, state, 1);
    let mut back = |state: &mut Phase<MatrixGroup>| subject.advance(stepper, &backward, state, 1);
    let laws = check_map(group, &mut there, Some(&mut back), &points);
    let laws = laws.unwrap_or_else(|_| panic!("{name}: refused"));
    assert_eq!(laws.len(), 7, "{name}: {laws:?}");
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

fn order_holds(subject: &Subject, stepper: &dyn Stepper, random: &mut Random) {
    let name = &subject.name;
    // Some motions are slow.
    let order = (0..5).find_map(|_| {
        let start = subject.draw(random, 0.9);
        order::seen(&subject.group, &start, 64, |h, steps, state| {
            subject.advance(stepper, &subject.slots(h), state, u64::from(steps))
        })
    });
    let order = order.unwrap_or_else(|| panic!("{name}: no order seen"));
    let expected = TRUNCATION as f64 + 1.0;
    assert!((order - expected).abs() < 0.3, "{name}: order {order:.2}, not {expected}");
}

#[test]
fn steps_of_kernels_obey_the_laws() {
    let mut random = Random::new(17);
    for subject in Subject::all() {
        let stepper = Backend::Interpreter.stepper(subject.step.kernel()).unwrap();
        laws_hold(&subject, &*stepper, &mut random);
        order_holds(&subject, &*stepper, &mut random);
    }
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
    let slots = subject.slots(STEP);
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
    let subjects = Subject::all();
    for backend in Backend::ALL {
        for (seed, subject) in subjects.iter().enumerate() {
            let Some(compiled) = backend.stepper(subject.step.kernel()) else { break };
            has_the_bits(subject, &compiled, &mut Random::new(seed as u64));
        }
    }
}
