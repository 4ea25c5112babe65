//! Tests of what users write and what is emitted: one program, which is linked once.
#![allow(missing_docs)]

#[cfg(feature = "system")]
mod c_header;
mod expressions;
#[cfg(feature = "system")]
mod limits;
mod quoting;
mod renamed;
mod rust_bodies;
#[cfg(feature = "system")]
mod size;
#[cfg(feature = "system")]
mod sums;
#[cfg(feature = "system")]
mod system_file;
#[cfg(feature = "system")]
mod text;
mod tools;
