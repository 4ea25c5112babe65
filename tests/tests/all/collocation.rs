//! Steps of collocation: errors, sweeps, energy over long runs, and refusals; `judged_collocation` compares them with the judge's.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint::collocation::{Collocation, Energy, Undefined};
use coadjoint::groups::Coordinates;
use coadjoint::{LieGroup, Phase, SE3, SO3, StepError};
use coadjoint_tests::kernels::{ROOT, SIX, SIX_MOMENTA, THREE, TOP, TextEnergy, smooth};
use nalgebra::{Vector3, Vector6};

/// The momentum after steps from the time 0.1.
fn after<G, E, const M: usize>(
    group: &G,
    energy: E,
    h: f64,
    steps: u64,
    mu: &G::Vector,
) -> G::Vector
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    let mut step = Collocation::<_, _, M>::new(group.clone(), energy, h).unwrap();
    let mut state = Phase::<G>::new(group.identity(), mu.clone());
    step.advance_by(&mut state, 0.1, steps).unwrap();
    state.momentum
}

fn distance<V: Coordinates<f64>>(a: &V, b: &V) -> f64 {
    let difference = a.clone().minus(b);
    difference.pairing(&difference).sqrt()
}

/// The errors of one step h = 0.5 with 2, 3, 4 and 5 nodes.
fn one_step(hamiltonian: &str) -> [f64; 4] {
    let (group, mu) = (SE3::new(), Vector6::from(SIX_MOMENTA));
    let smooth = smooth("SE3", hamiltonian, 1);
    let energy = &TextEnergy::closure(&smooth);
    let exact = after::<_, _, 8>(&group, energy, 0.025, 20, &mu);
    [
        distance(&after::<_, _, 2>(&group, energy, 0.5, 1, &mu), &exact),
        distance(&after::<_, _, 3>(&group, energy, 0.5, 1, &mu), &exact),
        distance(&after::<_, _, 4>(&group, energy, 0.5, 1, &mu), &exact),
        distance(&after::<_, _, 5>(&group, energy, 0.5, 1, &mu), &exact),
    ]
}

#[test]
fn one_step_errs_as_an_independent_program_does() {
    for (hamiltonian, expected) in
        [(TOP, [3.1e-6, 7.8e-9, 1.2e-11, 1.1e-14]), (SIX, [4.1e-6, 5.5e-9, 3.4e-11, 2.0e-13])]
    {
        for (found, expected) in one_step(hamiltonian).into_iter().zip(expected) {
            assert!((0.5 * expected..2.0 * expected).contains(&found), "{hamiltonian}: {found:e}");
        }
    }
}

#[test]
fn sweeps_of_a_body_with_a_root_are_few() {
    let smooth = smooth("SO3", ROOT, 7);
    let root = &TextEnergy::closure(&smooth);
    for (h, bound) in [(0.1, 3.6), (0.2, 5.7), (0.4, 9.0), (0.8, 14.0)] {
        let mut step = Collocation::<_, _, 4>::new(SO3::new(), root, h).unwrap();
        let mut body = Phase::<SO3>::at_identity(THREE);
        step.advance_by(&mut body, 0.0, 20).unwrap();
        let sweeps: u32 = (0..3000).map(|_| step.advance(&mut body, 0.0).unwrap().iterations).sum();
        let mean = f64::from(sweeps) / 3000.0;
        assert!(mean <= bound, "h = {h}: {mean:.2} sweeps a step");
    }
}

/// √(1 − μ₂²): undefined beyond |μ₂| = 1.
#[derive(Clone, Copy, Debug)]
struct Bounded;

impl Energy<Vector3<f64>> for Bounded {
    fn value(&self, _time: f64, m: &Vector3<f64>) -> f64 {
        (1.0 - m.z * m.z).sqrt() + 0.5 * m.x * m.x
    }

    fn gradient(&self, time: f64, m: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(m.x, 0.0, -m.z / (self.value(time, m) - 0.5 * m.x * m.x))
    }

