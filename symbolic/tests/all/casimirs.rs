//! Polynomial Casimirs.

use coadjoint_symbolic::lie::{CasimirError, LieAlgebra, casimirs, catalogue};
use coadjoint_symbolic::number::{Rational, integer, ratio};
use coadjoint_symbolic::poly::Polynomial;

fn found(group: &str, degree: u32) -> Vec<Polynomial> {
    let algebra = catalogue::lookup(group).unwrap();
    let list = casimirs(&algebra, degree).unwrap();
    for casimir in &list {
        assert_casimir(&algebra, casimir);
        let terms: Vec<Rational> = casimir.terms().map(|(_, c)| c).collect();
        assert!(terms.iter().all(Rational::is_integer) && terms[0] > integer(0));
    }
    list
}

/// {C, μ_j} = −Σ ∂_iC c_ij^l μ_l vanishes.
fn assert_casimir(algebra: &LieAlgebra, casimir: &Polynomial) {
    let n = algebra.dim();
    let mut brackets = vec![Polynomial::zero(n); n];
    for c in algebra.structure() {
        let term = &casimir.derivative(c.i) * &Polynomial::variable(n, c.k);
        brackets[c.j] = &brackets[c.j] + &term.scale(&c.value);
    }
    assert!(brackets.iter().all(Polynomial::is_zero), "{casimir:?}");
}

fn degrees(group: &str, degree: u32) -> Vec<u32> {
    found(group, degree).iter().map(Polynomial::degree).collect()
}

/// The sum of coefficient · μ_i μ_j.
fn quadratic(n: usize, terms: &[(u32, u32, i64)]) -> Polynomial {
    Polynomial::from_factors(n, terms.iter().map(|&(i, j, c)| (vec![(i, 1), (j, 1)], integer(c))))
}

#[test]
fn known_invariants() {
    // Marsden and Ratiu, Introduction to Mechanics and Symmetry, chapter 14.
    assert_eq!(found("SO3", 4), [quadratic(3, &[(0, 0, 1), (1, 1, 1), (2, 2, 1)])]);
    assert_eq!(
        found("SE3", 4),
        [
            quadratic(6, &[(0, 3, 1), (1, 4, 1), (2, 5, 1)]),
            quadratic(6, &[(3, 3, 1), (4, 4, 1), (5, 5, 1)]),
        ]
    );
    assert_eq!(found("SE2", 3), [quadratic(3, &[(1, 1, 1), (2, 2, 1)])]);
    // H² + 4EF in coordinates dual to H, E, F.
    assert_eq!(found("SL2", 4), [quadratic(3, &[(0, 0, 1), (1, 2, 4)])]);
    assert_eq!(found("Heisenberg", 3), [Polynomial::variable(3, 2)]);
    let squares: Vec<(u32, u32, i64)> = (0..6).map(|i| (i, i, 1)).collect();
    assert_eq!(
        found("SO4", 4),
        [quadratic(6, &squares), quadratic(6, &[(0, 5, 1), (1, 4, -1), (2, 3, 1)])]
    );
    assert!(found("Aff1", 5).is_empty());
    assert_eq!(found("R2", 3), [Polynomial::variable(2, 0), Polynomial::variable(2, 1)]);
}

#[test]
fn degrees_of_the_generators() {
    // The degrees of the simple groups: exponents plus one (Bourbaki, Lie VI, plates I to IV).
    assert_eq!(degrees("SU3", 4), [2, 3]);
    assert_eq!(degrees("SO5", 4), [2, 4]);
    assert_eq!(degrees("Sp4", 4), [2, 4]);
    assert_eq!(degrees("U2", 3), [1, 2]);
    assert_eq!(degrees("U3", 3), [1, 2, 3]);
    assert_eq!(degrees("SU2*R1", 4), [1, 2]);
    // Γ·Γ, Γ·Δ and Δ·Δ are all: a generic orbit has dimension 2·3, as Γ and Δ are left alone by no turn (M. Raïs).
    assert_eq!(degrees("SE23", 4), [2, 2, 2]);
}

#[test]
fn products_are_treated_by_factors() {
    let list = found("SO3^64", 6);
    assert_eq!(list.len(), 64);
    assert_eq!(list[5], { quadratic(192, &[(15, 15, 1), (16, 16, 1), (17, 17, 1)]) });
}

#[test]
fn awkward_constants() {
    // so(3) with basis scaled by large numbers: the squares get coefficients far beyond a word.
    let [a, b, c] = [ratio(1_000_000_007, 3), ratio(998_244_353, 5), ratio(1_000_000_009, 7)];
    let names = ["u", "v", "w"].map(String::from).to_vec();
    let scaled = LieAlgebra::from_brackets(
        "scaled",
        names,
        [
            (0, 1, vec![(2, &a * &b / &c)]),
            (1, 2, vec![(0, &b * &c / &a)]),
            (2, 0, vec![(1, &c * &a / &b)]),
        ],
    )
    .unwrap();
    let list = casimirs(&scaled, 2).unwrap();
    assert_eq!(list.len(), 1);
    assert_casimir(&scaled, &list[0]);
    // Momenta dual to u = a e_1, … are a p_1, …, so C = Σ (μ_i / a_i)².
    let terms: Vec<Rational> = list[0].terms().map(|(_, value)| value).collect();
    assert_eq!(&terms[1] / &terms[0], (&a / &b).pow(2));
    assert_eq!(&terms[2] / &terms[0], (&a / &c).pow(2));
}

#[test]
fn limits() {
    let algebra = catalogue::lookup("SU4").unwrap();
    let error = casimirs(&algebra, 12).unwrap_err();
    assert!(matches!(error, CasimirError::TooLarge { degree: 12, .. }));
    assert!(error.to_string().contains("lower degree"));
}
