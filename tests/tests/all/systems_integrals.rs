//! The extra integrals of the integrable systems: bounded over long runs, and shrinking with the
//! step at the order of the method; where a linear symmetry of H is behind one, exact.
//!
//! Formulas and sources are in the files of `examples/`; that each is an integral of the exact flow
//! is checked in exact arithmetic by `every_integral_commutes_with_its_hamiltonian`.
#![allow(clippy::expect_used)]

use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::system::{Options, read};
use coadjoint_tests::reference::{EndState, end_state, numbers};
use coadjoint_tests::run::run;

/// The extra integrals, as (system, name, formula).
const INTEGRALS: &[(&str, &str, &str)] = &[
    // Π₃ (Π₁² + Π₂²) − 4 Π₁ Γ₃ is one only where Π·Γ = 0; see its own test below.
    (
        "kovalevskaya-top",
        "Kovalevskaya's",
        "((mu[0]^2 - mu[1]^2)/4 - mu[3])^2 + (mu[0]*mu[1]/2 - mu[4])^2",
    ),
    (
        // |Π|² − k Σ aᵢ Pᵢ²
        "clebsch-case",
        "Clebsch's",
        "mu[0]^2 + mu[1]^2 + mu[2]^2 - 4/5*(mu[3]^2 + 7/10*mu[4]^2 + 2/5*mu[5]^2)",
    ),
    (
        // Σ (j_a² + j_b²) M_ab², j = (1, 2, 3, 4)
        "manakov-so4",
        "Manakov's",
        "5*mu[0]^2 + 10*mu[1]^2 + 17*mu[2]^2 + 13*mu[3]^2 + 20*mu[4]^2 + 25*mu[5]^2",
    ),
    // s₁ = s₂ = 1
    ("three-wave", "Manley and Rowe's first", "mu[0]^2 + mu[1]^2 - mu[4]^2 - mu[5]^2"),
    ("three-wave", "Manley and Rowe's second", "mu[0]^2 + mu[1]^2 + (mu[2]^2 + mu[3]^2)/2"),
    (
        // tr L³ = Σ b³ + 3 Σ aᵢ² (bᵢ + bᵢ₊₁)
        "toda-lattice",
        "Flaschka's tr L³",
        "mu[3]^3 + mu[4]^3 + mu[5]^3 + mu[6]^3 + 3*mu[0]^2*(mu[3] + mu[4]) \
         + 3*mu[1]^2*(mu[4] + mu[5]) + 3*mu[2]^2*(mu[5] + mu[6])",
    ),
    // Symmetries linear in μ.
    ("lagrange-top", "Π₃", "mu[2]"),
    ("heavy-top-bruels", "Π₂", "mu[1]"),
    ("three-wave", "the first diagonal entry", "mu[6]"),
    ("three-wave", "the second diagonal entry", "mu[7]"),
    ("heisenberg-spin-ring", "the magnetisation", "mu[2] + mu[5] + mu[8] + mu[11]"),
];

fn integral(name: &str) -> (&'static str, &'static str) {
    let found = INTEGRALS.iter().find(|(_, known, _)| *known == name);
    found.map(|&(system, _, formula)| (system, formula)).expect("a known integral")
}

fn polynomial(formula: &str, dim: usize) -> Polynomial {
    let text = format!("group = \"R{dim}\"\nhamiltonian = \"{formula}\"\n");
    read(&text, Options::default()).expect("a polynomial").problem.hamiltonian
}

/// Ḟ = Σ ∂ⱼF ∂ᵢH c_ij^l μ_l, exactly.
fn rate(system: &str, f: &Polynomial) -> Polynomial {
    let entry = end_state(system);
    let (algebra, h) = (entry.algebra(), entry.polynomial());
    let dim = algebra.dim();
    let mut sum = Polynomial::zero(dim);
    for s in algebra.structure() {
        let product = &(&f.derivative(s.j) * &h.derivative(s.i)) * &Polynomial::variable(dim, s.k);
        sum = &sum + &product.scale(&s.value);
    }
    sum
}

