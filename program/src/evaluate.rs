//! The interpreter: a program evaluated node by node.

use alloc::vec::Vec;

use crate::dispatch;
use crate::node::Node;
use crate::number::Number;
use crate::program::Program;

impl Program {
    /// Evaluates every node into `scratch`, where [`Program::outputs`] then point; `input` and `slot` give inputs and
    /// folded coefficients by number. `scratch` is reused between calls and does not shrink.
    ///
    /// Always inlined, so that lanes get the instruction set of the caller.
    #[inline(always)]
    pub(crate) fn evaluate<T: Number>(
        &self,
        input: impl Fn(usize) -> T,
        slot: impl Fn(usize) -> T,
        scratch: &mut Vec<T>,
    ) {
        scratch.clear();
        scratch.reserve(self.nodes().len());
        for node in self.nodes() {
            let at = |id: crate::Id| scratch[id.index()];
            let value = match *node {
                Node::Zero => T::of(0.0),
                Node::Constant(bits) => T::of(f64::from_bits(bits)),
                Node::Epsilon => T::of(f64::EPSILON),
                Node::Input(i) => input(i as usize),
                Node::Slot(i) => slot(i as usize),
                Node::Add(a, b) => at(a).add(at(b)),
                Node::Sub(a, b) => at(a).sub(at(b)),
                Node::Mul(a, b) => at(a).mul(at(b)),
                Node::TimesPlus(a, b, c) => at(a).times_plus(at(b), at(c)),
                Node::Div(a, b) => at(a).div(at(b)),
                Node::Neg(a) => at(a).neg(),
                Node::Abs(a) => at(a).abs(),
                Node::Sqrt(a) => at(a).sqrt(),
                Node::Round(a) => at(a).round(),
                Node::Scale(a, k) => at(a).scale(at(k)),
                Node::Exponent(a) => at(a).exponent(),
                Node::Select(a, b, c, d) => at(a).select(at(b), at(c), at(d)),
            };
            scratch.push(value);
        }
    }

    /// The results of the program on `inputs` with these folded coefficients. Missing inputs and slots read as 0.
    #[must_use]
    pub fn run(&self, inputs: &[f64], slots: &[f64]) -> Vec<f64> {
        let read = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(0.0);
        let mut nodes = Vec::new();
        if inputs.len() >= self.inputs() && slots.len() >= self.slots() {
            dispatch::evaluate(self, inputs, slots, &mut nodes);
        } else {
            self.evaluate(|i| read(inputs, i), |i| read(slots, i), &mut nodes);
        }
        self.outputs().iter().map(|id| nodes[id.index()]).collect()
    }
}
