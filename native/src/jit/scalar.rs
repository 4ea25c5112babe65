//! The loop of a kernel for one trajectory.

use coadjoint_program::{BLOCK, Kernel};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::{F64, I64};
use cranelift_codegen::ir::{
    AbiParam, Block, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Variable};

use super::JitError;
use super::coder::{Coder, Form};
use super::frame::{Frame, Part};

/// The function of [`AdvanceFunction`](crate::AdvanceFunction)'s signature.
pub(super) fn build(kernel: &Kernel, config: TargetFrontendConfig) -> Result<Function, JitError> {
    let mut signature = Signature::new(config.default_call_conv);
    signature.params = vec![AbiParam::new(I64); 5];
    signature.returns = vec![AbiParam::new(I64)];
    let mut function = Function::with_name_signature(UserFuncName::user(0, 0), signature);
    let mut context = FunctionBuilderContext::new();
    let builder = FunctionBuilder::new(&mut function, &mut context);
    let (coder, params) = Coder::<1>::new(builder, Form::Number, Frame::of(kernel));
    Loop::write(coder, kernel, &params).finish(config)?;
    Ok(function)
}

/// The numbers that go round in registers, and where the loop goes next.
struct Loop<'f, 'k> {
    coder: Coder<'f, 1>,
    kernel: &'k Kernel,
    steps: Value,
    /// Steps made in blocks that are done.
    made: Variable,
    /// Steps of this block: how many to make, and made.
    length: Variable,
    count: Variable,
    /// The report: the largest number of corrections, the largest residual.
    corrections: Variable,
    residual: Variable,
}

