//! The experiments of M. Vaquero, J. Cortés and D. Martín de Diego, *Symmetry Preservation in Hamiltonian Systems:
//! Simulation and Learning*, and comparisons of our own, on one page with the numbers that judge them.

#![allow(missing_docs, reason = "a program of one page; nothing is published")]

pub mod experiment;
pub mod gallery;
pub mod outcome;
pub mod page;
mod plot;
mod state;
pub mod text;
