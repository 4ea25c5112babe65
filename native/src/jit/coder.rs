//! Programs as Cranelift's instructions, on numbers or on pairs of lanes.

use std::ops::Range;

use coadjoint_program::schedule::{Kept, Part, Places, Variable};
use coadjoint_program::{Id, Kernel, Node, Program};
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::immediates::Ieee64;
use cranelift_codegen::ir::types::{F64, F64X2, I64, I64X2};
use cranelift_codegen::ir::{
    Block, ConstantData, InstBuilder, MemFlagsData, StackSlot, StackSlotData, StackSlotKind, Type,
    Value,
};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::FunctionBuilder;

use crate::jit::host::JitError;

/// The bits of the fraction of a number, and the bias of its exponent.
const FRACTION: i64 = 52;
const BIAS: f64 = 1023.0;
/// A number so large that the last bits of a sum with it are a whole number.
const LARGE: f64 = 6_755_399_441_055_744.0;

/// The representation of a number of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    /// A single number.
    Number,
    /// A number together with that of the next trajectory.
    Pair,
}

impl Width {
    pub(super) fn kind(self) -> Type {
        match self {
            Self::Number => F64,
            Self::Pair => F64X2,
        }
    }

    pub(super) fn bytes(self) -> usize {
        self.kind().bytes() as usize
    }
}

/// Writes the body of a function.
pub(super) struct Coder<'f> {
    pub(super) builder: FunctionBuilder<'f>,
    pub(super) form: Width,
    pub(super) frame: Frame,
    memory: StackSlot,
    /// Its address.
    pub(super) base: Value,
    /// Address of the folded coefficients.
    pub(super) slots: Value,
}

/// Memory of numbers: it is there, and aligned to its size.
fn sound() -> MemFlagsData {
    MemFlagsData::trusted()
}

impl<'f> Coder<'f> {
    /// Begins a function of addresses and counts, the first being that of the folded coefficients; returns it with
    /// the parameters.
    pub(super) fn new(
        mut builder: FunctionBuilder<'f>,
        form: Width,
        frame: Frame,
    ) -> (Self, Vec<Value>) {
        let entry = builder.create_block();
        builder.append_block_params_for_function_params(entry);
        builder.switch_to_block(entry);
        let params = builder.block_params(entry).to_vec();
        let memory = StackSlotData::new(StackSlotKind::ExplicitSlot, 0, 4);
        let memory = builder.create_sized_stack_slot(memory);
        let base = builder.ins().stack_addr(I64, memory, 0);
        let slots = params.first().copied().unwrap_or(base);
        (Self { builder, form, frame, memory, base, slots }, params)
    }

    /// Ends the function.
    ///
    /// # Errors
    /// [`JitError::Large`] where the frame does not fit the stack.
    pub(super) fn finish(mut self, config: TargetFrontendConfig) -> Result<(), JitError> {
        let size = self.frame.bytes(self.form.bytes())?;
        self.builder.func.sized_stack_slots[self.memory].size = size;
        self.builder.seal_all_blocks();
        self.builder.finalize(config);
        Ok(())
    }

    fn offset(&self, place: usize) -> i32 {
        // A frame that is too large for this is refused when the function ends.
        (place * self.form.bytes()) as i32
    }

    /// The value at a place of the frame.
    pub(super) fn load(&mut self, place: usize) -> Value {
        let offset = self.offset(place);
        self.builder.ins().load(self.form.kind(), sound(), self.base, offset)
    }

    pub(super) fn store(&mut self, place: usize, value: Value) {
        let offset = self.offset(place);
        self.builder.ins().store(sound(), value, self.base, offset);
    }

    /// A constant, in every lane.
    pub(super) fn number(&mut self, value: f64) -> Value {
        match self.form {
            Width::Number => self.float(value),
            Width::Pair => {
                let bytes = [value.to_bits().to_le_bytes(); 2].concat();
                let constant =
                    self.builder.func.dfg.constants.insert(ConstantData::from(&bytes[..]));
                self.builder.ins().vconst(F64X2, constant)
            }
        }
    }

    /// A number by itself.
    pub(super) fn float(&mut self, value: f64) -> Value {
        self.builder.ins().f64const(Ieee64::with_bits(value.to_bits()))
    }

    fn slot(&mut self, i: usize) -> Value {
        let offset = (i * F64.bytes() as usize) as i32;
        let value = self.builder.ins().load(F64, sound(), self.slots, offset);
        match self.form {
            Width::Number => value,
            Width::Pair => self.builder.ins().splat(F64X2, value),
        }
    }

