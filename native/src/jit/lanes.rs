//! The loop of a kernel for trajectories side by side: pairs, one after the other.
//!
//! Trajectories know nothing of each other, so a pair runs all its steps before the next one starts.

use coadjoint_program::{Kernel, WIDTH};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::{F64, F64X2, I8, I64, I64X2};
use cranelift_codegen::ir::{
    AbiParam, Block, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Variable};

use super::JitError;
use super::coder::{Coder, Form};
use super::control::Progress;
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
    progress: Progress,
    /// g, μ, live, made.
    lists: [Variable; 4],
    pair: Variable,
    iteration: Variable,
    /// Masks of the lanes that move, and of those whose equation is not solved yet.
    live: Variable,
    open: Variable,
    /// Steps made in the block, as numbers.
    count: Variable,
}

impl<'f, 'k> Loop<'f, 'k> {
    fn write(mut coder: Coder<'f>, kernel: &'k Kernel, params: &[Value]) -> Coder<'f> {
        let lists = [1, 2, 4, 5].map(|at| coder.variable(I64, params[at]));
        let progress = Progress::new(&mut coder, params[3]);
        let [pair, iteration] = std::array::from_fn(|_| coder.count());
        let zero = coder.number(0.0);
        let none = coder.compare(FloatCC::NotEqual, zero, zero);
        let [live, open] = std::array::from_fn(|_| coder.variable(I64X2, none));
        let count = coder.variable(F64X2, zero);
        let x = coder.frame.x;
        for i in 0..kernel.dim() {
            coder.store(x + i, zero);
        }
        let mut this = Self { coder, kernel, progress, lists, pair, iteration, live, open, count };
        this.pairs();
        this.coder
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

    /// Copies g and μ of the pair from the caller's memory to the frame, or back.
    fn state(&mut self, inwards: bool) {
        let lists = [0, 1].map(|i| self.coder.get(self.lists[i]));
        self.coder.exchange(lists, WIDTH, inwards);
    }

    /// The lanes of the pair that the caller wants moved.
    fn wanted(&mut self) -> Value {
        let list = self.coder.get(self.lists[2]);
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
        let list = self.coder.get(self.lists[3]);
        let counts = self.coder.get(self.count);
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
        let [first, next, leave, out] = self.coder.blocks();
        self.coder.jump(first);

        self.coder.at(first);
        self.state(true);
        let wanted = self.wanted();
        self.coder.set(self.live, wanted);
        self.progress.restart(&mut self.coder);
        self.coder.jump(next);
        self.blocks(next, leave);

        self.coder.at(leave);
        self.state(false);
        for (list, bytes) in self.lists.into_iter().zip([8, 8, 1, 8]) {
            self.coder.add(list, 2 * bytes);
        }
        let pair = self.coder.add(self.pair, 1);
        let pairs = self.coder.integer((WIDTH / 2) as i64);
        let more = self.coder.less(pair, pairs);
        self.coder.branch(more, first, out);

        self.coder.at(out);
        self.coder.builder.ins().return_(&[]);
    }

    /// All blocks of steps of a pair.
    fn blocks(&mut self, next: Block, leave: Block) {
        let [some, begin, step, accept, transport, end, back, done] = self.coder.blocks();
        let (state, start) = (self.coder.frame.state, self.coder.frame.start);

        self.coder.at(next);
        let more = self.progress.more(&mut self.coder);
        self.coder.branch(more, some, leave);

        self.coder.at(some);
        let live = self.coder.get(self.live);
        let live = self.any(live);
        self.coder.branch(live, begin, leave);

        self.coder.at(begin);
        self.progress.begin(&mut self.coder);
        let zero = self.coder.number(0.0);
        self.coder.set(self.count, zero);
        self.coder.jump(step);

        self.coder.at(step);
        self.solve(accept);

        self.coder.at(accept);
        let right = self.coder.holds(self.kernel, Part::Accept);
        let live = self.coder.get(self.live);
        let live = self.and(live, right);
        self.coder.set(self.live, live);
        let ones = self.coder.ones(live);
        let count = self.coder.get(self.count);
        let count = self.coder.builder.ins().fadd(count, ones);
        self.coder.set(self.count, count);
        let some = self.any(live);
        self.coder.branch(some, transport, end);

        self.coder.at(transport);
        self.update_all(live, Part::Transport, state);
        let more = self.progress.step(&mut self.coder);
        self.coder.branch(more, step, end);

        self.coder.at(end);
        let count = self.coder.get(self.count);
        let zero = self.coder.number(0.0);
        let stirred = self.coder.compare(FloatCC::GreaterThan, count, zero);
        if self.kernel.programs().frame.is_some() {
            self.coder.store(self.coder.frame.times, count);
            self.update_all(stirred, Part::Frame, state);
        }
        let sound = self.coder.holds(self.kernel, Part::Sound);
        let broken = self.without(stirred, sound);
        let some = self.any(broken);
        self.coder.branch(some, back, done);

        self.coder.at(back);
        for i in 0..self.kernel.element() + self.kernel.dim() {
            let before = self.coder.load(start + i);
            self.coder.update(broken, state + i, before);
        }
        let count = self.coder.get(self.count);
        let count = self.coder.choose(broken, zero, count);
        self.coder.set(self.count, count);
        self.coder.jump(done);

        self.coder.at(done);
        self.tell();
        let length = self.progress.length(&mut self.coder);
        let whole = self.coder.builder.ins().fcvt_from_uint(F64, length);
        let whole = self.coder.builder.ins().splat(F64X2, whole);
        let count = self.coder.get(self.count);
        let whole = self.coder.compare(FloatCC::Equal, count, whole);
        let live = self.coder.get(self.live);
        let live = self.and(live, whole);
        self.coder.set(self.live, live);
        self.progress.end(&mut self.coder, length);
        self.coder.jump(next);
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
            self.coder.jump(after);
            return;
        }
        let live = self.coder.get(self.live);
        self.coder.set(self.open, live);
        let none = self.coder.integer(0);
        self.coder.set(self.iteration, none);
        let [again] = self.coder.blocks();
        self.coder.jump(again);

        self.coder.at(again);
        let open = self.coder.get(self.open);
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
        self.coder.set(self.open, open);
        let iteration = self.coder.add(self.iteration, 1);
        let most = self.coder.integer(i64::from(most));
        let some = self.coder.less(iteration, most);
        let more = self.any(open);
        let more = self.coder.builder.ins().band(more, some);
        self.coder.branch(more, again, after);
    }
}
