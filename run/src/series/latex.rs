//! The series for papers.

use std::fmt::Write;

use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;
use num_traits::{One, Signed};

use super::Series;
use super::coefficient::terms;

/// An `align` environment with one row per order that does not vanish; in a comoving frame S generates
/// the flow of H₀.
pub fn series(derived: &Series) -> String {
    let Series { problem, series } = derived;
    let mut rows = vec![format!("H &= {}", polynomial(problem, &problem.hamiltonian))];
    if let Some(frame) = &problem.comoving {
        rows.push(format!("H - H_0 &= {}", polynomial(problem, &frame.energy())));
    }
    for k in (1..=problem.truncation).step_by(2) {
        rows.push(format!("S_{{{k}}} &= {}", polynomial(problem, series.order(k))));
    }
    format!("\\begin{{align}}\n{}\n\\end{{align}}\n", rows.join(" \\\\\n"))
}

/// A polynomial in the momentum.
pub fn polynomial(problem: &Problem, polynomial: &Polynomial) -> String {
    let mut out = String::new();
    for term in terms(problem, polynomial) {
        let negative = term.number().is_some_and(Rational::is_negative);
        let sign = match (out.is_empty(), negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => "- ",
            (false, false) => "+ ",
        };
        out.push_str(sign);
        let powers: String = problem
            .coordinates
            .iter()
            .zip(&term.exponents)
            .filter(|(_, power)| **power > 0)
            .map(|(name, power)| factor(&name_in_math(name), *power))
            .collect();
        match term.number() {
            Some(number) if number.abs().is_one() && !powers.is_empty() => {}
            Some(number) if number.is_integer() => {
                let _ = write!(out, "{} ", number.numer().abs());
            }
            Some(number) => {
                let (n, d) = (number.numer().abs(), number.denom());
                let _ = write!(out, "\\tfrac{{{n}}}{{{d}}} ");
            }
            None => {
                let text = term.coefficient(problem).replace('_', "\\_").replace('^', "\\^{}");
                let _ = write!(out, "\\left(\\text{{{text}}}\\right) ");
            }
        }
        out.push_str(&powers);
    }
    let out = out.trim_end();
    if out.is_empty() { "0".to_owned() } else { out.to_owned() }
}

fn factor(name: &str, power: u32) -> String {
    if power == 1 { format!("{name} ") } else { format!("{name}^{{{power}}} ") }
}

/// `x1` as x₁, `Pi_x` as Π with index x, `mu[0]` as μ with index 0.
fn name_in_math(name: &str) -> String {
    let letters = |c: char| c.is_alphabetic();
    let end = name.find(|c: char| !letters(c)).unwrap_or(name.len());
    let (head, tail) = name.split_at(end);
    let greek = ["Pi", "Gamma", "Omega", "mu", "pi", "gamma", "omega", "alpha", "beta", "xi", "nu"];
    let head = match head {
        head if greek.contains(&head) => format!("\\{head}"),
        head if head.chars().count() > 1 => format!("\\mathrm{{{head}}}"),
        head => head.to_owned(),
    };
    let index: String = tail.chars().filter(|c| c.is_alphanumeric()).collect();
    if index.is_empty() { head } else { format!("{head}_{{{index}}}") }
}
