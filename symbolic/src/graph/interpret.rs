//! The programs of a generating function, evaluated in any numbers that add and multiply.
//!
//! Where emitted Rust has no fused products, this has its bits; [`Program::run`] always fuses.

use std::ops::{Add, Mul};

use coadjoint_program::{Node, Program};
use num_traits::Zero;

/// Numbers that add and multiply: `f64`, `f32`, or a pack of lanes.
pub trait Arithmetic: Copy + Add<Output = Self> + Mul<Output = Self> + Zero {}

impl<T: Copy + Add<Output = T> + Mul<Output = T> + Zero> Arithmetic for T {}

/// Evaluates every node into `scratch`, where [`Program::outputs`] then point. For programs of sums and products, as
/// [`lower`](super::lower) makes them; other operations read as 0.
///
/// Always inlined, so that lanes get the instruction set of the caller.
#[inline(always)]
pub fn evaluate<T: Arithmetic>(
    program: &Program,
    input: impl Fn(usize) -> T,
    slot: impl Fn(usize) -> T,
    scratch: &mut Vec<T>,
) {
    scratch.clear();
    scratch.reserve(program.nodes().len());
    for node in program.nodes() {
        let value = match *node {
            Node::Input(i) => input(i as usize),
            Node::Slot(i) => slot(i as usize),
            Node::Add(a, b) => scratch[a.index()] + scratch[b.index()],
            Node::Mul(a, b) => scratch[a.index()] * scratch[b.index()],
            Node::TimesPlus(a, b, c) => {
                scratch[a.index()] * scratch[b.index()] + scratch[c.index()]
            }
            _ => T::zero(),
        };
        scratch.push(value);
    }
}