#[test]
fn every_integral_commutes_with_its_hamiltonian() {
    for &(system, name, formula) in INTEGRALS {
        let dim = end_state(system).algebra().dim();
        assert!(rate(system, &polynomial(formula, dim)).is_zero(), "{name}");
    }
}

/// The drift of a function over both halves of `spans` times the reference's span, in steps of `span`/n.
fn drift(
    entry: &EndState,
    formula: &str,
    truncation: usize,
    (spans, n): (usize, usize),
    start: Option<&[f64]>,
) -> (f64, f64) {
    let integral = polynomial(formula, entry.momentum0.len());
    let watched = |mu: &[f64]| integral.evaluate(mu);
    let series = entry.series(truncation);
    run(entry, &series, (spans * n, n), start, &[&watched]).1.watched[0]
}

/// n and 2n steps to the span show the order K + 1, and the drift is not notably larger in the second half of the run
/// than in the first.
fn shrinks(system: &str, formula: &str, truncation: usize, (spans, n): (usize, usize)) {
    let entry = end_state(system);
    let [coarse, fine] = [n, 2 * n].map(|n| drift(&entry, formula, truncation, (spans, n), None));
    let note = format!("{system}, K = {truncation}: {coarse:?}, {fine:?}");
    let order = (coarse.0.max(coarse.1) / fine.0.max(fine.1)).log2();
    assert!((order - (truncation + 1) as f64).abs() < 0.5, "order {order}: {note}");
    for (first, second) in [coarse, fine] {
        assert!(second < 1.5 * first, "{note}");
    }
}

/// Of Toda's lattice, which scatters, the drift ends with the collision.
#[test]
fn integrals_drift_at_the_order_of_the_method() {
    for (name, truncation, runs) in [
        ("Kovalevskaya's", 3, (4, 100)),
        ("Kovalevskaya's", 5, (4, 100)),
        ("Clebsch's", 3, (4, 60)),
        ("Clebsch's", 5, (4, 60)),
        ("Manakov's", 3, (16, 20)),
        ("Manakov's", 5, (16, 20)),
        ("Manley and Rowe's first", 3, (2, 60)),
        ("Manley and Rowe's second", 3, (2, 60)),
        ("Manley and Rowe's first", 5, (1, 40)),
        ("Flaschka's tr L³", 3, (4, 50)),
        ("Flaschka's tr L³", 5, (4, 50)),
    ] {
        let (system, formula) = integral(name);
        shrinks(system, formula, truncation, runs);
    }
}

/// F is an integral only on Π·Γ = 0 (Ḟ = −Π₂ Π·Γ). The integrator keeps Π·Γ = 0 exactly, so F stays near its first value.
#[test]
fn goryachev_and_chaplygins_integral() {
    let system = "goryachev-chaplygin-top";
    let formula = "mu[2]*(mu[0]^2 + mu[1]^2) - 4*mu[0]*mu[5]";
    let level = polynomial("-mu[1]*(mu[0]*mu[3] + mu[1]*mu[4] + mu[2]*mu[5])", 6);
    assert_eq!(rate(system, &polynomial(formula, 6)), level);
    for truncation in [3, 5] {
        shrinks(system, formula, truncation, (4, 60));
        // Off the level it is none: the same top with Π·Γ = 0.48 drifts by order one.
        let start = [1.2, -0.9, 0.7, 0.8, 0.6, 0.0];
        let off = drift(&end_state(system), formula, truncation, (4, 60), Some(&start));
        assert!(off.0 > 0.1, "{off:?}");
    }
}

/// A rotation that leaves H alone leaves S alone, so its momentum is exact at any truncation.
#[test]
fn linear_symmetries_are_exact() {
    for (name, n) in [
        ("Π₃", 100),
        ("Π₂", 300),
        ("the first diagonal entry", 100),
        ("the second diagonal entry", 100),
        ("the magnetisation", 50),
    ] {
        let (system, formula) = integral(name);
        let entry = end_state(system);
        let drift = drift(&entry, formula, 3, (1, n), None);
        let size = numbers(&entry.momentum0).iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        assert!(drift.0.max(drift.1) < 2e-13 * size, "{name}: {drift:?}");
    }
}
