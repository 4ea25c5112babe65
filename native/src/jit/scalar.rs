//! The loop of a kernel for one trajectory.

use coadjoint_program::Kernel;
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::{F64, I64};
use cranelift_codegen::ir::{
    AbiParam, Block, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Variable};

use super::JitError;
use super::coder::{Coder, Form};
use super::control::Progress;
use super::frame::{Frame, Part};

/// The function of [`AdvanceFunction`](crate::AdvanceFunction)'s signature.
pub(super) fn build(kernel: &Kernel, config: TargetFrontendConfig) -> Result<Function, JitError> {
    let mut signature = Signature::new(config.default_call_conv);
    signature.params = vec![AbiParam::new(I64); 5];
    signature.returns = vec![AbiParam::new(I64)];
    let mut function = Function::with_name_signature(UserFuncName::user(0, 0), signature);
    let mut context = FunctionBuilderContext::new();
    let builder = FunctionBuilder::new(&mut function, &mut context);
    let (coder, params) = Coder::new(builder, Form::Number, Frame::of(kernel));
    Loop::write(coder, kernel, &params).finish(config)?;
    Ok(function)
}

/// The numbers that go round in registers.
struct Loop<'f, 'k> {
    coder: Coder<'f>,
    kernel: &'k Kernel,
    progress: Progress,
    /// The report: the largest number of corrections, the largest residual.
    corrections: Variable,
    residual: Variable,
}

impl<'f, 'k> Loop<'f, 'k> {
    fn write(mut coder: Coder<'f>, kernel: &'k Kernel, params: &[Value]) -> Coder<'f> {
        let progress = Progress::new(&mut coder, params[3]);
        let corrections = coder.count();
        let zero = coder.number(0.0);
        let residual = coder.variable(F64, zero);
        coder.exchange([params[1], params[2]], 1, true);
        let x = coder.frame.x;
        for i in 0..kernel.dim() {
            coder.store(x + i, zero);
        }
        let mut this = Self { coder, kernel, progress, corrections, residual };
        this.blocks(params);
        this.coder
    }

    /// The results of a program, stored from a place on.
    fn store(&mut self, part: Part, place: usize) {
        self.coder.evaluate(self.kernel, part, |coder, i, value| coder.store(place + i, value));
    }

    /// All blocks of steps, and the end.
    fn blocks(&mut self, params: &[Value]) {
        let [next, begin, step, accept, transport, end, checked, done, back, out] =
            self.coder.blocks();
        self.coder.jump(next);

        self.coder.at(next);
        let more = self.progress.more(&mut self.coder);
        self.coder.branch(more, begin, out);

        self.coder.at(begin);
        self.progress.begin(&mut self.coder);
        self.coder.jump(step);

        self.coder.at(step);
        self.solve(accept);

        self.coder.at(accept);
        let right = self.coder.holds(self.kernel, Part::Accept);
        self.coder.branch(right, transport, end);

        self.coder.at(transport);
        self.store(Part::Transport, self.coder.frame.state);
        let more = self.progress.step(&mut self.coder);
        self.coder.branch(more, step, end);

        self.coder.at(end);
        let made = self.progress.tried(&mut self.coder);
        self.coder.branch(made, checked, out);

        self.coder.at(checked);
        if self.kernel.programs().frame.is_some() {
            let made = self.progress.tried(&mut self.coder);
            let times = self.coder.builder.ins().fcvt_from_uint(F64, made);
            self.coder.store(self.coder.frame.times, times);
            self.store(Part::Frame, self.coder.frame.state);
        }
        let sound = self.coder.holds(self.kernel, Part::Sound);
        self.coder.branch(sound, done, back);

        self.coder.at(done);
        let made = self.progress.tried(&mut self.coder);
        self.progress.end(&mut self.coder, made);
        let length = self.progress.length(&mut self.coder);
        let whole = self.coder.builder.ins().icmp(IntCC::Equal, made, length);
        self.coder.branch(whole, next, out);

        self.coder.at(back);
        self.coder.keep(true);
        self.coder.jump(out);

        self.coder.at(out);
        self.coder.exchange([params[1], params[2]], 1, false);
        let corrections = self.coder.get(self.corrections);
        let corrections = self.coder.builder.ins().fcvt_from_uint(F64, corrections);
        let residual = self.coder.get(self.residual);
        for (i, value) in [corrections, residual].into_iter().enumerate() {
            let offset = (i * 8) as i32;
            self.coder.builder.ins().store(MemFlagsData::trusted(), value, params[4], offset);
        }
        let made = self.progress.done(&mut self.coder);
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
            self.coder.jump(after);
            return;
        }
        let iteration = self.coder.count();
        let [again, solved, open] = self.coder.blocks();
        self.coder.jump(again);

        self.coder.at(again);
        let (mut left, mut moved) = (one, zero);
        self.coder.evaluate(self.kernel, Part::Correct, |coder, i, value| {
            if i > 2 * n {
                moved = value;
                return;
            }
            // p, then x and what is left.
            coder.store(if i < n { frame.p + i } else { frame.x + i - n }, value);
            left = value;
        });
        let way = self.coder.load(frame.way);
        let way = self.coder.builder.ins().fadd(way, moved);
        self.coder.store(frame.way, way);
        let count = self.coder.add(iteration, 1);
        let corrections = self.coder.get(self.corrections);
        let corrections = self.coder.builder.ins().umax(corrections, count);
        self.coder.set(self.corrections, corrections);
        let tolerance = self.coder.number(self.kernel.tolerance());
        let right = self.coder.compare(FloatCC::LessThanOrEqual, left, tolerance);
        self.coder.branch(right, solved, open);

        self.coder.at(open);
        let near = self.coder.number(self.kernel.near());
        let near = self.coder.compare(FloatCC::LessThanOrEqual, way, near);
        let most = self.coder.integer(i64::from(most));
        let some = self.coder.less(count, most);
        let more = self.coder.builder.ins().band(near, some);
        self.coder.branch(more, again, after);

        self.coder.at(solved);
        let residual = self.coder.get(self.residual);
        let larger = self.coder.compare(FloatCC::LessThan, residual, left);
        let residual = self.coder.builder.ins().select(larger, left, residual);
        self.coder.set(self.residual, residual);
        self.coder.jump(after);
    }
}
