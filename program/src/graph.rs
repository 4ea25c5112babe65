//! Graphs under construction: hash-consed, so that equal sub-expressions are one node.

use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::mem;

/// The index of nodes.
#[cfg(feature = "std")]
type Known = std::collections::HashMap<Node, Id>;
/// The index without the standard library, which has no random numbers to hash with.
#[cfg(not(feature = "std"))]
type Known = BTreeMap<Node, Id>;

/// A growing graph. Ids are handed out in order of creation, so output never depends on hashing. It grows behind shared
/// references, so that formulas nest.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: RefCell<Vec<Node>>,
    known: RefCell<Known>,
    /// The nodes that are a function's value, of which node.
    calls: RefCell<BTreeMap<Id, (Function, Id)>>,
    /// The programs that were called side by side.
    rows: RefCell<Vec<Rows>>,
}

impl Graph {
    /// A graph without nodes.
    pub fn new() -> Self {
        Self::default()
    }

    fn intern(&self, node: Node) -> Id {
        *self.known.borrow_mut().entry(node).or_insert_with(|| {
            let mut nodes = self.nodes.borrow_mut();
            nodes.push(node);
            // Graphs are bounded by the term limit of the series, far below 2³² nodes.
            Id(u32::try_from(nodes.len() - 1).unwrap_or(u32::MAX))
        })
    }

    /// Remembers that `result` is a function's value at a, for derivatives.
    pub(crate) fn name(&self, function: Function, a: Id, result: Id) {
        if self.node(result).is_operation() {
            self.calls.borrow_mut().insert(result, (function, a));
        }
    }

    /// The function and its argument that this is the value of, if it is one's.
    pub(crate) fn called(&self, id: Id) -> Option<(Function, Id)> {
        self.calls.borrow().get(&id).copied()
    }

    /// The operation that `id` stands for.
    pub(crate) fn node(&self, id: Id) -> Node {
        self.nodes.borrow()[id.index()]
    }

    /// True if this is the number 0, known without any input.
    pub fn is_zero(&self, id: Id) -> bool {
        self.node(id) == Node::Zero
    }

