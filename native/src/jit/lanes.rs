//! The loop of a kernel for trajectories side by side: pairs, one after the other.
//!
//! Trajectories know nothing of each other, so a pair runs all its steps before the next one starts.

use coadjoint_program::{BLOCK, Kernel, WIDTH};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::{F64, F64X2, I8, I64, I64X2};
use cranelift_codegen::ir::{
    AbiParam, Block, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Variable};

use super::JitError;
use super::coder::{Coder, Form};
use super::frame::{Frame, Part};

/// The function of [`LanesFunction`](crate::LanesFunction)'s signature.
pub(super) fn build(kernel: &Kernel, config: TargetFrontendConfig) -> Result<Function, JitError> {
    let mut signature = Signature::new(config.default_call_conv);
    signature.params = vec![AbiParam::new(I64); 6];
    let mut function = Function::with_name_signature(UserFuncName::user(0, 1), signature);
    let mut context = FunctionBuilderContext::new();
    let builder = FunctionBuilder::new(&mut function, &mut context);
    let (coder, params) = Coder::new(builder, Form::Pair, Frame::of(kernel));
    Loop::write(coder, kernel, &params).finish(config)?;
    Ok(function)
}

/// What goes round in registers: lists of the caller moved on to the pair at hand, counts, masks.
struct Loop<'f, 'k> {
    coder: Coder<'f>,
    kernel: &'k Kernel,
    steps: Value,
    /// g, μ, live, made.
    lists: [Variable; 4],
    pair: Variable,
    /// Steps asked of the blocks that are done, of this block, and tried in it.
    done: Variable,
    length: Variable,
    tried: Variable,
    iteration: Variable,
    /// Masks of the lanes that move, and of those whose equation is not solved yet.
    live: Variable,
    open: Variable,
    /// Steps made in the block, as numbers.
    count: Variable,
}

