//! Long programs as several functions: a compiler's time grows faster than the length of a function.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::c::C;
use super::dialect::Dialect;
use super::function::{function, leaf, output};
use super::signature::Signature;

/// The function of a signature in a dialect based on `c`, as pieces of a limited number of operations and a function that
/// calls them. What a piece leaves for later ones is in an array `w`.
#[must_use]
pub fn pieces(dialect: &impl Dialect, c: &C, signature: &Signature<'_>, longest: usize) -> String {
    let nodes = signature.program.nodes();
    let operations = nodes.iter().filter(|node| node.operands().next().is_some()).count();
    if operations <= longest {
        return function(dialect, signature);
    }
    let count = operations.div_ceil(longest);
    let longest = operations.div_ceil(count);
    let piece = pieces_of_nodes(signature, longest);
    let (places, size) = places(signature, &piece, count);
    let mut text = String::new();
    let mut calls = String::new();
    let mut names: Vec<String> = vec![String::new(); nodes.len()];
    let (parameters, arguments) = c.workspace(signature);
    let mut next = 0;
    for number in 0..count {
        let name = format!("{}_{number}", signature.name);
        text.push_str(&format!("{} {name}({parameters})\n{{\n", c.head));
        // Which of them a piece reads is the compiler's business.
        for argument in arguments.split(", ") {
            text.push_str(&format!("    (void){argument};\n"));
        }
        let mut passed = Vec::new();
        while next < nodes.len() && piece[next] == number {
            let node = nodes[next];
            names[next] = leaf(dialect, signature, node).unwrap_or_else(|| {
                let operands: Vec<&str> =
                    node.operands().map(|id| names[id.index()].as_str()).collect();
                let name = format!("t{next}");
                text.push_str(&dialect.declare(&name, &dialect.operation(node, &operands)));
                name
            });
            if let Some(place) = places.get(&next) {
                passed.push((next, *place));
                text.push_str(&dialect.store(&format!("w[{place}]"), &names[next]));
            }
            next += 1;
        }
        for (result, id) in signature.program.outputs().iter().enumerate() {
            if piece[id.index()] == number {
                output(dialect, signature, result, &names[id.index()], &mut text);
            }
        }
        for (node, place) in passed {
            names[node] = format!("w[{place}]");
        }
        text.push_str("}\n\n");
        calls.push_str(&format!("    {name}({arguments});\n"));
    }
    text.push_str(&dialect.head(signature));
    text.push_str(&format!("    {} w[{}];\n{calls}", c.number, size.max(1)));
    text.push_str(&dialect.tail());
    text
}

/// The number of the piece that each node is in.
fn pieces_of_nodes(signature: &Signature<'_>, longest: usize) -> Vec<usize> {
    let mut operations = 0;
    let nodes = signature.program.nodes().iter();
    nodes
        .map(|node| {
            let operation = node.operands().next().is_some();
            let piece = if operation {
                operations / longest
            } else {
                operations.saturating_sub(1) / longest
            };
            operations += usize::from(operation);
            piece
        })
        .collect()
}

/// For each operation that a later piece reads its place in `w`, and the length of `w`. A place is free again in the
/// piece after the last that reads it.
fn places(
    signature: &Signature<'_>,
    piece: &[usize],
    count: usize,
) -> (BTreeMap<usize, usize>, usize) {
    let nodes = signature.program.nodes();
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
        if node.operands().next().is_some() && last[at] > piece[at] {
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