    /// The number this is, where it is known without any input.
    pub fn known_number(&self, id: Id) -> Option<f64> {
        match self.node(id) {
            Node::Zero => Some(0.0),
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// The number 0.
    pub fn zero(&self) -> Id {
        self.intern(Node::Zero)
    }

    /// A number.
    pub fn constant(&self, value: f64) -> Id {
        if value == 0.0 {
            return self.zero();
        }
        self.intern(Node::Constant(value.to_bits()))
    }

    /// The rounding unit of the numbers that the program is evaluated in.
    pub fn epsilon(&self) -> Id {
        self.intern(Node::Epsilon)
    }

    /// Input number `index`.
    pub fn input(&self, index: usize) -> Id {
        self.intern(Node::Input(index as u32))
    }

    /// Folded coefficient number `index`.
    pub fn slot(&self, index: usize) -> Id {
        self.intern(Node::Slot(index as u32))
    }

    /// a · b, in canonical operand order; the number 0 absorbs, 1 and −1 make no product.
    pub fn mul(&self, a: Id, b: Id) -> Id {
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
    pub fn add(&self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (Node::Zero, _) => b,
            (_, Node::Zero) => a,
            (_, Node::Neg(b)) => self.sub(a, b),
            (Node::Neg(a), _) => self.sub(b, a),
            _ => self.intern(Node::Add(a.min(b), a.max(b))),
        }
    }

    /// a − b.
    pub fn sub(&self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (_, Node::Zero) => a,
            (Node::Zero, _) => self.neg(b),
            (_, Node::Neg(b)) => self.add(a, b),
            _ => self.intern(Node::Sub(a, b)),
        }
    }

    /// a · b + c.
    pub fn times_plus(&self, a: Id, b: Id, c: Id) -> Id {
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
    pub fn neg(&self, a: Id) -> Id {
        match self.node(a) {
            Node::Zero => a,
            Node::Neg(a) => a,
            Node::Constant(bits) => self.constant(-f64::from_bits(bits)),
            _ => self.intern(Node::Neg(a)),
        }
    }

    /// a / b.
    pub fn div(&self, a: Id, b: Id) -> Id {
        match self.is_zero(a) {
            true => a,
            false => self.intern(Node::Div(a, b)),
        }
    }

    /// |a|.
    pub fn abs(&self, a: Id) -> Id {
        match self.node(a) {
            Node::Zero | Node::Abs(_) => a,
            Node::Neg(a) => self.intern(Node::Abs(a)),
            _ => self.intern(Node::Abs(a)),
        }
    }

    /// √a.
    pub fn sqrt(&self, a: Id) -> Id {
        match self.is_zero(a) {
            true => a,
            false => self.intern(Node::Sqrt(a)),
        }
    }

    /// The integer nearest to a, the even one of two.
    pub fn round(&self, a: Id) -> Id {
        match self.is_zero(a) {
            true => a,
            false => self.intern(Node::Round(a)),
        }
    }

    /// a · 2ᵏ, for whole k from −1022 to 1023.
    pub fn scale(&self, a: Id, k: Id) -> Id {
        match self.is_zero(a) || self.is_zero(k) {
            true => a,
            false => self.intern(Node::Scale(a, k)),
        }
    }

    /// The exponent of a, as [`Node::Exponent`] has it.
    pub fn exponent(&self, a: Id) -> Id {
        self.intern(Node::Exponent(a))
    }

    /// `then` if a ≤ b, else `otherwise`; that also where a or b is not a number.
    pub fn select(&self, a: Id, b: Id, then: Id, otherwise: Id) -> Id {
        match then == otherwise {
            true => then,
            false => self.intern(Node::Select(a, b, then, otherwise)),
        }
    }

    /// The smaller of two numbers; b where a is not a number, and a number only if both are or a alone is not.
    pub fn min(&self, a: Id, b: Id) -> Id {
        self.select(a, b, a, b)
    }

    /// The larger of two numbers. Not a number where b is not; a's being none is lost.
    pub fn max(&self, a: Id, b: Id) -> Id {
        self.select(b, a, a, b)
    }

    /// base^exponent by repeated squaring, every intermediate power shared; exponent ≥ 1.
    pub fn power(&self, base: Id, exponent: u32) -> Id {
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
    pub fn call(&self, program: &Program, inputs: &[Id]) -> Vec<Id> {
        self.call_from(program, inputs, 0)
    }

    /// As [`Graph::call`], with the program's first slot at `first_slot` of this graph.
    pub fn call_from(&self, program: &Program, inputs: &[Id], first_slot: usize) -> Vec<Id> {
        let mut ids: Vec<Id> = Vec::with_capacity(program.nodes().len());
        for node in program.nodes() {
            ids.push(self.copied(node.map(|operand| ids[operand.index()]), inputs, first_slot));
        }
        for &(result, function, a) in program.calls() {
            self.name(function, ids[a.index()], ids[result.index()]);
        }
        program.outputs().iter().map(|output| ids[output.index()]).collect()
    }

    /// The nodes of another program on several lists of inputs, and the ids of the results of each. Where no operation is left out
    /// for what is known of its operands, texts may have the program once, on [`Rows`] of numbers.
    pub fn call_each(&self, program: &Program, inputs: &[Vec<Id>]) -> Vec<Vec<Id>> {
        let outputs: Vec<_> = inputs.iter().map(|inputs| self.call(program, inputs)).collect();
        if inputs.len() > 1 && inputs.iter().all(|inputs| self.is_whole(program, inputs)) {
            let outputs = outputs.iter().map(|row| row.iter().copied().map(Some).collect());
            let rows = Rows {
                program: program.clone(),
                inputs: inputs.to_vec(),
                outputs: outputs.collect(),
            };
            self.rows.borrow_mut().push(rows);
        }
        outputs
    }

    /// True if a program called with these inputs has a node for each of its operations.
    fn is_whole(&self, program: &Program, inputs: &[Id]) -> bool {
        let mut ids: Vec<Id> = Vec::with_capacity(program.nodes().len());
        program.nodes().iter().all(|node| {
            let node = node.map(|operand| ids[operand.index()]);
            let id = self.copied(node, inputs, 0);
            ids.push(id);
            let [mut own, mut asked] = [self.node(id), node].map(|node| {
                let operands: Vec<Id> = node.operands().collect();
                (mem::discriminant(&node), operands)
            });
            own.1.sort_unstable();
            asked.1.sort_unstable();
            !node.is_operation() || own == asked
        })
    }

    /// A node of another program whose operands are nodes of this graph.
    fn copied(&self, node: Node, inputs: &[Id], first_slot: usize) -> Id {
        match node {
            Node::Input(i) => inputs.get(i as usize).copied().unwrap_or_else(|| self.zero()),
            Node::Slot(i) => self.slot(first_slot + i as usize),
            Node::Add(a, b) => self.add(a, b),
            Node::Sub(a, b) => self.sub(a, b),
            Node::Mul(a, b) => self.mul(a, b),
            Node::TimesPlus(a, b, c) => self.times_plus(a, b, c),
            Node::Div(a, b) => self.div(a, b),
            Node::Neg(a) => self.neg(a),
            Node::Abs(a) => self.abs(a),
            Node::Sqrt(a) => self.sqrt(a),
            Node::Round(a) => self.round(a),
            Node::Scale(a, k) => self.scale(a, k),
            Node::Select(a, b, c, d) => self.select(a, b, c, d),
            Node::Constant(bits) => self.constant(f64::from_bits(bits)),
            node @ (Node::Zero | Node::Epsilon | Node::Exponent(_)) => self.intern(node),
        }
    }

    /// The number of nodes: a mark for [`Graph::rewind`] and [`Graph::cost_since`].
    pub fn mark(&self) -> usize {
        self.nodes.borrow().len()
    }

    /// Forgets every node made after `mark`.
    pub fn rewind(&self, mark: usize) {
        for node in self.nodes.borrow_mut().drain(mark..) {
            self.known.borrow_mut().remove(&node);
        }
        self.calls.borrow_mut().retain(|result, _| result.index() < mark);
        let made = |rows: &Rows| rows.ids().all(|id| id.index() < mark);
        self.rows.borrow_mut().retain(made);
    }

    /// The operations of the nodes made after `mark`.
    pub fn cost_since(&self, mark: usize) -> Cost {
        Cost::of(&self.nodes.borrow()[mark..])
    }

    /// Marks the nodes that are needed for one of these.
    pub(crate) fn needed(&self, outputs: &[Id]) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.borrow().len()];
        for output in outputs {
            needed[output.index()] = true;
        }
        for (index, node) in self.nodes.borrow().iter().enumerate().rev() {
            if needed[index] {
                for operand in node.operands() {
                    needed[operand.index()] = true;
                }
            }
        }
        needed
    }

    /// The program that computes `outputs`, nodes nothing needs left out.
    pub fn finish(&self, inputs: usize, outputs: &[Id]) -> Program {
        let needed = self.needed(outputs);
        let (own, calls) = (self.nodes.borrow(), self.calls.borrow());
        let mut renamed = vec![Id(0); own.len()];
        let mut nodes = Vec::new();
        for (index, node) in own.iter().enumerate() {
            if needed[index] {
                renamed[index] = Id(nodes.len() as u32);
                nodes.push(node.map(|operand| renamed[operand.index()]));
            }
        }
        let outputs = outputs.iter().map(|output| renamed[output.index()]).collect();
        let calls =
            calls.iter().filter(|(result, (_, a))| needed[result.index()] && needed[a.index()]);
        let calls = calls.map(|(result, &(function, a))| {
            (renamed[result.index()], function, renamed[a.index()])
        });
        let calls = calls.collect();
        let slot = |node: &Node| match node {
            Node::Slot(i) => *i as usize + 1,
            _ => 0,
        };
        let slots = nodes.iter().map(slot).max().unwrap_or(0);
        // Those whose inputs are all needed; of their results some may not be.
        let rows = self.rows.borrow();
        let kept =
            rows.iter().filter(|rows| rows.inputs.iter().flatten().all(|id| needed[id.index()]));
        let rename = |id: Id| needed[id.index()].then(|| renamed[id.index()]);
        let rows = kept.map(|rows| Rows {
            program: rows.program.clone(),
            inputs: rows
                .inputs
                .iter()
                .map(|row| row.iter().map(|id| renamed[id.index()]).collect())
                .collect(),
            outputs: rows
                .outputs
                .iter()
                .map(|row| row.iter().map(|id| id.and_then(rename)).collect())
                .collect(),
        });
        let rows = rows.collect();
        Program { inputs, slots, nodes, outputs, calls, rows }
    }
}

/// A node of a [`Graph`](crate::Graph), an index into its arena. Operands have smaller ids than their users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The index into [`Program::nodes`](crate::Program::nodes).
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One operation on numbers. Each is rounded once, as IEEE 754 says; nothing may be contracted or reordered.
///
/// The programs of a generating function have inputs, slots, sums, products and fused products only: signs and numbers
/// live in their slots. A whole step has the others too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// The number 0, the value of an empty polynomial.
    Zero,
    /// Another number, by its bits.
    Constant(u64),
    /// The distance from 1 to the next larger number of the type that the program is evaluated in.
    Epsilon,
    /// Input number i.
    Input(u32),
    /// Folded coefficient number i.
    Slot(u32),
    /// a + b
    Add(Id, Id),
    /// a − b
    Sub(Id, Id),
    /// a · b
    Mul(Id, Id),
    /// a · b + c, rounded once where the target rounds as the processor's fused product does.
    TimesPlus(Id, Id, Id),
    /// a / b
    Div(Id, Id),
    /// −a
    Neg(Id),
    /// |a|
    Abs(Id),
    /// √a
    Sqrt(Id),
    /// The integer nearest to a, the even one of two.
    Round(Id),
    /// a · 2ᵏ, for whole k from −1022 to 1023, rounded once where the result is too small: the product with the number
    /// whose exponent field is that of k. Other k give other numbers, the same on every target.
    Scale(Id, Id),
    /// The exponent of a: ⌊log₂ |a|⌋; for numbers too small to have a leading 1, and 0, one less than that of the
    /// smallest with one (−1023), for infinities and what is no number one more than that of the largest (1024).
    Exponent(Id),
    /// c if a ≤ b, else d; d where a or b is not a number.
    Select(Id, Id, Id, Id),
}

