//! Work-precision comparisons of coadjoint and its peers.
//!
//! A [`Problem`](problem::Problem) has exact equations, attitude included, and a converged end state; a
//! [`Method`](method::Method) runs it at a [`Setting`](method::Setting); [`measure`] times the methods interleaved and
//! [`report`] writes tables and diagrams. A peer that wins is shown winning.

// Indices name components and lanes as in the formulas; iterators over three arrays at once would hide them.
#![allow(clippy::needless_range_loop)]

pub mod arithmetic;
pub mod ensemble;
pub mod growth;
pub mod measure;
pub mod method;
pub mod number;
pub mod ours;
pub mod peers;
pub mod problem;
pub mod report;
pub mod state;

#[cfg(test)]
mod tests;
