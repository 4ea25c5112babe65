//! Nodes as statements, one operation each.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::scope::Scope;
use crate::graph::{Id, Node, Program};

/// The statements of a program, and the expressions of its outputs.
///
/// Inputs are read as `input[i]`, slots as `c[i]`.
pub struct Body {
    /// `let` statements, in order.
    pub statements: TokenStream,
    /// One expression per output.
    pub outputs: Vec<TokenStream>,
}

/// Turns the nodes of a program into statements, one after the other.
pub struct Writer<'a> {
    program: &'a Program,
    scope: &'a Scope,
    /// For each node how it is read.
    read: Vec<TokenStream>,
    /// For each node what it is, where it is an output.
    about: Vec<Vec<String>>,
    operations: usize,
    statements: TokenStream,
}

impl<'a> Writer<'a> {
    /// A writer that has written nothing.
    #[must_use]
    pub fn new(program: &'a Program, scope: &'a Scope) -> Self {
        let count = program.nodes().len();
        let mut about = vec![Vec::new(); count];
        for (i, output) in program.outputs().iter().enumerate() {
            about[output.index()].extend(scope.meaning.output(i, scope.dim));
        }
        let read = vec![TokenStream::new(); count];
        Self { program, scope, read, about, operations: 0, statements: TokenStream::new() }
    }

    /// Writes a node whose operands are written: an input or an operation as a `let` statement; slots
    /// are read in place.
    pub fn write(&mut self, index: usize) {
        let node = &self.program.nodes()[index];
        let operand = |id: Id| &self.read[id.index()];
        let (name, value) = match *node {
            Node::Zero => {
                self.read[index] = quote!(T::of(0.0));
                return;
            }
            Node::Constant(bits) => {
                let value = Literal::f64_unsuffixed(f64::from_bits(bits));
                self.read[index] = quote!(T::of(#value));
                return;
            }
            Node::Slot(i) => {
                let i = Literal::u32_unsuffixed(i);
                let lifted = self.scope.lifted;
                self.read[index] = if lifted { quote!(T::lift(c[#i])) } else { quote!(c[#i]) };
                return;
            }
            Node::Input(i) => {
                let name = self.scope.meaning.input(i as usize, self.scope.dim);
                let i = Literal::u32_unsuffixed(i);
                (format_ident!("{name}"), quote!(input[#i]))
            }
            Node::Add(a, b) => {
                let (x, y) = (operand(a), operand(b));
                (self.next_name(), quote!(#x + #y))
            }
            Node::Mul(a, b) => {
                let (x, y) = (operand(a), operand(b));
                (self.next_name(), quote!(#x * #y))
            }
            Node::TimesPlus(a, b, c) => {
                let (x, y, z) = (operand(a), operand(b), operand(c));
                (self.next_name(), quote!(#x.times_plus(#y, #z)))
            }
            Node::Sub(a, b) => {
                let (x, y) = (operand(a), operand(b));
                (self.next_name(), quote!(#x - #y))
            }
            Node::Div(a, b) => {
                let (x, y) = (operand(a), operand(b));
                (self.next_name(), quote!(#x / #y))
            }
            Node::Neg(a) => {
                let x = operand(a);
                (self.next_name(), quote!(-#x))
            }
            Node::Abs(a) => {
                let x = operand(a);
                (self.next_name(), quote!(#x.simd_abs()))
            }
            Node::Sqrt(a) => {
                let x = operand(a);
                (self.next_name(), quote!(#x.simd_sqrt()))
            }
            Node::Round(a) => {
                let x = operand(a);
                (self.next_name(), quote!(#x.simd_round()))
            }
            Node::Select(a, b, c, d) => {
                let (w, x, y, z) = (operand(a), operand(b), operand(c), operand(d));
                (self.next_name(), quote!(#y.select(#w.simd_le(#x), #z)))
            }
        };
        self.operations += usize::from(node.operands().next().is_some());
        // The file printer turns these into plain comments.
        let about = (!self.about[index].is_empty()).then(|| {
            let text = format!(" {}", self.about[index].join(", "));
            quote!(#[doc = #text])
        });
        self.statements.extend(quote!(#about let #name = #value;));
        self.read[index] = quote!(#name);
    }

    fn next_name(&self) -> proc_macro2::Ident {
        format_ident!("t{}", self.operations + 1)
    }

    /// From here on the node is read as `tokens`, a name or a place.
    pub fn read_as(&mut self, index: usize, tokens: TokenStream) {
        self.read[index] = tokens;
    }

    /// Stores the value of a written node in a place.
    pub fn store(&mut self, index: usize, place: &TokenStream) {
        let value = &self.read[index];
        self.statements.extend(quote!(#place = #value;));
    }

    /// The expression of a written node.
    #[must_use]
    pub fn value(&self, id: Id) -> TokenStream {
        self.read[id.index()].clone()
    }

    /// The statements since the last call.
    pub fn take_statements(&mut self) -> TokenStream {
        std::mem::take(&mut self.statements)
    }
}