impl Node {
    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = Id> + use<> {
        let list = match *self {
            Self::Zero | Self::Constant(_) | Self::Epsilon | Self::Input(_) | Self::Slot(_) => {
                [None; 4]
            }
            Self::Neg(a) | Self::Abs(a) | Self::Sqrt(a) | Self::Round(a) | Self::Exponent(a) => {
                [Some(a), None, None, None]
            }
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Scale(a, b) => [Some(a), Some(b), None, None],
            Self::TimesPlus(a, b, c) => [Some(a), Some(b), Some(c), None],
            Self::Select(a, b, c, d) => [Some(a), Some(b), Some(c), Some(d)],
        };
        list.into_iter().flatten()
    }

    /// True if it has operands. Inputs, coefficients and numbers are read where they are used.
    pub fn is_operation(&self) -> bool {
        self.operands().next().is_some()
    }

    /// Renames the operands by `rename`.
    pub(crate) fn map(self, rename: impl Fn(Id) -> Id) -> Self {
        match self {
            Self::Add(a, b) => Self::Add(rename(a), rename(b)),
            Self::Sub(a, b) => Self::Sub(rename(a), rename(b)),
            Self::Mul(a, b) => Self::Mul(rename(a), rename(b)),
            Self::Div(a, b) => Self::Div(rename(a), rename(b)),
            Self::TimesPlus(a, b, c) => Self::TimesPlus(rename(a), rename(b), rename(c)),
            Self::Neg(a) => Self::Neg(rename(a)),
            Self::Abs(a) => Self::Abs(rename(a)),
            Self::Sqrt(a) => Self::Sqrt(rename(a)),
            Self::Round(a) => Self::Round(rename(a)),
            Self::Scale(a, k) => Self::Scale(rename(a), rename(k)),
            Self::Exponent(a) => Self::Exponent(rename(a)),
            Self::Select(a, b, c, d) => Self::Select(rename(a), rename(b), rename(c), rename(d)),
            leaf @ (Self::Zero
            | Self::Constant(_)
            | Self::Epsilon
            | Self::Input(_)
            | Self::Slot(_)) => leaf,
        }
    }
}

