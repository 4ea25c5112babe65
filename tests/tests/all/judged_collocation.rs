//! Steps by collocation, of the runtime and of kernels, and their judge, which shares only the formula of the Hamiltonian with them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint::collocation::Collocation;
use coadjoint::groups::{Coordinates, DirectProduct, Heisenberg, Product, SE2, SL2, SO4, SU2, SU3};
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_codegen::judge::{DoubleDouble, Enclosure, Judge, JudgeError};
use coadjoint_codegen::step::Origin;
use coadjoint_program::{Precision, Stepper};
use coadjoint_tests::backends::entries_of;
use coadjoint_tests::bridge::named;
use coadjoint_tests::kernels::{
    ANY, DRIVEN, ROOT, SIX, SIX_MOMENTA, SPIN, THREE, TOP, TextEnergy, smooth,
};
use coadjoint_tests::stress::Random;

const START: f64 = 0.1;

/// The momentum that the judge's step leads to, in doubled precision.
fn end(judge: &Judge, h: f64, mu: &[f64]) -> Vec<DoubleDouble> {
    let mut setting = judge.at(h, &[]).unwrap();
    setting.start(START, 0);
    let step = setting.step(mu).unwrap();
    let end = step.end(&step.right_solution().unwrap(), f64::EPSILON / 2.0).unwrap();
    end.momentum.iter().map(|mu| mu.scaled(end.scale)).collect()
}

/// One step errs with one power more than the order, beside a step with eight nodes: orders 2 to 10 of a field that moves,
/// and 2 to 8 of all functions, of which shorter steps with five nodes err by the rounding of the judge.
#[test]
fn steps_of_the_judge_have_the_orders_of_their_nodes() {
    let all = "exp(a/3) + ln(2 + b) + sin(c)/2 + cos(a + t) + tan(b/4) + atan(c) + tanh(a) \
        + (3 + c)^(2/3)";
    for (energy, most) in [(DRIVEN, 5), (all, 4)] {
        let judge = |nodes: usize| Judge::of_smooth(&smooth("SO3", energy, 2 * nodes - 1)).unwrap();
        let exact = judge(8);
        for nodes in 1..=most {
            let judge = judge(nodes);
            let error = |h| {
                let pairs = end(&judge, h, &THREE).into_iter().zip(end(&exact, h, &THREE));
                pairs.map(|(a, b)| (a - b).to_f64().powi(2)).sum::<f64>().sqrt()
            };
            let order = (error(0.04) / error(0.02)).log2() - 1.0;
            assert!((order - 2.0 * nodes as f64).abs() < 0.15, "{energy}, {nodes} nodes: {order}");
        }
    }
}

/// Compares the end of a step with the judge's, within the judge's bound.
fn is_judged_right(judge: &Judge, (h, mu): (f64, &[f64]), end: &[f64]) {
    let mut motion = Enclosure::new(mu);
    let mut setting = judge.at(h, &[]).unwrap();
    setting.start(START, 0);
    motion.step(&mut setting, None, f64::EPSILON / 2.0).unwrap();
    for (found, exact) in end.iter().zip(motion.momentum()) {
        assert!((found - exact).abs() < 4e-15, "{found} {exact}");
    }
    let deviation = motion.momentum_deviation(end);
    assert!(deviation < 1.0, "h = {h}: {deviation}");
}

