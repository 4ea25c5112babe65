//! Programs as straight-line Rust.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::parts::{Scope, parts};
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

/// Writes `program` down, in several functions where it is large.
#[must_use]
pub fn body(program: &Program, scope: &Scope) -> Body {
    if let Some(body) = parts(program, scope) {
        return body;
    }
    let mut writer = Writer::new(program, scope.lifted);
    for index in 0..program.nodes().len() {
        writer.write(index);
    }
    let outputs = program.outputs().iter().map(|&id| writer.value(id)).collect();
    Body { statements: writer.take_statements(), outputs }
}

/// Turns the nodes of a program into statements, one after the other.
pub(super) struct Writer<'a> {
    program: &'a Program,
    lifted: bool,
    uses: Vec<usize>,
    written: Vec<Written>,
    statements: TokenStream,
}

impl<'a> Writer<'a> {
    /// A writer that has written nothing; it lifts slots if so told.
    pub fn new(program: &'a Program, lifted: bool) -> Self {
        let nothing = Written { tokens: TokenStream::new(), depth: 0, atomic: true };
        let written = vec![nothing; program.nodes().len()];
        Self { program, lifted, uses: program.uses(), written, statements: TokenStream::new() }
    }

    /// Writes a node whose operands are written.
    pub fn write(&mut self, index: usize) {
        let node = &self.program.nodes()[index];
        self.written[index] = write(node, self.lifted, &self.written);
        let is_input = matches!(node, Node::Input(_));
        let shared = self.uses[index] > 1 && !matches!(node, Node::Zero | Node::Slot(_));
        if is_input || shared || self.written[index].depth >= DEPTH {
            let name = match node {
                Node::Input(i) => format_ident!("p{i}"),
                _ => format_ident!("t{index}"),
            };
            let value = &self.written[index].tokens;
            self.statements.extend(quote!(let #name = #value;));
            self.read_as(index, quote!(#name));
        }
    }

    /// From here on the node is read as `tokens`, a name or a place.
    pub fn read_as(&mut self, index: usize, tokens: TokenStream) {
        self.written[index] = Written { tokens, depth: 0, atomic: true };
    }

    /// Stores the value of a written node in a place.
    pub fn store(&mut self, index: usize, place: &TokenStream) {
        let value = &self.written[index].tokens;
        self.statements.extend(quote!(#place = #value;));
    }

    /// The expression of a written node.
    pub fn value(&self, id: Id) -> TokenStream {
        self.written[id.index()].tokens.clone()
    }

    /// The statements since the last call.
    pub fn take_statements(&mut self) -> TokenStream {
        std::mem::take(&mut self.statements)
    }
}

#[derive(Clone)]
struct Written {
    tokens: TokenStream,
    depth: usize,
    /// Whether the tokens can stand before a method call or an operator without parentheses.
    atomic: bool,
}

fn write(node: &Node, lifted: bool, written: &[Written]) -> Written {
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
            let tokens = if lifted { quote!(T::lift(c[#i])) } else { quote!(c[#i]) };
            Written { tokens, depth: 0, atomic: true }
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
