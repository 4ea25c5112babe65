//! The loop of a kernel: its statements as Cranelift's instructions, for one trajectory or for a pair under masks.

use coadjoint_program::schedule::{Block, Kept, Kind, Part, Statement, Test, Variable};
use coadjoint_program::{Kernel, WIDTH};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::{F64, I8, I64, I64X2};
use cranelift_codegen::ir::{
    AbiParam, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Variable as Register};

use crate::jit::coder::{Coder, Frame, Width};
use crate::jit::host::JitError;

/// Writes the loop.
pub(super) struct Loop<'f, 'k> {
    pub(super) coder: Coder<'f>,
    kernel: &'k Kernel,
    /// Registers of the counts.
    counts: Vec<Register>,
    /// Marks of trajectories that move on, and the steps asked for.
    live: Register,
    steps: Register,
    /// The report of one trajectory: the largest number of corrections, the largest residual.
    report: [Register; 2],
}

impl<'f, 'k> Loop<'f, 'k> {
    pub(super) fn new(mut coder: Coder<'f>, kernel: &'k Kernel) -> Self {
        let (count, flag) = match coder.form {
            Width::Number => (I64, I8),
            Width::Pair => (I64X2, I64X2),
        };
        let builder = &mut coder.builder;
        let kind = |(variable, _)| if variable == Variable::Flow { I64 } else { count };
        let counts = Variable::ALL.map(|one| builder.declare_var(kind(one))).to_vec();
        let [live, steps] = [flag, count].map(|kind| builder.declare_var(kind));
        let report = [I64, F64].map(|kind| builder.declare_var(kind));
        Self { coder, kernel, counts, live, steps, report }
    }

    pub(super) fn get(&mut self, count: Variable) -> Value {
        self.coder.builder.use_var(self.counts[count as usize])
    }

    fn set(&mut self, count: Variable, value: Value) {
        self.coder.builder.def_var(self.counts[count as usize], value);
    }

    /// A count in all lanes.
    fn spread(&mut self, value: Value) -> Value {
        match self.coder.form {
            Width::Number => value,
            Width::Pair => self.coder.builder.ins().splat(I64X2, value),
        }
    }

    /// A count, in all lanes.
    fn whole(&mut self, value: u32) -> Value {
        let value = self.coder.integer(u64::from(value));
        self.spread(value)
    }

    /// Runs the loop for `steps` steps of the trajectories that are live.
    pub(super) fn run(&mut self, steps: Value, live: Value) {
        self.coder.builder.def_var(self.live, live);
        // Counts are compared as signed numbers.
        let most = self.coder.integer(u64::MAX >> 1);
        let steps = self.coder.builder.ins().umin(steps, most);
        let steps = self.spread(steps);
        self.coder.builder.def_var(self.steps, steps);
        let zeros = [self.coder.integer(0), self.coder.float(0.0)];
        for (register, zero) in self.report.into_iter().zip(zeros) {
            self.coder.builder.def_var(register, zero);
        }
        self.block(self.kernel.schedule(), None);
    }

    /// The largest number of corrections, as a number, and the largest residual.
    pub(super) fn report(&mut self) -> [Value; 2] {
        let [corrections, residual] = self.report.map(|of| self.coder.builder.use_var(of));
        [self.coder.builder.ins().fcvt_from_uint(F64, corrections), residual]
    }

    fn block(&mut self, block: &Block, mask: Option<Value>) {
        for &(variable, initial) in &block.variables {
            match (variable.kind(self.kernel), initial) {
                (Kind::Count, initial) => {
                    let value = match variable {
                        Variable::Flow => self.coder.integer(0),
                        _ => self.whole(initial.unwrap_or(0)),
                    };
                    self.set(variable, value);
                }
                (_, Some(initial)) => {
                    let value = self.coder.number(f64::from(initial));
                    for place in self.coder.frame.places(variable) {
                        self.coder.store(place, value);
                    }
                }
                (_, None) => {}
            }
        }
        for statement in &block.body {
            self.statement(statement, block, mask);
        }
    }

