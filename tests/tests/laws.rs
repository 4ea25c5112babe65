//! The laws of MATH.md for the derived series: every group × chart × K ∈ {1, 3, 5, 7}.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::laws::{OrderError, check, measured_order};
use coadjoint::{
    Cayley, Chart, Coordinates, Exponential, LieGroup, MatrixGroup, Phase, SE3, SO3, advance,
};
use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::lie::{Chart as ChartName, LieAlgebra};
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_tests::bridge::{matrix_group, series_function};

/// Numbers in (−1, 1) from a fixed seed.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Σ μ_i²/(i + 3) + μ_0 μ_last/9 + μ_0/4: different on every axis, with a cross and a linear term.
fn hamiltonian(dim: usize, simple: bool) -> Polynomial {
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let unit = |entries: &[(usize, u32)]| {
        let mut exponents = vec![0; dim];
        for &(i, power) in entries {
            exponents[i] += power;
        }
        exponents
    };
    let mut terms: Vec<_> = (0..dim).map(|i| (unit(&[(i, 2)]), ratio(1, i as i64 + 3))).collect();
    if !simple {
        terms.push((unit(&[(0, 1), (dim - 1, 1)]), ratio(1, 9)));
        terms.push((unit(&[(0, 1)]), ratio(1, 4)));
    }
    Polynomial::from_terms(dim, terms)
}

fn random_phase<G: LieGroup<Scalar = f64>>(group: &G, random: &mut Random) -> Phase<G> {
    let mut vector = |size: f64| G::Vector::from_entries(group.dim(), |_| size * random.number());
    let x = vector(0.4);
    let mu = vector(1.0);
    Phase::new(group.exp(&x), mu)
}

/// Runs every law for one group, chart and truncation, and returns the measured order.
fn laws_hold<G, C>(
    name: &str,
    group: &G,
    chart: C,
    algebra: &LieAlgebra,
    truncation: usize,
    simple: bool,
) where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let kind = if C::NAME == "exp" { ChartName::Exponential } else { ChartName::Cayley };
    let h = hamiltonian(algebra.dim(), simple);
    let series = derive(algebra, kind, &h, truncation, TermLimit::new(2_000_000)).unwrap();
    let what = format!("{name}, {}, K = {truncation}", C::NAME);

    let mut random = Random(17);
    let count = if algebra.dim() > 4 { 1 } else { 2 };
    let points: Vec<_> = (0..count).map(|_| random_phase(group, &mut random)).collect();
    let map = series_function(group.clone(), chart, &series, 0.3).unwrap();
    let backward = series_function(group.clone(), chart, &series, -0.3).unwrap();
    for law in check(&map, Some(&backward), &points).unwrap() {
        assert!(law.pass(), "{what}: {} {:e} exceeds {:e}", law.name, law.value, law.bound);
    }

    // The finest halving still well above rounding shows the order best. Coarse steps may fail.
    let mut order = None;
    for steps in [1, 2, 4, 8, 16, 32] {
        let measured = measured_order(group, &points[0], 4.0, steps, |h, steps, state| {
            let map = series_function(group.clone(), chart, &series, h).unwrap();
            (0..steps).try_for_each(|_| advance(&map, state).map(|_| ()))
        });
        match measured {
            Ok(value) => order = Some(value),
            Err(OrderError::OutOfRange { fine, .. }) if fine < 1e-12 => break,
            Err(_) => {}
        }
    }
    let order = order.unwrap_or_else(|| panic!("{what}: no order seen"));
    let expected = truncation as f64 + 1.0;
    assert!((order - expected).abs() < 0.3, "{what}: order {order:.2}, not {expected}");
}

fn every_chart(name: &str, truncations: &[usize], simple: bool) {
    let algebra = lookup(name).unwrap();
    let group = matrix_group(&algebra).unwrap();
    for &truncation in truncations {
        laws_hold(name, &group, Exponential, &algebra, truncation, simple);
        if let Ok(group) = group.clone().into_cayley() {
            assert!(ChartName::Cayley.check(&algebra).is_ok());
            laws_hold(name, &group, Cayley, &algebra, truncation, simple);
        } else {
            assert!(ChartName::Cayley.check(&algebra).is_err());
        }
    }
}

#[test]
fn rotations_in_closed_form() {
    let algebra = lookup("SO3").unwrap();
    for truncation in [1, 3, 5, 7] {
        laws_hold("SO3 closed", &SO3::new(), Exponential, &algebra, truncation, false);
        laws_hold("SO3 closed", &SO3::new(), Cayley, &algebra, truncation, false);
    }
}

#[test]
fn rigid_motions_in_closed_form() {
    let algebra = lookup("SE3").unwrap();
    for truncation in [1, 3, 5, 7] {
        laws_hold("SE3 closed", &SE3::new(), Exponential, &algebra, truncation, false);
        laws_hold("SE3 closed", &SE3::new(), Cayley, &algebra, truncation, false);
    }
}

#[test]
fn three_dimensional_groups() {
    for name in ["SO3", "SU2", "SE2", "SL2", "Heisenberg", "Aff1"] {
        every_chart(name, &[1, 3, 5, 7], false);
    }
}

#[test]
fn four_dimensional_unitary_group() {
    every_chart("U2", &[1, 3, 5, 7], false);
}

#[test]
fn four_dimensional_rotations() {
    every_chart("SO4", &[1, 3, 5, 7], true);
}

#[test]
fn special_unitary_group() {
    every_chart("SU3", &[1, 3, 5, 7], true);
}

#[test]
fn products() {
    every_chart("SO3*SE2", &[1, 3, 5, 7], true);
    every_chart("SO3^2", &[1, 3, 5, 7], true);
}

#[test]
fn semidirect_products() {
    every_chart("SO3 |x R3^2", &[1, 3, 5, 7], true);
}

#[test]
fn brackets_alone() {
    let algebra = lookup("SO3").unwrap();
    let structure: Vec<_> = algebra
        .structure()
        .iter()
        .map(|s| (s.i, s.j, s.k, coadjoint_tests::bridge::double(&s.value)))
        .collect();
    let group = MatrixGroup::from_structure_constants(3, &structure).unwrap();
    for truncation in [1, 3, 5, 7] {
        laws_hold("SO3 by brackets", &group, Exponential, &algebra, truncation, false);
    }
}
