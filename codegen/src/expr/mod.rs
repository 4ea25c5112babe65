//! Expressions, in two forms: as the user wrote them ([`Arena`], with places), and those in
//! parameters only that become opaque coefficients ([`ParameterExpr`]).

mod arena;
mod function;
mod parameter;

pub use arena::{Arena, ExprId, Node};
pub use function::Function;
pub use parameter::ParameterExpr;
