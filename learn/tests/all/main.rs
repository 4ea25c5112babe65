//! Tests of learning, each in a module of its own: one program, which is linked once.
#![allow(missing_docs, clippy::unwrap_used)]

mod data;
mod fold;
mod geometry;
mod models;
mod networks;
mod polynomial;
mod session;
mod support;
