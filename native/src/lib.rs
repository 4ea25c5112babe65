//! Steps as machine code, compiled when a system is known.
//!
//! An [`Entry`] is a compiled [`Kernel`](coadjoint_program::Kernel): the same loop, the same bits, no call per step.

mod entry;
#[cfg(feature = "jit")]
pub mod jit;

pub use entry::{AdvanceFunction, Entry, LanesFunction};
