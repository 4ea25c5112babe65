//! The terms of a polynomial, with coefficients as text.
//!
//! Coefficients are fractions; only a file with irrational numbers, such as sqrt(2), leaves opaque
//! symbols in them.

use coadjoint_codegen::cancel;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Symbol;
use num_traits::{One, Signed};

/// Exponents of the first variables and the coefficient: a sum of fractions times powers of the symbols after them.
pub(crate) struct Term {
    /// One exponent per variable.
    pub exponents: Vec<u32>,
    /// Each with the powers of the symbols.
    summands: Vec<(Rational, Vec<u32>)>,
}

/// The terms, highest exponents first.
pub(crate) fn terms(polynomial: &Polynomial, variables: usize) -> Vec<Term> {
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
pub(crate) fn joined(summands: impl IntoIterator<Item = (bool, String)>) -> String {
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
    pub(crate) fn number(&self) -> Option<&Rational> {
        match &self.summands[..] {
            [(factor, symbols)] if symbols.iter().all(|&power| power == 0) => Some(factor),
            _ => None,
        }
    }

    /// The coefficient in the notation of the input.
    pub(crate) fn coefficient(&self, symbols: &[Symbol]) -> String {
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
    pub(crate) fn powers(
        &self,
        names: &[String],
        power: impl Fn(&str, u32) -> String,
    ) -> Vec<String> {
        let factors = names.iter().zip(&self.exponents).filter(|(_, power)| **power > 0);
        factors.map(|(name, exponent)| power(name, *exponent)).collect()
    }

    /// Its sign, and its text in the notation of system files.
    pub(crate) fn text(&self, names: &[String], symbols: &[Symbol]) -> (bool, String) {
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
