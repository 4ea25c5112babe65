//! The loop of a kernel for trajectories side by side: groups of V pairs, one group after the other.
//!
//! Trajectories know nothing of each other, so a group runs all its steps before the next one starts.

use coadjoint_program::{BLOCK, Kernel, WIDTH};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::types::{F64, F64X2, I8, I64, I64X2};
use cranelift_codegen::ir::{
    AbiParam, Block, Function, InstBuilder, MemFlagsData, Signature, UserFuncName, Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext, Variable};

use super::JitError;
use super::coder::{Coder, Form, Group};
use super::frame::{Frame, Part};

/// The function of [`LanesFunction`](crate::LanesFunction)'s signature.
pub(super) fn build(kernel: &Kernel, config: TargetFrontendConfig) -> Result<Function, JitError> {
    match std::env::var("JIT_V").as_deref() {
        Ok("2") => build_with::<2>(kernel, config),
        Ok("4") => build_with::<4>(kernel, config),
        _ => build_with::<1>(kernel, config),
    }
}

fn build_with<const V: usize>(
    kernel: &Kernel,
    config: TargetFrontendConfig,
) -> Result<Function, JitError> {
    let mut signature = Signature::new(config.default_call_conv);
    signature.params = vec![AbiParam::new(I64); 6];
    let mut function = Function::with_name_signature(UserFuncName::user(0, 1), signature);
    let mut context = FunctionBuilderContext::new();
    let builder = FunctionBuilder::new(&mut function, &mut context);
    let (coder, params) = Coder::<V>::new(builder, Form::Pair, Frame::of(kernel));
    Loop::write(coder, kernel, &params).finish(config)?;
    Ok(function)
}

/// What goes round in registers: lists of the caller moved on to the group at hand, counts, masks.
struct Loop<'f, 'k, const V: usize> {
    coder: Coder<'f, V>,
    kernel: &'k Kernel,
    steps: Value,
    /// g, μ, live, made.
    lists: [Variable; 4],
    group: Variable,
    /// Steps asked of the blocks that are done, of this block, and tried in it.
    done: Variable,
    length: Variable,
    tried: Variable,
    iteration: Variable,
    /// Masks of the lanes that move, and of those whose equation is not solved yet.
    live: [Variable; V],
    open: [Variable; V],
    /// Steps made in the block, as numbers.
    count: [Variable; V],
}

impl<'f, 'k, const V: usize> Loop<'f, 'k, V> {
    fn write(mut coder: Coder<'f, V>, kernel: &'k Kernel, params: &[Value]) -> Coder<'f, V> {
        let lists = std::array::from_fn(|_| coder.builder.declare_var(I64));
        for (&list, at) in lists.iter().zip([1, 2, 4, 5]) {
            coder.builder.def_var(list, params[at]);
        }
        let [group, done, length, tried, iteration] = std::array::from_fn(|_| {
            let variable = coder.builder.declare_var(I64);
            let zero = coder.builder.ins().iconst(I64, 0);
            coder.builder.def_var(variable, zero);
            variable
        });
        let zero = coder.number(0.0);
        let none = coder.compare(FloatCC::NotEqual, zero, zero);
        let [live, open] = std::array::from_fn(|_| {
            std::array::from_fn(|v| {
                let variable = coder.builder.declare_var(I64X2);
                coder.builder.def_var(variable, none[v]);
                variable
            })
        });
        let count = std::array::from_fn(|v| {
            let variable = coder.builder.declare_var(F64X2);
            coder.builder.def_var(variable, zero[v]);
            variable
        });
        let steps = params[3];
        let mut this = Self {
            coder,
            kernel,
            steps,
            lists,
            group,
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
        this.groups();
        this.coder
    }

    fn get(&mut self, variable: Variable) -> Value {
        self.coder.builder.use_var(variable)
    }

    fn all(&mut self, variables: [Variable; V]) -> Group<V> {
        variables.map(|variable| self.coder.builder.use_var(variable))
    }

