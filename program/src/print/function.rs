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
    let mut count = 0;
    for node in program.nodes() {
        let name = match *node {
            Node::Zero => dialect.constant(0.0),
            Node::Constant(bits) => dialect.constant(f64::from_bits(bits)),
            Node::Slot(index) => dialect.slot(index as usize),
            Node::Input(index) => match Signature::find(&signature.inputs, index as usize) {
                Some((field, at)) => field.place(at, |name| name.into()),
                None => dialect.constant(0.0),
            },
            operation => {
                let operands: Vec<&str> =
                    operation.operands().map(|id| names[id.index()].as_str()).collect();
                let expression = dialect.operation(operation, &operands);
                let name = format!("t{count}");
                count += 1;
                text.push_str(&dialect.declare(&name, &expression));
                name
            }
        };
        names.push(name);
    }
    for (number, id) in program.outputs().iter().enumerate() {
        if let Some((field, at)) = Signature::find(&signature.outputs, number) {
            let place = field.place(at, |name| dialect.single(name));
            text.push_str(&dialect.store(&place, &names[id.index()]));
        }
    }
}
