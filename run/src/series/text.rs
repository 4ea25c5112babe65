//! The series for people.

use std::fmt::Write;

use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::{Problem, Symbol};

use coadjoint_learn::ModelFile;
use num_traits::ToPrimitive;

use super::Series;
use super::terms::{joined, terms};
use crate::error::RunError;
use crate::number::shortest;

/// A head, then one polynomial per order.
pub fn series(derived: &Series) -> String {
    let Series { problem, series } = derived;
    let Problem { name, algebra, chart, truncation, .. } = problem;
    let (group, order) = (algebra.name(), truncation + 1);
    let mut out = format!(
        "{name}: group {group}, chart {chart}, truncation {truncation}, order of accuracy {order}\nH = {}\n",
        polynomial(problem, &problem.hamiltonian)
    );
    // Writing into a string cannot fail.
    if let Some(frame) = &problem.comoving {
        let energy = polynomial(problem, &frame.energy());
        let _ = writeln!(out, "comoving frame: f = {energy}; S generates the flow of H - f");
    }
    let _ = writeln!(out, "S(h, p) = sum over k of h^k S_k(p); even k vanish");
    for k in (1..=*truncation).step_by(2) {
        let order = series.order(k);
        let _ = writeln!(out, "S_{k} = {}    ({} terms)", polynomial(problem, order), order.len());
    }
    out
}

/// A polynomial in the notation of system files.
pub fn polynomial(problem: &Problem, polynomial: &Polynomial) -> String {
    sum(polynomial, &problem.coordinates, &problem.symbols)
}

/// S of a learned polynomial in the notation of system files, its coefficients as decimals.
///
/// # Errors
/// Where the model is no polynomial.
pub fn learned(model: &ModelFile) -> Result<String, RunError> {
    let hamiltonian = coadjoint_learn::problem(model, "learned")?.hamiltonian;
    Ok(joined(hamiltonian.terms().map(|(exponents, value)| {
        let value = value.to_f64().unwrap_or(f64::NAN) * model.step;
        let mut factors = vec![shortest(value.abs())];
        for (i, power) in exponents.into_iter().enumerate().filter(|(_, power)| *power > 0) {
            factors.push(if power == 1 { format!("mu[{i}]") } else { format!("mu[{i}]^{power}") });
        }
        (value < 0.0, factors.join("*"))
    })))
}

/// A polynomial in variables with these names, and the symbols after them.
pub fn sum(polynomial: &Polynomial, names: &[String], symbols: &[Symbol]) -> String {
    joined(terms(polynomial, names.len()).iter().map(|term| term.text(names, symbols)))
}