    fn undefined(&self, _time: f64, m: &Vector3<f64>) -> Option<Undefined> {
        let argument = 1.0 - m.z * m.z;
        (argument <= 0.0).then_some(Undefined { expression: "sqrt(1 - mu[2]^2)", argument })
    }
}

#[test]
fn refused_steps_say_why_and_leave_the_state() {
    let refused = |h: f64, mu: [f64; 3]| {
        let mut step = Collocation::<_, _, 4>::new(SO3::new(), Bounded, h).unwrap();
        let mut state = Phase::<SO3>::at_identity(mu);
        let error = step.advance(&mut state, 3.0).unwrap_err();
        assert_eq!(state.momentum.map(f64::to_bits), Vector3::from(mu).map(f64::to_bits));
        assert_eq!(state.group_element, SO3::new().identity());
        error
    };
    let error = refused(0.1, [0.3, 0.4, 1.5]);
    assert!(
        matches!(error, StepError::Undefined { expression: "sqrt(1 - mu[2]^2)", argument: -1.25, at: None, time }
            if (time - 3.05).abs() < 0.05),
        "{error}"
    );
    // The momentum of the state is inside, that of a node outside.
    let error = refused(2.0, [0.6, 1.2, 0.2]);
    assert!(error.asks_for_smaller_step(), "{error}");
    assert!(matches!(refused(0.1, [f64::NAN, 0.0, 0.0]), StepError::NonFiniteState));
    let smooth = smooth("SO3", ROOT, 7);
    let root = &TextEnergy::closure(&smooth);
    let mut long = Collocation::<_, _, 4>::new(SO3::new(), root, 3.0).unwrap();
    let error = long.advance(&mut Phase::<SO3>::at_identity([9.0, 5.0, 7.0]), 0.0).unwrap_err();
    assert!(error.asks_for_smaller_step(), "{error}");
    let invalid = Collocation::<_, _, 4>::new(SO3::new(), root, 0.0).map(|_| ());
    assert_eq!(invalid, Err(StepError::InvalidStep { step: 0.0 }));
}

#[test]
fn a_used_step_makes_the_bits_of_a_new_one() {
    let smooth = smooth("SE3", SIX, 7);
    let six = &TextEnergy::closure(&smooth);
    let mut used = Collocation::<_, _, 4>::new(SE3::new(), six, 0.2).unwrap();
    let mut other = Phase::<SE3>::at_identity(Vector6::repeat(0.4));
    used.advance_by(&mut other, 0.0, 9).unwrap();
    let [mut a, mut b] = [(); 2].map(|()| Phase::<SE3>::at_identity(SIX_MOMENTA));
    used.advance_by(&mut a, 0.0, 9).unwrap();
    Collocation::<_, _, 4>::new(SE3::new(), six, 0.2).unwrap().advance_by(&mut b, 0.0, 9).unwrap();
    assert_eq!((a.momentum, a.group_element), (b.momentum, b.group_element));
}

/// The mean change of the energy of a body with a root in each quarter of a run of 10⁶ steps: a trend would be a drift.
#[test]
#[ignore = "minutes in release mode; the figures are in docs/measurements/collocation.md"]
fn energy_does_not_drift_over_a_million_steps() {
    let quarter = 250_000;
    let smooth = smooth("SO3", ROOT, 7);
    let root = &TextEnergy::closure(&smooth);
    let mut step = Collocation::<_, _, 4>::new(SO3::new(), root, 0.4).unwrap();
    let mut body = Phase::<SO3>::at_identity(THREE);
    let start = root.value(0.0, &body.momentum);
    let mut means = [0.0; 4];
    for mean in &mut means {
        for _ in 0..quarter {
            step.advance(&mut body, 0.0).unwrap();
            *mean += (root.value(0.0, &body.momentum) - start) / f64::from(quarter);
        }
    }
    println!("mean change of the energy by quarters: {means:.2?}");
    assert!((means[3] - means[0]).abs() < 1e-11, "{means:?}");
}
