//! The extra integrals of the integrable systems: bounded over long runs, and shrinking with the
//! step at the order of the method; where a linear symmetry of H is behind one, exact.
//!
//! Formulas and sources are in the files of `examples/`; that each is an integral of the exact flow
//! is checked in exact arithmetic by `every_integral_commutes_with_its_hamiltonian`.
#![allow(clippy::expect_used)]

use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_tests::reference::end_state;
use coadjoint_tests::run::{Watched, run};
use coadjoint_tests::series::orders;

/// c·∏ μᵢ, indices repeated for powers.
type Monomials = &'static [(i64, i64, &'static [usize])];

/// The extra integrals, as (system, name, terms with numerator, denominator, factors).
const INTEGRALS: &[(&str, &str, Monomials)] = &[
    // Π₃ (Π₁² + Π₂²) − 4 Π₁ Γ₃ is one only where Π·Γ = 0; see its own test below.
    (
        // (¼ (Π₁² − Π₂²) − Γ₁)² + (½ Π₁Π₂ − Γ₂)², expanded.
        "kovalevskaya-top",
        "Kovalevskaya's",
        &[
            (1, 16, &[0, 0, 0, 0]),
            (-1, 8, &[0, 0, 1, 1]),
            (1, 16, &[1, 1, 1, 1]),
            (-1, 2, &[0, 0, 3]),
            (1, 2, &[1, 1, 3]),
            (1, 1, &[3, 3]),
            (1, 4, &[0, 0, 1, 1]),
            (-1, 1, &[0, 1, 4]),
            (1, 1, &[4, 4]),
        ],
    ),
    (
        // |Π|² − k Σ aᵢ Pᵢ², a = (1, 7/10, 2/5), k = 4/5
        "clebsch-case",
        "Clebsch's",
        &[
            (1, 1, &[0, 0]),
            (1, 1, &[1, 1]),
            (1, 1, &[2, 2]),
            (-4, 5, &[3, 3]),
            (-14, 25, &[4, 4]),
            (-8, 25, &[5, 5]),
        ],
    ),
    (
        // Σ (j_a² + j_b²) M_ab², j = (1, 2, 3, 4)
        "manakov-so4",
        "Manakov's",
        &[
            (5, 1, &[0, 0]),
            (10, 1, &[1, 1]),
            (17, 1, &[2, 2]),
            (13, 1, &[3, 3]),
            (20, 1, &[4, 4]),
            (25, 1, &[5, 5]),
        ],
    ),
    // s₁ = s₂ = 1
    (
        "three-wave",
        "Manley and Rowe's first",
        &[(1, 1, &[0, 0]), (1, 1, &[1, 1]), (-1, 1, &[4, 4]), (-1, 1, &[5, 5])],
    ),
    (
        "three-wave",
        "Manley and Rowe's second",
        &[(1, 1, &[0, 0]), (1, 1, &[1, 1]), (1, 2, &[2, 2]), (1, 2, &[3, 3])],
    ),
    // tr L³ = Σ b³ + 3 Σ aᵢ² (bᵢ + bᵢ₊₁)
    (
        "toda-lattice",
        "Flaschka's tr L³",
        &[
            (1, 1, &[3, 3, 3]),
            (1, 1, &[4, 4, 4]),
            (1, 1, &[5, 5, 5]),
            (1, 1, &[6, 6, 6]),
            (3, 1, &[0, 0, 3]),
            (3, 1, &[0, 0, 4]),
            (3, 1, &[1, 1, 4]),
            (3, 1, &[1, 1, 5]),
            (3, 1, &[2, 2, 5]),
            (3, 1, &[2, 2, 6]),
        ],
    ),
    // Symmetries linear in μ.
    ("lagrange-top", "Π₃", &[(1, 1, &[2])]),
    ("heavy-top-bruels", "Π₂", &[(1, 1, &[1])]),
    ("three-wave", "the first diagonal entry", &[(1, 1, &[6])]),
    ("three-wave", "the second diagonal entry", &[(1, 1, &[7])]),
    (
        "heisenberg-spin-ring",
        "the magnetisation",
        &[(1, 1, &[2]), (1, 1, &[5]), (1, 1, &[8]), (1, 1, &[11])],
    ),
];

fn integral(name: &str) -> (&'static str, Monomials) {
    let found = INTEGRALS.iter().find(|(_, known, _)| *known == name);
    found.map(|&(system, _, terms)| (system, terms)).expect("a known integral")
}

fn value(terms: Monomials, mu: &[f64]) -> f64 {
    terms
        .iter()
        .map(|(a, b, factors)| {
            *a as f64 / *b as f64 * factors.iter().map(|&i| mu[i]).product::<f64>()
        })
        .sum()
}

fn polynomial(terms: Monomials, dim: usize) -> Polynomial {
    Polynomial::from_terms(
        dim,
        terms.iter().map(|(a, b, factors)| {
            let mut exponents = vec![0; dim];
            for &i in *factors {
                exponents[i] += 1;
            }
            (exponents, Rational::new((*a).into(), (*b).into()))
        }),
    )
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
    for &(system, name, terms) in INTEGRALS {
        let dim = end_state(system).algebra().dim();
        assert!(rate(system, &polynomial(terms, dim)).is_zero(), "{name}");
    }
}

