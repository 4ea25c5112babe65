//! Graphs under construction: hash-consed, so that equal sub-expressions are one node.

use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use crate::elementary::Function;
use crate::node::{Cost, Id, Node};
use crate::program::Program;

/// Where nodes are found again.
#[cfg(feature = "std")]
type Known = std::collections::HashMap<Node, Id>;
/// Without the standard library there are no numbers at random to hash with.
#[cfg(not(feature = "std"))]
type Known = alloc::collections::BTreeMap<Node, Id>;

/// A growing graph. Ids are handed out in order of creation, so output never depends on hashing.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    known: Known,
    /// The nodes that are a function's value, of which node.
    calls: BTreeMap<Id, (Function, Id)>,
}

impl Graph {
    /// A graph without nodes.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn intern(&mut self, node: Node) -> Id {
        if let Some(&id) = self.known.get(&node) {
            return id;
        }
        // Graphs are bounded by the term limit of the series, far below 2³² nodes.
        let id = Id(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(node);
        self.known.insert(node, id);
        id
    }

    /// Remembers that `result` is a function's value at a, for derivatives.
    pub(crate) fn name(&mut self, function: Function, a: Id, result: Id) {
        if self.node(result).operands().next().is_some() {
            self.calls.insert(result, (function, a));
        }
    }

    /// The function and its argument that this is the value of, if it is one's.
    pub(crate) fn called(&self, id: Id) -> Option<(Function, Id)> {
        self.calls.get(&id).copied()
    }

