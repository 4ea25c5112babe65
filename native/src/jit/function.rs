//! The functions of an entry: the caller's memory, and the loop between.

use coadjoint_program::schedule::Variable;
use coadjoint_program::{Kernel, WIDTH};
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::types::{I8, I64, I64X2};
use cranelift_codegen::ir::{
    AbiParam, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};

use crate::jit::coder::{Coder, Form, Frame};
use crate::jit::host::JitError;
use crate::jit::steps::Loop;

/// A function of [`AdvanceFunction`](crate::AdvanceFunction)'s signature, or of
/// [`LanesFunction`](crate::LanesFunction)'s for pairs.
pub(super) fn build(
    kernel: &Kernel,
    form: Form,
    config: TargetFrontendConfig,
) -> Result<Function, JitError> {
    let mut signature = Signature::new(config.default_call_conv);
    let (params, returns) = if form == Form::Number { (5, 1) } else { (6, 0) };
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