impl<'f, 'k> Loop<'f, 'k> {
    fn write(mut coder: Coder<'f, 1>, kernel: &'k Kernel, params: &[Value]) -> Coder<'f, 1> {
        let integer = |coder: &mut Coder<'f, 1>| {
            let variable = coder.builder.declare_var(I64);
            let zero = coder.builder.ins().iconst(I64, 0);
            coder.builder.def_var(variable, zero);
            variable
        };
        let [made, length, count, corrections] = std::array::from_fn(|_| integer(&mut coder));
        let residual = coder.builder.declare_var(F64);
        let [zero] = coder.number(0.0);
        coder.builder.def_var(residual, zero);
        let steps = params[3];
        let mut this = Self { coder, kernel, steps, made, length, count, corrections, residual };
        this.state(params, true);
        let x = this.coder.frame.x;
        for i in 0..kernel.dim() {
            this.coder.store(x + i, [zero]);
        }
        this.blocks(params);
        this.coder
    }

    fn get(&mut self, variable: Variable) -> Value {
        self.coder.builder.use_var(variable)
    }

    /// Goes to one of two blocks.
    fn branch(&mut self, condition: Value, then: Block, otherwise: Block) {
        self.coder.builder.ins().brif(condition, then, &[], otherwise, &[]);
    }

    fn block(&mut self) -> Block {
        self.coder.builder.create_block()
    }

    fn at(&mut self, block: Block) {
        self.coder.builder.switch_to_block(block);
    }

    /// Whether a program that gives one number gives 1.
    fn holds(&mut self, part: Part) -> Value {
        let [one] = self.coder.number(1.0);
        let mut found = one;
        self.coder.evaluate(self.kernel, part, |_, _, [value]| found = value);
        self.coder.builder.ins().fcmp(FloatCC::Equal, found, one)
    }

    /// The results of a program, stored from a place on.
    fn store(&mut self, part: Part, place: usize) {
        self.coder.evaluate(self.kernel, part, |coder, i, values| coder.store(place + i, values));
    }

    /// Copies g and μ from the caller's memory to the frame, or back.
    fn state(&mut self, params: &[Value], inwards: bool) {
        let m = self.kernel.element();
        for i in 0..m + self.kernel.dim() {
            let (list, at) = if i < m { (params[1], i) } else { (params[2], i - m) };
            let offset = (at * 8) as i32;
            let place = self.coder.frame.state + i;
            if inwards {
                let value =
                    self.coder.builder.ins().load(F64, MemFlagsData::trusted(), list, offset);
                self.coder.store(place, [value]);
            } else {
                let [value] = self.coder.load(place);
                self.coder.builder.ins().store(MemFlagsData::trusted(), value, list, offset);
            }
        }
    }

    /// All blocks of steps, and the end.
    fn blocks(&mut self, params: &[Value]) {
        let [next, begin, step, accept, transport, end, checked, back, out] =
            std::array::from_fn(|_| self.block());
        self.coder.builder.ins().jump(next, &[]);

        self.at(next);
        let made = self.get(self.made);
        let more = self.coder.builder.ins().icmp(IntCC::UnsignedLessThan, made, self.steps);
        self.branch(more, begin, out);

        self.at(begin);
        let made = self.get(self.made);
        let rest = self.coder.builder.ins().isub(self.steps, made);
        let block = self.coder.builder.ins().iconst(I64, BLOCK as i64);
        let length = self.coder.builder.ins().umin(rest, block);
        self.coder.builder.def_var(self.length, length);
        let zero = self.coder.builder.ins().iconst(I64, 0);
        self.coder.builder.def_var(self.count, zero);
        let (state, start) = (self.coder.frame.state, self.coder.frame.start);
        let entries = self.kernel.element() + self.kernel.dim();
        self.coder.copy(state, start, entries);
        self.coder.builder.ins().jump(step, &[]);

        self.at(step);
        self.solve(accept);

        self.at(accept);
        let right = self.holds(Part::Accept);
        self.branch(right, transport, end);

        self.at(transport);
        self.store(Part::Transport, state);
        let count = self.get(self.count);
        let count = self.coder.builder.ins().iadd_imm_s(count, 1);
        self.coder.builder.def_var(self.count, count);
        let length = self.get(self.length);
        let more = self.coder.builder.ins().icmp(IntCC::UnsignedLessThan, count, length);
        self.branch(more, step, end);

        self.at(end);
        let count = self.get(self.count);
        self.branch(count, checked, out);

        self.at(checked);
        if self.kernel.programs().frame.is_some() {
            let count = self.get(self.count);
            let times = self.coder.builder.ins().fcvt_from_uint(F64, count);
            self.coder.store(self.coder.frame.times, [times]);
            self.store(Part::Frame, state);
        }
        let sound = self.holds(Part::Sound);
        let done = self.block();
        self.branch(sound, done, back);

        self.at(done);
        let (made, count, length) =
            (self.get(self.made), self.get(self.count), self.get(self.length));
        let made = self.coder.builder.ins().iadd(made, count);
        self.coder.builder.def_var(self.made, made);
        let whole = self.coder.builder.ins().icmp(IntCC::Equal, count, length);
        self.branch(whole, next, out);

        self.at(back);
        self.coder.copy(start, state, entries);
        self.coder.builder.ins().jump(out, &[]);

        self.at(out);
        self.state(params, false);
        let corrections = self.get(self.corrections);
        let corrections = self.coder.builder.ins().fcvt_from_uint(F64, corrections);
        let residual = self.get(self.residual);
        for (i, value) in [corrections, residual].into_iter().enumerate() {
            let offset = (i * 8) as i32;
            self.coder.builder.ins().store(MemFlagsData::trusted(), value, params[4], offset);
        }
        let made = self.get(self.made);
        self.coder.builder.ins().return_(&[made]);
    }

    /// Solves the equation of a step, then goes to `after`.
    fn solve(&mut self, after: Block) {
        let n = self.kernel.dim();
        let frame = self.coder.frame.clone();
        // The constants lie behind p.
        self.store(Part::Guess, frame.p);
        let (one, zero) = (self.coder.number(1.0), self.coder.number(0.0));
        self.coder.store(frame.left, one);
        self.coder.store(frame.way, zero);
        let most = self.kernel.corrections();
        if most == 0 {
            self.coder.builder.ins().jump(after, &[]);
            return;
        }
        let iteration = self.coder.builder.declare_var(I64);
        let none = self.coder.builder.ins().iconst(I64, 0);
        self.coder.builder.def_var(iteration, none);
        let [again, solved, open] = std::array::from_fn(|_| self.block());
        self.coder.builder.ins().jump(again, &[]);

        self.at(again);
        let (mut left, mut moved) = (one[0], zero[0]);
        self.coder.evaluate(self.kernel, Part::Correct, |coder, i, values| {
            if i > 2 * n {
                [moved] = values;
                return;
            }
            // p, then x and what is left.
            coder.store(if i < n { frame.p + i } else { frame.x + i - n }, values);
            [left] = values;
        });
        let [way] = self.coder.load(frame.way);
        let way = self.coder.builder.ins().fadd(way, moved);
        self.coder.store(frame.way, [way]);
        let count = self.get(iteration);
        let count = self.coder.builder.ins().iadd_imm_s(count, 1);
        self.coder.builder.def_var(iteration, count);
        let corrections = self.get(self.corrections);
        let corrections = self.coder.builder.ins().umax(corrections, count);
        self.coder.builder.def_var(self.corrections, corrections);
        let [tolerance] = self.coder.number(self.kernel.tolerance());
        let right = self.coder.builder.ins().fcmp(FloatCC::LessThanOrEqual, left, tolerance);
        self.branch(right, solved, open);

        self.at(open);
        let [near] = self.coder.number(self.kernel.near());
        let near = self.coder.builder.ins().fcmp(FloatCC::LessThanOrEqual, way, near);
        let most = self.coder.builder.ins().iconst(I64, i64::from(most));
        let some = self.coder.builder.ins().icmp(IntCC::UnsignedLessThan, count, most);
        let more = self.coder.builder.ins().band(near, some);
        self.branch(more, again, after);

        self.at(solved);
        let residual = self.get(self.residual);
        let larger = self.coder.builder.ins().fcmp(FloatCC::LessThan, residual, left);
        let residual = self.coder.builder.ins().select(larger, left, residual);
        self.coder.builder.def_var(self.residual, residual);
        self.coder.builder.ins().jump(after, &[]);
    }
}
