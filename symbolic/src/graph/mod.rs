//! Expression graphs: what a step computes, as shared multiplications and additions.
//!
//! Polynomials whose coefficients are numbered *slots* are lowered together into one [`Program`]:
//! Horner's scheme in several variables, powers and equal sub-expressions shared. Graphs and programs are those of
//! `coadjoint-program`, which every target reads.

mod horner;
mod interpret;

pub use coadjoint_program::{Cost, Graph, Id, Node, Program};
pub use horner::{SlotPolynomial, SlotTerm, lower};
pub use interpret::{Arithmetic, evaluate};
