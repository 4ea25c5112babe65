//! The series of `reference/series.json`, term by term. The file was computed in exact arithmetic
//! by a separate implementation.

use coadjoint_symbolic::hamilton_jacobi::{TermLimit, derive};
use coadjoint_symbolic::lie::{Chart, LieAlgebra, RationalMatrix, catalogue};
use coadjoint_symbolic::number::Rational;
use coadjoint_symbolic::poly::Polynomial;
use serde_json::Value;

fn polynomial(variables: usize, terms: &Value) -> Polynomial {
    let terms = terms.as_array().unwrap().iter().map(|term| {
        let exponents: Vec<u32> = serde_json::from_value(term["exponents"].clone()).unwrap();
        (exponents, term["coefficient"].as_str().unwrap().parse::<Rational>().unwrap())
    });
    Polynomial::from_terms(variables, terms)
}

fn algebra(group: &str) -> LieAlgebra {
    let bases: Value = serde_json::from_str(include_str!("../reference/bases.json")).unwrap();
    let matrices = bases[group].as_array().unwrap().iter().map(|matrix| {
        RationalMatrix::from_rows(matrix.as_array().unwrap().iter().map(|row| {
            let row = row.as_array().unwrap().iter();
            row.map(|entry| entry.as_str().unwrap().parse().unwrap()).collect()
        }))
    });
    let algebra = LieAlgebra::from_basis(group, matrices.collect()).unwrap();
    let named = catalogue::lookup(group).unwrap();
    assert_eq!(named.basis(), algebra.basis(), "{group}: the catalogue's basis");
    assert_eq!(named.structure(), algebra.structure());
    algebra
}

#[test]
fn every_entry_term_by_term() {
    let entries: Value = serde_json::from_str(include_str!("../reference/series.json")).unwrap();
    let entries = entries.as_array().unwrap();
    assert_eq!(entries.len(), 7);
    for entry in entries {
        let algebra = algebra(entry["group"].as_str().unwrap());
        let chart = match entry["chart"].as_str().unwrap() {
            "exp" => Chart::Exponential,
            "cayley" => Chart::Cayley,
            other => panic!("unknown chart {other}"),
        };
        let hamiltonian = polynomial(algebra.dim(), &entry["H"]);
        let orders = entry["S"].as_array().unwrap();
        let series =
            derive(&algebra, chart, &hamiltonian, orders.len(), TermLimit::default()).unwrap();
        for order in orders {
            let k = order["k"].as_u64().unwrap() as usize;
            let expected = polynomial(algebra.dim(), &order["terms"]);
            assert_eq!(*series.order(k), expected, "{} {} S_{k}", entry["system"], chart);
        }
    }
}

#[test]
fn catalogue_has_the_reference_bases() {
    let bases: Value = serde_json::from_str(include_str!("../reference/bases.json")).unwrap();
    let groups: Vec<&String> = bases.as_object().unwrap().keys().collect();
    assert_eq!(groups.len(), 6);
    for group in groups {
        algebra(group);
    }
}
