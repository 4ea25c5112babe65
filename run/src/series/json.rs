//! The series as JSON: `{system, group, H, chart, S: [{k, terms: [{exponents, coefficient}]}]}`, and
//! `comoving`, the part of H that moves the frame and is left out of S, where there is one.

use coadjoint_codegen::poly::Polynomial;
use serde_json::{Value, json};

use super::Series;
use super::terms::{Term, terms};

/// The whole object.
pub fn series(derived: &Series) -> String {
    let Series { problem, series } = derived;
    let list = |polynomial: &Polynomial| -> Value {
        let term = |term: &Term| json!({ "exponents": term.exponents, "coefficient": term.coefficient(&problem.symbols) });
        terms(polynomial, problem.algebra.dim()).iter().map(term).collect()
    };
    let orders = (1..=problem.truncation)
        .map(|k| json!({ "k": k, "terms": list(series.order(k)) }))
        .collect::<Value>();
    let mut object = json!({
        "system": problem.name,
        "group": problem.algebra.name(),
        "H": list(&problem.hamiltonian),
        "chart": problem.chart.name(),
        "S": orders,
    });
    if let Some(frame) = &problem.comoving {
        object["comoving"] = list(&frame.energy());
    }
    format!("{object:#}")
}
