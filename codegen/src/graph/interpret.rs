//! The plain interpreter: the oracle of the tests, and what the command line runs.

use std::ops::{Add, Mul};

use num_traits::Zero;

use super::node::{Node, Program};

/// What the interpreter computes with: `f64`, `f32`, or a pack of lanes.
pub trait Number: Copy + Add<Output = Self> + Mul<Output = Self> + Zero {}

impl<T: Copy + Add<Output = T> + Mul<Output = T> + Zero> Number for T {}

impl Program {
    /// Evaluates the program: `inputs` are the coordinates, `slots` the folded coefficients;
    /// results go to `outputs` in order. `scratch` is reused between calls to avoid allocation.
    ///
    /// Missing inputs and slots read as 0.
    pub fn run<T: Number>(
        &self,
        inputs: &[T],
        slots: &[T],
        scratch: &mut Vec<T>,
        outputs: &mut [T],
    ) {
        let read = |list: &[T], i: usize| list.get(i).copied().unwrap_or(T::zero());
        self.evaluate(|i| read(inputs, i), |i| read(slots, i), scratch);
        for (output, id) in outputs.iter_mut().zip(self.outputs()) {
            *output = scratch[id.index()];
        }
    }

    /// Evaluates every node into `scratch`, where [`Program::outputs`] then point.
    ///
    /// Always inlined, so that lanes get the instruction set of the caller.
    #[inline(always)]
    pub fn evaluate<T: Number>(
        &self,
        input: impl Fn(usize) -> T,
        slot: impl Fn(usize) -> T,
        scratch: &mut Vec<T>,
    ) {
        scratch.clear();
        scratch.reserve(self.nodes().len());
        for node in self.nodes() {
            let value = match *node {
                Node::Zero => T::zero(),
                Node::Input(i) => input(i as usize),
                Node::Slot(i) => slot(i as usize),
                Node::Add(a, b) => scratch[a.index()] + scratch[b.index()],
                Node::Mul(a, b) => scratch[a.index()] * scratch[b.index()],
                Node::TimesPlus(a, b, c) => {
                    scratch[a.index()] * scratch[b.index()] + scratch[c.index()]
                }
            };
            scratch.push(value);
        }
    }
}
