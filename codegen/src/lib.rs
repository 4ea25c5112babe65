//! See the workspace README.

pub mod diagnostic;
pub mod expr;
pub mod hamilton_jacobi;
pub mod lie;
pub mod number;
pub mod parse;
pub mod pass;
pub mod poly;
pub mod problem;
