//! The terms of a polynomial in the momentum, with coefficients as text.
//!
//! Coefficients are fractions; only a file with irrational numbers, such as sqrt(2), leaves opaque
//! symbols in them.

use coadjoint_codegen::cancel;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;
use num_traits::{One, Signed};

/// Exponents of the momentum's coordinates and the coefficient: a sum of fractions times powers of
/// symbols.
pub struct Term {
    /// One exponent per coordinate.
    pub exponents: Vec<u32>,
    /// Each with the powers of the symbols.
    pub summands: Vec<(Rational, Vec<u32>)>,
}

/// The terms, highest exponents first.
pub fn terms(problem: &Problem, polynomial: &Polynomial) -> Vec<Term> {
    let dim = problem.algebra.dim();
    let mut result: Vec<Term> = Vec::new();
    for (exponents, factor) in polynomial.terms() {
        cancel::check();
        let (momenta, symbols) = exponents.split_at(dim);
        match result.last_mut() {
            Some(last) if last.exponents == momenta => {
                last.summands.push((factor, symbols.to_vec()));
            }
            _ => result.push(Term {
                exponents: momenta.to_vec(),
                summands: vec![(factor, symbols.to_vec())],
            }),
        }
    }
    result
}

impl Term {
    /// The coefficient, if it is a number.
    pub fn number(&self) -> Option<&Rational> {
        match &self.summands[..] {
            [(factor, symbols)] if symbols.iter().all(|&power| power == 0) => Some(factor),
            _ => None,
        }
    }

    /// The coefficient in the notation of the input.
    pub fn coefficient(&self, problem: &Problem) -> String {
        cancel::check();
        if let Some(number) = self.number() {
            return number.to_string();
        }
        let mut text = String::new();
        for (factor, symbols) in &self.summands {
            let sign = match (factor.is_negative(), text.is_empty()) {
                (true, true) => "-",
                (true, false) => " - ",
                (false, true) => "",
                (false, false) => " + ",
            };
            text.push_str(sign);
            let mut factors = Vec::new();
            if !factor.abs().is_one() || symbols.iter().all(|&power| power == 0) {
                factors.push(factor.abs().to_string());
            }
            for (symbol, &power) in problem.symbols.iter().zip(symbols) {
                match power {
                    0 => {}
                    1 => factors.push(symbol.text.clone()),
                    _ => factors.push(format!("({})^{power}", symbol.text)),
                }
            }
            text.push_str(&factors.join("*"));
        }
        text
    }
}
