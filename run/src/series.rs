//! The exact series, and how it is written.

use std::fmt::Write;
use std::path::Path;

use coadjoint_codegen::cancel;
use coadjoint_codegen::hamilton_jacobi::{self, GeneratingSeries, TermLimit};
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::{Problem, Symbol};
use coadjoint_learn::ModelFile;
use num_traits::{One, Signed, ToPrimitive};
use serde_json::{Value, json};

use crate::error::RunError;
use crate::number::shortest;

/// A system with its series.
pub struct Expansion {
    /// The system.
    pub problem: Problem,
    /// S₁ … S_K.
    pub series: GeneratingSeries,
}

impl Expansion {
    /// Derives S₁ … S_K of a system, which is called `file` in messages.
    ///
    /// # Errors
    /// Fails if the series is too large.
    pub fn derive(file: &Path, problem: Problem) -> Result<Self, RunError> {
        let series = hamilton_jacobi::derive(
            &problem.algebra,
            problem.chart,
            problem.generated(),
            problem.truncation,
            TermLimit::default(),
        )
        .map_err(RunError::of(file))?;
        Ok(Self { problem, series })
    }
}

/// A head, then one polynomial per order.
pub fn text(derived: &Expansion) -> String {
    let Expansion { problem, series } = derived;
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
/// Fails if the model is no polynomial.
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

/// The series as JSON: `{system, group, H, chart, S: [{k, terms: [{exponents, coefficient}]}]}`, and `comoving`, the part of H
/// that moves the frame and is left out of S, where there is one.
pub fn json(derived: &Expansion) -> String {
    let Expansion { problem, series } = derived;
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

/// An `align` environment with one row per order that does not vanish; in a comoving frame S generates
/// the flow of H₀.
pub fn latex(derived: &Expansion) -> String {
    let Expansion { problem, series } = derived;
    let mut rows = vec![format!("H &= {}", latex_polynomial(problem, &problem.hamiltonian))];
    if let Some(frame) = &problem.comoving {
        rows.push(format!("H - H_0 &= {}", latex_polynomial(problem, &frame.energy())));
    }
    for k in (1..=problem.truncation).step_by(2) {
        rows.push(format!("S_{{{k}}} &= {}", latex_polynomial(problem, series.order(k))));
    }
    format!("\\begin{{align}}\n{}\n\\end{{align}}\n", rows.join(" \\\\\n"))
}

/// A polynomial in the momentum.
pub(crate) fn latex_polynomial(problem: &Problem, polynomial: &Polynomial) -> String {
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

/// A term of a polynomial: exponents of the first variables, and the coefficient, a sum of fractions times powers of the
/// symbols after them. Only a file with irrational numbers, such as sqrt(2), leaves such symbols.
struct Term {
    /// One exponent per variable.
    pub exponents: Vec<u32>,
    /// Each with the powers of the symbols.
    summands: Vec<(Rational, Vec<u32>)>,
}

/// The terms, highest exponents first.
fn terms(polynomial: &Polynomial, variables: usize) -> Vec<Term> {
    let mut result: Vec<Term> = Vec::new();
    for (exponents, factor) in polynomial.terms() {
        cancel::check();
        let (own, symbols) = exponents.split_at(variables);
        let summand = (factor, symbols.to_vec());
        match result.last_mut() {
            Some(last) if last.exponents == own => last.summands.push(summand),
            _ => result.push(Term { exponents: own.to_vec(), summands: vec![summand] }),
        }
    }
    result
}

/// Summands, each with its sign, as a sum.
fn joined(summands: impl IntoIterator<Item = (bool, String)>) -> String {
    let mut text = String::new();
    for (negative, summand) in summands {
        text.push_str(match (text.is_empty(), negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        });
        text.push_str(&summand);
    }
    if text.is_empty() { "0".to_owned() } else { text }
}

impl Term {
    /// The coefficient, if it is a number.
    fn number(&self) -> Option<&Rational> {
        match &self.summands[..] {
            [(factor, symbols)] if symbols.iter().all(|&power| power == 0) => Some(factor),
            _ => None,
        }
    }

    /// The coefficient in the notation of the input.
    fn coefficient(&self, symbols: &[Symbol]) -> String {
        cancel::check();
        joined(self.summands.iter().map(|(factor, powers)| {
            let mut factors = Vec::new();
            if !factor.abs().is_one() || powers.iter().all(|&power| power == 0) {
                factors.push(factor.abs().to_string());
            }
            for (symbol, &power) in symbols.iter().zip(powers) {
                match power {
                    0 => {}
                    1 => factors.push(symbol.text.clone()),
                    _ => factors.push(format!("({})^{power}", symbol.text)),
                }
            }
            (factor.is_negative(), factors.join("*"))
        }))
    }

    /// Its powers of variables with these names.
    fn powers(&self, names: &[String], power: impl Fn(&str, u32) -> String) -> Vec<String> {
        let factors = names.iter().zip(&self.exponents).filter(|(_, power)| **power > 0);
        factors.map(|(name, exponent)| power(name, *exponent)).collect()
    }

    /// Its sign, and its text in the notation of system files.
    fn text(&self, names: &[String], symbols: &[Symbol]) -> (bool, String) {
        let power = |name: &str, power| match power {
            1 => name.to_owned(),
            _ => format!("{name}^{power}"),
        };
        let powers = self.powers(names, power).join("*");
        let coefficient = self.coefficient(symbols);
        let (negative, size) = match coefficient.strip_prefix('-') {
            _ if self.summands.len() > 1 => (false, format!("({coefficient})")),
            Some(size) => (true, size.to_owned()),
            None => (false, coefficient),
        };
        let text = match (powers.is_empty(), size.as_str()) {
            (true, _) => size,
            (false, "1") => powers,
            (false, size) => format!("{size}*{powers}"),
        };
        (negative, text)
    }
}
