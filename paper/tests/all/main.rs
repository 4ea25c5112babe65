//! Tests of the paper: one program, which is linked once.
#![allow(missing_docs)]

mod command;
#[path = "../../../cli/tests/all/cases/legible.rs"]
mod legible;
mod page;
