//! The arena of nodes, hash-consed so that equal sub-expressions are one node.

use std::collections::HashMap;

/// A node of a [`Graph`], an index into its arena. Operands have smaller ids than their users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(u32);

impl Id {
    /// The index into [`Program::nodes`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One operation. Signs and numbers live in the slots, so nothing else is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// The number 0, the value of an empty polynomial.
    Zero,
    /// Input number i: a coordinate of p (or of μ′ in a predictor).
    Input(u32),
    /// Folded coefficient number i.
    Slot(u32),
    /// a + b
    Add(Id, Id),
    /// a · b
    Mul(Id, Id),
    /// a · b + c
    TimesPlus(Id, Id, Id),
}

/// How many operations a program takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Products, those inside a product-and-sum included.
    pub multiplications: usize,
    /// Sums, those inside a product-and-sum included.
    pub additions: usize,
}

impl Cost {
    /// All operations.
    #[must_use]
    pub fn total(self) -> usize {
        self.multiplications + self.additions
    }
}

/// A growing graph. Ids are handed out in order of creation, so output never depends on hashing.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    known: HashMap<Node, Id>,
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

    fn is_zero(&self, id: Id) -> bool {
        self.nodes[id.index()] == Node::Zero
    }

    /// The number 0.
    pub fn zero(&mut self) -> Id {
        self.intern(Node::Zero)
    }

    /// Input number `index`.
    pub fn input(&mut self, index: usize) -> Id {
        self.intern(Node::Input(index as u32))
    }

    /// Folded coefficient number `index`.
    pub fn slot(&mut self, index: usize) -> Id {
        self.intern(Node::Slot(index as u32))
    }

    /// a · b, in canonical operand order; the number 0 absorbs.
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        if self.is_zero(a) || self.is_zero(b) {
            return self.zero();
        }
        self.intern(Node::Mul(a.min(b), a.max(b)))
    }

    /// a + b; adding to the number 0 gives the other operand.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        match (self.nodes[a.index()], self.nodes[b.index()]) {
            (Node::Zero, _) => b,
            (_, Node::Zero) => a,
            _ => self.intern(Node::Add(a.min(b), a.max(b))),
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
        self.intern(Node::TimesPlus(a.min(b), a.max(b), c))
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
    }

    /// The operations of the nodes made after `mark`.
    #[must_use]
    pub fn cost_since(&self, mark: usize) -> Cost {
        cost(&self.nodes[mark..])
    }

    /// The program that computes `outputs`, nodes nothing needs left out.
    #[must_use]
    pub fn finish(self, inputs: usize, outputs: &[Id]) -> Program {
        let mut needed = vec![false; self.nodes.len()];
        for output in outputs {
            needed[output.index()] = true;
        }
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if needed[index] {
                for operand in operands(node) {
                    needed[operand.index()] = true;
                }
            }
        }
        let mut renamed = vec![Id(0); self.nodes.len()];
        let mut nodes = Vec::new();
        for (index, node) in self.nodes.iter().enumerate() {
            if needed[index] {
                renamed[index] = Id(nodes.len() as u32);
                nodes.push(match *node {
                    Node::Add(a, b) => Node::Add(renamed[a.index()], renamed[b.index()]),
                    Node::Mul(a, b) => Node::Mul(renamed[a.index()], renamed[b.index()]),
                    Node::TimesPlus(a, b, c) => {
                        Node::TimesPlus(renamed[a.index()], renamed[b.index()], renamed[c.index()])
                    }
                    leaf => leaf,
                });
            }
        }
        let outputs = outputs.iter().map(|output| renamed[output.index()]).collect();
        Program { inputs, nodes, outputs }
    }
}

/// The operands of a node, in order.
pub fn operands(node: &Node) -> impl Iterator<Item = Id> {
    let list = match *node {
        Node::Zero | Node::Input(_) | Node::Slot(_) => [None; 3],
        Node::Add(a, b) | Node::Mul(a, b) => [Some(a), Some(b), None],
        Node::TimesPlus(a, b, c) => [Some(a), Some(b), Some(c)],
    };
    list.into_iter().flatten()
}

fn cost(nodes: &[Node]) -> Cost {
    let mut cost = Cost::default();
    for node in nodes {
        match node {
            Node::Zero | Node::Input(_) | Node::Slot(_) => {}
            Node::Add(..) => cost.additions += 1,
            Node::Mul(..) => cost.multiplications += 1,
            Node::TimesPlus(..) => {
                cost.additions += 1;
                cost.multiplications += 1;
            }
        }
    }
    cost
}

/// A finished graph: nodes in an order of evaluation, and which of them are the results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    inputs: usize,
    nodes: Vec<Node>,
    outputs: Vec<Id>,
}

impl Program {
    /// How many inputs the program reads.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// All nodes; operands come before their users.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The nodes whose values are the results, in order.
    #[must_use]
    pub fn outputs(&self) -> &[Id] {
        &self.outputs
    }

    /// The operations one evaluation takes.
    #[must_use]
    pub fn cost(&self) -> Cost {
        cost(&self.nodes)
    }

    /// How often each node is used, as an operand or as a result.
    #[must_use]
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        for node in &self.nodes {
            for operand in operands(node) {
                uses[operand.index()] += 1;
            }
        }
        for output in &self.outputs {
            uses[output.index()] += 1;
        }
        uses
    }
}
