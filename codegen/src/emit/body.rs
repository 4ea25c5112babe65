//! Programs as straight-line Rust.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::graph::{Id, Node, Program};

/// Expressions nest at most this deep before an intermediate gets a name.
const DEPTH: usize = 6;

/// The statements of a program, and the expressions of its outputs.
///
/// Inputs are read as `input[i]`, slots as `c[i]`; what is used more than once gets a name.
pub struct Body {
    /// `let` statements, in order.
    pub statements: TokenStream,
    /// One expression per output.
    pub outputs: Vec<TokenStream>,
}

/// Writes `program` down.
#[must_use]
pub fn body(program: &Program) -> Body {
    let uses = program.uses();
    let mut statements = TokenStream::new();
    let mut written: Vec<Written> = Vec::with_capacity(program.nodes().len());
    for (index, node) in program.nodes().iter().enumerate() {
        let mut expression = write(node, &written);
        let is_input = matches!(node, Node::Input(_));
        let shared = uses[index] > 1 && !matches!(node, Node::Zero | Node::Slot(_));
        if is_input || shared || expression.depth >= DEPTH {
            let name = match node {
                Node::Input(i) => format_ident!("p{i}"),
                _ => format_ident!("t{index}"),
            };
            let value = &expression.tokens;
            statements.extend(quote!(let #name = #value;));
            expression = Written { tokens: quote!(#name), depth: 0, atomic: true };
        }
        written.push(expression);
    }
    let outputs = program.outputs().iter().map(|id| written[id.index()].tokens.clone()).collect();
    Body { statements, outputs }
}

struct Written {
    tokens: TokenStream,
    depth: usize,
    /// Whether the tokens can stand before a method call or an operator without parentheses.
    atomic: bool,
}

fn write(node: &Node, written: &[Written]) -> Written {
    let get = |id: Id| &written[id.index()];
    let depth = |ids: &[Id]| 1 + ids.iter().map(|&id| get(id).depth).max().unwrap_or(0);
    let operand = |id: Id| {
        let Written { tokens, atomic, .. } = get(id);
        if *atomic { quote!(#tokens) } else { quote!((#tokens)) }
    };
    match *node {
        Node::Zero => Written { tokens: quote!(T::of(0.0)), depth: 0, atomic: true },
        Node::Input(i) => {
            let i = Literal::u32_unsuffixed(i);
            Written { tokens: quote!(input[#i]), depth: 0, atomic: true }
        }
        Node::Slot(i) => {
            let i = Literal::u32_unsuffixed(i);
            Written { tokens: quote!(c[#i]), depth: 0, atomic: true }
        }
        Node::Add(a, b) => {
            let (x, y) = (operand(a), operand(b));
            Written { tokens: quote!(#x + #y), depth: depth(&[a, b]), atomic: false }
        }
        Node::Mul(a, b) => {
            let (x, y) = (operand(a), operand(b));
            Written { tokens: quote!(#x * #y), depth: depth(&[a, b]), atomic: false }
        }
        Node::TimesPlus(a, b, c) => {
            let (x, y, z) = (operand(a), &get(b).tokens, &get(c).tokens);
            Written {
                tokens: quote!(#x.times_plus(#y, #z)),
                depth: depth(&[a, b, c]),
                atomic: true,
            }
        }
    }
}
