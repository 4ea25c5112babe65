//! A program as a function, one operation a line; a long one as several, since a compiler's time grows faster than the
//! length of a function.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::c::{Body, Dialect};
use crate::graph::{Node, Program};
use crate::print::c::Signature;

/// The function of a signature; [`body`] says what `longest` means.
pub fn function(dialect: &impl Dialect, signature: &Signature<'_>, longest: usize) -> String {
    dialect.function(signature, &body(dialect, signature, longest))
}

/// The text of a signature's program, where it has more than `longest` operations as pieces. What a piece leaves for later
/// ones and for the outputs is in an array `w`.
pub fn body(dialect: &impl Dialect, signature: &Signature<'_>, longest: usize) -> Body {
    let program = signature.program;
    let nodes = program.nodes();
    let count = program.operations().div_ceil(longest).max(1);
    let mut writer = Writer { dialect, signature, names: Vec::with_capacity(nodes.len()) };
    let mut result = Body::default();
    if count == 1 {
        writer.statements(nodes.len(), &mut result.statements);
    } else {
        let piece = program.parts(longest);
        let (places, size) = places(program, &piece, count);
        for number in 0..count {
            let mut text = String::new();
            let first = writer.names.len();
            let end = piece.partition_point(|&own| own <= number);
            writer.statements(end, &mut text);
            for (node, place) in places.range(first..end) {
                let place = dialect.shared(*place);
                text.push_str(&format!("    {place} = {};\n", writer.names[*node]));
                writer.names[*node] = place;
            }
            result.pieces.push_str(&dialect.piece(signature, number, size, &text));
        }
        result.statements = dialect.calls(signature, count, size);
    }
    let read = |id: &crate::Id| writer.names[id.index()].clone();
    result.outputs = program.outputs().iter().map(read).collect();
    result
}

/// Writes nodes. Inputs, coefficients and numbers stand where they are used.
struct Writer<'a, D> {
    dialect: &'a D,
    signature: &'a Signature<'a>,
    /// For each node written so far, the text that reads it.
    names: Vec<String>,
}

impl<D: Dialect> Writer<'_, D> {
    /// A line for each operation up to this node.
    fn statements(&mut self, end: usize, text: &mut String) {
        for at in self.names.len()..end {
            let node = self.signature.program.nodes()[at];
            let name = self.leaf(node).unwrap_or_else(|| {
                let operands: Vec<&str> =
                    node.operands().map(|id| self.names[id.index()].as_str()).collect();
                let name = self.dialect.bound(&format!("t{at}"));
                let value = self.dialect.operation(node, &operands);
                text.push_str(&self.dialect.declare(&name, &value));
                name
            });
            self.names.push(name);
        }
    }

    /// The text of a node without operands; `None` for an operation.
    fn leaf(&self, node: Node) -> Option<String> {
        let dialect = self.dialect;
        match node {
            Node::Zero => Some(dialect.constant(0.0)),
            Node::Constant(bits) => Some(dialect.constant(f64::from_bits(bits))),
            Node::Epsilon => Some(dialect.epsilon()),
            Node::Slot(index) => Some(dialect.slot(index as usize)),
            Node::Input(index) => {
                let found = Signature::find(&self.signature.inputs, index as usize);
                let place = found.map(|(field, at)| field.place(at, |name| name.into()));
                Some(place.unwrap_or_else(|| dialect.constant(0.0)))
            }
            _ => None,
        }
    }
}

/// For each operation that a later piece or an output reads its place in `w`, and the length of `w`. A place is free again
/// in the piece after the last that reads it.
fn places(program: &Program, piece: &[usize], count: usize) -> (BTreeMap<usize, usize>, usize) {
    let nodes = program.nodes();
    let mut last = piece.to_vec();
    for (at, node) in nodes.iter().enumerate() {
        for operand in node.operands() {
            last[operand.index()] = last[operand.index()].max(piece[at]);
        }
    }
    for output in program.outputs() {
        last[output.index()] = count;
    }
    let mut places = BTreeMap::new();
    let mut ends: Vec<Vec<usize>> = vec![Vec::new(); count + 1];
    let mut free: Vec<usize> = Vec::new();
    let mut size = 0;
    let mut current = 0;
    for (at, node) in nodes.iter().enumerate() {
        while current < piece[at] {
            free.append(&mut ends[current]);
            current += 1;
        }
        if node.is_operation() && last[at] > piece[at] {
            let place = free.pop().unwrap_or_else(|| {
                size += 1;
                size - 1
            });
            places.insert(at, place);
            ends[last[at]].push(place);
        }
    }
    (places, size)
}
