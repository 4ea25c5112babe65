//! End states the crates did not produce: `tests/reference/*.json`.
//!
//! `systems.json` is written by `make_references.py` beside it (Taylor series of order 44 at 190
//! bits, 25 digits kept) from system files; `end_states.json` came with the project.

use std::str::FromStr;

use coadjoint_codegen::hamilton_jacobi::{GeneratingSeries, TermLimit, derive};
use coadjoint_codegen::lie::{Chart, LieAlgebra, catalogue};
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use serde::Deserialize;

#[derive(Clone, Debug, Deserialize)]
pub struct Term {
    pub exponents: Vec<u32>,
    /// c as a reduced fraction.
    pub coefficient: String,
}

/// A system, where it starts, and where it is at time T.
#[derive(Clone, Debug, Deserialize)]
pub struct EndState {
    pub system: String,
    /// The system file, where there is one.
    pub file: Option<String>,
    /// A name of the catalogue, or `algebra`.
    pub group: String,
    /// All structure constants (i, j, k, c) where `group` is `algebra`.
    pub structure: Option<Vec<(usize, usize, usize, String)>>,
    #[serde(rename = "H")]
    pub hamiltonian: Vec<Term>,
    pub momentum0: Vec<String>,
    #[serde(rename = "T")]
    pub time: String,
    pub momentum: Vec<String>,
    /// g(T), with g(0) = 1; adjoint matrices where only brackets are known.
    pub group_element: Vec<Vec<String>>,
}

pub fn end_states() -> Vec<EndState> {
    let mut all: Vec<EndState> = serde_json::from_str(include_str!("../reference/end_states.json"))
        .expect("end_states.json");
    let systems: Vec<EndState> =
        serde_json::from_str(include_str!("../reference/systems.json")).expect("systems.json");
    all.extend(systems);
    all
}

pub fn end_state(system: &str) -> EndState {
    let found = end_states().into_iter().find(|entry| entry.system == system);
    found.unwrap_or_else(|| panic!("no reference for {system}"))
}

pub fn numbers(texts: &[String]) -> Vec<f64> {
    texts.iter().map(|text| text.parse().expect("a decimal")).collect()
}

impl EndState {
    pub fn algebra(&self) -> LieAlgebra {
        match &self.structure {
            None => catalogue::lookup(&self.group).expect("a group of the catalogue"),
            Some(structure) => {
                let entries = structure.iter().map(|(i, j, k, c)| (*i, *j, *k, fraction(c)));
                LieAlgebra::from_structure_constants(&*self.system, self.momentum0.len(), entries)
                    .expect("a Lie algebra")
            }
        }
    }

    pub fn polynomial(&self) -> Polynomial {
        let terms = self.hamiltonian.iter();
        Polynomial::from_terms(
            self.momentum0.len(),
            terms.map(|term| (term.exponents.clone(), fraction(&term.coefficient))),
        )
    }

    pub fn series(&self, truncation: usize) -> GeneratingSeries {
        let (algebra, limit) = (self.algebra(), TermLimit::default());
        derive(&algebra, Chart::Exponential, &self.polynomial(), truncation, limit)
            .expect("a derivation")
    }
}

fn fraction(text: &str) -> Rational {
    Rational::from_str(text).expect("a fraction")
}
