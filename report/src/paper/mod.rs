//! The figures and tables of the paper.

pub mod learning;
pub mod poisson;
pub mod simulation;
