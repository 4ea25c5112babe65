//! Tests of compiled kernels: one program, which is linked once.
#![allow(missing_docs)]

mod bits;
#[cfg(unix)]
mod faults;
mod samples;
#[cfg(target_os = "linux")]
mod store;