    /// `then` where the mask is set, else `otherwise`.
    fn choose(&mut self, mask: Value, then: Value, otherwise: Value) -> Value {
        let mask = self.builder.ins().bitcast(F64X2, MemFlagsData::new(), mask);
        self.builder.ins().bitselect(mask, then, otherwise)
    }

    fn select(&mut self, [a, b, then, otherwise]: [Value; 4]) -> Value {
        match self.form {
            Width::Pair => {
                let mask = self.builder.ins().fcmp(FloatCC::LessThanOrEqual, a, b);
                self.choose(mask, then, otherwise)
            }
            // By masks, too: a selection of numbers is a branch on some processors, and which coordinate is the
            // largest is nothing they can predict.
            Width::Number => {
                let [a, b, then, otherwise] =
                    [a, b, then, otherwise].map(|value| self.builder.ins().splat(F64X2, value));
                let mask = self.builder.ins().fcmp(FloatCC::LessThanOrEqual, a, b);
                let chosen = self.choose(mask, then, otherwise);
                self.builder.ins().extractlane(chosen, 0)
            }
        }
    }

    /// Numbers as words of bits.
    fn words(&mut self, a: Value) -> Value {
        let kind = if self.form == Width::Pair { I64X2 } else { I64 };
        self.builder.ins().bitcast(kind, MemFlagsData::new(), a)
    }

    /// Words of bits as numbers.
    fn numbers(&mut self, words: Value) -> Value {
        self.builder.ins().bitcast(self.form.kind(), MemFlagsData::new(), words)
    }

    /// a · 2ᵏ, by the exponent field of k, which is in the last bits of a sum.
    fn scale(&mut self, a: Value, k: Value) -> Value {
        let large = self.number(LARGE + BIAS);
        let sum = self.builder.ins().fadd(k, large);
        let words = self.words(sum);
        let field = self.builder.ins().ishl_imm_u(words, FRACTION);
        let factor = self.numbers(field);
        self.builder.ins().fmul(a, factor)
    }

    /// The exponent field of a, put into the last bits of a large number, less its bias.
    fn exponent(&mut self, a: Value) -> Value {
        let whole = (1_u64 << FRACTION) as f64;
        let (sign, whole, less) =
            (self.number(-0.0), self.number(whole), self.number(whole + BIAS));
        let size = self.builder.ins().band_not(a, sign);
        let words = self.words(size);
        let field = self.builder.ins().ushr_imm_u(words, FRACTION);
        let field = self.numbers(field);
        let sum = self.builder.ins().bor(field, whole);
        self.builder.ins().fsub(sum, less)
    }

    /// Stores a value, in the lanes of a mask if there is one.
    pub(super) fn assign(&mut self, mask: Option<Value>, place: usize, new: Value) {
        let value = match mask {
            Some(mask) => {
                let old = self.load(place);
                self.choose(mask, new, old)
            }
            None => new,
        };
        self.store(place, value);
    }

