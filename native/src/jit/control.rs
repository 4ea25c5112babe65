//! What the loops of one trajectory and of pairs have in common: variables, branches, the caller's memory, and how far
//! a run has come.

use coadjoint_program::{BLOCK, Kernel};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::I64;
use cranelift_codegen::ir::{Block, InstBuilder, MemFlagsData, Type, Value};
use cranelift_frontend::Variable;

use super::coder::Coder;
use super::frame::Part;

impl Coder<'_> {
    /// A variable that begins with this value.
    pub(super) fn variable(&mut self, kind: Type, value: Value) -> Variable {
        let variable = self.builder.declare_var(kind);
        self.builder.def_var(variable, value);
        variable
    }

    /// A count that begins with 0.
    pub(super) fn count(&mut self) -> Variable {
        let zero = self.integer(0);
        self.variable(I64, zero)
    }

    pub(super) fn integer(&mut self, value: i64) -> Value {
        self.builder.ins().iconst(I64, value)
    }

    pub(super) fn get(&mut self, variable: Variable) -> Value {
        self.builder.use_var(variable)
    }

    pub(super) fn set(&mut self, variable: Variable, value: Value) {
        self.builder.def_var(variable, value);
    }

    /// Adds to a count; the sum.
    pub(super) fn add(&mut self, variable: Variable, by: i64) -> Value {
        let value = self.get(variable);
        let value = self.builder.ins().iadd_imm_s(value, by);
        self.set(variable, value);
        value
    }

    /// a < b of counts.
    pub(super) fn less(&mut self, a: Value, b: Value) -> Value {
        self.builder.ins().icmp(IntCC::UnsignedLessThan, a, b)
    }

    pub(super) fn blocks<const N: usize>(&mut self) -> [Block; N] {
        std::array::from_fn(|_| self.builder.create_block())
    }

    pub(super) fn at(&mut self, block: Block) {
        self.builder.switch_to_block(block);
    }

    pub(super) fn jump(&mut self, block: Block) {
        self.builder.ins().jump(block, &[]);
    }

    /// Goes to one of two blocks.
    pub(super) fn branch(&mut self, condition: Value, then: Block, otherwise: Block) {
        self.builder.ins().brif(condition, then, &[], otherwise, &[]);
    }

    /// Where a program that gives one number gives 1.
    pub(super) fn holds(&mut self, kernel: &Kernel, part: Part) -> Value {
        let one = self.number(1.0);
        let mut found = one;
        self.evaluate(kernel, part, |_, _, value| found = value);
        self.builder.ins().fcmp(FloatCC::Equal, found, one)
    }

    /// Copies g and μ from the caller's memory to the frame (`inwards`) or back; numbers there are so many apart.
    pub(super) fn exchange(&mut self, lists: [Value; 2], apart: usize, inwards: bool) {
        // The caller's numbers are aligned each by itself.
        let flags = MemFlagsData::new().with_notrap();
        let (m, n) = (self.frame.element, self.frame.dim);
        for i in 0..m + n {
            let (list, at) = if i < m { (lists[0], i) } else { (lists[1], i - m) };
            let place = self.frame.state + i;
            let offset = (at * apart * 8) as i32;
            if inwards {
                let value = self.builder.ins().load(self.form.kind(), flags, list, offset);
                self.store(place, value);
            } else {
                let value = self.load(place);
                self.builder.ins().store(flags, value, list, offset);
            }
        }
    }

    /// Keeps the state as that at the start of a block, or takes it back from there.
    pub(super) fn keep(&mut self, back: bool) {
        let (state, start) = (self.frame.state, self.frame.start);
        let entries = self.frame.element + self.frame.dim;
        let (from, to) = if back { (start, state) } else { (state, start) };
        self.copy(from, to, entries);
    }
}

/// How far a run has come.
pub(super) struct Progress {
    /// Steps asked for.
    asked: Value,
    /// Those of blocks that are done, those of this block, and those tried in it.
    done: Variable,
    length: Variable,
    tried: Variable,
}

impl Progress {
    pub(super) fn new(coder: &mut Coder<'_>, asked: Value) -> Self {
        let [done, length, tried] = std::array::from_fn(|_| coder.count());
        Self { asked, done, length, tried }
    }

    /// Begins the run anew.
    pub(super) fn restart(&self, coder: &mut Coder<'_>) {
        let zero = coder.integer(0);
        coder.set(self.done, zero);
    }

    /// Whether there is a block to come.
    pub(super) fn more(&self, coder: &mut Coder<'_>) -> Value {
        let done = coder.get(self.done);
        coder.less(done, self.asked)
    }

    /// Begins the next block.
    pub(super) fn begin(&self, coder: &mut Coder<'_>) {
        let done = coder.get(self.done);
        let rest = coder.builder.ins().isub(self.asked, done);
        let block = coder.integer(BLOCK as i64);
        let length = coder.builder.ins().umin(rest, block);
        coder.set(self.length, length);
        let zero = coder.integer(0);
        coder.set(self.tried, zero);
        coder.keep(false);
    }

    /// Counts a step; whether there is another in the block.
    pub(super) fn step(&self, coder: &mut Coder<'_>) -> Value {
        let tried = coder.add(self.tried, 1);
        let length = coder.get(self.length);
        coder.less(tried, length)
    }

    /// The steps of the block.
    pub(super) fn length(&self, coder: &mut Coder<'_>) -> Value {
        coder.get(self.length)
    }

    /// The steps tried in the block.
    pub(super) fn tried(&self, coder: &mut Coder<'_>) -> Value {
        coder.get(self.tried)
    }

    /// The steps of blocks that are done.
    pub(super) fn done(&self, coder: &mut Coder<'_>) -> Value {
        coder.get(self.done)
    }

    /// Ends a block, so many steps being made.
    pub(super) fn end(&self, coder: &mut Coder<'_>, made: Value) {
        let done = coder.get(self.done);
        let done = coder.builder.ins().iadd(done, made);
        coder.set(self.done, done);
    }
}
