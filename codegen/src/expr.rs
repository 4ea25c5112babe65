//! Expressions, in two forms: as the user wrote them (an arena, with places), and those in
//! parameters only that become opaque coefficients ([`ParameterExpr`]).

use crate::diagnostic::Span;
use crate::number::Rational;

pub use coadjoint_symbolic::expr::{Function, ParameterExpr};

/// The identity of a node in its [`Arena`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ExprId(u32);

impl ExprId {
    /// The index of the node in its arena; its operands have smaller ones.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A number, a variable, or an operation on earlier nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    Number(Rational),
    Coordinate(usize),
    /// A scalar parameter, by its index among all parameters flattened.
    Parameter(usize),
    Time,
    /// An input, a function of the time.
    Signal(usize),
    Neg(ExprId),
    Add(ExprId, ExprId),
    Sub(ExprId, ExprId),
    Mul(ExprId, ExprId),
    Div(ExprId, ExprId),
    Pow(ExprId, ExprId),
    Call(Function, ExprId),
    /// Stands for input that was wrong and has been reported, so that nothing is reported twice.
    Wrong,
}

impl Node {
    /// The operands of the node: two, one, or none.
    pub(crate) fn operands(&self) -> [Option<ExprId>; 2] {
        match *self {
            Self::Number(_)
            | Self::Coordinate(_)
            | Self::Parameter(_)
            | Self::Time
            | Self::Signal(_)
            | Self::Wrong => [None, None],
            Self::Neg(a) | Self::Call(_, a) => [Some(a), None],
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Pow(a, b) => [Some(a), Some(b)],
        }
    }
}

/// An expression as a list of nodes in the order they were read, operands before what uses them.
///
/// An arena instead of a tree: passes are loops, so deep nesting costs no stack, and a `let` that
/// is used twice is one node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arena {
    nodes: Vec<(Node, Span)>,
}

impl Arena {
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Adds a node that was read at `span`.
    pub(crate) fn push(&mut self, node: Node, span: Span) -> ExprId {
        // Inputs are far smaller than 2³² operations; the loops of the front ends are limited.
        let id = ExprId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push((node, span));
        id
    }

    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The place in the input where the node was read.
    pub(crate) fn span(&self, id: ExprId) -> Span {
        self.nodes[id.index()].1
    }

    /// For each node, the number of its uses in these expressions.
    pub(crate) fn uses(&self, roots: &[ExprId]) -> Vec<u32> {
        let mut uses = vec![0_u32; self.len()];
        roots.iter().for_each(|root| uses[root.index()] += 1);
        for at in (0..self.len()).rev() {
            if uses[at] > 0 {
                let operands = self.nodes[at].0.operands();
                operands.into_iter().flatten().for_each(|operand| uses[operand.index()] += 1);
            }
        }
        uses
    }

    /// The nodes in their order, with identity and place.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (ExprId, &Node, Span)> {
        self.nodes.iter().enumerate().map(|(i, (node, span))| (ExprId(i as u32), node, *span))
    }
}