/// Drift over `spans` times the reference's span, n and 2n steps to each: order K + 1, and not
/// notably more in the second half than in the first.
fn shrinks(name: &str, truncation: usize, spans: usize, n: usize) {
    let (system, terms) = integral(name);
    let watched = |mu: &[f64]| value(terms, mu);
    let entry = end_state(system);
    let series = orders(&entry.algebra(), &entry.polynomial(), truncation);
    let drift = |n: usize| {
        let list: [Watched<'_>; 1] = [&watched];
        run(&entry, &series, (spans * n, n), None, &list).1.watched[0]
    };
    let (coarse, fine) = (drift(n), drift(2 * n));
    let note = format!("{name}, K = {truncation}: {coarse:?}, {fine:?}");
    let order = (coarse.0.max(coarse.1) / fine.0.max(fine.1)).log2();
    assert!((order - (truncation + 1) as f64).abs() < 0.5, "order {order}: {note}");
    for (first, second) in [coarse, fine] {
        assert!(second < 1.5 * first, "{note}");
    }
}

#[test]
fn kovalevskayas_integral() {
    shrinks("Kovalevskaya's", 3, 4, 100);
    shrinks("Kovalevskaya's", 5, 4, 100);
}

#[test]
fn clebschs_integral() {
    shrinks("Clebsch's", 3, 4, 60);
    shrinks("Clebsch's", 5, 4, 60);
}

#[test]
fn manakovs_integral() {
    shrinks("Manakov\'s", 3, 16, 20);
    shrinks("Manakov\'s", 5, 16, 20);
}

#[test]
fn manley_and_rowes_relations() {
    shrinks("Manley and Rowe's first", 3, 2, 60);
    shrinks("Manley and Rowe's second", 3, 2, 60);
    shrinks("Manley and Rowe's first", 5, 1, 40);
}

/// Scattering: the drift ends with the collision.
#[test]
fn todas_integral() {
    shrinks("Flaschka's tr L³", 3, 4, 50);
    shrinks("Flaschka's tr L³", 5, 4, 50);
}

/// Where Π·Γ = 0 it is an integral (Ḟ = −Π₂ Π·Γ); the integrator keeps Π·Γ = 0 exactly, so F
/// stays near.
#[test]
fn goryachev_and_chaplygins_integral() {
    let terms: Monomials = &[(1, 1, &[0, 0, 2]), (1, 1, &[1, 1, 2]), (-4, 1, &[0, 5])];
    let f = polynomial(terms, 6);
    let level = polynomial(&[(-1, 1, &[0, 1, 3]), (-1, 1, &[1, 1, 4]), (-1, 1, &[1, 2, 5])], 6);
    assert_eq!(rate("goryachev-chaplygin-top", &f), level);

    let entry = end_state("goryachev-chaplygin-top");
    let watched = |mu: &[f64]| value(terms, mu);
    let list: [Watched<'_>; 1] = [&watched];
    for (truncation, n) in [(3, 60), (5, 60)] {
        let series = orders(&entry.algebra(), &entry.polynomial(), truncation);
        let coarse = run(&entry, &series, (4 * n, n), None, &list).1.watched[0];
        let fine = run(&entry, &series, (8 * n, 2 * n), None, &list).1.watched[0];
        let order = (coarse.0.max(coarse.1) / fine.0.max(fine.1)).log2();
        let note = format!("K = {truncation}: {coarse:?}, {fine:?}");
        assert!((order - (truncation + 1) as f64).abs() < 0.5, "order {order}: {note}");
        assert!(fine.1 < 1.5 * fine.0, "{note}");
        // Off the level it is none: the same top with Π·Γ = 0.48 drifts by order one.
        let start = [1.2, -0.9, 0.7, 0.8, 0.6, 0.0];
        let off = run(&entry, &series, (4 * n, n), Some(&start), &list).1.watched[0];
        assert!(off.0 > 0.1, "{off:?}");
    }
}

/// A rotation that leaves H alone leaves S alone, so its momentum is exact at any truncation.
#[test]
fn linear_symmetries_are_exact() {
    for (name, truncation, n) in [
        ("Π₃", 3, 100),
        ("Π₂", 3, 300),
        ("the first diagonal entry", 3, 100),
        ("the second diagonal entry", 3, 100),
        ("the magnetisation", 3, 50),
    ] {
        let (system, terms) = integral(name);
        let entry = end_state(system);
        let watched = |mu: &[f64]| value(terms, mu);
        let list: [Watched<'_>; 1] = [&watched];
        let series = orders(&entry.algebra(), &entry.polynomial(), truncation);
        let drift = run(&entry, &series, (n, n), None, &list).1.watched[0];
        let start = coadjoint_tests::reference::numbers(&entry.momentum0);
        let size = start.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        assert!(drift.0.max(drift.1) < 2e-13 * size, "{name}: {drift:?}");
    }
}