    fn statement(&mut self, statement: &Statement, within: &Block, mask: Option<Value>) {
        match statement {
            Statement::Call(part) => self.call(*part, within, mask),
            Statement::Lengthen => {
                let [distance, moved] =
                    [Variable::Distance, Variable::Moved].map(|of| self.load(of));
                let sum = self.coder.builder.ins().fadd(distance, moved);
                let place = self.coder.frame.places(Variable::Distance).start;
                self.coder.assign(mask, place, sum);
            }
            Statement::Next(variable) => {
                let before = self.get(*variable);
                // A mask is −1 where it is set.
                let mask = mask.filter(|_| *variable != Variable::Flow);
                let less = mask.unwrap_or_else(|| self.coder.integer(u64::MAX));
                let sum = self.coder.builder.ins().isub(before, less);
                self.set(*variable, sum);
            }
            Statement::Keep(kept) => self.copy_state(None, *kept, false),
            Statement::Restore(Kept::Step) => self.copy_state(mask, Kept::Step, true),
            Statement::Restore(Kept::Block) => {
                self.copy_state(mask, Kept::Block, true);
                let [done, mut count] = [Variable::Done, Variable::Count].map(|of| self.get(of));
                if let Some(mask) = mask {
                    count = self.coder.builder.ins().band(count, mask);
                }
                let done = self.coder.builder.ins().isub(done, count);
                self.set(Variable::Done, done);
            }
            Statement::Note if self.coder.form == Width::Number => self.note(),
            Statement::Clock | Statement::Note => {}
            Statement::RefuseStep | Statement::RefuseState => {
                let live = self.coder.builder.use_var(self.live);
                let refused = mask.unwrap_or(live);
                let live = self.coder.builder.ins().band_not(live, refused);
                self.coder.builder.def_var(self.live, live);
            }
            Statement::While(condition, block) | Statement::If(condition, block) => {
                let repeats = matches!(statement, Statement::While(..));
                let [test, body, out] = self.coder.blocks();
                self.coder.jump(test);
                self.coder.at(test);
                // It does not change where it does not hold: nothing assigns there what it reads.
                let condition = self.condition(condition);
                let mut any = condition;
                let mut lanes = None;
                if self.coder.form == Width::Pair {
                    let within = mask.map(|of| self.coder.builder.ins().band(of, condition));
                    let within = within.unwrap_or(condition);
                    any = self.coder.builder.ins().vany_true(within);
                    lanes = Some(within);
                }
                self.coder.builder.ins().brif(any, body, &[], out, &[]);
                self.coder.at(body);
                self.block(block, lanes);
                self.coder.jump(if repeats { test } else { out });
                self.coder.at(out);
            }
        }
    }

    fn call(&mut self, part: Part, within: &Block, mask: Option<Value>) {
        let (inputs, outputs) = part.variables(self.kernel);
        for &input in inputs {
            if input.kind(self.kernel) == Kind::Count {
                let count = self.get(input);
                let number = self.number_of(count);
                self.coder.store(self.coder.frame.places(input).start, number);
            }
        }
        let first = self.coder.slots;
        if self.kernel.flows().is_some() && part.is_of_flow() {
            let flow = self.get(Variable::Flow);
            let bytes = self.coder.integer(8 * self.kernel.slots_of_flow() as u64);
            let bytes = self.coder.builder.ins().imul(flow, bytes);
            self.coder.slots = self.coder.builder.ins().iadd(first, bytes);
        }
        self.coder.evaluate(self.kernel, part, |coder, i, value| {
            if let Some((variable, place)) = coder.frame.find(outputs, i) {
                coder.assign(mask.filter(|_| !within.owns(variable)), place, value);
            }
        });
        self.coder.slots = first;
    }