    /// The operation that `id` stands for.
    #[must_use]
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id.index()]
    }

    /// Whether this is the number 0, known without any input.
    #[must_use]
    pub fn is_zero(&self, id: Id) -> bool {
        self.node(id) == Node::Zero
    }

    /// The number this is, where it is known without any input.
    #[must_use]
    pub fn known_number(&self, id: Id) -> Option<f64> {
        match self.node(id) {
            Node::Zero => Some(0.0),
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// The number 0.
    pub fn zero(&mut self) -> Id {
        self.intern(Node::Zero)
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> Id {
        if value == 0.0 {
            return self.zero();
        }
        self.intern(Node::Constant(value.to_bits()))
    }

    /// The rounding unit of the numbers that the program is evaluated in.
    pub fn epsilon(&mut self) -> Id {
        self.intern(Node::Epsilon)
    }

    /// Input number `index`.
    pub fn input(&mut self, index: usize) -> Id {
        self.intern(Node::Input(index as u32))
    }

    /// Folded coefficient number `index`.
    pub fn slot(&mut self, index: usize) -> Id {
        self.intern(Node::Slot(index as u32))
    }

    /// a · b, in canonical operand order; the number 0 absorbs, 1 and −1 make no product.
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        if self.is_zero(a) || self.is_zero(b) {
            return self.zero();
        }
        for (one, other) in [(a, b), (b, a)] {
            match self.known_number(one) {
                Some(1.0) => return other,
                Some(-1.0) => return self.neg(other),
                _ => {}
            }
        }
        self.intern(Node::Mul(a.min(b), a.max(b)))
    }

    /// a + b; adding to the number 0 gives the other operand.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (Node::Zero, _) => b,
            (_, Node::Zero) => a,
            (_, Node::Neg(b)) => self.sub(a, b),
            (Node::Neg(a), _) => self.sub(b, a),
            _ => self.intern(Node::Add(a.min(b), a.max(b))),
        }
    }

    /// a − b.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (_, Node::Zero) => a,
            (Node::Zero, _) => self.neg(b),
            (_, Node::Neg(b)) => self.add(a, b),
            _ => self.intern(Node::Sub(a, b)),
        }
    }

    /// a · b + c.
    pub fn times_plus(&mut self, a: Id, b: Id, c: Id) -> Id {
        if self.is_zero(a) || self.is_zero(b) {
            return c;
        }
        if self.is_zero(c) {
            return self.mul(a, b);
        }
        for (one, other) in [(a, b), (b, a)] {
            match self.known_number(one) {
                Some(1.0) => return self.add(other, c),
                Some(-1.0) => return self.sub(c, other),
                _ => {}
            }
        }
        self.intern(Node::TimesPlus(a.min(b), a.max(b), c))
    }

    /// −a.
    pub fn neg(&mut self, a: Id) -> Id {
        match self.node(a) {
            Node::Zero => a,
            Node::Neg(a) => a,
            Node::Constant(bits) => self.constant(-f64::from_bits(bits)),
            _ => self.intern(Node::Neg(a)),
        }
    }

    /// a / b.
    pub fn div(&mut self, a: Id, b: Id) -> Id {
        match self.is_zero(a) {
            true => a,
            false => self.intern(Node::Div(a, b)),
        }
    }

    /// |a|.
    pub fn abs(&mut self, a: Id) -> Id {
        match self.node(a) {
            Node::Zero | Node::Abs(_) => a,
            Node::Neg(a) => self.intern(Node::Abs(a)),
            _ => self.intern(Node::Abs(a)),
        }
    }

    /// √a.
    pub fn sqrt(&mut self, a: Id) -> Id {
        match self.is_zero(a) {
            true => a,
            false => self.intern(Node::Sqrt(a)),
        }
    }

    /// The integer nearest to a, the even one of two.
    pub fn round(&mut self, a: Id) -> Id {
        match self.is_zero(a) {
            true => a,
            false => self.intern(Node::Round(a)),
        }
    }

    /// a · 2ᵏ, for whole k from −1022 to 1023.
    pub fn scale(&mut self, a: Id, k: Id) -> Id {
        match self.is_zero(a) || self.is_zero(k) {
            true => a,
            false => self.intern(Node::Scale(a, k)),
        }
    }

    /// The exponent of a, as [`Node::Exponent`] has it.
    pub fn exponent(&mut self, a: Id) -> Id {
        self.intern(Node::Exponent(a))
    }

    /// `then` if a ≤ b, else `otherwise`; that also where a or b is not a number.
    pub fn select(&mut self, a: Id, b: Id, then: Id, otherwise: Id) -> Id {
        match then == otherwise {
            true => then,
            false => self.intern(Node::Select(a, b, then, otherwise)),
        }
    }

    /// The smaller of two numbers; b where a is not a number, and a number only if both are or a alone is not.
    pub fn min(&mut self, a: Id, b: Id) -> Id {
        self.select(a, b, a, b)
    }

    /// The larger of two numbers. Not a number where b is not; a's being none is lost.
    pub fn max(&mut self, a: Id, b: Id) -> Id {
        self.select(b, a, a, b)
    }

    /// base^exponent by repeated squaring, every intermediate power shared; exponent ≥ 1.
    pub fn power(&mut self, base: Id, exponent: u32) -> Id {
        match exponent {
            0 | 1 => base,
            n if n.is_multiple_of(2) => {
                let root = self.power(base, n / 2);
                self.mul(root, root)
            }
            n => {
                let even = self.power(base, n - 1);
                self.mul(even, base)
            }
        }
    }

    /// The nodes of another program on these inputs, its slots being this graph's; the ids of its results.
    pub fn call(&mut self, program: &Program, inputs: &[Id]) -> Vec<Id> {
        self.call_from(program, inputs, 0)
    }

    /// The same where the program's first slot is this one of the graph's.
    pub fn call_from(&mut self, program: &Program, inputs: &[Id], first_slot: usize) -> Vec<Id> {
        let mut ids: Vec<Id> = Vec::with_capacity(program.nodes().len());
        for node in program.nodes() {
            let id = match *node {
                Node::Input(i) => inputs.get(i as usize).copied().unwrap_or_else(|| self.zero()),
                Node::Zero => self.zero(),
                Node::Constant(bits) => self.constant(f64::from_bits(bits)),
                Node::Epsilon => self.epsilon(),
                Node::Slot(i) => self.slot(first_slot + i as usize),
                Node::Add(a, b) => self.add(ids[a.index()], ids[b.index()]),
                Node::Sub(a, b) => self.sub(ids[a.index()], ids[b.index()]),
                Node::Mul(a, b) => self.mul(ids[a.index()], ids[b.index()]),
                Node::TimesPlus(a, b, c) => {
                    self.times_plus(ids[a.index()], ids[b.index()], ids[c.index()])
                }
                Node::Div(a, b) => self.div(ids[a.index()], ids[b.index()]),
                Node::Neg(a) => self.neg(ids[a.index()]),
                Node::Abs(a) => self.abs(ids[a.index()]),
                Node::Sqrt(a) => self.sqrt(ids[a.index()]),
                Node::Round(a) => self.round(ids[a.index()]),
                Node::Scale(a, k) => self.scale(ids[a.index()], ids[k.index()]),
                Node::Exponent(a) => self.exponent(ids[a.index()]),
                Node::Select(a, b, c, d) => {
                    let [a, b, c, d] = [a, b, c, d].map(|operand| ids[operand.index()]);
                    self.select(a, b, c, d)
                }
            };
            ids.push(id);
        }
        for &(result, function, a) in program.calls() {
            self.name(function, ids[a.index()], ids[result.index()]);
        }
        program.outputs().iter().map(|output| ids[output.index()]).collect()
    }

    /// How many nodes there are: a mark for [`Graph::rewind`] and [`Graph::cost_since`].
    #[must_use]
    pub fn mark(&self) -> usize {
        self.nodes.len()
    }

    /// Forgets every node made after `mark`.
    pub fn rewind(&mut self, mark: usize) {
        for node in self.nodes.drain(mark..) {
            self.known.remove(&node);
        }
        self.calls.retain(|result, _| result.index() < mark);
    }

    /// The operations of the nodes made after `mark`.
    #[must_use]
    pub fn cost_since(&self, mark: usize) -> Cost {
        Cost::of(&self.nodes[mark..])
    }

    /// Whether each node is needed for one of these.
    pub(crate) fn needed(&self, outputs: &[Id]) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        for output in outputs {
            needed[output.index()] = true;
        }
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if needed[index] {
                for operand in node.operands() {
                    needed[operand.index()] = true;
                }
            }
        }
        needed
    }

    /// The program that computes `outputs`, nodes nothing needs left out.
    #[must_use]
    pub fn finish(self, inputs: usize, outputs: &[Id]) -> Program {
        let needed = self.needed(outputs);
        let mut renamed = vec![Id(0); self.nodes.len()];
        let mut nodes = Vec::new();
        for (index, node) in self.nodes.iter().enumerate() {
            if needed[index] {
                renamed[index] = Id(nodes.len() as u32);
                nodes.push(node.map(|operand| renamed[operand.index()]));
            }
        }
        let outputs = outputs.iter().map(|output| renamed[output.index()]).collect();
        let calls = self
            .calls
            .iter()
            .filter(|(result, (_, a))| needed[result.index()] && needed[a.index()]);
        let calls = calls.map(|(result, &(function, a))| {
            (renamed[result.index()], function, renamed[a.index()])
        });
        Program::of_graph(inputs, nodes, outputs, calls.collect())
    }
}
