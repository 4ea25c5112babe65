//! Tests of compiled kernels: one program, which is linked once.
#![allow(missing_docs)]

#[cfg(unix)]
mod bits;
mod common;
#[cfg(unix)]
mod faults;
#[cfg(feature = "jit")]
mod jit;
#[cfg(feature = "jit")]
mod samples;
