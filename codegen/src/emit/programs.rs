//! A kernel's programs as Rust: what the runtime's loop drives.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::options::Options;
use super::program::{Body, Field, Scope, body, operations};
use crate::graph::Program;
use crate::step::Step;

/// Steps of more operations than this are not printed: the compiler would take minutes.
pub const MOST_OPERATIONS: usize = 20_000;

/// The largest number of operations of a step that is inlined into the loop that drives it, whatever calls it.
const SHORT: usize = 1500;

/// The operations of a whole step.
#[must_use]
pub fn step_operations(step: &Step) -> usize {
    let parts = step.kernel().programs();
    let all = [&parts.guess, &parts.correct, &parts.accept, &parts.transport, &parts.sound];
    all.into_iter().chain(&parts.frame).map(operations).sum()
}

/// `impl Programs for name`, and `impl Integrator`, which drives them; `slots` is the number of coefficients.
#[must_use]
pub fn programs(
    step: &Step,
    options: &Options,
    group: &TokenStream,
    slots: usize,
    solver: &TokenStream,
) -> TokenStream {
    let Options { krate, name, .. } = options;
    let kernel = step.kernel();
    let (n, m, k) = (kernel.dim(), kernel.element(), kernel.constants());
    let inline = match step_operations(step) {
        0..=SHORT => quote!(#[inline(always)]),
        _ => quote!(#[inline(never)]),
    };
    let parts = kernel.programs();
    let function = |name: &str,
                    program: &Program,
                    inputs: Vec<Field>,
                    outputs: &[Option<usize>]| {
        let name = format_ident!("{name}");
        let parameters: Vec<_> = inputs.iter().map(Field::parameter).collect();
        let c = options.bound("c");
        let scope = Scope { krate, inputs, slots, lifted: true, suffix: options.suffix };
        let Body { statements, outputs: values } = body(program, &scope);
        let count = Literal::usize_unsuffixed(slots);
        let mut values = values.into_iter();
        let result = outputs.iter().map(|len| match len {
            Some(len) => {
                let values = values.by_ref().take(*len);
                quote!([#(#values),*])
            }
            None => {
                let value = values.next();
                quote!(#value)
            }
        });
        let result: Vec<_> = result.collect();
        let kinds = outputs.iter().map(|len| match len {
            Some(len) => {
                let len = Literal::usize_unsuffixed(*len);
                quote!([T; #len])
            }
            None => quote!(T),
        });
        let (kind, result) = match &result[..] {
            [one] => (quote!(T), quote!(#one)),
            several => (quote!((#(#kinds),*)), quote!((#(#several),*))),
        };
        quote! {
            #inline
            fn #name<T: #krate::plumbing::Number<C>>(#c: &[C; #count], #(#parameters),*) -> #kind {
                #statements
                #result
            }
        }
    };
    let array = |name: &str, len: usize| Field::array(options.bound(name), len);
    let number = |name: &str| Field::number(options.bound(name));
    let state = || vec![array("g", m), array("mu", n)];
    let with = |mut fields: Vec<Field>, last: Field| {
        fields.push(last);
        fields
    };
    let moved = [Some(m), Some(n)];
    let frame = match &parts.frame {
        Some(frame) => function("frame", frame, with(state(), number("times")), &moved),
        None => {
            let (count, n, m) = (index(slots), index(n), index(m));
            let (g, mu) = (options.bound("g"), options.bound("mu"));
            quote! {
                fn frame<T: #krate::plumbing::Number<C>>(
                    _: &[C; #count], #g: &[T; #m], #mu: &[T; #n], _: T,
                ) -> ([T; #m], [T; #n]) {
                    (*#g, *#mu)
                }
            }
        }
    };
    let functions = [
        function("guess", &parts.guess, vec![array("mu", n)], &[Some(n), Some(k)]),
        function(
            "correct",
            &parts.correct,
            vec![array("p", n), array("mu", n), array("k", k)],
            &[Some(n), Some(n), None, None],
        ),
        function(
            "accept",
            &parts.accept,
            vec![array("mu", n), array("x", n), number("left"), number("way")],
            &[None],
        ),
        function("transport", &parts.transport, with(state(), array("x", n)), &moved),
        frame,
        function("sound", &parts.sound, state(), &[None]),
    ];
    let near = kernel.near();
    let corrections = kernel.corrections();
    let framed = parts.frame.is_some();
    let sizes = [n, m, k, slots].map(index);
    let sizes = quote!(#(#sizes),*);
    let (phase, steps) = (options.bound("phase"), options.bound("steps"));
    quote! {
        impl<C: #krate::Scalar> #krate::plumbing::Programs<C, #sizes> for #name<C> {
            const NEAR: f64 = #near;
            const CORRECTIONS: u32 = #corrections;
            const FRAMED: bool = #framed;

            #(#functions)*
        }

        impl<T: #krate::Scalar> #krate::solve::Integrator for #name<T> {
            #solver

            #[inline(always)]
            fn drive(
                &self,
                #phase: &mut #krate::Phase<#group>,
                #steps: u64,
            ) -> #krate::plumbing::DrivenOf<Self> {
                #krate::plumbing::drive::<Self, Self, #sizes>(&self.coefficients, #phase, #steps)
            }
        }
    }
}

fn index(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}
