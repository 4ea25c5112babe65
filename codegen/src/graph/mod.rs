//! Expression graphs: what a step computes, as shared multiplications and additions.
//!
//! Polynomials whose coefficients are numbered *slots* are lowered together into one [`Program`]:
//! Horner's scheme in several variables, powers and equal sub-expressions shared. A program has
//! two readers, the Rust emitter and the plain [interpreter](Program::run); further back ends (C,
//! JIT) read the same nodes.

mod horner;
mod interpret;
mod node;

pub use horner::{SlotPolynomial, SlotTerm, lower};
pub use interpret::Number;
pub use node::{Cost, Graph, Id, Node, Program, operands};
