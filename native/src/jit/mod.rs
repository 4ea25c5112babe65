//! Steps as machine code by Cranelift: no compiler on the machine, ready in milliseconds.
//!
//! Both functions of an [`Entry`] are built from the programs of a [`Kernel`] with the loop of its interpreter around
//! them, and have the interpreter's bits: each node is one instruction (or a few exact ones), rounded once; a fused
//! product is the processor's own. Lanes are taken in pairs, Cranelift's widest vectors of numbers.

mod code;
mod coder;
mod host;
mod steps;

use coadjoint_program::{Kernel, Trajectories};

use crate::Entry;
use crate::jit::coder::Width;
use crate::jit::host::{assemble, isa};

pub use host::JitError;

/// The kernel's functions that are asked for as machine code for this processor; the interpreter makes the steps
/// of the other one.
///
/// # Errors
/// [`JitError`] where the processor or the kernel has no code.
pub fn compile(kernel: &Kernel, trajectories: Trajectories) -> Result<Entry, JitError> {
    let isa = isa()?;
    let config = isa.frontend_config();
    let one = || assemble(&isa, steps::build(kernel, Width::Number, config)?);
    let pairs = || assemble(&isa, steps::build(kernel, Width::Pair, config)?);
    let (advance, lanes) = match trajectories {
        Trajectories::One => (Some(one()?), None),
        Trajectories::Lanes => (None, Some(pairs()?)),
        Trajectories::Both => std::thread::scope(|scope| {
            let lanes = scope.spawn(pairs);
            let advance = one();
            let died = |_| Err(JitError::Compile("a thread died".into()));
            let lanes = lanes.join().unwrap_or_else(died);
            Ok((Some(advance?), Some(lanes?)))
        })?,
    };
    code::load(kernel, isa, advance.as_ref(), lanes.as_ref())
}
