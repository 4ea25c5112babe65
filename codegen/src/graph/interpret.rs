//! The plain interpreter: the oracle of the tests, and what the command line runs.

use std::ops::{Add, Mul};

use super::node::{Node, Program};

/// What the interpreter computes with: `f64`, or a pack of lanes.
pub trait Number: Copy + Add<Output = Self> + Mul<Output = Self> {
    /// The number 0.
    const ZERO: Self;
}

impl Number for f64 {
    const ZERO: Self = 0.0;
}

impl Number for f32 {
    const ZERO: Self = 0.0;
}

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
        scratch.clear();
        for node in self.nodes() {
            let value = match *node {
                Node::Zero => T::ZERO,
                Node::Input(i) => inputs.get(i as usize).copied().unwrap_or(T::ZERO),
                Node::Slot(i) => slots.get(i as usize).copied().unwrap_or(T::ZERO),
                Node::Add(a, b) => scratch[a.index()] + scratch[b.index()],
                Node::Mul(a, b) => scratch[a.index()] * scratch[b.index()],
                Node::TimesPlus(a, b, c) => {
                    scratch[a.index()] * scratch[b.index()] + scratch[c.index()]
                }
            };
            scratch.push(value);
        }
        for (output, id) in outputs.iter_mut().zip(self.outputs()) {
            *output = scratch[id.index()];
        }
    }
}
