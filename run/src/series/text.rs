//! The series for people.

use std::fmt::Write;

use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;

use super::Series;
use super::coefficient::terms;

/// A head, then one polynomial per order.
pub fn series(derived: &Series) -> String {
    let Series { problem, series } = derived;
    let mut out = String::new();
    let _ = writeln!(
        out,
        "{}: group {}, chart {}, truncation {}, order of accuracy {}",
        problem.name,
        problem.algebra.name(),
        problem.chart,
        problem.truncation,
        problem.truncation + 1
    );
    let _ = writeln!(out, "H = {}", polynomial(problem, &problem.hamiltonian));
    if let Some(frame) = &problem.comoving {
        let _ = writeln!(
            out,
            "comoving frame: f = {}; S generates the flow of H - f",
            polynomial(problem, &frame.energy())
        );
    }
    let _ = writeln!(out, "S(h, p) = sum over k of h^k S_k(p); even k vanish");
    for k in (1..=problem.truncation).step_by(2) {
        let order = series.order(k);
        let _ = writeln!(out, "S_{k} = {}    ({} terms)", polynomial(problem, order), order.len());
    }
    out
}

/// A polynomial in the notation of system files.
pub fn polynomial(problem: &Problem, polynomial: &Polynomial) -> String {
    let mut out = String::new();
    for term in terms(problem, polynomial) {
        let coefficient = term.coefficient(problem);
        let sum = term.summands.len() > 1;
        let (sign, size) = match coefficient.strip_prefix('-') {
            Some(rest) if !sum => ("-", rest.to_owned()),
            _ => ("+", if sum { format!("({coefficient})") } else { coefficient }),
        };
        match (out.is_empty(), sign) {
            (true, "-") => out.push('-'),
            (true, _) => {}
            (false, sign) => {
                let _ = write!(out, " {sign} ");
            }
        }
        let powers: Vec<String> = problem
            .coordinates
            .iter()
            .zip(&term.exponents)
            .filter(|(_, power)| **power > 0)
            .map(|(name, power)| if *power == 1 { name.clone() } else { format!("{name}^{power}") })
            .collect();
        match (powers.is_empty(), size.as_str()) {
            (true, size) => out.push_str(size),
            (false, "1") => out.push_str(&powers.join("*")),
            (false, size) => {
                let _ = write!(out, "{size}*{}", powers.join("*"));
            }
        }
    }
    if out.is_empty() { "0".to_owned() } else { out }
}
