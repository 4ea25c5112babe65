//! The dialect of C with vectors of the machine's full width, as GCC and Clang have them.

use alloc::format;
use alloc::string::String;

use super::c::{C, Dialect};
use crate::graph::Node;

/// C on numbers of the type `V`, a GNU vector, which `native.c.in` defines; coefficients are spread over the lanes where they are used.
pub(super) struct Vectors(pub C);

impl Dialect for Vectors {
    fn c(&self) -> &C {
        &self.0
    }

    fn constant(&self, value: f64) -> String {
        format!("spread({})", self.0.literal(value))
    }

    fn slot(&self, index: usize) -> String {
        format!("spread(c[{index}])")
    }

    fn operation(&self, node: Node, operands: &[&str]) -> String {
        match (node, operands) {
            (Node::Select(..), [a, b, c, d]) => format!("pick((M)({a} <= {b}), {c}, {d})"),
            _ => self.0.operation(node, operands),
        }
    }
}
