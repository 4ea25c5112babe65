//! Expressions in parameters only, which become opaque coefficients ([`ParameterExpr`]).

use std::fmt::Write;

use coadjoint_program::fold::Values;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::number::Rational;

/// A function of one real number. (Those of the momentum are straight-line programs, [`coadjoint_program::Function`].)
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Function {
    /// The square root.
    Sqrt,
    /// The sine (radians).
    Sin,
    /// The cosine (radians).
    Cos,
    /// The tangent (radians).
    Tan,
    /// The inverse of the tangent.
    Atan,
    /// The hyperbolic tangent.
    Tanh,
    /// The exponential.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The absolute value.
    Abs,
    /// 1, 0 or −1.
    Sign,
}

impl Function {
    /// Every function.
    pub const ALL: [Self; 10] = [
        Self::Sqrt,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Atan,
        Self::Tanh,
        Self::Exp,
        Self::Ln,
        Self::Abs,
        Self::Sign,
    ];

    /// The name of the function: the same in a system file and as a method of `f64`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sqrt => "sqrt",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Atan => "atan",
            Self::Tanh => "tanh",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
            Self::Sign => "sign",
        }
    }

    /// The function of this name.
    pub fn lookup(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == name)
    }

    /// The value of the function at `x`.
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Self::Sqrt => x.sqrt(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Atan => x.atan(),
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Abs => x.abs(),
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
        }
    }

    /// The derivative of the function at `x`.
    pub(crate) fn slope(self, x: f64) -> f64 {
        match self {
            Self::Sqrt => 0.5 / x.sqrt(),
            Self::Sin => x.cos(),
            Self::Cos => -x.sin(),
            Self::Tan => 1.0 + x.tan().powi(2),
            Self::Atan => 1.0 / (1.0 + x * x),
            Self::Tanh => 1.0 - x.tanh().powi(2),
            Self::Exp => x.exp(),
            Self::Ln => 1.0 / x,
            Self::Abs if x == 0.0 => f64::NAN,
            Self::Abs => x.signum(),
            Self::Sign => 0.0,
        }
    }
}

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
    pub fn evaluate(&self, parameters: &[f64]) -> f64 {
        self.evaluate_rows(parameters)
    }

    /// The values for rows of parameters side by side.
    pub fn evaluate_rows<T: Values>(&self, parameters: &[T]) -> T {
        let all = |x: f64| T::each(|_| x);
        let one = |a: &Self, of: &dyn Fn(f64) -> f64| {
            let a = a.evaluate_rows(parameters);
            T::each(|l| of(a.lane(l)))
        };
        let two = |a: &Self, b: &Self, of: &dyn Fn(f64, f64) -> f64| {
            let (a, b) = (a.evaluate_rows(parameters), b.evaluate_rows(parameters));
            T::each(|l| of(a.lane(l), b.lane(l)))
        };
        match self {
            Self::Rational(q) => all(q.to_f64().unwrap_or(f64::NAN)),
            Self::Parameter(i) => parameters.get(*i).copied().unwrap_or(all(f64::NAN)),
            Self::Add(a, b) => two(a, b, &|a, b| a + b),
            Self::Sub(a, b) => two(a, b, &|a, b| a - b),
            Self::Mul(a, b) => two(a, b, &|a, b| a * b),
            Self::Div(a, b) => two(a, b, &|a, b| a / b),
            Self::Neg(a) => one(a, &|a| -a),
            Self::Powi(a, n) => one(a, &|a| a.powi(*n)),
            Self::Call(function, a) => one(a, &|a| function.apply(a)),
        }
    }

    /// Puts exact values in for the parameters that have one, and computes with numbers as far as that is exact.
    pub(crate) fn with_values(&self, values: &[Option<Rational>]) -> Self {
        type Exact<'a> = &'a dyn Fn(&Rational, &Rational) -> Option<Rational>;
        let within = |a: &Self| Box::new(a.with_values(values));
        let pair =
            |a: &Self, b: &Self, exact: Exact<'_>, otherwise: fn(Box<Self>, Box<Self>) -> Self| {
                let (a, b) = (within(a), within(b));
                match (&*a, &*b) {
                    (Self::Rational(x), Self::Rational(y)) => exact(x, y).map(Self::Rational),
                    _ => None,
                }
                .unwrap_or_else(|| otherwise(a, b))
            };
        match self {
            Self::Rational(_) => self.clone(),
            Self::Parameter(i) => {
                let value = values.get(*i).cloned().flatten();
                value.map_or_else(|| self.clone(), Self::Rational)
            }
            Self::Add(a, b) => pair(a, b, &|a, b| Some(a + b), Self::Add),
            Self::Sub(a, b) => pair(a, b, &|a, b| Some(a - b), Self::Sub),
            Self::Mul(a, b) => pair(a, b, &|a, b| Some(a * b), Self::Mul),
            Self::Div(a, b) => pair(a, b, &|a, b| (!b.is_zero()).then(|| a / b), Self::Div),
            Self::Neg(a) => match *within(a) {
                Self::Rational(a) => Self::Rational(-a),
                a => Self::Neg(Box::new(a)),
            },
            Self::Powi(a, n) => match *within(a) {
                Self::Rational(a) if *n >= 0 || !a.is_zero() => Self::Rational(a.pow(*n)),
                a => Self::Powi(Box::new(a), *n),
            },
            Self::Call(function, a) => Self::Call(*function, within(a)),
        }
    }

    /// The derivative of the expression along a change of the flattened parameters; NaN where it has none.
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
