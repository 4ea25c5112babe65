//! Functions that are expressions of others: `sinh`, `atan2`, `min` and the like.

use super::sum::pi;
use crate::diagnostic::Span;
use crate::expr::{Arena, ExprId, Function, Node};
use crate::number::{Rational, integer};

/// A function of one or two numbers that is made of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Composite {
    Sinh,
    Cosh,
    Asin,
    Acos,
    Atan2,
    Min,
    Max,
}

impl Composite {
    /// Every function.
    pub(super) const ALL: [Self; 7] =
        [Self::Sinh, Self::Cosh, Self::Asin, Self::Acos, Self::Atan2, Self::Min, Self::Max];

    /// Its name in a text.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan2 => "atan2",
            Self::Min => "min",
            Self::Max => "max",
        }
    }

    /// The function of this name.
    pub(super) fn lookup(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == name)
    }

    /// The number of its arguments.
    pub(super) fn arguments(self) -> usize {
        match self {
            Self::Sinh | Self::Cosh | Self::Asin | Self::Acos => 1,
            Self::Atan2 | Self::Min | Self::Max => 2,
        }
    }

    /// Its value at these arguments, in the place of the call.
    pub(super) fn build(
        self,
        arena: &mut Arena,
        arguments: &[ExprId],
        place: Span,
    ) -> Option<ExprId> {
        let mut write = Inserter { arena, place };
        Some(match (self, arguments) {
            (Self::Sinh | Self::Cosh, &[a]) => {
                let minus = write.push(Node::Neg(a));
                let [up, down] = [a, minus].map(|a| write.push(Node::Call(Function::Exp, a)));
                let sum = write.push(match self {
                    Self::Sinh => Node::Sub(up, down),
                    _ => Node::Add(up, down),
                });
                write.half(sum)
            }
            (Self::Asin, &[a]) => write.arcsine(a),
            (Self::Acos, &[a]) => {
                let (right, arcsine) = (write.number(pi() / integer(2)), write.arcsine(a));
                write.push(Node::Sub(right, arcsine))
            }
            // 2 atan(y/(r + x)), which jumps at y = 0, x < 0.
            (Self::Atan2, &[y, x]) => {
                let two = write.number(integer(2));
                let squares = [y, x].map(|a| write.push(Node::Pow(a, two)));
                let sum = write.push(Node::Add(squares[0], squares[1]));
                let length = write.push(Node::Call(Function::Sqrt, sum));
                let beside = write.push(Node::Add(length, x));
                let ratio = write.push(Node::Div(y, beside));
                let half = write.push(Node::Call(Function::Atan, ratio));
                write.push(Node::Mul(two, half))
            }
            // a (1 + s)/2 + b (1 − s)/2 with the sign s of b − a, or of a − b: one of both to the last digit.
            (Self::Min | Self::Max, &[a, b]) => {
                let apart = write.push(match self {
                    Self::Min => Node::Sub(b, a),
                    _ => Node::Sub(a, b),
                });
                let (sign, one) =
                    (write.push(Node::Call(Function::Sign, apart)), write.number(integer(1)));
                let shares = [Node::Add(one, sign), Node::Sub(one, sign)].map(|node| {
                    let share = write.push(node);
                    write.half(share)
                });
                let parts = [(a, shares[0]), (b, shares[1])]
                    .map(|(value, share)| write.push(Node::Mul(value, share)));
                write.push(Node::Add(parts[0], parts[1]))
            }
            _ => return None,
        })
    }
}

/// Writes nodes in one place.
struct Inserter<'a> {
    arena: &'a mut Arena,
    place: Span,
}

impl Inserter<'_> {
    fn push(&mut self, node: Node) -> ExprId {
        self.arena.push(node, self.place)
    }

    fn number(&mut self, value: Rational) -> ExprId {
        self.push(Node::Number(value))
    }

    fn half(&mut self, a: ExprId) -> ExprId {
        let two = self.number(integer(2));
        self.push(Node::Div(a, two))
    }

    /// atan(a/√((1 − a)(1 + a)))
    fn arcsine(&mut self, a: ExprId) -> ExprId {
        let one = self.number(integer(1));
        let factors = [Node::Sub(one, a), Node::Add(one, a)].map(|node| self.push(node));
        let product = self.push(Node::Mul(factors[0], factors[1]));
        let root = self.push(Node::Call(Function::Sqrt, product));
        let ratio = self.push(Node::Div(a, root));
        self.push(Node::Call(Function::Atan, ratio))
    }
}
