//! Opaque coefficients as expressions of C in the user's parameters.

use super::names::Names;
use crate::emit::c::dialect::decimal;
use crate::emit::parameter::{Notation, expression};
use crate::expr::Function;
use crate::problem::{Parameter, Shape, Symbol};

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

/// The values of symbols.
pub(crate) fn symbols(symbols: &[Symbol], parameters: &[String], names: &Names) -> Vec<String> {
    let notation = Notation {
        parameters,
        number: &decimal,
        power: &|base, exponent| {
            let power = format!("{}{POWER_OF}{base}, {}u)", names.lower, exponent.unsigned_abs());
            if exponent < 0 { format!("(1.0 / {power})") } else { power }
        },
        call: &|function, argument| match function {
            Function::Ln => format!("log({argument})"),
            Function::Abs => format!("fabs({argument})"),
            Function::Sign => format!("(({argument} > 0.0) - ({argument} < 0.0))"),
            _ => format!("{}({argument})", function.name()),
        },
    };
    symbols.iter().map(|symbol| expression(&symbol.expr, &notation)).collect()
}
