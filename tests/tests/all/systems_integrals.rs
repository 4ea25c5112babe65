//! The extra integrals of the integrable systems: bounded over long runs, and shrinking with the
//! step at the order of the method; where a linear symmetry of H is behind one, exact.
//!
//! Formulas and sources are in the files of `examples/`; that each is an integral of the exact flow
//! is checked in exact arithmetic by `every_integral_commutes_with_its_hamiltonian`.
#![allow(clippy::expect_used)]

use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_tests::reference::{EndState, end_state, numbers};
use coadjoint_tests::run::run;

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

/// The drift of a function over both halves of `spans` times the reference's span, in steps of `span`/n.
fn drift(
    entry: &EndState,
    terms: Monomials,
    truncation: usize,
    (spans, n): (usize, usize),
    start: Option<&[f64]>,
) -> (f64, f64) {
    let watched = |mu: &[f64]| value(terms, mu);
    let series = entry.series(truncation);
    run(entry, &series, (spans * n, n), start, &[&watched]).1.watched[0]
}

/// n and 2n steps to the span show the order K + 1, and the drift is not notably larger in the second half of the run
/// than in the first.
fn shrinks(system: &str, terms: Monomials, truncation: usize, (spans, n): (usize, usize)) {
    let entry = end_state(system);
    let [coarse, fine] = [n, 2 * n].map(|n| drift(&entry, terms, truncation, (spans, n), None));
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
        let (system, terms) = integral(name);
        shrinks(system, terms, truncation, runs);
    }
}

/// Where Π·Γ = 0 it is an integral (Ḟ = −Π₂ Π·Γ); the integrator keeps Π·Γ = 0 exactly, so F
/// stays near.
#[test]
fn goryachev_and_chaplygins_integral() {
    let system = "goryachev-chaplygin-top";
    let terms: Monomials = &[(1, 1, &[0, 0, 2]), (1, 1, &[1, 1, 2]), (-4, 1, &[0, 5])];
    let level = polynomial(&[(-1, 1, &[0, 1, 3]), (-1, 1, &[1, 1, 4]), (-1, 1, &[1, 2, 5])], 6);
    assert_eq!(rate(system, &polynomial(terms, 6)), level);
    for truncation in [3, 5] {
        shrinks(system, terms, truncation, (4, 60));
        // Off the level it is none: the same top with Π·Γ = 0.48 drifts by order one.
        let start = [1.2, -0.9, 0.7, 0.8, 0.6, 0.0];
        let off = drift(&end_state(system), terms, truncation, (4, 60), Some(&start));
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
        let (system, terms) = integral(name);
        let entry = end_state(system);
        let drift = drift(&entry, terms, 3, (1, n), None);
        let size = numbers(&entry.momentum0).iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        assert!(drift.0.max(drift.1) < 2e-13 * size, "{name}: {drift:?}");
    }
}
