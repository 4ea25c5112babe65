//! Programs as text in other languages.
//!
//! - [`Signature`] names what a program of a kernel reads and writes; [`signatures`] are those that its loop calls.
//! - [`Dialect`] is how one language writes numbers and operations; [`function`] prints a program in it.
//! - [`LoopStyle`] are a language's words for the loop of a kernel, which [`steps`] prints.
//! - [`fill`] puts what differs between kernels into a template of fixed text.
//! - [`native_unit`] is a kernel as a unit of C to be compiled for this machine.
//! - [`device_unit`] is a kernel as a text in OpenCL C or CUDA C++, a thread a trajectory.

mod c;
mod device;
mod function;
mod native;
mod steps;
mod template;
mod vectors;

pub use c::{Body, C, Dialect, Field, RowOf, Signature, signatures};
pub use device::{DeviceLanguage, KERNEL_NAME, device_unit};
pub use function::{body, function};
pub use native::{ABI, native_unit};
pub use steps::{LoopStyle, steps, tuple};
pub use template::{Value, fill};
