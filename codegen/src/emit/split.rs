//! Large programs as several functions.
//!
//! The compiler's time grows faster than a function's length, so a program of many operations is cut
//! into functions of bounded length. They hand values to each other through an array.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::scope::Scope;
use super::writer::{Body, Writer};
use crate::graph::{Node, Program};

/// Programs with more operations than this are cut. Shorter ones the compiler takes in its stride,
/// and inlines into a step for lanes, which makes use of wider registers.
const LARGE: usize = 1500;

/// The most operations of one function of a program that is cut.
const MOST_OPERATIONS: usize = 1000;

/// The program in several functions; `None` where one is enough.
#[must_use]
pub fn split(program: &Program, scope: &Scope) -> Option<Body> {
    let nodes = program.nodes();
    let part_of = assign(nodes)?;
    let count = part_of.last()? + 1;
    let handed = handed_on(program, &part_of);
    let places = Literal::usize_unsuffixed(handed.len());

    let Scope { krate, input, slots, lifted, .. } = scope;
    let slots = Literal::usize_unsuffixed(*slots);
    let place = |k: usize| {
        let k = Literal::usize_unsuffixed(k);
        quote!(shared[#k])
    };
    let mut places_taken = handed.iter().enumerate().map(|(k, &index)| (index, k)).peekable();
    let mut functions = TokenStream::new();
    let mut calls = TokenStream::new();
    let (generics, coefficient) = match lifted {
        false => (quote!(T: #krate::Scalar), quote!(T)),
        true => {
            (quote!(C: #krate::Scalar, T: #krate::Scalar + #krate::plumbing::Lift<C>), quote!(C))
        }
    };
    let mut writer = Writer::new(program, scope);
    let mut start = 0;
    for part in 0..count {
        let end = start + part_of[start..].iter().take_while(|&&p| p == part).count();
        for input in inputs(&nodes[start..end], nodes) {
            writer.write(input);
        }
        for index in start..end {
            if !matches!(nodes[index], Node::Input(_)) {
                writer.write(index);
            }
        }
        while let Some((index, k)) = places_taken.next_if(|&(index, _)| index < end) {
            let place = place(k);
            writer.store(index, &place);
            writer.read_as(index, place);
        }
        let name = format_ident!("part{part}");
        let statements = writer.take_statements();
        functions.extend(quote! {
            #[inline(never)]
            fn #name<#generics>(input: &#input, c: &[#coefficient; #slots], shared: &mut [T; #places]) {
                #statements
            }
        });
        calls.extend(quote!(#name(input, c, &mut shared);));
        start = end;
    }
    let statements = quote! {
        #functions
        let mut shared = [T::of(0.0); #places];
        #calls
    };
    let outputs = program.outputs().iter().map(|&id| match nodes[id.index()] {
        Node::Input(i) => {
            let i = Literal::u32_unsuffixed(i);
            quote!(input[#i])
        }
        _ => writer.value(id),
    });
    Some(Body { statements, outputs: outputs.collect() })
}

/// The part of every node: as many operations in each, in their order. `None` for a single part.
fn assign(nodes: &[Node]) -> Option<Vec<usize>> {
    let is_operation = |node: &Node| node.operands().next().is_some();
    let operations = nodes.iter().filter(|node| is_operation(node)).count();
    if operations <= LARGE {
        return None;
    }
    let length = operations.div_ceil(operations.div_ceil(MOST_OPERATIONS));
    let mut seen = 0;
    let part = nodes.iter().map(|node| {
        seen += usize::from(is_operation(node));
        seen.saturating_sub(1) / length
    });
    Some(part.collect())
}

/// The nodes that are computed in one part and read in another or by the caller, in order.
fn handed_on(program: &Program, part_of: &[usize]) -> BTreeSet<usize> {
    let nodes = program.nodes();
    let read_elsewhere = nodes.iter().zip(part_of).flat_map(|(node, part)| {
        node.operands().map(|id| id.index()).filter(move |&operand| part_of[operand] != *part)
    });
    let outputs = program.outputs().iter().map(|id| id.index());
    read_elsewhere
        .chain(outputs)
        .filter(|&index| nodes[index].operands().next().is_some())
        .collect()
}

/// The inputs that these nodes read.
fn inputs(part: &[Node], nodes: &[Node]) -> BTreeSet<usize> {
    let read = part.iter().flat_map(Node::operands).map(|id| id.index());
    read.filter(|&index| matches!(nodes[index], Node::Input(_))).collect()
}