    /// Counts as numbers.
    fn number_of(&mut self, counts: Value) -> Value {
        let ins = |this: &mut Self, count| this.coder.builder.ins().fcvt_from_uint(F64, count);
        match self.coder.form {
            Width::Number => ins(self, counts),
            Width::Pair => {
                let [first, second] = [0, 1].map(|lane| {
                    let count = self.coder.builder.ins().extractlane(counts, lane);
                    ins(self, count)
                });
                let pair = self.coder.builder.ins().splat(self.coder.form.kind(), first);
                self.coder.builder.ins().insertlane(pair, second, 1)
            }
        }
    }

    /// Copies g and μ to where they are kept, or back.
    fn copy_state(&mut self, mask: Option<Value>, kept: Kept, back: bool) {
        let (state, start) = (self.coder.frame.state(), self.coder.frame.kept(kept));
        for (now, kept) in state.zip(start..) {
            let (from, to) = if back { (kept, now) } else { (now, kept) };
            let value = self.coder.load(from);
            self.coder.assign(mask, to, value);
        }
    }

    /// Takes the step made into the report.
    fn note(&mut self) {
        let [corrections, residual] = self.report;
        let [most, largest] = self.report.map(|of| self.coder.builder.use_var(of));
        let tried = self.get(Variable::Tried);
        let most = self.coder.builder.ins().umax(most, tried);
        self.coder.builder.def_var(corrections, most);
        let bound = self.load(Variable::ResidualBound);
        let larger = self.coder.builder.ins().fcmp(FloatCC::LessThan, largest, bound);
        let largest = self.coder.builder.ins().select(larger, bound, largest);
        self.coder.builder.def_var(residual, largest);
    }

    fn load(&mut self, number: Variable) -> Value {
        self.coder.load(self.coder.frame.places(number).start)
    }

    fn compare(&mut self, number: Variable, code: FloatCC, with: f64) -> Value {
        let (number, with) = (self.load(number), self.coder.number(with));
        self.coder.builder.ins().fcmp(code, number, with)
    }

    fn not(&mut self, condition: Value) -> Value {
        match self.coder.form {
            Width::Number => self.coder.builder.ins().icmp_imm_u(IntCC::Equal, condition, 0),
            Width::Pair => self.coder.builder.ins().bnot(condition),
        }
    }

    /// The value of a condition: 1 or 0 for one trajectory, a mask for pairs.
    fn condition(&mut self, condition: &[(bool, Test)]) -> Value {
        let mut all = None;
        for &(holds, test) in condition {
            let mut found = self.test(test);
            if !holds {
                found = self.not(found);
            }
            all = Some(all.map_or(found, |all| self.coder.builder.ins().band(all, found)));
        }
        all.unwrap_or_else(|| self.coder.builder.use_var(self.live))
    }

    fn test(&mut self, test: Test) -> Value {
        let (a, b) = match test {
            Test::Live => return self.coder.builder.use_var(self.live),
            Test::Remaining => (self.get(Variable::Done), self.coder.builder.use_var(self.steps)),
            Test::Below(Variable::Flow, most) => {
                let flow = self.get(Variable::Flow);
                (self.spread(flow), self.whole(most))
            }
            Test::Below(a, most) => (self.get(a), self.whole(most)),
            Test::Right => return self.compare(Variable::Right, FloatCC::Equal, 1.0),
            Test::Open => {
                let (most, far) = (self.kernel.tolerance, self.kernel.near);
                let solved = self.compare(Variable::ResidualBound, FloatCC::LessThanOrEqual, most);
                let near = self.compare(Variable::Distance, FloatCC::LessThanOrEqual, far);
                return self.coder.builder.ins().band_not(near, solved);
            }
        };
        self.coder.builder.ins().icmp(IntCC::SignedLessThan, a, b)
    }
}

