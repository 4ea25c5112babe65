//! The quadratic forms that bound eigenvalues, against eigenvalues computed numerically.

use coadjoint_symbolic::lie::catalogue::lookup;
use coadjoint_symbolic::lie::{LieAlgebra, QuadraticForm};
use coadjoint_symbolic::number::{Rational, integer};
use nalgebra::{Complex, DMatrix, Schur};
use num_traits::ToPrimitive;

/// Nilpotent blocks of size three have eigenvalues of about the third root of rounding.
const BLUR: f64 = 1e-3;

fn ad(algebra: &LieAlgebra, x: &[f64]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(algebra.dim(), algebra.dim());
    for c in algebra.structure() {
        matrix[(c.k, c.j)] += x[c.i] * c.value.to_f64().unwrap();
    }
    matrix
}

fn element(algebra: &LieAlgebra, x: &[f64]) -> DMatrix<f64> {
    let basis = algebra.basis().unwrap();
    let mut matrix = DMatrix::zeros(basis[0].rows(), basis[0].rows());
    for (e, x) in basis.iter().zip(x) {
        for (i, j, value) in e.entries() {
            matrix[(i, j)] += x * value.to_f64().unwrap();
        }
    }
    matrix
}

fn largest(matrix: DMatrix<f64>, part: impl Fn(&Complex<f64>) -> f64) -> f64 {
    // The iteration may stand still where eigenvalues coincide; noise below `BLUR` parts them.
    let n = matrix.nrows();
    let noise = points(n * n, 20).into_iter().map(|noise| DMatrix::from_vec(n, n, noise) * 1e-13);
    let schur = noise.skip(1).find_map(|noise| Schur::try_new(&matrix + noise, 1e-14, 1000));
    schur.unwrap().complex_eigenvalues().iter().map(part).fold(0.0, f64::max)
}

fn bound(forms: &[QuadraticForm], x: &[f64]) -> f64 {
    forms.iter().map(|form| form.value(x)).fold(0.0, f64::max).sqrt()
}

/// Points of the cube [-1, 1]ⁿ, half of them with a few coordinates only.
fn points(n: usize, count: usize) -> Vec<Vec<f64>> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as f64 / u64::MAX as f64
    };
    (0..count)
        .map(|k| {
            (0..n)
                .map(|_| {
                    let x = 2.0 * next() - 1.0;
                    if k % 2 == 1 && next() < 0.6 { 0.0 } else { x }
                })
                .collect()
        })
        .collect()
}

/// The algebra in a basis that hides its ideals: e_i + 2 e_{i+1}.
fn mixed(algebra: &LieAlgebra) -> LieAlgebra {
    let n = algebra.dim();
    let basis = algebra.basis().unwrap();
    let mixed = (0..n).map(|i| match basis.get(i + 1) {
        Some(next) => basis[i].plus(next, &integer(2)),
        None => basis[i].clone(),
    });
    LieAlgebra::from_basis("mixed", mixed.collect()).unwrap()
}

const ALL: [&str; 25] = [
    "SO2",
    "SO3",
    "SO4",
    "SO5",
    "SO6",
    "SE2",
    "SE3",
    "SU2",
    "SU3",
    "SU4",
    "U1",
    "U2",
    "U3",
    "SL2",
    "Heisenberg",
    "Aff1",
    "R2",
    "SO3 |x R3^2",
    "SO3 |x Sym3",
    "SL2 |x R2",
    "SO4 |x R4",
    "SU2 |x R4",
    "SO3 * SE2",
    "SL2 * Heisenberg * SO3",
    "SE3^3",
];

#[test]
fn rotation_in_the_adjoint_action_is_bounded() {
    for name in ALL {
        let plain = lookup(name).unwrap();
        for algebra in [mixed(&plain), plain] {
            let forms = algebra.elliptic_forms();
            for x in points(algebra.dim(), 40) {
                let found = largest(ad(&algebra, &x), |λ| λ.im.abs());
                let bound = bound(&forms, &x);
                assert!(found <= bound + BLUR, "{name} {x:?}: {found} > {bound}");
            }
        }
    }
}

