//! Tests of the preprocessor: one program, which is linked once.
#![allow(missing_docs)]

mod formulas;
mod outside;
