//! Programs as text in other languages.
//!
//! - [`Signature`] names what a program of a kernel reads and writes; [`signatures`] are those that its loop calls.
//! - [`Dialect`] is how one language writes numbers, operations and the head of a function; [`function`] prints a
//!   program in it, one operation a line, and [`pieces`] a long one as several functions.
//! - [`LoopStyle`] is how a language writes the loop of a kernel, which [`steps`] prints.
//! - [`C`] is the dialect of C and of languages like it; [`native_unit`] is a kernel as a unit of C to be compiled for
//!   this machine.
//! - [`device_unit`] is a kernel as a text in OpenCL C or CUDA C++, a thread a trajectory.

mod c;
mod device;
mod dialect;
mod function;
mod native;
mod pieces;
mod signature;
mod steps;
mod vectors;

pub use c::C;
pub use device::{DeviceLanguage, KERNEL_NAME, device_unit};
pub use dialect::Dialect;
pub use function::{function, statements};
pub use native::{ABI, native_unit};
pub use pieces::pieces;
pub use signature::{Field, Signature, signatures};
pub use steps::{LoopStyle, steps};
