//! Exact arithmetic, algebras, series, programs and the judge, each in a module of its own: one program, which is
//! linked once.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::needless_range_loop,
    missing_docs
)]

mod acceptance;
mod casimirs;
mod catalogue;
mod derivation;
mod graph;
#[cfg(feature = "judge")]
mod judge;
mod kicks;
mod lie_algebra;
mod polynomial;
mod series_naive;
mod series_reference;
