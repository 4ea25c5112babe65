//! Tests of the page: one program, which is linked once.
#![allow(missing_docs)]

mod gallery;
mod mistakes;
mod run;