#[test]
fn the_bound_is_exact_where_it_is_said_to_be() {
    let exact = [
        "SO2",
        "SO3",
        "SO4",
        "SE2",
        "SE3",
        "SU2",
        "U1",
        "U2",
        "SL2",
        "Heisenberg",
        "Aff1",
        "R2",
        "SO3 |x R3^2",
        "SO3 * SE2",
        "SL2 * Heisenberg * SO3",
        "SE3^3",
    ];
    for name in exact {
        let plain = lookup(name).unwrap();
        for algebra in [mixed(&plain), plain] {
            let forms = algebra.elliptic_forms();
            for x in points(algebra.dim(), 40) {
                let found = largest(ad(&algebra, &x), |λ| λ.im.abs());
                let bound = bound(&forms, &x);
                assert!((found - bound).abs() < BLUR, "{name} {x:?}: {found} is not {bound}");
            }
        }
    }
}

#[test]
fn the_forms_are_the_known_ones() {
    let terms = |name: &str| -> Vec<Vec<(usize, usize, Rational)>> {
        let forms = lookup(name).unwrap().elliptic_forms();
        forms.iter().map(|f| f.terms().map(|(i, j, c)| (i, j, c.clone())).collect()).collect()
    };
    let square = |of: &[usize]| of.iter().map(|&i| (i, i, integer(1))).collect::<Vec<_>>();
    assert_eq!(terms("SO3"), [square(&[0, 1, 2])]);
    assert_eq!(terms("SE3"), [square(&[0, 1, 2])]);
    assert_eq!(terms("SE2"), [square(&[0])]);
    assert_eq!(terms("SO3 * SE2"), [square(&[0, 1, 2]), square(&[3])]);
    // ad_x on sl(2) has the eigenvalues 0, ±2√(h² + ef).
    assert_eq!(terms("SL2"), [vec![(0, 0, integer(-4)), (1, 2, integer(-4))]]);
    for name in ["Heisenberg", "Aff1", "R3", "U1"] {
        assert!(terms(name).is_empty(), "{name}");
    }
}

#[test]
fn matrices_of_the_cayley_chart_are_bounded() {
    for name in ALL {
        let plain = lookup(name).unwrap();
        for algebra in [mixed(&plain), plain] {
            let forms = algebra.cayley_forms().unwrap();
            for x in points(algebra.dim(), 40) {
                let found = largest(element(&algebra, &x), |λ| λ.norm());
                let bound = bound(&forms, &x);
                assert!(found <= bound + BLUR, "{name} {x:?}: {found} > {bound}");
                if ["SO2", "SO3", "SE2", "SE3", "SU2"].contains(&name) {
                    assert!((found - bound).abs() < BLUR, "{name} {x:?}: {found} is not {bound}");
                }
            }
        }
    }
}

#[test]
fn algebras_without_matrices_have_no_cayley_forms() {
    let names = ["a", "b"].map(String::from).to_vec();
    let algebra = LieAlgebra::from_brackets("aff", names, [(0, 1, vec![(1, integer(1))])]).unwrap();
    assert!(algebra.cayley_forms().is_none());
    assert!(algebra.elliptic_forms().is_empty());
}

#[test]
fn a_spiral_is_bounded_by_its_rotation_alone() {
    // e_1 turns and scales the plane of e_2 and e_3: eigenvalues (3 ± 2i) x_1.
    let names = ["a", "b", "c"].map(String::from).to_vec();
    let brackets = [
        (0, 1, vec![(1, integer(3)), (2, integer(2))]),
        (0, 2, vec![(1, integer(-2)), (2, integer(3))]),
    ];
    let algebra = LieAlgebra::from_brackets("spiral", names, brackets).unwrap();
    let forms = algebra.elliptic_forms();
    assert_eq!(forms.len(), 1);
    assert_eq!(forms[0].value(&[1.0, 5.0, 7.0]), 4.0);
}
