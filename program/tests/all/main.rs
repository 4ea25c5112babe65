//! The tests of the crate, as one program.

mod derivative;
mod function;
mod numbers;
