//! The series for papers.

use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;
use num_traits::{One, Signed};

use super::Series;
use super::terms::{joined, terms};

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
    let power = |name: &str, power| match power {
        1 => format!("{} ", name_in_math(name)),
        _ => format!("{}^{{{power}}} ", name_in_math(name)),
    };
    joined(terms(polynomial, problem.algebra.dim()).iter().map(|term| {
        let powers = term.powers(&problem.coordinates, power).concat();
        let size = match term.number() {
            Some(number) if number.abs().is_one() && !powers.is_empty() => String::new(),
            Some(number) if number.is_integer() => format!("{} ", number.numer().abs()),
            Some(number) => {
                format!("\\tfrac{{{}}}{{{}}} ", number.numer().abs(), number.denom())
            }
            None => {
                let text = term.coefficient(&problem.symbols);
                let text = text.replace('_', "\\_").replace('^', "\\^{}");
                format!("\\left(\\text{{{text}}}\\right) ")
            }
        };
        let text = (size + &powers).trim_end().to_owned();
        (term.number().is_some_and(Rational::is_negative), text)
    }))
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
