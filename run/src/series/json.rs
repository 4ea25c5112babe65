//! The series as JSON: `{system, group, H, chart, S: [{k, terms: [{exponents, coefficient}]}]}`, and
//! `comoving`, the part of H that moves the frame and is left out of S, where there is one.

use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;
use serde::Serialize;

use super::Series;
use super::coefficient::terms;

#[derive(Serialize)]
struct Object {
    system: String,
    group: String,
    #[serde(rename = "H")]
    hamiltonian: Vec<Term>,
    #[serde(skip_serializing_if = "Option::is_none")]
    comoving: Option<Vec<Term>>,
    chart: String,
    #[serde(rename = "S")]
    orders: Vec<Order>,
}

#[derive(Serialize)]
struct Order {
    k: usize,
    terms: Vec<Term>,
}

#[derive(Serialize)]
struct Term {
    exponents: Vec<u32>,
    coefficient: String,
}

/// The whole object.
pub fn series(derived: &Series) -> String {
    let Series { problem, series } = derived;
    let object = Object {
        system: problem.name.clone(),
        group: problem.algebra.name().to_owned(),
        hamiltonian: list(problem, &problem.hamiltonian),
        comoving: problem.comoving.as_ref().map(|frame| list(problem, &frame.energy())),
        chart: problem.chart.to_string(),
        orders: (1..=problem.truncation)
            .map(|k| Order { k, terms: list(problem, series.order(k)) })
            .collect(),
    };
    // Strings and integers always serialize.
    serde_json::to_string_pretty(&object).unwrap_or_default()
}

fn list(problem: &Problem, polynomial: &Polynomial) -> Vec<Term> {
    let term = |term: &super::coefficient::Term| Term {
        exponents: term.exponents.clone(),
        coefficient: term.coefficient(problem),
    };
    terms(problem, polynomial).iter().map(term).collect()
}
