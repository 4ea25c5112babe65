//! Potentials: the torque derived from V(g), and the quantities that its kicks conserve (the kicks: `kicked.rs`).
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::{LieGroup, SO3, potential};
use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::number::{Rational, integer};
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::potential::{Force, Potential};
use coadjoint_codegen::system::{Options, Parameters, System, read};
use coadjoint_tests::backends::entries_of;
use coadjoint_tests::bridge::matrix_group;
use nalgebra::{DVector, UnitQuaternion, Vector3};

const INERTIA: [f64; 3] = [1.0, 1.25, 1.5];

/// Gravity gradient, 3/2 r·Ir with r = gᵀ·earth.
#[potential(group = SO3)]
fn gravity_gradient(g: [[f64; 3]; 3], inertia: [f64; 3], earth: [f64; 3]) -> f64 {
    let mut sum = 0.0;
    for i in 0..3 {
        let r = g[0][i] * earth[0] + g[1][i] * earth[1] + g[2][i] * earth[2];
        sum += 1.5 * inertia[i] * r * r;
    }
    sum
}

/// The torque of a satellite whose Earth goes round.
pub fn torque(time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
    let earth = [time.cos(), time.sin(), 0.0];
    GravityGradient::new(INERTIA, earth).map_or(Vector3::repeat(f64::NAN), |v| v.torque(attitude))
}

fn attitude() -> UnitQuaternion<f64> {
    SO3::new().exp(&Vector3::new(0.4, -0.7, 0.2))
}

/// 3 r × Ir, P. C. Hughes, *Spacecraft Attitude Dynamics*, 1986, section 9.1.
fn hand_written(earth: [f64; 3], attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
    let r = attitude.inverse() * Vector3::from(earth);
    r.cross(&Vector3::from(INERTIA).component_mul(&r)) * 3.0
}

#[test]
fn the_derived_torque_is_the_hand_written_one() {
    let earth = [0.36, 0.48, 0.8];
    let derived = GravityGradient::<f64>::new(INERTIA, earth).unwrap();
    let torque = derived.torque(&attitude());
    let expected = hand_written(earth, &attitude());
    assert!((torque - expected).amax() < 1e-15 && expected.amax() > 0.1, "{torque} {expected}");
    let m = attitude().to_rotation_matrix();
    let g = [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)]));
    let energy = derived.energy(&attitude());
    assert!((energy - gravity_gradient(g, INERTIA, earth)).abs() < 1e-15);
    assert!(GravityGradient::new(INERTIA, [f64::NAN, 0.0, 0.0]).is_err());
}

/// The system file with these lines before an initial state that is not used.
fn system(lines: &str) -> System {
    let options = Options { parameters: Parameters::Substituted, ..Default::default() };
    read(lines, options).unwrap_or_else(|d: Diagnostics| panic!("{}", d.render("file", lines)))
}

fn of_file(lines: &str) -> Potential {
    system(lines).potential.unwrap().0
}

/// Component k is −d/ds V(g·exp(s e_k)), by differences of eighth order, on a group of matrices,
/// on one of block matrices, and on one of adjoint matrices.
#[test]
fn the_torque_is_minus_the_derivative_of_the_potential() {
    for file in [
        "group = \"SO3\"\nhamiltonian = \"mu[0]^2\"\npotential = \"g[0][1]^3 - 2*g[2][2]*g[1][0] + g[0][0]/3\"",
        "group = \"SE3\"\nhamiltonian = \"mu[0]^2\"\npotential = \"g[0][3]^2*g[1][1] + g[2][3]*g[0][2] - g[1][3]\"",
        "group = \"SO3*SO2\"\nhamiltonian = \"mu[0]^2\"\npotential = \"(g[0][0]*g[3][3] + g[1][0]*g[4][3])^2 - g[2][1]\"",
        "hamiltonian = \"a^2\"\npotential = \"g[0][1]^2 + g[2][0]*g[1][1]\"\n[algebra]\ngenerators = [\"a\", \"b\", \"c\"]\nbrackets = [\"[a, b] = 2*b\", \"[a, c] = -2*c\", \"[b, c] = a\"]",
    ] {
        let potential = of_file(file);
        let group = matrix_group(&potential.algebra).unwrap();
        let n = group.dim();
        let x = DVector::from_fn(n, |i, _| 0.3 - 0.17 * i as f64);
        let g = group.exp(&x);
        let Force::Polynomial(energy) = &potential.force else { panic!("no polynomial") };
        for (k, torque) in potential.torque(energy).iter().enumerate() {
            let value = |s: f64| {
                let mut turn = DVector::zeros(n);
                turn[k] = s;
                energy.evaluate(&entries_of(&group, &group.compose(&g, &group.exp(&turn))))
            };
            // B. Fornberg, Math. Comp. 51 (1988) 699, table 1.
            let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
            let h = 0.01;
            let slope: f64 = weights
                .iter()
                .zip(1..)
                .map(|(w, j)| w * (value(h * f64::from(j)) - value(-h * f64::from(j))) / h)
                .sum();
            let exact = torque.evaluate(&entries_of(&group, &g));
            assert!((exact + slope).abs() < 1e-12, "{file}: component {k}: {exact} and {slope}");
        }
    }
}

fn kernel(file: &str) -> Vec<Vec<Rational>> {
    let potential = of_file(file);
    let Force::Polynomial(energy) = &potential.force else { panic!("no polynomial") };
    potential.symmetries(energy)
}

#[test]
fn symmetries_that_are_left() {
    let unit = |entries: &[i64]| entries.iter().map(|&x| integer(x)).collect::<Vec<_>>();
    let top = "group = \"SO3\"\nhamiltonian = \"mu[0]^2\"\npotential = \"2*g[2][2] + g[2][0]^2\"";
    assert_eq!(kernel(top), [unit(&[0, 0, 1])], "turning about the vertical");
    let pulled = "group = \"SO3\"\nhamiltonian = \"mu[0]^2\"\npotential = \"g[2][2] + g[0][1]\"";
    assert!(kernel(pulled).is_empty());
    let file = include_str!("../../../examples/satellite.toml");
    assert_eq!(kernel(file), [unit(&[0, 0, 1, 1])], "attitude and orbit together");
}

#[test]
fn casimirs_that_survive() {
    let potential = of_file(
        "group = \"SO3*SO3\"\nhamiltonian = \"mu[0]^2\"\npotential = \"g[3][5] + g[4][4]^2\"",
    );
    let norm = |from: usize| {
        let square = |i: usize| (vec![(i as u32, 2)], integer(1));
        Polynomial::from_factors(6, (from..from + 3).map(square))
    };
    assert!(potential.keeps(&norm(0)));
    assert!(!potential.keeps(&norm(3)));
}

/// The matrices of a group known by its brackets are the adjoint ones.
#[test]
fn sizes() {
    let size = |name| coadjoint_codegen::lie::catalogue::lookup(name).unwrap().matrix_size();
    assert_eq!([size("SO3*SO2"), size("SU3")], [5, 6]);
}
