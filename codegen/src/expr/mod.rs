//! Expressions, in two forms: as the user wrote them ([`Arena`], with places), and those in
//! parameters only that become opaque coefficients ([`ParameterExpr`]).

mod arena;

pub use arena::{Arena, ExprId, Node};
pub use coadjoint_symbolic::expr::{Function, ParameterExpr};