/// The operations of a program, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Products, those inside a product-and-sum included.
    pub multiplications: usize,
    /// Sums and differences, those inside a product-and-sum included.
    pub additions: usize,
    /// Quotients and roots.
    pub divisions: usize,
}

impl Cost {
    /// All operations; comparisons, signs and absolute values count nothing.
    pub fn total(self) -> usize {
        self.multiplications + self.additions + self.divisions
    }

    /// The cost of these nodes.
    fn of(nodes: &[Node]) -> Self {
        let mut cost = Self::default();
        for node in nodes {
            match node {
                Node::Add(..) | Node::Sub(..) => cost.additions += 1,
                Node::Mul(..) | Node::Scale(..) => cost.multiplications += 1,
                Node::TimesPlus(..) => {
                    cost.additions += 1;
                    cost.multiplications += 1;
                }
                Node::Div(..) | Node::Sqrt(_) => cost.divisions += 1,
                _ => {}
            }
        }
        cost
    }
}

/// A straight-line program: numbers and folded coefficients in, numbers out, no branches and no loops.
///
/// It cannot be malformed: operands come before their users, and inputs are within their number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Program {
    inputs: usize,
    slots: usize,
    nodes: Vec<Node>,
    outputs: Vec<Id>,
    /// The nodes that are a function's value, and at which node.
    calls: Vec<(Id, Function, Id)>,
    rows: Vec<Rows>,
}