    fn set(&mut self, variables: [Variable; V], values: Group<V>) {
        for (variable, value) in variables.into_iter().zip(values) {
            self.coder.builder.def_var(variable, value);
        }
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

    fn and(&mut self, a: Group<V>, b: Group<V>) -> Group<V> {
        std::array::from_fn(|v| self.coder.builder.ins().band(a[v], b[v]))
    }

    /// a where b is not.
    fn without(&mut self, a: Group<V>, b: Group<V>) -> Group<V> {
        std::array::from_fn(|v| self.coder.builder.ins().band_not(a[v], b[v]))
    }

    /// Whether a mask is set in any lane.
    fn any(&mut self, masks: Group<V>) -> Value {
        let mut mask = masks[0];
        for &other in &masks[1..] {
            mask = self.coder.builder.ins().bor(mask, other);
        }
        self.coder.builder.ins().vany_true(mask)
    }

    /// Stores the results of a program from a place on in the lanes of the masks.
    fn update_all(&mut self, masks: Group<V>, part: Part, place: usize) {
        self.coder.evaluate(self.kernel, part, |coder, i, values| {
            coder.update(masks, place + i, values);
        });
    }

    /// The lanes in which a program that gives one number gives 1.
    fn holds(&mut self, part: Part) -> Group<V> {
        let one = self.coder.number(1.0);
        let mut found = one;
        self.coder.evaluate(self.kernel, part, |_, _, values| found = values);
        self.coder.compare(FloatCC::Equal, found, one)
    }

    /// Copies g and μ of the group from the caller's memory to the frame, or back.
    fn state(&mut self, inwards: bool) {
        // The caller's numbers are aligned each by itself.
        let flags = MemFlagsData::new().with_notrap();
        let lists = [self.get(self.lists[0]), self.get(self.lists[1])];
        let m = self.kernel.element();
        for i in 0..m + self.kernel.dim() {
            let (list, at) = if i < m { (lists[0], i) } else { (lists[1], i - m) };
            let place = self.coder.frame.state + i;
            let offset = |v: usize| ((at * WIDTH + 2 * v) * 8) as i32;
            if inwards {
                let values = std::array::from_fn(|v| {
                    self.coder.builder.ins().load(F64X2, flags, list, offset(v))
                });
                self.coder.store(place, values);
            } else {
                let values = self.coder.load(place);
                for (v, value) in values.into_iter().enumerate() {
                    self.coder.builder.ins().store(flags, value, list, offset(v));
                }
            }
        }
    }

    /// The lanes of the group that the caller wants moved.
    fn wanted(&mut self) -> Group<V> {
        let list = self.get(self.lists[2]);
        std::array::from_fn(|v| {
            let mut mask = None;
            for lane in [0_u8, 1] {
                let offset = 2 * v as i32 + i32::from(lane);
                let ins = self.coder.builder.ins();
                let byte = ins.load(I8, MemFlagsData::trusted(), list, offset);
                let set = self.coder.builder.ins().icmp_imm_u(IntCC::NotEqual, byte, 0);
                let wide = self.coder.builder.ins().bmask(I64, set);
                mask = Some(match mask {
                    None => self.coder.builder.ins().splat(I64X2, wide),
                    Some(mask) => self.coder.builder.ins().insertlane(mask, wide, lane),
                });
            }
            mask.unwrap_or(list)
        })
    }

    /// Adds the steps of the block to those the caller is told of.
    fn tell(&mut self) {
        let list = self.get(self.lists[3]);
        let counts = self.all(self.count);
        for (v, counts) in counts.into_iter().enumerate() {
            for lane in [0_u8, 1] {
                let offset = (2 * v as i32 + i32::from(lane)) * 8;
                let count = self.coder.builder.ins().extractlane(counts, lane);
                let count = self.coder.builder.ins().fcvt_to_uint_sat(I64, count);
                let told =
                    self.coder.builder.ins().load(I64, MemFlagsData::trusted(), list, offset);
                let told = self.coder.builder.ins().iadd(told, count);
                self.coder.builder.ins().store(MemFlagsData::trusted(), told, list, offset);
            }
        }
    }

    /// All groups, and the end.
    fn groups(&mut self) {
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
            self.add(list, 2 * V as i64 * bytes);
        }
        let group = self.add(self.group, 1);
        let groups = (WIDTH / (2 * V)) as i64;
        let more = self.coder.builder.ins().icmp_imm_u(IntCC::UnsignedLessThan, group, groups);
        self.branch(more, first, out);

        self.at(out);
        self.coder.builder.ins().return_(&[]);
    }

    /// All blocks of steps of a group.
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
        let live = self.all(self.live);
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
        let live = self.all(self.live);
        let live = self.and(live, right);
        self.set(self.live, live);
        let ones = self.coder.ones(live);
        for v in 0..V {
            let count = self.get(self.count[v]);
            let count = self.coder.builder.ins().fadd(count, ones[v]);
            self.coder.builder.def_var(self.count[v], count);
        }
        let some = self.any(live);
        self.branch(some, transport, end);

        self.at(transport);
        self.update_all(live, Part::Transport, state);
        let tried = self.add(self.tried, 1);
        let length = self.get(self.length);
        let more = self.coder.builder.ins().icmp(IntCC::UnsignedLessThan, tried, length);
        self.branch(more, step, end);

        self.at(end);
        let count = self.all(self.count);
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
        let count = self.all(self.count);
        let count = std::array::from_fn(|v| self.coder.choose(broken[v], zero[v], count[v]));
        self.set(self.count, count);
        self.coder.builder.ins().jump(done, &[]);

        self.at(done);
        self.tell();
        let length = self.get(self.length);
        let whole = self.coder.builder.ins().fcvt_from_uint(F64, length);
        let whole = [self.coder.builder.ins().splat(F64X2, whole); V];
        let count = self.all(self.count);
        let whole = self.coder.compare(FloatCC::Equal, count, whole);
        let live = self.all(self.live);
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
        let store = |coder: &mut Coder<'f, V>, i, values| coder.store(frame.p + i, values);
        self.coder.evaluate(self.kernel, Part::Guess, store);
        let (one, zero) = (self.coder.number(1.0), self.coder.number(0.0));
        self.coder.store(frame.left, one);
        self.coder.store(frame.way, zero);
        let most = self.kernel.corrections();
        if most == 0 {
            self.coder.builder.ins().jump(after, &[]);
            return;
        }
        let live = self.all(self.live);
        self.set(self.open, live);
        self.set_integer(self.iteration, 0);
        let again = self.block();
        self.coder.builder.ins().jump(again, &[]);

        self.at(again);
        let open = self.all(self.open);
        let (mut left, mut way) = (one, zero);
        self.coder.evaluate(self.kernel, Part::Correct, |coder, i, values| {
            if i <= 2 * n {
                // p, then x and what is left.
                left =
                    coder.update(open, if i < n { frame.p + i } else { frame.x + i - n }, values);
            } else {
                let before = coder.load(frame.way);
                let sum = std::array::from_fn(|v| coder.builder.ins().fadd(before[v], values[v]));
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
