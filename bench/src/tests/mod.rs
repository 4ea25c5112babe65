//! Tests of the peers and the references as a whole. They are part of the library so that `cargo test` does not build the
//! programs, whose measured steps take the compiler more than a minute.

mod orders;
mod references;
