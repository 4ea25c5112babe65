//! Steps of collocation: errors, orders, laws, sweeps, energy over long runs, and refusals.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::{Coordinates, SE2, SL2, SU2};
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_tests::bridge::matrix_group;
use coadjoint_tests::energies::{Any, Driven, Root, SIX, Six, Spin, THREE, Top};
use nalgebra::{DVector, Vector3, Vector6};

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
fn one_step<G, E>(group: &G, energy: E, mu: &G::Vector) -> [f64; 4]
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector> + Copy,
{
    let exact = after::<_, _, 8>(group, energy, 0.025, 20, mu);
    [
        distance(&after::<_, _, 2>(group, energy, 0.5, 1, mu), &exact),
        distance(&after::<_, _, 3>(group, energy, 0.5, 1, mu), &exact),
        distance(&after::<_, _, 4>(group, energy, 0.5, 1, mu), &exact),
        distance(&after::<_, _, 5>(group, energy, 0.5, 1, mu), &exact),
    ]
}

#[test]
fn one_step_errs_as_an_independent_program_does() {
    // The same method in another program, in both charts.
    let tables = matrix_group(&coadjoint_codegen::lie::catalogue::lookup("SE3").unwrap()).unwrap();
    let mu = Vector6::from(SIX);
    let long = DVector::from_column_slice(&SIX);
    let at = |v: &DVector<f64>| Vector6::from_column_slice(v.as_slice());
    let erase = |g: Vector6<f64>| DVector::from_column_slice(g.as_slice());
    let top = (
        |t: f64, v: &DVector<f64>| Top.value(t, &at(v)),
        |t: f64, v: &DVector<f64>| erase(Top.gradient(t, &at(v))),
    );
    let six = (
        |t: f64, v: &DVector<f64>| Six.value(t, &at(v)),
        |t: f64, v: &DVector<f64>| erase(Six.gradient(t, &at(v))),
    );
    for (name, found, expected) in [
        ("top, Cayley", one_step(&SE3::new(), Top, &mu), [2.6e-6, 6.4e-8, 9.5e-11, 2.8e-13]),
        ("six, Cayley", one_step(&SE3::new(), Six, &mu), [9.0e-6, 2.3e-8, 4.1e-11, 2.0e-13]),
        ("top, exp", one_step(&tables, top, &long), [3.1e-6, 7.8e-9, 1.2e-11, 1.1e-14]),
        ("six, exp", one_step(&tables, six, &long), [4.1e-6, 5.5e-9, 3.4e-11, 2.0e-13]),
    ] {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((0.5 * expected..2.0 * expected).contains(&found), "{name}: {found:e}");
        }
    }
}

/// The order from the errors after the time 2.4 in steps of two sizes.
fn order<G, E, const M: usize>(group: &G, energy: E, mu: &G::Vector, [long, short]: [f64; 2]) -> f64
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector> + Copy,
{
    let time = 2.4;
    let exact = after::<_, _, 8>(group, energy, 0.04, 60, mu);
    let error = |h: f64| {
        let end = after::<_, _, M>(group, energy, h, (time / h).round() as u64, mu);
        distance(&end, &exact)
    };
    (error(long) / error(short)).ln() / (long / short).ln()
}

#[test]
fn orders_are_twice_the_number_of_nodes() {
    let three = Vector3::from(THREE);
    let six = Vector6::from(SIX);
    let spin = Vector3::new(1.2, -0.5, 0.8);
    let found = [
        ("root 1", order::<_, _, 1>(&SO3::new(), Root, &three, [0.05, 0.025]), 2.0),
        ("root 2", order::<_, _, 2>(&SO3::new(), Root, &three, [0.1, 0.05]), 4.0),
        ("root 3", order::<_, _, 3>(&SO3::new(), Root, &three, [0.2, 0.1]), 6.0),
        ("root 4", order::<_, _, 4>(&SO3::new(), Root, &three, [0.4, 0.3]), 8.0),
        ("root 5", order::<_, _, 5>(&SO3::new(), Root, &three, [0.8, 0.6]), 10.0),
        ("spin 2", order::<_, _, 2>(&SO3::new(), Spin, &spin, [0.1, 0.05]), 4.0),
        ("spin 3", order::<_, _, 3>(&SU2::new(), Spin, &spin, [0.2, 0.1]), 6.0),
        ("spin 4", order::<_, _, 4>(&SO3::new(), Spin, &spin, [0.6, 0.4]), 8.0),
        ("driven 2", order::<_, _, 2>(&SO3::new(), Driven, &three, [0.1, 0.05]), 4.0),
        ("driven 3", order::<_, _, 3>(&SO3::new(), Driven, &three, [0.1, 0.05]), 6.0),
        ("driven 4", order::<_, _, 4>(&SO3::new(), Driven, &three, [0.15, 0.1]), 8.0),
        ("top 5", order::<_, _, 5>(&SE3::new(), Top, &six, [0.8, 0.6]), 10.0),
        ("any 5", order::<_, _, 5>(&SE2::new(), Any, &three, [0.8, 0.6]), 10.0),
        ("tables 5", order::<_, _, 5>(&SL2::new(), Any, &three, [0.6, 0.48]), 10.0),
        ("six 1", order::<_, _, 1>(&SE3::new(), Six, &six, [0.05, 0.025]), 2.0),
        ("six 2", order::<_, _, 2>(&SE3::new(), Six, &six, [0.1, 0.05]), 4.0),
        ("six 3", order::<_, _, 3>(&SE3::new(), Six, &six, [0.2, 0.1]), 6.0),
        ("six 4", order::<_, _, 4>(&SE3::new(), Six, &six, [0.4, 0.3]), 8.0),
    ];
    for (name, found, expected) in found {
        assert!((found - expected).abs() < 0.15, "{name} nodes: order {found:.3}");
    }
}

#[test]
fn sweeps_of_a_body_with_a_root_are_few() {
    for (h, bound) in [(0.1, 3.6), (0.2, 5.7), (0.4, 9.0), (0.8, 14.0)] {
        let mut step = Collocation::<_, _, 4>::new(SO3::new(), Root, h).unwrap();
        let mut body = Phase::<SO3>::at_identity(THREE);
        step.advance_by(&mut body, 0.0, 20).unwrap();
        let sweeps: u32 = (0..3000).map(|_| step.advance(&mut body, 0.0).unwrap().iterations).sum();
        let mean = f64::from(sweeps) / 3000.0;
        assert!(mean <= bound, "h = {h}: {mean:.2} sweeps a step");
    }
}
