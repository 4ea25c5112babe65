//! Opaque coefficients as expressions in the user's parameters, in any language.

use super::program::float;
use crate::expr::{Function, ParameterExpr};
use crate::problem::Symbol;

/// The notation of a language for all that is more than an infix operator.
pub(crate) struct Notation<'a> {
    /// The scalar parameters, in the order of their numbers.
    pub parameters: &'a [String],
    /// A number.
    pub number: &'a dyn Fn(f64) -> String,
    /// A whole power.
    pub power: &'a dyn Fn(String, i32) -> String,
    /// A function's value.
    pub call: &'a dyn Fn(Function, String) -> String,
}

/// The value of an expression; what has no parameter in it is a number already.
pub(crate) fn expression(expr: &ParameterExpr, notation: &Notation<'_>) -> String {
    let known = expr.evaluate(&[]);
    if !known.is_nan() {
        return (notation.number)(known);
    }
    let sub = |e: &ParameterExpr| expression(e, notation);
    match expr {
        ParameterExpr::Rational(_) => (notation.number)(known),
        ParameterExpr::Parameter(index) => notation.parameters[*index].clone(),
        ParameterExpr::Add(a, b) => format!("({} + {})", sub(a), sub(b)),
        ParameterExpr::Sub(a, b) => format!("({} - {})", sub(a), sub(b)),
        ParameterExpr::Mul(a, b) => format!("({} * {})", sub(a), sub(b)),
        ParameterExpr::Div(a, b) => format!("({} / {})", sub(a), sub(b)),
        ParameterExpr::Neg(a) => format!("(-{})", sub(a)),
        ParameterExpr::Powi(a, exponent) => (notation.power)(sub(a), *exponent),
        ParameterExpr::Call(function, a) => (notation.call)(*function, sub(a)),
    }
}

/// The values of symbols as expressions of Rust, of type `T`.
pub(crate) fn symbols(symbols: &[Symbol], parameters: &[String]) -> Vec<String> {
    let notation = Notation {
        parameters,
        number: &|value| format!("T::of({})", float(value)),
        power: &|base, exponent| format!("{base}.simd_powi({exponent})"),
        call: &|function, argument| match function {
            Function::Sign => format!("plumbing::sign({argument})"),
            _ => format!("{argument}.simd_{}()", function.name()),
        },
    };
    symbols.iter().map(|symbol| expression(&symbol.expr, &notation)).collect()
}
