//! Tests of what users write and what is emitted: one program, which is linked once.
#![allow(missing_docs, clippy::panic)]

mod c_header;
mod cases;
mod given;
mod limits;
mod quoting;
mod renamed;
mod rust_bodies;
mod size;
mod smooth;
mod sums;
mod system_file;
mod text;
mod tools;
