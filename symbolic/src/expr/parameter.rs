//! Expressions in parameters only: the opaque coefficients of a Hamiltonian.

use std::fmt::Write;

use num_traits::{One, Signed, ToPrimitive};

use crate::expr::Function;
use crate::number::Rational;

/// An expression in parameters and numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterExpr {
    /// An exact number.
    Rational(Rational),
    /// A scalar parameter, by its index among all parameters flattened.
    Parameter(usize),
    /// a + b.
    Add(Box<Self>, Box<Self>),
    /// a − b.
    Sub(Box<Self>, Box<Self>),
    /// a · b.
    Mul(Box<Self>, Box<Self>),
    /// a / b.
    Div(Box<Self>, Box<Self>),
    /// −a.
    Neg(Box<Self>),
    /// a to an integer power.
    Powi(Box<Self>, i32),
    /// A function of a.
    Call(Function, Box<Self>),
}

impl ParameterExpr {
    /// The value of the expression for given values of the flattened parameters; a missing one counts as NaN.
    #[must_use]
    pub fn evaluate(&self, parameters: &[f64]) -> f64 {
        let value = |e: &Self| e.evaluate(parameters);
        match self {
            Self::Rational(q) => q.to_f64().unwrap_or(f64::NAN),
            Self::Parameter(i) => parameters.get(*i).copied().unwrap_or(f64::NAN),
            Self::Add(a, b) => value(a) + value(b),
            Self::Sub(a, b) => value(a) - value(b),
            Self::Mul(a, b) => value(a) * value(b),
            Self::Div(a, b) => value(a) / value(b),
            Self::Neg(a) => -value(a),
            Self::Powi(a, n) => value(a).powi(*n),
            Self::Call(function, a) => function.apply(value(a)),
        }
    }

    /// The derivative of the expression along a change of the flattened parameters; NaN where it has none.
    #[must_use]
    pub fn slope(&self, parameters: &[f64], change: &[f64]) -> f64 {
        let value = |e: &Self| e.evaluate(parameters);
        let slope = |e: &Self| e.slope(parameters, change);
        match self {
            Self::Rational(_) => 0.0,
            Self::Parameter(i) => change.get(*i).copied().unwrap_or(f64::NAN),
            Self::Add(a, b) => slope(a) + slope(b),
            Self::Sub(a, b) => slope(a) - slope(b),
            Self::Mul(a, b) => slope(a) * value(b) + value(a) * slope(b),
            Self::Div(a, b) => (slope(a) - value(self) * slope(b)) / value(b),
            Self::Neg(a) => -slope(a),
            Self::Powi(_, 0) => 0.0,
            Self::Powi(a, n) => f64::from(*n) * value(a).powi(n - 1) * slope(a),
            Self::Call(function, a) => function.slope(value(a)) * slope(a),
        }
    }

    /// The expression as a user would write it, with `names` for the flattened parameters.
    #[must_use]
    pub fn text(&self, names: &[String]) -> String {
        let mut out = String::new();
        self.write(&mut out, names, 0);
        out
    }

    /// Binding strength: 1 sum, 2 product, 3 power, 4 atom.
    fn strength(&self) -> u8 {
        match self {
            Self::Add(..) | Self::Sub(..) | Self::Neg(_) => 1,
            Self::Mul(..) | Self::Div(..) => 2,
            Self::Powi(..) => 3,
            Self::Rational(q) if q.is_negative() => 1,
            Self::Rational(q) if !q.denom().is_one() => 2,
            Self::Rational(_) | Self::Parameter(_) | Self::Call(..) => 4,
        }
    }

    fn write(&self, out: &mut String, names: &[String], least: u8) {
        let wrapped = self.strength() < least;
        if wrapped {
            out.push('(');
        }
        let mut binary = |a: &Self, operator: &str, b: &Self, left: u8, right: u8| {
            a.write(out, names, left);
            out.push_str(operator);
            b.write(out, names, right);
        };
        match self {
            Self::Add(a, b) => binary(a, " + ", b, 1, 1),
            Self::Sub(a, b) => binary(a, " - ", b, 1, 2),
            Self::Mul(a, b) => binary(a, "*", b, 2, 2),
            Self::Div(a, b) => binary(a, "/", b, 2, 3),
            Self::Rational(q) => {
                let _ = write!(out, "{q}");
            }
            Self::Parameter(i) => match names.get(*i) {
                Some(name) => out.push_str(name),
                None => {
                    let _ = write!(out, "parameter {i}");
                }
            },
            Self::Neg(a) => {
                out.push('-');
                a.write(out, names, 2);
            }
            Self::Powi(a, n) => {
                a.write(out, names, 4);
                let _ = write!(out, "^{n}");
            }
            Self::Call(function, a) => {
                out.push_str(function.name());
                out.push('(');
                a.write(out, names, 0);
                out.push(')');
            }
        }
        if wrapped {
            out.push(')');
        }
    }
}
