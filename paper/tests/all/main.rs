//! Tests of the paper: one program, which is linked once.
#![allow(missing_docs)]

mod command;
mod page;
