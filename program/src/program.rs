//! A finished program: nodes in an order of evaluation, and which of them are the results.

use alloc::vec;
use alloc::vec::Vec;

use crate::elementary::Function;
use crate::error::ProgramError;
use crate::node::{Cost, Id, Node};

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
}

impl Program {
    /// A program of these nodes.
    ///
    /// # Errors
    /// [`ProgramError`] where an operand does not come before its user, an output is no node, or an input is not below
    /// `inputs`.
    pub fn new(inputs: usize, nodes: Vec<Node>, outputs: Vec<u32>) -> Result<Self, ProgramError> {
        for (at, node) in nodes.iter().enumerate() {
            if node.operands().any(|operand| operand.index() >= at) {
                return Err(ProgramError::Order { node: at });
            }
            match *node {
                Node::Input(i) if i as usize >= inputs => {
                    return Err(ProgramError::Input { node: at, inputs });
                }
                _ => {}
            }
        }
        if let Some(output) = outputs.iter().position(|&id| id as usize >= nodes.len()) {
            return Err(ProgramError::Output { output });
        }
        Ok(Self::of_graph(inputs, nodes, outputs.into_iter().map(Id).collect(), Vec::new()))
    }

    /// The program of a graph, whose nodes are in order.
    pub(crate) fn of_graph(
        inputs: usize,
        nodes: Vec<Node>,
        outputs: Vec<Id>,
        calls: Vec<(Id, Function, Id)>,
    ) -> Self {
        let slot = |node: &Node| match node {
            Node::Slot(i) => *i as usize + 1,
            _ => 0,
        };
        let slots = nodes.iter().map(slot).max().unwrap_or(0);
        Self { inputs, slots, nodes, outputs, calls }
    }

    /// How many inputs the program reads.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// One more than the number of the last folded coefficient it reads; zero if none.
    #[must_use]
    pub fn slots(&self) -> usize {
        self.slots
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

    /// The nodes that are a function's value, as (value, function, argument), in order.
    #[must_use]
    pub fn calls(&self) -> &[(Id, Function, Id)] {
        &self.calls
    }

    /// The operations one evaluation takes.
    #[must_use]
    pub fn cost(&self) -> Cost {
        Cost::of(&self.nodes)
    }

    /// How often each node is used, as an operand or as a result.
    #[must_use]
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