    pub(super) fn integer(&mut self, value: u64) -> Value {
        self.builder.ins().iconst(I64, value as i64)
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

    /// Copies g and μ from the caller's memory to the frame (`inwards`) or back; `apart` numbers apart there.
    pub(super) fn exchange(&mut self, lists: [Value; 2], apart: usize, inwards: bool) {
        // The caller's numbers are aligned each by itself.
        let flags = MemFlagsData::new().with_notrap();
        for (list, variable) in lists.into_iter().zip([Variable::Element, Variable::Momentum]) {
            for (at, place) in self.frame.places(variable).enumerate() {
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
    }

    /// A leaf of the program, read anew.
    pub(super) fn leaf(&mut self, inputs: &[Variable], node: Node) -> Value {
        match node {
            Node::Slot(i) => self.slot(i as usize),
            Node::Input(i) => match self.frame.find(inputs, i as usize) {
                Some((_, place)) => self.load(place),
                None => self.number(0.0),
            },
            Node::Constant(bits) => self.number(f64::from_bits(bits)),
            Node::Epsilon => self.number(f64::EPSILON),
            _ => self.number(0.0),
        }
    }

    /// An operation on these operands, of which it takes as many as it needs.
    pub(super) fn operation(&mut self, node: Node, [a, b, c, d]: [Value; 4]) -> Value {
        match node {
            Node::Add(..) => self.builder.ins().fadd(a, b),
            Node::Sub(..) => self.builder.ins().fsub(a, b),
            Node::Mul(..) => self.builder.ins().fmul(a, b),
            Node::TimesPlus(..) => self.builder.ins().fma(a, b, c),
            Node::Div(..) => self.builder.ins().fdiv(a, b),
            Node::Neg(_) => self.builder.ins().fneg(a),
            Node::Abs(_) => self.builder.ins().fabs(a),
            Node::Sqrt(_) => self.builder.ins().sqrt(a),
            Node::Round(_) => self.builder.ins().nearest(a),
            Node::Scale(..) => self.scale(a, b),
            Node::Exponent(_) => self.exponent(a),
            Node::Select(..) => self.select([a, b, c, d]),
            Node::Zero | Node::Constant(_) | Node::Epsilon | Node::Input(_) | Node::Slot(_) => a,
        }
    }
}

/// Registers given to values; the processor has sixteen or more.
const REGISTERS: usize = 13;

/// A value read from memory keeps its register if it is used again within this number of operations.
const NEAR: usize = 16;

/// When the values of a program are used.
struct Uses {
    /// The operations that use a node, one node's after the other's; those of results come after all operations.
    times: Vec<usize>,
    /// For each node, the index of its next use and the end of its uses.
    next: Vec<usize>,
    end: Vec<usize>,
}

impl Uses {
    fn of(program: &Program) -> Self {
        let nodes = program.nodes();
        let mut end = program.uses();
        let mut sum = 0;
        for count in &mut end {
            sum += *count;
            *count = sum;
        }
        let mut next: Vec<usize> =
            (0..nodes.len()).map(|i| if i == 0 { 0 } else { end[i - 1] }).collect();
        let begin = next.clone();
        let mut times = vec![0; sum];
        let operands =
            nodes.iter().enumerate().flat_map(|(t, node)| node.operands().map(move |id| (t, id)));
        let outputs = program.outputs().iter().enumerate().map(|(i, &id)| (nodes.len() + i, id));
        for (t, id) in operands.chain(outputs) {
            times[next[id.index()]] = t;
            next[id.index()] += 1;
        }
        Self { times, next: begin, end }
    }

    /// The next use of a node, if there is one.
    fn next(&self, node: usize) -> Option<usize> {
        (self.next[node] < self.end[node]).then(|| self.times[self.next[node]])
    }

    /// Forgets the uses of a node up to this time.
    fn pass(&mut self, node: usize, time: usize) {
        while self.next(node).is_some_and(|next| next <= time) {
            self.next[node] += 1;
        }
    }
}

/// The places of a program's values.
struct Held<'p> {
    inputs: &'static [Variable],
    nodes: &'p [Node],
    uses: Uses,
    /// Values in registers.
    held: Vec<(usize, Value)>,
    /// Places of the frame in which values wait.
    places: Vec<Option<usize>>,
    free: Vec<usize>,
}

impl Held<'_> {
    fn get(&mut self, coder: &mut Coder<'_>, node: usize) -> Value {
        if let Some(&(_, value)) = self.held.iter().find(|&&(held, _)| held == node) {
            return value;
        }
        match self.places[node] {
            Some(place) => coder.load(place),
            None => coder.leaf(self.inputs, self.nodes[node]),
        }
    }

    /// A place of the frame that nothing waits in.
    fn place(&mut self, coder: &mut Coder<'_>) -> usize {
        self.free.pop().unwrap_or_else(|| coder.frame.scratch())
    }

    /// After a use: gives up the value if it was the last one, or keeps it in a register if the next one is near.
    fn used(&mut self, node: usize, value: Value, time: usize) {
        self.uses.pass(node, time);
        let at = self.held.iter().position(|&(held, _)| held == node);
        match (self.uses.next(node), at) {
            (None, at) => {
                if let Some(at) = at {
                    self.held.swap_remove(at);
                }
                self.free.extend(self.places[node].take());
            }
            (Some(next), None) if next <= time + NEAR => self.held.push((node, value)),
            _ => {}
        }
    }

    /// Frees registers until there are no more values in them than registers.
    fn fit(&mut self, coder: &mut Coder<'_>) {
        while self.held.len() > REGISTERS {
            let later = |&at: &usize| self.uses.next(self.held[at].0);
            let Some(at) = (0..self.held.len()).max_by_key(later) else {
                return;
            };
            let (node, value) = self.held.swap_remove(at);
            if self.places[node].is_none() && self.nodes[node].is_operation() {
                let place = self.place(coder);
                coder.store(place, value);
                self.places[node] = Some(place);
            }
        }
    }
}

impl Coder<'_> {
    /// Writes out a program of the step; its results go to `sink`, in order and all after the last input was read.
    pub(super) fn evaluate(
        &mut self,
        kernel: &Kernel,
        part: Part,
        mut sink: impl FnMut(&mut Self, usize, Value),
    ) {
        let Some(program) = part.program(kernel) else {
            return;
        };
        self.frame.clear();
        let nodes = program.nodes();
        let mut held = Held {
            inputs: part.variables(kernel).0,
            nodes,
            uses: Uses::of(program),
            held: Vec::new(),
            places: vec![None; nodes.len()],
            free: Vec::new(),
        };
        for (time, &node) in nodes.iter().enumerate() {
            if !node.is_operation() || held.uses.next(time).is_none() {
                continue;
            }
            let mut operands = [self.base; 4];
            let ids: Vec<Id> = node.operands().collect();
            for (at, id) in ids.iter().enumerate() {
                operands[at] = match ids[..at].iter().position(|other| other == id) {
                    Some(same) => operands[same],
                    None => held.get(self, id.index()),
                };
            }
            let value = self.operation(node, operands);
            for (id, value) in ids.iter().zip(operands) {
                held.used(id.index(), value, time);
            }
            held.held.push((time, value));
            held.fit(self);
        }
        // Inputs may lie where results go.
        let mut moved = vec![None; program.outputs().len()];
        for (place, output) in moved.iter_mut().zip(program.outputs()) {
            if let Node::Input(_) = nodes[output.index()] {
                let value = held.get(self, output.index());
                let to = held.place(self);
                self.store(to, value);
                *place = Some(to);
            }
        }
        for (i, output) in program.outputs().iter().enumerate() {
            let value = match moved[i] {
                Some(place) => self.load(place),
                None => held.get(self, output.index()),
            };
            sink(self, i, value);
            held.used(output.index(), value, nodes.len() + i);
        }
    }
}

