//! Steps as machine code, compiled when a system is known.
//!
//! An [`Entry`] is a compiled [`Kernel`](coadjoint_program::Kernel): the same loop, the same bits, no call per step.
//! [`Native::by_c`] has the system's C compiler make one, and a [`Store`] keeps it on disk. [`cards`] runs kernels on graphics cards.

mod c;
pub mod cards;
mod entry;
mod error;
#[cfg(feature = "jit")]
pub mod jit;
mod library;
mod store;

pub use c::{COptions, Native};
pub use entry::Entry;
pub use error::NativeError;
pub use store::Store;
