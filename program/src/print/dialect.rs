//! How a language writes what a program consists of.

use alloc::string::String;

use super::signature::Signature;
use crate::node::Node;

/// How one language writes numbers, operations and functions.
///
/// Every operation is rounded once; a dialect whose compiler might contract or reorder operations has to forbid it.
pub trait Dialect {
    /// The head of a function up to its opening brace and the end of the line. It gives the inputs and outputs of the
    /// signature and the folded coefficients.
    fn head(&self, signature: &Signature<'_>) -> String;

    /// The end of a function, closing brace and end of the line included.
    fn tail(&self) -> String {
        String::from("}\n")
    }

    /// A statement, with indentation and end of the line, that declares `name` as the value of `expression`.
    fn declare(&self, name: &str, expression: &str) -> String;

    /// A statement, with indentation and end of the line, that writes `value` to an output. `place` is `name[index]` in
    /// an array, else what [`Dialect::single`] makes of its name.
    fn store(&self, place: &str, value: &str) -> String;

    /// A single number among the outputs, as it is written to.
    fn single(&self, name: &str) -> String;

    /// A number of the program. It stands alone or as an operand: a negative one has to be in parentheses.
    fn constant(&self, value: f64) -> String;

    /// The rounding unit of the numbers: the distance from 1 to the next larger one.
    fn epsilon(&self) -> String {
        self.constant(f64::EPSILON)
    }

    /// Folded coefficient number `index`.
    fn slot(&self, index: usize) -> String;

    /// An operation on operands as they are written, as many as `node` has. Leaves are never asked for.
    fn operation(&self, node: Node, operands: &[&str]) -> String;
}
