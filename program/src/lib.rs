//! Straight-line programs: what a step of a Lie–Poisson integrator computes, for every target.
//!
//! - [`Graph`] grows nodes, equal ones once; [`Program`] is a finished one, in an order of evaluation.
//! - [`Kernel`] is a whole step as programs: guess, correction, acceptance, transport, and the loop that drives them.
//! - [`Stepper`] is what makes the steps of a kernel. The kernel itself is one, the interpreter, the reference for all
//!   targets.
//! - [`print`](mod@print) writes programs and kernels in other languages.
//!
//! A fused product is an operation of the program, so that targets agree to the bit.
#![no_std]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("coadjoint-program needs one of its features `std` (the default) and `libm`");

mod dispatch;
mod drive;
mod error;
mod evaluate;
mod kernel;
mod node;
mod number;
mod packed;
mod precision;
pub mod print;
mod program;
pub mod quoting;
pub mod schedule;
mod stepper;

pub use drive::Scratch;
pub use error::ProgramError;
pub use kernel::{BLOCK, Kernel, Programs};
pub use node::{Cost, Graph, Id, Node};
pub use number::{Lanes, Number};
pub use precision::Precision;
pub use program::Program;
pub use stepper::{Outcome, Stepper, Trajectories, WIDTH};
