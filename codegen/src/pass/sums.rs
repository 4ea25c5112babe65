//! Sums of symbols as symbols of their own.

use std::collections::BTreeMap;

use num_traits::Signed;

use super::coefficient::{balanced, difference};
use crate::comoving::Frame;
use crate::expr::ParameterExpr;
use crate::number::Rational;
use crate::poly::{Polynomial, split_at};
use crate::problem::Symbol;

/// Factors (variable, power).
type Monomial = Vec<(u32, u32)>;
type Sum = Vec<(Monomial, Rational)>;

/// Makes every sum of symbols in the frame's rest, 1/I₁ − 1/I₂ say, a symbol of its own, of which the
/// series would expand the powers. New symbols are appended to `symbols`; `names` are those of the
/// parameters. Proportional sums share a symbol.
pub(crate) fn name_sums(
    frame: &Frame,
    dim: usize,
    symbols: &mut Vec<Symbol>,
    names: &[String],
) -> Frame {
    let mut grouped: BTreeMap<Monomial, Sum> = BTreeMap::new();
    for (factors, value) in frame.rest.factors() {
        let (momenta, own) = split_at(&factors, dim);
        grouped.entry(momenta.to_vec()).or_default().push((own.to_vec(), value));
    }
    let mut terms = Sum::new();
    // Sums whose first coefficient is one, and the symbols they have become.
    let mut known: Vec<(Sum, usize)> = Vec::new();
    for (mut factors, mut sum) in grouped {
        let Some((first, leading)) = sum.first().cloned() else { continue };
        if sum.len() == 1 {
            factors.extend(first);
        } else {
            sum.iter_mut().for_each(|(_, value)| *value = &*value / &leading);
            let place = match known.iter().find(|(other, _)| *other == sum) {
                Some(&(_, place)) => place,
                None => {
                    let expr = expression(&sum, dim, symbols);
                    let text = expr.text(names);
                    symbols.push(Symbol { expr, text });
                    known.push((sum, symbols.len() - 1));
                    symbols.len() - 1
                }
            };
            factors.push(((dim + place) as u32, 1));
        }
        terms.push((factors, leading));
    }
    let variables = dim + symbols.len();
    Frame {
        spin: frame.spin.widened(variables).into_owned(),
        casimirs: frame.casimirs.widened(variables).into_owned(),
        rest: Polynomial::from_factors(variables, terms),
    }
}

fn expression(sum: &Sum, dim: usize, symbols: &[Symbol]) -> ParameterExpr {
    let of_sign = |negative: bool| {
        let terms = sum.iter().filter(|(_, value)| value.is_negative() == negative);
        terms.map(|(factors, value)| product(factors, &value.abs(), dim, symbols)).collect()
    };
    difference(of_sign(false), of_sign(true))
}

/// value · Π symbolᵢ^powerᵢ.
fn product(
    factors: &[(u32, u32)],
    value: &Rational,
    dim: usize,
    symbols: &[Symbol],
) -> ParameterExpr {
    let number = (*value != Rational::from_integer(1.into()) || factors.is_empty())
        .then(|| ParameterExpr::Rational(value.clone()));
    let powers = factors.iter().filter_map(|&(variable, power)| {
        let base = symbols.get((variable as usize).checked_sub(dim)?)?.expr.clone();
        let power = i32::try_from(power).ok()?;
        Some(if power == 1 { base } else { ParameterExpr::Powi(Box::new(base), power) })
    });
    balanced(number.into_iter().chain(powers).collect(), ParameterExpr::Mul)
        .unwrap_or_else(|| ParameterExpr::Rational(value.clone()))
}
