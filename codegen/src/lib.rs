//! See the workspace README.

pub mod hamilton_jacobi;
pub mod lie;
pub mod number;
pub mod poly;
