//! The checks when a Lie algebra is built, and the charts it has.

use coadjoint_symbolic::lie::{
    Chart, ChartError, LieAlgebra, LieAlgebraError, RationalMatrix, catalogue,
};
use coadjoint_symbolic::number::{Rational, integer, ratio};

fn matrix(rows: &[&[i64]]) -> RationalMatrix {
    RationalMatrix::from_rows(rows.iter().map(|row| row.iter().map(|&x| integer(x)).collect()))
}

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

/// Every message is one line.
fn message(error: LieAlgebraError) -> String {
    let text = error.to_string();
    assert!(!text.contains('\n'));
    text
}

#[test]
fn so3_brackets() {
    let so3 = catalogue::lookup("SO3").unwrap();
    let found: Vec<(usize, usize, usize, Rational)> =
        so3.structure().iter().map(|c| (c.i, c.j, c.k, c.value.clone())).collect();
    let expected =
        [(0, 1, 2, 1), (0, 2, 1, -1), (1, 0, 2, -1), (1, 2, 0, 1), (2, 0, 1, 1), (2, 1, 0, -1)];
    assert_eq!(found, expected.map(|(i, j, k, c)| (i, j, k, integer(c))));
    let again = LieAlgebra::from_structure_constants("again", 3, found).unwrap();
    assert_eq!(again.structure(), so3.structure());
    assert_eq!((again.dim(), again.name()), (3, "again"));
    assert!(again.basis().is_none());
}

#[test]
fn basis_that_does_not_close() {
    let basis = vec![
        matrix(&[&[0, 0, 0], &[0, 0, -1], &[0, 1, 0]]),
        matrix(&[&[0, 0, 1], &[0, 0, 0], &[-1, 0, 0]]),
    ];
    let error = LieAlgebra::from_basis("half", basis).unwrap_err();
    assert!(matches!(error, LieAlgebraError::NotClosed { indices: (0, 1), .. }));
    assert!(message(error).contains("[e1, e2]"));
}

#[test]
fn dependent_basis() {
    let a = matrix(&[&[0, -1], &[1, 0]]);
    let b = matrix(&[&[0, 3], &[-3, 0]]);
    let error = LieAlgebra::from_basis("twice", vec![a, b]).unwrap_err();
    assert!(matches!(error, LieAlgebraError::Dependent { index: 1, .. }));
    let zero = RationalMatrix::zero(2, 2);
    let error = LieAlgebra::from_basis("zero", vec![zero]).unwrap_err();
    assert!(message(error).contains("e1"));
}

#[test]
fn shapes() {
    let error = LieAlgebra::from_basis("wide", vec![matrix(&[&[1, 0, 0], &[0, 1, 0]])]);
    assert!(message(error.unwrap_err()).contains("2 × 3"));
    let error = LieAlgebra::from_basis("mixed", vec![matrix(&[&[1]]), matrix(&[&[1, 0], &[0, 1]])]);
    assert!(message(error.unwrap_err()).contains("2 × 2"));
    assert_eq!(LieAlgebra::from_basis("none", vec![]).unwrap_err(), LieAlgebraError::Empty);
    let error = LieAlgebra::from_structure_constants("far", 2, [(0, 1, 2, integer(1))]);
    assert_eq!(error.unwrap_err(), LieAlgebraError::OutOfRange { index: 2, dimension: 2 });
}

#[test]
fn jacobi_violated() {
    // [a,b] = c, [a,c] = a: [[a,b],c] + [[b,c],a] + [[c,a],b] = 0 + 0 − [a,b] = −c.
    let error = LieAlgebra::from_brackets(
        "wrong",
        names(&["a", "b", "c"]),
        [(0, 1, vec![(2, integer(1))]), (0, 2, vec![(0, integer(1))])],
    )
    .unwrap_err();
    match &error {
        LieAlgebraError::Jacobi { indices, along, value, .. } => {
            assert_eq!(
                (*indices, along.as_str(), (**value).clone()),
                ((0, 1, 2), "c", integer(-1))
            );
        }
        other => panic!("{other}"),
    }
    assert!(message(error).contains("[[a, b], c]"));
}

#[test]
fn antisymmetry_violated() {
    let error =
        LieAlgebra::from_structure_constants("one-sided", 2, [(0, 1, 1, integer(1))]).unwrap_err();
    assert!(matches!(error, LieAlgebraError::NotAntisymmetric { indices: (0, 1, 1), .. }));
    let both = [(0, 1, 1, integer(1)), (1, 0, 1, integer(2))];
    let error = LieAlgebra::from_structure_constants("unequal", 2, both).unwrap_err();
    assert!(message(error).contains("1 and 2"));
}

#[test]
fn brackets_given_twice() {
    let list = |second: Rational| {
        LieAlgebra::from_brackets(
            "ab",
            names(&["a", "b"]),
            [(0, 1, vec![(1, integer(1))]), (1, 0, vec![(1, second)])],
        )
    };
    assert!(list(integer(-1)).is_ok());
    let error = list(integer(1)).unwrap_err();
    assert!(matches!(error, LieAlgebraError::Inconsistent { indices: (1, 0), .. }));
    let square =
        LieAlgebra::from_brackets("aa", names(&["a", "b"]), [(0, 0, vec![(1, ratio(1, 2))])]);
    assert!(square.is_err());
}

#[test]
fn cayley_needs_matrices() {
    let so3 = catalogue::lookup("SO3").unwrap();
    assert_eq!(Chart::Cayley.check(&so3), Ok(()));
    let constants = so3.structure().iter().map(|c| (c.i, c.j, c.k, c.value.clone()));
    let bare = LieAlgebra::from_structure_constants("bare", 3, constants).unwrap();
    assert_eq!(Chart::Exponential.check(&bare), Ok(()));
    let error = Chart::Cayley.check(&bare).unwrap_err();
    assert!(matches!(error, ChartError::NoMatrices { .. }));
    assert!(error.to_string().contains("exponential chart"));
}
