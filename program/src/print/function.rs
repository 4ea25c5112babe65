//! A program as a function, one operation a line; a long one as several, since a compiler's time grows faster than the
//! length of a function.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::c::Dialect;
use crate::graph::Node;
use crate::print::c::Signature;

/// The function of a signature, where it has more than `longest` operations as pieces that it calls. What a piece leaves
/// for later ones is in an array `w`.
pub fn function(dialect: &impl Dialect, signature: &Signature<'_>, longest: usize) -> String {
    let nodes = signature.program.nodes();
    let count = signature.program.operations().div_ceil(longest).max(1);
    let mut body = Body { dialect, signature, names: Vec::with_capacity(nodes.len()) };
    if count == 1 {
        let mut text = dialect.c().head(signature);
        body.statements(nodes.len(), &mut text);
        body.outputs(|_| true, &mut text);
        return text + "}\n";
    }
    let piece = signature.program.parts(longest);
    let (places, size) = places(nodes, &piece, count);
    let (parameters, arguments) = dialect.c().workspace(signature);
    let (mut text, mut calls) = (String::new(), String::new());
    for number in 0..count {
        let name = format!("{}_{number}", signature.name);
        text.push_str(&format!("{} {name}({parameters})\n{{\n", dialect.c().head));
        // Which of them a piece reads is the compiler's business.
        for argument in arguments.split(", ") {
            text.push_str(&format!("    (void){argument};\n"));
        }
        let first = body.names.len();
        let end = piece.partition_point(|&own| own <= number);
        for next in first..end {
            body.statements(next + 1, &mut text);
            if let Some(place) = places.get(&next) {
                text.push_str(&format!("    w[{place}] = {};\n", body.names[next]));
            }
        }
        body.outputs(|node| piece[node] == number, &mut text);
        for (node, place) in places.range(first..end) {
            body.names[*node] = format!("w[{place}]");
        }
        text.push_str("}\n\n");
        calls.push_str(&format!("    {name}({arguments});\n"));
    }
    text.push_str(&dialect.c().head(signature));
    text.push_str(&format!("    {} w[{}];\n{calls}}}\n", dialect.c().number, size.max(1)));
    text
}

/// The statements of a function. Inputs, coefficients and numbers stand where they are used.
struct Body<'a, D> {
    dialect: &'a D,
    signature: &'a Signature<'a>,
    /// For each node written so far, the text that reads it.
    names: Vec<String>,
}

impl<D: Dialect> Body<'_, D> {
    /// A line for each operation up to this node.
    fn statements(&mut self, end: usize, text: &mut String) {
        for at in self.names.len()..end {
            let node = self.signature.program.nodes()[at];
            let name = self.leaf(node).unwrap_or_else(|| {
                let operands: Vec<&str> =
                    node.operands().map(|id| self.names[id.index()].as_str()).collect();
                let name = format!("t{at}");
                let value = self.dialect.operation(node, &operands);
                text.push_str(&self.dialect.c().declare(&name, &value));
                name
            });
            self.names.push(name);
        }
    }

    /// A line for each output whose node `of` wants.
    fn outputs(&self, of: impl Fn(usize) -> bool, text: &mut String) {
        for (number, id) in self.signature.program.outputs().iter().enumerate() {
            let found = Signature::find(&self.signature.outputs, number);
            if let Some((field, at)) = found.filter(|_| of(id.index())) {
                let place = field.place(at, |name| format!("*{name}"));
                text.push_str(&format!("    {place} = {};\n", self.names[id.index()]));
            }
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

/// For each operation that a later piece reads its place in `w`, and the length of `w`. A place is free again in the
/// piece after the last that reads it.
fn places(nodes: &[Node], piece: &[usize], count: usize) -> (BTreeMap<usize, usize>, usize) {
    let mut last = piece.to_vec();
    for (at, node) in nodes.iter().enumerate() {
        for operand in node.operands() {
            last[operand.index()] = last[operand.index()].max(piece[at]);
        }
    }
    let mut places = BTreeMap::new();
    let mut ends: Vec<Vec<usize>> = vec![Vec::new(); count];
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
