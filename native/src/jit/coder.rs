//! Programs as Cranelift's instructions, on numbers or on pairs of lanes.

use coadjoint_program::{Id, Kernel, Node};
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::immediates::Ieee64;
use cranelift_codegen::ir::types::{F64, F64X2, I64X2};
use cranelift_codegen::ir::{ConstantData, InstBuilder, MemFlagsData, Type, Value};
use cranelift_frontend::FunctionBuilder;

use super::frame::{Frame, Part};

/// How a number of the program is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// By itself.
    Number,
    /// With the same number of the next trajectory.
    Pair,
}

impl Form {
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

/// V values of one form: a number of the program in all lanes that are taken at once.
pub(super) type Group<const V: usize> = [Value; V];

/// Writes the body of a function.
pub(super) struct Coder<'f, const V: usize> {
    pub(super) builder: FunctionBuilder<'f>,
    pub(super) form: Form,
    pub(super) frame: Frame,
    /// Address of the frame.
    pub(super) base: Value,
    /// Address of the folded coefficients.
    pub(super) slots: Value,
}

/// Memory of numbers: it is there, and aligned to its size.
fn sound() -> MemFlagsData {
    MemFlagsData::trusted()
}

impl<const V: usize> Coder<'_, V> {
    fn offset(&self, place: usize, v: usize) -> i32 {
        // The frame was asked to be small before anything was written.
        ((place * V + v) * self.form.bytes()) as i32
    }

    /// What is at a place of the frame.
    pub(super) fn load(&mut self, place: usize) -> Group<V> {
        std::array::from_fn(|v| {
            let offset = self.offset(place, v);
            self.builder.ins().load(self.form.kind(), sound(), self.base, offset)
        })
    }

    pub(super) fn store(&mut self, place: usize, values: Group<V>) {
        for (v, value) in values.into_iter().enumerate() {
            let offset = self.offset(place, v);
            self.builder.ins().store(sound(), value, self.base, offset);
        }
    }

    pub(super) fn copy(&mut self, from: usize, to: usize, count: usize) {
        for i in 0..count {
            let values = self.load(from + i);
            self.store(to + i, values);
        }
    }

    /// The same number everywhere.
    pub(super) fn number(&mut self, value: f64) -> Group<V> {
        let value = match self.form {
            Form::Number => self.builder.ins().f64const(Ieee64::with_bits(value.to_bits())),
            Form::Pair => {
                let bytes = [value.to_bits().to_le_bytes(); 2].concat();
                let constant =
                    self.builder.func.dfg.constants.insert(ConstantData::from(&bytes[..]));
                self.builder.ins().vconst(F64X2, constant)
            }
        };
        [value; V]
    }

    fn slot(&mut self, i: usize) -> Group<V> {
        let offset = (i * F64.bytes() as usize) as i32;
        let value = self.builder.ins().load(F64, sound(), self.slots, offset);
        [match self.form {
            Form::Number => value,
            Form::Pair => self.builder.ins().splat(F64X2, value),
        }; V]
    }

    /// `then` where the mask is set, else `otherwise`.
    pub(super) fn choose(&mut self, mask: Value, then: Value, otherwise: Value) -> Value {
        let mask = self.builder.ins().bitcast(F64X2, MemFlagsData::new(), mask);
        self.builder.ins().bitselect(mask, then, otherwise)
    }

    fn select(&mut self, [a, b, then, otherwise]: [Value; 4]) -> Value {
        match self.form {
            Form::Pair => {
                let mask = self.builder.ins().fcmp(FloatCC::LessThanOrEqual, a, b);
                self.choose(mask, then, otherwise)
            }
            // By masks, too: a selection of numbers is a branch on some processors, and which coordinate is the
            // largest is nothing they can predict.
            Form::Number => {
                let [a, b, then, otherwise] =
                    [a, b, then, otherwise].map(|value| self.builder.ins().splat(F64X2, value));
                let mask = self.builder.ins().fcmp(FloatCC::LessThanOrEqual, a, b);
                let chosen = self.choose(mask, then, otherwise);
                self.builder.ins().extractlane(chosen, 0)
            }
        }
    }

    /// Masks of the lanes in which a comparison holds.
    pub(super) fn compare(&mut self, code: FloatCC, a: Group<V>, b: Group<V>) -> Group<V> {
        std::array::from_fn(|v| self.builder.ins().fcmp(code, a[v], b[v]))
    }

    /// 1 in the lanes of the masks, 0 elsewhere.
    pub(super) fn ones(&mut self, masks: Group<V>) -> Group<V> {
        let one = self.number(1.0);
        std::array::from_fn(|v| {
            let bits = self.builder.ins().bitcast(I64X2, MemFlagsData::new(), one[v]);
            let kept = self.builder.ins().band(masks[v], bits);
            self.builder.ins().bitcast(F64X2, MemFlagsData::new(), kept)
        })
    }

    /// The results of a program of the step; nothing is stored.
    pub(super) fn evaluate(&mut self, kernel: &Kernel, part: Part) -> Vec<Group<V>> {
        let Some(program) = part.program(kernel) else {
            return Vec::new();
        };
        let nodes = program.nodes();
        let mut known: Vec<Option<Group<V>>> = vec![None; nodes.len()];
        // Each result with all that it needs and is not there yet: fewer values live at once than in the program's order.
        let mut open: Vec<(Id, bool)> =
            program.outputs().iter().rev().map(|&output| (output, false)).collect();
        while let Some((id, ready)) = open.pop() {
            let node = nodes[id.index()];
            if known[id.index()].is_some() || is_leaf(node) {
                continue;
            }
            if ready {
                known[id.index()] = Some(self.operation(part, nodes, &known, node));
            } else {
                open.push((id, true));
                let operands: Vec<Id> = node.operands().collect();
                open.extend(operands.into_iter().rev().map(|operand| (operand, false)));
            }
        }
        let outputs = program.outputs().iter();
        outputs.map(|&output| self.operand(part, nodes, &known, output)).collect()
    }

    /// A value made before, or a leaf read anew: as a rule part of the instruction that uses it.
    fn operand(
        &mut self,
        part: Part,
        nodes: &[Node],
        known: &[Option<Group<V>>],
        id: Id,
    ) -> Group<V> {
        match (known[id.index()], nodes[id.index()]) {
            (Some(values), _) => values,
            (None, Node::Constant(bits)) => self.number(f64::from_bits(bits)),
            (None, Node::Slot(i)) => self.slot(i as usize),
            (None, Node::Input(i)) => self.load(self.frame.input(part, i as usize)),
            // Operands come before their users.
            (None, _) => self.number(0.0),
        }
    }

    fn operation(
        &mut self,
        part: Part,
        nodes: &[Node],
        known: &[Option<Group<V>>],
        node: Node,
    ) -> Group<V> {
        let mut operands = [[self.base; V]; 4];
        for (place, id) in operands.iter_mut().zip(node.operands()) {
            *place = self.operand(part, nodes, known, id);
        }
        let [a, b, c, d] = operands;
        std::array::from_fn(|v| {
            let (a, b, c, d) = (a[v], b[v], c[v], d[v]);
            match node {
                Node::Add(..) => self.builder.ins().fadd(a, b),
                Node::Sub(..) => self.builder.ins().fsub(a, b),
                Node::Mul(..) => self.builder.ins().fmul(a, b),
                Node::TimesPlus(..) => self.builder.ins().fma(a, b, c),
                Node::Div(..) => self.builder.ins().fdiv(a, b),
                Node::Neg(_) => self.builder.ins().fneg(a),
                Node::Abs(_) => self.builder.ins().fabs(a),
                Node::Sqrt(_) => self.builder.ins().sqrt(a),
                Node::Select(..) => self.select([a, b, c, d]),
                Node::Zero | Node::Constant(_) | Node::Input(_) | Node::Slot(_) => a,
            }
        })
    }
}

fn is_leaf(node: Node) -> bool {
    matches!(node, Node::Zero | Node::Constant(_) | Node::Input(_) | Node::Slot(_))
}
