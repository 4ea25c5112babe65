//! Tests of the command, each subject in a module of its own: one program, which is linked once.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod cases;
mod compilers;
mod derive_and_emit;
mod device;
mod docs;
mod drive;
mod ensemble;
mod file_format;
mod groups;
mod lattice;
mod no_c;
mod outputs;
mod plot;
mod potential;
mod refused;
mod resume;
mod simulate_records;
mod smooth;
mod support;
mod verify;
