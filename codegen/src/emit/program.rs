//! Programs as straight-line Rust: a statement for each operation.
//!
//! The compiler's time grows faster than the length of a function, so a program of many operations becomes several
//! functions of bounded length, which hand values to each other through an array.

use std::collections::BTreeSet;

use num_traits::ToPrimitive;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::graph::{Id, Node, Program};
use crate::number::Rational;

/// Programs with more operations than this are cut. Shorter ones the compiler takes in its stride, and inlines into a step
/// for lanes, which makes use of wider registers.
const LARGE: usize = 1500;

/// The most operations of one function of a program that is cut.
const LONGEST_FUNCTION: usize = 1000;

/// Code of at most this number of operations is inlined for lanes, and so has the wide instructions of its caller.
const INLINED_IN_LANES: usize = 6000;

/// A call of a function that belongs to `operations` operations. Where they are many the function is not inlined for a
/// single number, since the compiler's time grows faster than their count; where they are very many, not for lanes either.
pub(crate) fn apart(krate: &TokenStream, call: &TokenStream, operations: usize) -> TokenStream {
    let called = quote!(#krate::plumbing::called(|| #call));
    if operations <= LARGE {
        call.clone()
    } else if operations <= INLINED_IN_LANES {
        quote!(if T::SINGLE { #called } else { #call })
    } else {
        called
    }
}

/// A part of a program's inputs: an array of numbers `T` behind a reference, or a number.
pub(crate) struct Field {
    name: Ident,
    len: Option<usize>,
}

impl Field {
    pub(crate) fn array(name: Ident, len: usize) -> Self {
        Self { name, len: Some(len) }
    }

    pub(crate) fn number(name: Ident) -> Self {
        Self { name, len: None }
    }

    /// `name: type`, as a parameter of a function.
    pub(crate) fn parameter(&self) -> TokenStream {
        let name = &self.name;
        match self.len {
            Some(len) => {
                let len = Literal::usize_unsuffixed(len);
                quote!(#name: &[T; #len])
            }
            None => quote!(#name: T),
        }
    }
}

/// The names in scope around a program.
pub(crate) struct Scope<'a> {
    /// The path of the runtime crate.
    pub krate: &'a TokenStream,
    /// The inputs, in the order of their numbers.
    pub inputs: Vec<Field>,
    /// The operations of the step that the program is part of, where it is of one.
    pub operations: Option<usize>,
    /// The suffix of the names that are bound.
    pub suffix: &'a str,
}

/// The statements of a program, and the expressions of its outputs.
pub(crate) struct Body {
    /// `let` statements, in order.
    pub statements: TokenStream,
    /// One expression per output.
    pub outputs: Vec<TokenStream>,
}

/// Writes `program` down, in several functions where it is large.
pub(crate) fn body(program: &Program, scope: &Scope<'_>) -> Body {
    let nodes = program.nodes();
    let parts = match program.operations() {
        0..=LARGE => vec![0; nodes.len()],
        _ => program.parts(LONGEST_FUNCTION),
    };
    let mut writer = Writer { program, scope, read: Vec::new(), statements: TokenStream::new() };
    if parts.last().is_none_or(|&last| last == 0) {
        (0..nodes.len()).for_each(|index| writer.write(index));
        let outputs = program.outputs().iter().map(|&id| writer.value(id)).collect();
        return Body { statements: writer.statements, outputs };
    }
    let handed = handed_on(program, &parts);
    let places = Literal::usize_unsuffixed(handed.len());
    let mut next_place = handed.iter().copied().enumerate().peekable();
    let (generics, parameters, call) = scope.part();
    let shared = scope.bound("shared");
    let mut functions = TokenStream::new();
    let mut calls = TokenStream::new();
    for part in 0..=parts[nodes.len() - 1] {
        while writer.read.len() < nodes.len() && parts[writer.read.len()] == part {
            writer.write(writer.read.len());
        }
        let mut handed_here = Vec::new();
        while let Some((place, index)) = next_place.next_if(|&(_, index)| index < writer.read.len())
        {
            let place = Literal::usize_unsuffixed(place);
            let value = &writer.read[index];
            writer.statements.extend(quote!(#shared[#place] = #value;));
            handed_here.push((index, quote!(#shared[#place])));
        }
        for (index, place) in handed_here {
            writer.read[index] = place;
        }
        let name = format_ident!("part{part}");
        let statements = std::mem::take(&mut writer.statements);
        functions.extend(quote! {
            #[inline(always)]
            fn #name #generics (#parameters, #shared: &mut [T; #places]) { #statements }
        });
        let call = quote!(#name(#call, &mut #shared));
        calls.extend(apart(scope.krate, &call, scope.operations.unwrap_or(usize::MAX)));
        calls.extend(quote!(;));
    }
    let zero = scope.constant(0.0);
    let statements = quote! {
        #functions
        let mut #shared = [#zero; #places];
        #calls
    };
    Body { statements, outputs: program.outputs().iter().map(|&id| writer.value(id)).collect() }
}

impl Scope<'_> {
    /// The name of something that is bound here.
    pub(crate) fn bound(&self, name: &str) -> Ident {
        format_ident!("{name}{}", self.suffix)
    }

    /// The generics and the parameters of a part of a program, and the arguments of a call.
    fn part(&self) -> (TokenStream, TokenStream, TokenStream) {
        let Self { krate, inputs, .. } = self;
        let c = self.bound("c");
        let parameters = inputs.iter().map(Field::parameter);
        let names = inputs.iter().map(|field| &field.name);
        let generics = quote!(<T: #krate::plumbing::Number, C: #krate::plumbing::Coefficients<T>>);
        let parameters = quote!(#c: C, #(#parameters),*);
        (generics, parameters, quote!(#c, #(#names),*))
    }

    /// The expression that reads input number `index`.
    fn input(&self, index: usize) -> TokenStream {
        let mut left = index;
        for Field { name, len } in &self.inputs {
            match len {
                Some(len) if left < *len => {
                    let index = Literal::usize_unsuffixed(left);
                    return quote!(#name[#index]);
                }
                None if left == 0 => return quote!(#name),
                _ => left -= len.unwrap_or(1),
            }
        }
        self.constant(0.0)
    }

    fn constant(&self, value: f64) -> TokenStream {
        let (c, value) = (self.bound("c"), Literal::f64_unsuffixed(value));
        quote!(#c.of(#value))
    }
}

/// Turns the nodes of a program into statements, one after the other.
struct Writer<'a> {
    program: &'a Program,
    scope: &'a Scope<'a>,
    /// For each node written so far, the expression that reads it.
    read: Vec<TokenStream>,
    statements: TokenStream,
}

impl Writer<'_> {
    /// Writes the next node: an operation as a `let` statement; others are read in place.
    fn write(&mut self, index: usize) {
        let node = &self.program.nodes()[index];
        let operands: Vec<_> = node.operands().map(|id| &self.read[id.index()]).collect();
        let c = self.scope.bound("c");
        let value = match (*node, &operands[..]) {
            (Node::Constant(bits), _) => self.scope.constant(f64::from_bits(bits)),
            (Node::Epsilon, _) => quote!(#c.epsilon()),
            (Node::Slot(i), _) => {
                let i = Literal::u32_unsuffixed(i);
                quote!(#c.at(#i))
            }
            (Node::Input(i), _) => self.scope.input(i as usize),
            (Node::Add(..), [x, y]) => quote!(#x + #y),
            (Node::Sub(..), [x, y]) => quote!(#x - #y),
            (Node::Mul(..), [x, y]) => quote!(#x * #y),
            (Node::TimesPlus(..), [x, y, z]) => quote!(#x.times_plus(#y, #z)),
            (Node::Div(..), [x, y]) => quote!(#x / #y),
            (Node::Neg(_), [x]) => quote!(-#x),
            (Node::Abs(_), [x]) => quote!(#x.simd_abs()),
            (Node::Sqrt(_), [x]) => quote!(#x.simd_sqrt()),
            (Node::Round(_), [x]) => quote!(#x.simd_round()),
            (Node::Scale(..), [x, k]) => quote!(T::scale(#x, #k)),
            (Node::Exponent(_), [x]) => quote!(T::exponent(#x)),
            // A call, no method: a lint looks for the type of what a method of one argument is called on, through
            // all statements before it, and would not end.
            (Node::Select(..), [w, x, y, z]) => quote!(T::select(#y, T::simd_le(#w, #x), #z)),
            _ => self.scope.constant(0.0),
        };
        if operands.is_empty() {
            self.read.push(value);
            return;
        }
        let name = self.scope.bound(&format!("t{index}"));
        self.statements.extend(quote!(let #name = #value;));
        self.read.push(quote!(#name));
    }

    fn value(&self, id: Id) -> TokenStream {
        self.read[id.index()].clone()
    }
}

/// The operations whose values are read in another part or by the caller, in order.
fn handed_on(program: &Program, parts: &[usize]) -> BTreeSet<usize> {
    let nodes = program.nodes();
    let read_elsewhere = nodes.iter().zip(parts).flat_map(|(node, part)| {
        node.operands().map(|id| id.index()).filter(move |&operand| parts[operand] != *part)
    });
    let outputs = program.outputs().iter().map(|id| id.index());
    read_elsewhere.chain(outputs).filter(|&index| nodes[index].is_operation()).collect()
}

/// The nearest `f64` of an exact number.
pub(crate) fn exact(value: &Rational) -> TokenStream {
    float(value.to_f64().unwrap_or(f64::NAN))
}

/// A literal; numbers beyond the range of `f64` by name, for folding to refuse.
pub(crate) fn float(value: f64) -> TokenStream {
    if value.is_finite() {
        let literal = Literal::f64_unsuffixed(value);
        quote!(#literal)
    } else {
        quote!(f64::NAN)
    }
}
