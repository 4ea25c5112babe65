//! Opaque coefficients as expressions of C in the user's parameters.

use super::names::Names;
use crate::emit::c::dialect::decimal;
use crate::expr::{Function, ParameterExpr};
use crate::problem::{Parameter, Shape};

/// The text before the name of a parameter.
pub(crate) const MEMBER: &str = "parameters->";
/// The end of the name of the function for powers, with the parenthesis of a call.
pub(crate) const POWER_OF: &str = "_internal_power(";

/// The scalars of the parameters as members of the structure `parameters`, in their order.
pub(crate) fn scalars(parameters: &[Parameter], names: &Names) -> Vec<String> {
    let members = parameters.iter().zip(&names.parameters);
    members
        .flat_map(|(parameter, name)| {
            let place = move |i: usize| format!("{MEMBER}{name}{}", index(&parameter.shape, i));
            (0..parameter.shape.len()).map(place).collect::<Vec<_>>()
        })
        .collect()
}

/// The index of scalar number `i` of a parameter.
fn index(shape: &Shape, i: usize) -> String {
    match shape {
        Shape::Scalar => String::new(),
        Shape::Array(_) | Shape::Vector(_) => format!("[{i}]"),
        Shape::Grid(_, columns) | Shape::Matrix(_, columns) => {
            format!("[{}][{}]", i / columns, i % columns)
        }
    }
}

pub(crate) fn member(shape: &Shape, name: &str) -> String {
    match shape {
        Shape::Scalar => format!("double {name}"),
        Shape::Array(n) | Shape::Vector(n) => format!("double {name}[{n}]"),
        Shape::Grid(rows, columns) | Shape::Matrix(rows, columns) => {
            format!("double {name}[{rows}][{columns}]")
        }
    }
}

/// The value of `expr`; what has no parameter in it is a number already. `scalars` are the expressions of the parameters.
pub(crate) fn expression(expr: &ParameterExpr, scalars: &[String], names: &Names) -> String {
    let sub = |e: &ParameterExpr| expression(e, scalars, names);
    let number = || decimal(expr.evaluate(&[]));
    let text = match expr {
        ParameterExpr::Rational(_) => number(),
        ParameterExpr::Parameter(i) => scalars.get(*i).cloned().unwrap_or_else(number),
        ParameterExpr::Add(a, b) => format!("({} + {})", sub(a), sub(b)),
        ParameterExpr::Sub(a, b) => format!("({} - {})", sub(a), sub(b)),
        ParameterExpr::Mul(a, b) => format!("({} * {})", sub(a), sub(b)),
        ParameterExpr::Div(a, b) => format!("({} / {})", sub(a), sub(b)),
        ParameterExpr::Neg(a) => format!("(-{})", sub(a)),
        ParameterExpr::Powi(a, n) => {
            let power = format!("{}{POWER_OF}{}, {}u)", names.lower, sub(a), n.unsigned_abs());
            if *n < 0 { format!("(1.0 / {power})") } else { power }
        }
        ParameterExpr::Call(function, a) => {
            let name = match function {
                Function::Sqrt => "sqrt",
                Function::Sin => "sin",
                Function::Cos => "cos",
                Function::Tan => "tan",
                Function::Atan => "atan",
                Function::Tanh => "tanh",
                Function::Exp => "exp",
                Function::Ln => "log",
                Function::Abs => "fabs",
            };
            format!("{name}({})", sub(a))
        }
    };
    if text.contains(MEMBER) { text } else { number() }
}