/// A step of the runtime, and one of the kernel on the group of this name, in steps of these lengths.
fn are_judged_right<G: LieGroup<Scalar = f64>, const M: usize>(
    group: &G,
    (name, hamiltonian): (&str, &str),
    mu: &[f64],
    lengths: &[f64],
) {
    let smooth = smooth(name, hamiltonian, 2 * M - 1);
    let judge = Judge::of_smooth(&smooth).unwrap();
    let step = Origin::from(smooth.clone()).step(Precision::Double).unwrap();
    for &h in lengths {
        let energy = TextEnergy::closure(&smooth);
        let mut generic = Collocation::<_, _, M>::new(group.clone(), energy, h).unwrap();
        let start = G::Vector::from_entries(mu.len(), |i| mu[i]);
        let mut state = Phase::<G>::new(group.identity(), start);
        let sweeps = generic.advance(&mut state, START).unwrap().iterations;
        let end: Vec<f64> = (0..mu.len()).map(|i| state.momentum[i]).collect();
        is_judged_right(&judge, (h, mu), &end);
        let mut slots = step.fold(h, &[]).unwrap();
        step.set_time(&mut slots, h, START);
        let (mut g, mut end) =
            (step.element_of(&entries_of(group, &group.identity())), mu.to_vec());
        let made = step.kernel().advance(&slots, &mut g, &mut end, 1);
        assert_eq!(made.steps, 1, "{name}, {M} nodes, {h}");
        assert!(
            made.corrections <= sweeps + 1,
            "{name}, {M} nodes, {h}: {} {sweeps}",
            made.corrections
        );
        is_judged_right(&judge, (h, mu), &end);
        let apart = step.kernel().programs.matrix.run(&g, &[]).into_iter();
        let apart = apart.zip(entries_of(group, &state.group_element)).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-13, "{name}, {M} nodes, {h}");
    }
}

/// With one node, two and four.
fn steps_are_judged_right<G: LieGroup<Scalar = f64>>(group: &G, name: &str, hamiltonian: &str) {
    let mu: Vec<f64> = (0..group.dim()).map(|i| 0.6 - 0.17 * i as f64).collect();
    are_judged_right::<G, 1>(group, (name, hamiltonian), &mu, &[0.05]);
    are_judged_right::<G, 2>(group, (name, hamiltonian), &mu, &[0.05, 0.15]);
    are_judged_right::<G, 4>(group, (name, hamiltonian), &mu, &[0.05, 0.15, 0.3]);
}

#[test]
fn steps_of_the_runtime_and_of_kernels_are_those_of_the_judge_to_rounding() {
    let lengths = [0.05, 0.2, 0.5];
    are_judged_right::<_, 4>(&SO3::new(), ("SO3", ROOT), &THREE, &lengths);
    are_judged_right::<_, 3>(&SO3::new(), ("SO3", DRIVEN), &THREE, &lengths);
    are_judged_right::<_, 4>(&SE3::new(), ("SE3", SIX), &SIX_MOMENTA, &lengths);
    are_judged_right::<_, 5>(&SE3::new(), ("SE3", TOP), &SIX_MOMENTA, &lengths);
    are_judged_right::<_, 2>(&named("SL2"), ("SL2", ANY), &THREE, &lengths.map(|h| 0.5 * h));
    are_judged_right::<_, 4>(&named("SL2"), ("SL2", ANY), &THREE, &lengths.map(|h| 0.5 * h));
    let root = "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + b^3/10";
    steps_are_judged_right(&SO3::new(), "SO3", "exp(-a/2)/3 + a + b*sin(2*t)/4 + ln(2 + c)*cos(t)");
    steps_are_judged_right(&SU2::new(), "SU2", root);
    steps_are_judged_right(&SO3::new(), "SO3", SPIN);
    steps_are_judged_right(&SU2::new(), "SU2", SPIN);
    steps_are_judged_right(&SE2::new(), "SE2", ANY);
    let plane = "exp(a/3) + b^2/2 + c^2/3";
    steps_are_judged_right(&SE2::new(), "SE2", plane);
    let six = "sqrt(1 + a^2 + b^2/2 + c^2/3) + exp(d/5) + e^2/3 + 1/(2 + f^2) + a*d/7";
    steps_are_judged_right(&SE3::new(), "SE3", six);
    // By tables.
    steps_are_judged_right(&named("SU2"), "SU2", root);
    steps_are_judged_right(&named("SE2"), "SE2", plane);
    steps_are_judged_right(&named("SE3"), "SE3", six);
    steps_are_judged_right(&Heisenberg::new(), "Heisenberg", root);
    steps_are_judged_right(&SL2::new(), "SL2", root);
    steps_are_judged_right(&SO4::new(), "SO4", six);
    let product = DirectProduct::new(vec![named("SO3"), named("SO3")]);
    steps_are_judged_right(&product, "SO3^2", six);
    steps_are_judged_right(&Product::<SO3, SE2, 6>::new(), "SO3*SE2", six);
    let eight = "sqrt(1 + a^2 + b^2/2 + c^2/3) + exp(d/5) + e^2/3 + g*h/4 + f/3";
    steps_are_judged_right(&SU3::new(), "SU3", eight);
}

