//! Expressions in parameters only, which become opaque coefficients ([`ParameterExpr`]).

mod function;
mod parameter;

pub use function::Function;
pub use parameter::ParameterExpr;