impl<'f, 'k> Loop<'f, 'k> {
    fn write(mut coder: Coder<'f>, kernel: &'k Kernel, params: &[Value]) -> Coder<'f> {
        let lists = std::array::from_fn(|_| coder.builder.declare_var(I64));
        for (&list, at) in lists.iter().zip([1, 2, 4, 5]) {
            coder.builder.def_var(list, params[at]);
        }
        let [pair, done, length, tried, iteration] = std::array::from_fn(|_| {
            let variable = coder.builder.declare_var(I64);
            let zero = coder.builder.ins().iconst(I64, 0);
            coder.builder.def_var(variable, zero);
            variable
        });
        let zero = coder.number(0.0);
        let none = coder.compare(FloatCC::NotEqual, zero, zero);
        let [live, open, count] =
            [(I64X2, none), (I64X2, none), (F64X2, zero)].map(|(kind, value)| {
                let variable = coder.builder.declare_var(kind);
                coder.builder.def_var(variable, value);
                variable
            });
        let steps = params[3];
        let mut this = Self {
            coder,
            kernel,
            steps,
            lists,
            pair,
            done,
            length,
            tried,
            iteration,
            live,
            open,
            count,
        };
        let x = this.coder.frame.x;
        for i in 0..kernel.dim() {
            this.coder.store(x + i, zero);
        }
        this.pairs();
        this.coder
    }

    fn get(&mut self, variable: Variable) -> Value {
        self.coder.builder.use_var(variable)
    }

    fn set(&mut self, variable: Variable, value: Value) {
        self.coder.builder.def_var(variable, value);
    }

    fn set_integer(&mut self, variable: Variable, value: i64) {
        let value = self.coder.builder.ins().iconst(I64, value);
        self.coder.builder.def_var(variable, value);
    }

    fn add(&mut self, variable: Variable, by: i64) -> Value {
        let value = self.get(variable);
        let value = self.coder.builder.ins().iadd_imm_s(value, by);
        self.coder.builder.def_var(variable, value);
        value
    }

    fn block(&mut self) -> Block {
        self.coder.builder.create_block()
    }

    fn at(&mut self, block: Block) {
        self.coder.builder.switch_to_block(block);
    }

    /// Goes to one of two blocks.
    fn branch(&mut self, condition: Value, then: Block, otherwise: Block) {
        self.coder.builder.ins().brif(condition, then, &[], otherwise, &[]);
    }

    fn and(&mut self, a: Value, b: Value) -> Value {
        self.coder.builder.ins().band(a, b)
    }

    /// a where b is not.
    fn without(&mut self, a: Value, b: Value) -> Value {
        self.coder.builder.ins().band_not(a, b)
    }

    /// Whether a mask is set in any lane.
    fn any(&mut self, mask: Value) -> Value {
        self.coder.builder.ins().vany_true(mask)
    }

    /// Stores the results of a program from a place on in the lanes of the mask.
    fn update_all(&mut self, mask: Value, part: Part, place: usize) {
        self.coder.evaluate(self.kernel, part, |coder, i, value| {
            coder.update(mask, place + i, value);
        });
    }

    /// The lanes in which a program that gives one number gives 1.
    fn holds(&mut self, part: Part) -> Value {
        let one = self.coder.number(1.0);
        let mut found = one;
        self.coder.evaluate(self.kernel, part, |_, _, value| found = value);
        self.coder.compare(FloatCC::Equal, found, one)
    }

    /// Copies g and μ of the pair from the caller's memory to the frame, or back.
    fn state(&mut self, inwards: bool) {
        // The caller's numbers are aligned each by itself.
        let flags = MemFlagsData::new().with_notrap();
        let lists = [self.get(self.lists[0]), self.get(self.lists[1])];
        let m = self.kernel.element();
        for i in 0..m + self.kernel.dim() {
            let (list, at) = if i < m { (lists[0], i) } else { (lists[1], i - m) };
            let place = self.coder.frame.state + i;
            let offset = (at * WIDTH * 8) as i32;
            if inwards {
                let value = self.coder.builder.ins().load(F64X2, flags, list, offset);
                self.coder.store(place, value);
            } else {
                let value = self.coder.load(place);
                self.coder.builder.ins().store(flags, value, list, offset);
            }
        }
    }

    /// The lanes of the pair that the caller wants moved.
    fn wanted(&mut self) -> Value {
        let list = self.get(self.lists[2]);
        let [first, second] = [0, 1].map(|lane| {
            let ins = self.coder.builder.ins();
            let byte = ins.load(I8, MemFlagsData::trusted(), list, lane);
            let set = self.coder.builder.ins().icmp_imm_u(IntCC::NotEqual, byte, 0);
            self.coder.builder.ins().bmask(I64, set)
        });
        let mask = self.coder.builder.ins().splat(I64X2, first);
        self.coder.builder.ins().insertlane(mask, second, 1)
    }

    /// Adds the steps of the block to those the caller is told of.
    fn tell(&mut self) {
        let list = self.get(self.lists[3]);
        let counts = self.get(self.count);
        for lane in [0_u8, 1] {
            let offset = i32::from(lane) * 8;
            let count = self.coder.builder.ins().extractlane(counts, lane);
            let count = self.coder.builder.ins().fcvt_to_uint_sat(I64, count);
            let told = self.coder.builder.ins().load(I64, MemFlagsData::trusted(), list, offset);
            let told = self.coder.builder.ins().iadd(told, count);
            self.coder.builder.ins().store(MemFlagsData::trusted(), told, list, offset);
        }
    }

    /// All pairs, and the end.
    fn pairs(&mut self) {
        let [first, next, leave, out] = std::array::from_fn(|_| self.block());
        self.coder.builder.ins().jump(first, &[]);

        self.at(first);
        self.state(true);
        let wanted = self.wanted();
        self.set(self.live, wanted);
        self.set_integer(self.done, 0);
        self.coder.builder.ins().jump(next, &[]);
        self.blocks(next, leave);

        self.at(leave);
        self.state(false);
        for (list, bytes) in self.lists.into_iter().zip([8, 8, 1, 8]) {
            self.add(list, 2 * bytes);
        }
        let pair = self.add(self.pair, 1);
        let pairs = (WIDTH / 2) as i64;
        let more = self.coder.builder.ins().icmp_imm_u(IntCC::UnsignedLessThan, pair, pairs);
        self.branch(more, first, out);

        self.at(out);
        self.coder.builder.ins().return_(&[]);
    }

    /// All blocks of steps of a pair.
    fn blocks(&mut self, next: Block, leave: Block) {
        let [some, begin, step, accept, transport, end, back, done] =
            std::array::from_fn(|_| self.block());
        let (state, start) = (self.coder.frame.state, self.coder.frame.start);
        let entries = self.kernel.element() + self.kernel.dim();

        self.at(next);
        let made = self.get(self.done);
        let more = self.coder.builder.ins().icmp(IntCC::UnsignedLessThan, made, self.steps);
        self.branch(more, some, leave);

        self.at(some);
        let live = self.get(self.live);
        let live = self.any(live);
        self.branch(live, begin, leave);

        self.at(begin);
        let made = self.get(self.done);
        let rest = self.coder.builder.ins().isub(self.steps, made);
        let block = self.coder.builder.ins().iconst(I64, BLOCK as i64);
        let length = self.coder.builder.ins().umin(rest, block);
        self.coder.builder.def_var(self.length, length);
        self.set_integer(self.tried, 0);
        let zero = self.coder.number(0.0);
        self.set(self.count, zero);
        self.coder.copy(state, start, entries);
        self.coder.builder.ins().jump(step, &[]);

        self.at(step);
        self.solve(accept);

        self.at(accept);
        let right = self.holds(Part::Accept);
        let live = self.get(self.live);
        let live = self.and(live, right);
        self.set(self.live, live);
        let ones = self.coder.ones(live);
        let count = self.get(self.count);
        let count = self.coder.builder.ins().fadd(count, ones);
        self.set(self.count, count);
        let some = self.any(live);
        self.branch(some, transport, end);

        self.at(transport);
        self.update_all(live, Part::Transport, state);
        let tried = self.add(self.tried, 1);
        let length = self.get(self.length);
        let more = self.coder.builder.ins().icmp(IntCC::UnsignedLessThan, tried, length);
        self.branch(more, step, end);

        self.at(end);
        let count = self.get(self.count);
        let zero = self.coder.number(0.0);
        let stirred = self.coder.compare(FloatCC::GreaterThan, count, zero);
        if self.kernel.programs().frame.is_some() {
            self.coder.store(self.coder.frame.times, count);
            self.update_all(stirred, Part::Frame, state);
        }
        let sound = self.holds(Part::Sound);
        let broken = self.without(stirred, sound);
        let some = self.any(broken);
        self.branch(some, back, done);

        self.at(back);
        for i in 0..entries {
            let before = self.coder.load(start + i);
            self.coder.update(broken, state + i, before);
        }
        let count = self.get(self.count);
        let count = self.coder.choose(broken, zero, count);
        self.set(self.count, count);
        self.coder.builder.ins().jump(done, &[]);

        self.at(done);
        self.tell();
        let length = self.get(self.length);
        let whole = self.coder.builder.ins().fcvt_from_uint(F64, length);
        let whole = self.coder.builder.ins().splat(F64X2, whole);
        let count = self.get(self.count);
        let whole = self.coder.compare(FloatCC::Equal, count, whole);
        let live = self.get(self.live);
        let live = self.and(live, whole);
        self.set(self.live, live);
        let made = self.get(self.done);
        let made = self.coder.builder.ins().iadd(made, length);
        self.coder.builder.def_var(self.done, made);
        self.coder.builder.ins().jump(next, &[]);
    }

    /// Solves the equation of a step in the live lanes, then goes to `after`.
    fn solve(&mut self, after: Block) {
        let n = self.kernel.dim();
        let frame = self.coder.frame.clone();
        // The constants lie behind p.
        let store = |coder: &mut Coder<'f>, i, value| coder.store(frame.p + i, value);
        self.coder.evaluate(self.kernel, Part::Guess, store);
        let (one, zero) = (self.coder.number(1.0), self.coder.number(0.0));
        self.coder.store(frame.left, one);
        self.coder.store(frame.way, zero);
        let most = self.kernel.corrections();
        if most == 0 {
            self.coder.builder.ins().jump(after, &[]);
            return;
        }
        let live = self.get(self.live);
        self.set(self.open, live);
        self.set_integer(self.iteration, 0);
        let again = self.block();
        self.coder.builder.ins().jump(again, &[]);

        self.at(again);
        let open = self.get(self.open);
        let (mut left, mut way) = (one, zero);
        self.coder.evaluate(self.kernel, Part::Correct, |coder, i, value| {
            if i <= 2 * n {
                // p, then x and what is left.
                left = coder.update(open, if i < n { frame.p + i } else { frame.x + i - n }, value);
            } else {
                let before = coder.load(frame.way);
                let sum = coder.builder.ins().fadd(before, value);
                way = coder.update(open, frame.way, sum);
            }
        });
        let tolerance = self.coder.number(self.kernel.tolerance());
        let solved = self.coder.compare(FloatCC::LessThanOrEqual, left, tolerance);
        let near = self.coder.number(self.kernel.near());
        let near = self.coder.compare(FloatCC::LessThanOrEqual, way, near);
        let open = self.without(open, solved);
        let open = self.and(open, near);
        self.set(self.open, open);
        let iteration = self.add(self.iteration, 1);
        let most = i64::from(most);
        let some = self.coder.builder.ins().icmp_imm_u(IntCC::UnsignedLessThan, iteration, most);
        let more = self.any(open);
        let more = self.coder.builder.ins().band(more, some);
        self.branch(more, again, after);
    }
}