/// Of steps of all lengths from random momenta, those that a kernel accepts the runtime accepts too, and both end alike.
fn accepted<G: LieGroup<Scalar = f64>, const M: usize>(group: &G, name: &str, hamiltonian: &str) {
    let smooth = smooth(name, hamiltonian, 2 * M - 1);
    let step = Origin::from(smooth.clone()).step(Precision::Double).unwrap();
    let mut random = Random::new(17);
    let [mut by_kernel, mut by_runtime] = [0, 0];
    for _ in 0..400 {
        let mu: Vec<f64> = (0..group.dim()).map(|_| random.between(-1.0, 1.0)).collect();
        let h = 10_f64.powf(random.between(-1.3, 0.6));
        let mut generic =
            Collocation::<_, _, M>::new(group.clone(), TextEnergy::closure(&smooth), h).unwrap();
        let start = G::Vector::from_entries(mu.len(), |i| mu[i]);
        let mut state = Phase::<G>::new(group.identity(), start);
        let other = generic.advance(&mut state, 0.0);
        by_runtime += u32::from(other.is_ok());
        let (mut g, mut moved) =
            (step.element_of(&entries_of(group, &group.identity())), mu.clone());
        let slots = step.fold(h, &[]).unwrap();
        if step.kernel().advance(&slots, &mut g, &mut moved, 1).steps == 0 {
            continue;
        }
        by_kernel += 1;
        assert!(other.is_ok(), "{name}, {M} nodes: h = {h}, {mu:?}: {other:?}");
        let apart = (0..mu.len()).map(|i| (moved[i] - state.momentum[i]).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-11, "{name}, {M} nodes: h = {h}, {mu:?}");
    }
    // The formulas of kernels end at a quarter turn.
    let many = 5 * by_kernel > 4 * by_runtime && by_kernel < 400;
    assert!(many, "{name}, {M} nodes: {by_kernel} {by_runtime}");
}

#[test]
fn kernels_accept_what_the_runtime_accepts() {
    let root = "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + b^3/10 + exp(a)/4";
    accepted::<_, 1>(&named("SO3"), "SO3", root);
    accepted::<_, 2>(&named("SO3"), "SO3", root);
    accepted::<_, 3>(&named("SO3"), "SO3", root);
    accepted::<_, 4>(&named("SO3"), "SO3", root);
    accepted::<_, 1>(&SL2::new(), "SL2", root);
    accepted::<_, 3>(&SL2::new(), "SL2", root);
    let six = "sqrt(1 + a^2 + b^2/2 + c^2/3) + exp(d/5) + e^2/3 + 1/(2 + f^2) + a*d/7";
    accepted::<_, 2>(&named("SE3"), "SE3", six);
    accepted::<_, 4>(&named("SE3"), "SE3", six);
}

#[test]
fn what_has_no_value_is_not_judged() {
    let judge = smooth("SO3", "ln(a) + b^2", 3);
    let judge = Judge::of_smooth(&judge).unwrap();
    let mut setting = judge.at(0.1, &[]).unwrap();
    assert!(setting.step(&[1.0, 0.2, 0.3]).unwrap().right_solution().is_ok());
    assert!(matches!(setting.step(&[-1.0, 0.2, 0.3]), Err(JudgeError::Undefined)));
    assert!(matches!(setting.step(&[f64::NAN, 0.2, 0.3]), Err(JudgeError::NotFinite { .. })));
    let step = setting.step(&[1.0, 0.2, 0.3]).unwrap();
    assert!(matches!(step.at(&[0.0; 3]), Err(JudgeError::Length { expected: 12, .. })));
}