/// Bytes that a frame may take.
const MOST: usize = 1 << 18;

/// Places of a frame, counted in numbers (or groups of lanes).
#[derive(Clone, Debug)]
pub(super) struct Frame {
    variables: Places,
    /// Offsets of saved g and μ: at the start of the block, and of a step with kicks.
    kept: Range<usize>,
    /// All of them.
    size: usize,
    /// The offset of values without a register, used by one program after another.
    scratch: usize,
}

impl Frame {
    pub(super) fn of(kernel: &Kernel) -> Self {
        let variables = Places::of(kernel);
        let states = if kernel.flows().is_some() { 2 } else { 1 };
        let kept = variables.len()..variables.len() + states * variables.state().len();
        let size = kept.end;
        Self { variables, kept, size, scratch: size }
    }

    /// Its size in bytes, for numbers of this size.
    pub(super) fn bytes(&self, each: usize) -> Result<u32, JitError> {
        let bytes = self.size.saturating_mul(each);
        match u32::try_from(bytes) {
            Ok(fits) if bytes <= MOST => Ok(fits),
            _ => Err(JitError::Large { bytes, most: MOST }),
        }
    }

    /// One more place for a value that has no register.
    pub(super) fn scratch(&mut self) -> usize {
        self.scratch += 1;
        self.size = self.size.max(self.scratch);
        self.scratch - 1
    }

    /// Forgets the values that have no register.
    pub(super) fn clear(&mut self) {
        self.scratch = self.kept.end;
    }

    /// Offsets of a variable's numbers; of a count, those that programs read.
    pub(super) fn places(&self, variable: Variable) -> Range<usize> {
        self.variables.range(variable)
    }

    /// The offset of saved g and μ.
    pub(super) fn kept(&self, kept: Kept) -> usize {
        self.kept.start + kept as usize * self.state().len()
    }

    /// Offsets of g and μ.
    pub(super) fn state(&self) -> Range<usize> {
        self.variables.state()
    }

    /// The variable of number i of a list, and where that number is.
    pub(super) fn find(&self, list: &[Variable], i: usize) -> Option<(Variable, usize)> {
        let mut before = 0;
        list.iter().find_map(|&variable| {
            let places = self.places(variable);
            let at = places.start + i - before;
            before += places.len();
            (i < before).then_some((variable, at))
        })
    }
}
