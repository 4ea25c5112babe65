//! The groups of the catalogue: dimensions, brackets, products, charts.

use coadjoint_symbolic::lie::{Chart, ChartError, LieAlgebra, RationalMatrix, catalogue};
use coadjoint_symbolic::number::{Rational, integer, ratio};

fn lookup(text: &str) -> LieAlgebra {
    catalogue::lookup(text).unwrap_or_else(|error| panic!("{error}"))
}

fn bracket(algebra: &LieAlgebra, i: usize, j: usize) -> Vec<(usize, Rational)> {
    let found = algebra.structure().iter().filter(|c| (c.i, c.j) == (i - 1, j - 1));
    found.map(|c| (c.k + 1, c.value.clone())).collect()
}

#[test]
fn every_name() {
    let dimensions = [1, 3, 6, 10, 3, 6, 9, 3, 8, 15, 1, 4, 9, 3, 10, 3, 2, 1, 2, 3];
    assert_eq!(catalogue::names().len(), dimensions.len());
    for (name, dimension) in catalogue::names().iter().zip(dimensions) {
        let algebra = lookup(name);
        assert_eq!((algebra.dim(), algebra.name()), (dimension, *name));
        assert!(algebra.basis().is_some(), "{name}");
        assert_eq!(Chart::Exponential.check(&algebra), Ok(()));
    }
}

#[test]
fn brackets_as_documented() {
    assert_eq!(lookup("SU2").structure(), lookup("SO3").structure());
    let sl2 = lookup("SL(2,R)");
    assert_eq!(bracket(&sl2, 1, 2), [(2, integer(2))]);
    assert_eq!(bracket(&sl2, 1, 3), [(3, integer(-2))]);
    assert_eq!(bracket(&sl2, 2, 3), [(1, integer(1))]);
    assert_eq!(bracket(&lookup("Heisenberg"), 1, 2), [(3, integer(1))]);
    assert_eq!(bracket(&lookup("Aff1"), 1, 2), [(2, integer(1))]);
    let se2 = lookup("SE2");
    assert_eq!(bracket(&se2, 1, 2), [(3, integer(1))]);
    assert_eq!(bracket(&se2, 1, 3), [(2, integer(-1))]);
    assert!(bracket(&se2, 2, 3).is_empty());
    assert!(lookup("R4").structure().is_empty());
    assert_eq!(lookup("SO(5)"), lookup("SO5"));
    assert_eq!(lookup("SE_2(3)"), lookup("SE23"));
    let sp4 = lookup("Sp(4, R)");
    assert_eq!(bracket(&sp4, 5, 8), [(1, integer(1))]);
    assert_eq!(bracket(&sp4, 6, 8), [(3, integer(1))]);
    assert_eq!(bracket(&sp4, 1, 5), [(5, integer(2))]);
    assert_eq!(lookup("Sp2").structure(), sl2.structure());
    assert_eq!(lookup("Sp6").dim(), 21);
}

#[test]
fn products() {
    let pair = lookup("SO3*SE3");
    assert_eq!(pair.dim(), 9);
    assert_eq!(bracket(&pair, 1, 2), [(3, integer(1))]);
    assert_eq!(bracket(&pair, 4, 5), [(6, integer(1))]);
    assert!(bracket(&pair, 1, 4).is_empty());
    assert_eq!(pair.basis().unwrap()[8].rows(), 7);
    // The block matrices have the brackets of the product.
    let matrices = pair.basis().unwrap().to_vec();
    assert_eq!(LieAlgebra::from_basis("again", matrices).unwrap().structure(), pair.structure());
    assert_eq!(lookup("SO3^2").structure(), lookup("SO3 × SO3").structure());
    assert_eq!(lookup("SO3^4").name(), "SO3^4");
    assert_eq!(lookup("(SO3*R1)^2").dim(), 8);
    let chain = lookup("SO3^256");
    assert_eq!((chain.dim(), chain.structure().len()), (768, 6 * 256));
    assert_eq!(Chart::Cayley.check(&chain), Ok(()));
}

#[test]
fn semidirect_products() {
    let heavy = lookup("SO3 |x R3");
    let se3 = lookup("SE3");
    assert_eq!(heavy.structure(), se3.structure());
    assert_eq!(heavy.basis(), se3.basis());
    assert_eq!(lookup("SO3 | x R3"), heavy);
    let two = lookup("SO3 ⋉ R3^2");
    assert_eq!((two.dim(), two.name()), (9, "SO3 |x R3^2"));
    assert_eq!(bracket(&two, 1, 8), [(9, integer(1))]);
    assert_eq!(bracket(&two, 1, 5), [(6, integer(1))]);
    let with_matrix = lookup("SO3 |x Sym3");
    assert_eq!(with_matrix.dim(), 9);
    for algebra in [&two, &with_matrix] {
        let matrices = algebra.basis().unwrap().to_vec();
        let again = LieAlgebra::from_basis("again", matrices).unwrap();
        assert_eq!(again.structure(), algebra.structure());
    }
    // ξ = e_3 turns x into y: S = E_xx goes to E_xy + E_yx, E_xy + E_yx to 2(E_yy − E_xx).
    assert_eq!(bracket(&with_matrix, 3, 4), [(5, integer(1))]);
    assert_eq!(bracket(&with_matrix, 3, 5), [(4, integer(-2)), (7, integer(2))]);
    // Any representation: sl(2) on quadratic forms is its adjoint representation.
    let sl2 = lookup("SL2");
    let adjoint: Vec<RationalMatrix> = (0..3)
        .map(|i| {
            let terms = sl2.structure().iter().filter(|c| c.i == i);
            RationalMatrix::from_entries(3, 3, terms.map(|c| (c.k, c.j, c.value.clone())))
        })
        .collect();
    let takiff = LieAlgebra::semidirect_product("sl2 |x ad", &sl2, &adjoint, 1).unwrap();
    assert_eq!(bracket(&takiff, 2, 6), [(4, integer(1))]);
    let broken: Vec<RationalMatrix> = adjoint.iter().map(|m| m.plus(m, &ratio(1, 2))).collect();
    assert!(LieAlgebra::semidirect_product("broken", &sl2, &broken, 1).is_err());
}

#[test]
fn cayley_where_it_exists() {
    for name in ["SO3", "SO4", "SO5", "SE2", "SE3", "SE23", "SU2", "U1", "U2", "U3", "SL2", "Sp4"] {
        assert_eq!(Chart::Cayley.check(&lookup(name)), Ok(()), "{name}");
    }
    for name in ["SU3", "SU4", "SO3*SU3"] {
        let error = Chart::Cayley.check(&lookup(name)).unwrap_err();
        assert!(matches!(error, ChartError::LeavesAlgebra { .. }), "{name}");
        assert!(error.to_string().contains("xξx leaves the algebra"));
    }
}

/// `codegen/tests/cases/system_files.cases` has the messages.
#[test]
fn a_name_of_any_length_is_refused() {
    let said = catalogue::lookup(&"(".repeat(100_000)).unwrap_err().to_string();
    assert!(said.contains("cannot read"), "{said}");
}