/// A function of [`AdvanceFunction`](crate::AdvanceFunction)'s signature, or of
/// [`LanesFunction`](crate::LanesFunction)'s for pairs.
pub(super) fn build(
    kernel: &Kernel,
    form: Width,
    config: TargetFrontendConfig,
) -> Result<Function, JitError> {
    let mut signature = Signature::new(config.default_call_conv);
    let (params, returns) = if form == Width::Number { (5, 1) } else { (6, 0) };
    signature.params = vec![AbiParam::new(I64); params];
    signature.returns = vec![AbiParam::new(I64); returns];
    let mut function = Function::with_name_signature(UserFuncName::user(0, 0), signature);
    let mut context = FunctionBuilderContext::new();
    let builder = FunctionBuilder::new(&mut function, &mut context);
    let (coder, params) = Coder::new(builder, form, Frame::of(kernel));
    let steps = Loop::new(coder, kernel);
    let coder = match params[..] {
        [_, g, mu, asked, report] => one(steps, [g, mu], asked, report),
        [_, g, mu, asked, live, made] => pairs(steps, [g, mu], asked, live, made),
        _ => return Err(JitError::Compile("a function has other parameters".into())),
    };
    coder.finish(config)?;
    Ok(function)
}

/// The steps of one trajectory.
fn one<'f>(mut of: Loop<'f, '_>, state: [Value; 2], steps: Value, report: Value) -> Coder<'f> {
    of.coder.exchange(state, 1, true);
    let live = of.coder.builder.ins().iconst(I8, 1);
    of.run(steps, live);
    of.coder.exchange(state, 1, false);
    for (i, value) in of.report().into_iter().enumerate() {
        of.coder.builder.ins().store(MemFlagsData::trusted(), value, report, 8 * i as i32);
    }
    let done = of.get(Variable::Done);
    of.coder.builder.ins().return_(&[done]);
    of.coder
}

/// The steps of all pairs, one after the other: trajectories are independent.
fn pairs<'f>(
    mut of: Loop<'f, '_>,
    state: [Value; 2],
    steps: Value,
    live: Value,
    made: Value,
) -> Coder<'f> {
    let first = of.coder.builder.declare_var(I64);
    let zero = of.coder.integer(0);
    of.coder.builder.def_var(first, zero);
    let [again, out] = of.coder.blocks();
    of.coder.jump(again);

    of.coder.at(again);
    let lane = of.coder.builder.use_var(first);
    let bytes = of.coder.builder.ins().ishl_imm_u(lane, 3);
    let state = state.map(|list| of.coder.builder.ins().iadd(list, bytes));
    of.coder.exchange(state, WIDTH, true);
    let list = of.coder.builder.ins().iadd(live, lane);
    let [left, right] = [0, 1].map(|lane| {
        let byte = of.coder.builder.ins().load(I8, MemFlagsData::trusted(), list, lane);
        let set = of.coder.builder.ins().icmp_imm_u(IntCC::NotEqual, byte, 0);
        of.coder.builder.ins().bmask(I64, set)
    });
    let live = of.coder.builder.ins().splat(I64X2, left);
    let live = of.coder.builder.ins().insertlane(live, right, 1);
    of.run(steps, live);
    of.coder.exchange(state, WIDTH, false);
    let done = of.get(Variable::Done);
    let list = of.coder.builder.ins().iadd(made, bytes);
    for lane in [0_u8, 1] {
        let count = of.coder.builder.ins().extractlane(done, lane);
        let offset = 8 * i32::from(lane);
        of.coder.builder.ins().store(MemFlagsData::trusted(), count, list, offset);
    }
    let next = of.coder.builder.ins().iadd_imm_s(lane, 2);
    of.coder.builder.def_var(first, next);
    let width = of.coder.integer(WIDTH as u64);
    let more = of.coder.builder.ins().icmp(IntCC::UnsignedLessThan, next, width);
    of.coder.builder.ins().brif(more, again, &[], out, &[]);

    of.coder.at(out);
    of.coder.builder.ins().return_(&[]);
    of.coder
}
