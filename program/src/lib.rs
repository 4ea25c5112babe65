//! Straight-line programs: what a step of a Lie–Poisson integrator computes, for every target.
//!
//! - [`Graph`] grows nodes, equal ones once; [`Program`] is a finished one, in an order of evaluation.
//! - [`Kernel`] is a whole step as programs: guess, correction, acceptance, transport, and the loop that drives them.
//! - [`Stepper`] is what makes the steps of a kernel. The kernel itself is one, the interpreter, the reference for all
//!   targets.
//! - [`fold::Fold`] is how the coefficients of a kernel follow from a step size and parameters, [`splitting`] how kicks and
//!   flows make a step, [`limits`] are those up to which steps are accepted, [`collocation`] has the numbers of steps by
//!   collocation; they are all that there is without the
//!   features.
//! - [`print`](mod@print) writes programs and kernels in other languages.
//!
//! A fused product is an operation of the program, so that targets agree to the bit.
#![no_std]

#[cfg(feature = "programs")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(all(feature = "programs", not(any(feature = "std", feature = "libm"))))]
compile_error!("coadjoint-program needs one of its features `std` (the default) and `libm`");

pub mod bits;
pub mod collocation;
#[cfg(feature = "programs")]
mod derivative;
pub mod fold;
#[cfg(feature = "programs")]
mod function;
#[cfg(feature = "programs")]
mod graph;
#[cfg(feature = "programs")]
mod interpret;
#[cfg(feature = "programs")]
mod kernel;
pub mod limits;
#[cfg(feature = "programs")]
mod number;
#[cfg(feature = "programs")]
pub mod print;
#[cfg(feature = "programs")]
pub mod quoting;
#[cfg(feature = "programs")]
pub mod schedule;
pub mod splitting;
#[cfg(feature = "programs")]
pub mod states;

#[cfg(feature = "programs")]
pub use derivative::Argument;
#[cfg(feature = "programs")]
pub use graph::{Cost, Function, Graph, Id, Node, Program, Rows};
#[cfg(feature = "programs")]
pub use interpret::{Attempt, Evaluation};
#[cfg(feature = "programs")]
pub use kernel::{
    Clock, Kernel, KernelParts, Outcome, Precision, ProgramError, Programs, Stepper, Trajectories,
    WIDTH,
};
#[cfg(feature = "programs")]
pub use schedule::BLOCK;
