//! A program as a function, one operation a line.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::dialect::Dialect;
use super::signature::Signature;
use crate::node::Node;

/// The function of a signature.
#[must_use]
pub fn function(dialect: &impl Dialect, signature: &Signature<'_>) -> String {
    let mut text = dialect.head(signature);
    statements(dialect, signature, &mut text);
    text.push_str(&dialect.tail());
    text
}

/// The statements of the function's body: a line for each operation, then one for each output. Inputs, coefficients and
/// numbers stand where they are used.
pub fn statements(dialect: &impl Dialect, signature: &Signature<'_>, text: &mut String) {
    let program = signature.program;
    let mut names: Vec<String> = Vec::with_capacity(program.nodes().len());
    for (at, node) in program.nodes().iter().enumerate() {
        let name = leaf(dialect, signature, *node).unwrap_or_else(|| {
            let operands: Vec<&str> =
                node.operands().map(|id| names[id.index()].as_str()).collect();
            let name = format!("t{at}");
            text.push_str(&dialect.declare(&name, &dialect.operation(*node, &operands)));
            name
        });
        names.push(name);
    }
    for (number, id) in program.outputs().iter().enumerate() {
        output(dialect, signature, number, &names[id.index()], text);
    }
}

/// How a node without operands is written; `None` for an operation.
pub(super) fn leaf(
    dialect: &impl Dialect,
    signature: &Signature<'_>,
    node: Node,
) -> Option<String> {
    match node {
        Node::Zero => Some(dialect.constant(0.0)),
        Node::Constant(bits) => Some(dialect.constant(f64::from_bits(bits))),
        Node::Epsilon => Some(dialect.epsilon()),
        Node::Slot(index) => Some(dialect.slot(index as usize)),
        Node::Input(index) => match Signature::find(&signature.inputs, index as usize) {
            Some((field, at)) => Some(field.place(at, |name| name.into())),
            None => Some(dialect.constant(0.0)),
        },
        _ => None,
    }
}

/// The statement that writes an output.
pub(super) fn output(
    dialect: &impl Dialect,
    signature: &Signature<'_>,
    number: usize,
    value: &str,
    text: &mut String,
) {
    if let Some((field, at)) = Signature::find(&signature.outputs, number) {
        let place = field.place(at, |name| dialect.single(name));
        text.push_str(&dialect.store(&place, value));
    }
}
