//! The loop of a kernel as one small tree of statements, which the interpreter walks and every target prints or compiles.

mod places;
mod tree;

pub use places::{Kind, Places};
pub(crate) use tree::schedule;
pub use tree::{BLOCK, Block, Kept, Part, Statement, Test, Variable};
