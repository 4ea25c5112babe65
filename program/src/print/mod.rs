//! Programs as text in other languages.
//!
//! - [`Signature`] names what a program of a kernel reads and writes; [`signatures`] are those that its loop calls.
//! - [`Dialect`] is how one language like C writes numbers and operations; [`function`] prints a program in it.
//! - [`LoopStyle`] is how a language writes the loop of a kernel, which [`steps`] prints.
//! - [`native_unit`] is a kernel as a unit of C to be compiled for this machine.
//! - [`device_unit`] is a kernel as a text in OpenCL C or CUDA C++, a thread a trajectory.

mod c;
mod device;
mod function;
mod native;
mod steps;
mod template;
mod vectors;

pub use c::{C, Dialect, Field, Signature, signatures};
pub use device::{DeviceLanguage, KERNEL_NAME, device_unit};
pub use function::{Body, body, function};
pub use native::{ABI, native_unit};
pub use steps::{Loop, LoopStyle, Name, statements, steps};
pub use template::{Value, fill};