/// Nodes of a program that are another program's on several lists of inputs: a row for each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// The other program, whose slots are those of the whole.
    pub program: Program,
    /// The inputs of each row.
    pub inputs: Vec<Vec<Id>>,
    /// The results of each row, as far as they are nodes.
    pub outputs: Vec<Vec<Option<Id>>>,
}

impl Rows {
    fn ids(&self) -> impl Iterator<Item = Id> {
        let outputs = self.outputs.iter().flatten().copied().flatten();
        self.inputs.iter().flatten().copied().chain(outputs)
    }
}

impl Program {
    /// The number of inputs of the program.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// One more than the number of the last folded coefficient it reads; zero if none.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// All nodes; operands come before their users.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The nodes whose values are the results, in order.
    pub fn outputs(&self) -> &[Id] {
        &self.outputs
    }

    /// The nodes that are a function's value, as (value, function, argument), in order.
    pub fn calls(&self) -> &[(Id, Function, Id)] {
        &self.calls
    }

    /// The programs that parts of it are, on numbers side by side, in order.
    pub fn rows(&self) -> &[Rows] {
        &self.rows
    }

    /// This formula with the values of functions and roots left open: each is an input of its own, after those of this
    /// program. What holds for all values of these holds for this program; only what rests on a relation between such
    /// values (sin² + cos² = 1) is lost. No value vanishes by underflow, and none is outside of a domain.
    pub fn with_open_functions(&self) -> Self {
        let graph = Graph::new();
        let inputs: Vec<Id> = (0..self.inputs).map(|i| graph.input(i)).collect();
        let mut count = self.inputs;
        let mut ids: Vec<Id> = Vec::with_capacity(self.nodes.len());
        for (at, node) in self.nodes.iter().enumerate() {
            let node = node.map(|operand| ids[operand.index()]);
            let called = self.calls.binary_search_by_key(&at, |(value, ..)| value.index()).is_ok();
            ids.push(match node {
                _ if called || matches!(node, Node::Sqrt(_)) => {
                    count += 1;
                    graph.input(count - 1)
                }
                // Not a number where a logarithm is none, else 0.
                Node::Sub(a, b) if a == b => graph.zero(),
                node => graph.copied(node, &inputs, 0),
            });
        }
        let outputs: Vec<Id> = self.outputs.iter().map(|output| ids[output.index()]).collect();
        graph.finish(count, &outputs)
    }

    /// The number of nodes that are operations.
    pub fn operations(&self) -> usize {
        self.nodes.iter().filter(|node| node.is_operation()).count()
    }

    /// The part of each node where the program is cut into parts of about as many operations, at most `longest`; ascending.
    pub fn parts(&self, longest: usize) -> Vec<usize> {
        let operations = self.operations();
        let length = operations.div_ceil(operations.div_ceil(longest).max(1)).max(1);
        let mut seen: usize = 0;
        let part = |node: &Node| {
            seen += usize::from(node.is_operation());
            seen.saturating_sub(1) / length
        };
        self.nodes.iter().map(part).collect()
    }

    /// The cost of one evaluation.
    pub fn cost(&self) -> Cost {
        Cost::of(&self.nodes)
    }

    /// The number of uses of each node, as an operand or as a result.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        for node in &self.nodes {
            for operand in node.operands() {
                uses[operand.index()] += 1;
            }
        }
        for output in &self.outputs {
            uses[output.index()] += 1;
        }
        uses
    }
}

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// The exponential.
    Exp,
    /// The natural logarithm; of positive numbers.
    Ln,
    /// The sine, of an angle in radians up to 10⁸.
    Sin,
    /// The cosine, of an angle in radians up to 10⁸.
    Cos,
    /// The tangent, of an angle in radians up to 10⁸.
    Tan,
    /// The inverse of the tangent.
    Atan,
    /// The hyperbolic tangent.
    Tanh,
    /// a to the power m/n, for n from 1; of numbers from 0 where n is not 1.
    Power(i32, u32),
}
