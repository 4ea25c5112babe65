//! A kernel as Rust: its programs as functions, the loop that calls them, and what the runtime asks of it.

use coadjoint_program::Kernel;
use coadjoint_program::schedule::{Kind, Part, Variable};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Options;
use super::program::{Body, Field, Scope, body};
use super::steps::steps;
use crate::graph::Program;
use crate::step::Step;

/// Steps of more operations than this are not printed: the compiler would take minutes.
pub(crate) const MOST_OPERATIONS: usize = 20_000;

pub(crate) fn step_operations(step: &Step) -> usize {
    let programs = Part::ALL.iter().filter_map(|(part, _)| part.program(step.kernel()));
    programs.map(Program::operations).sum()
}

/// The programs and the loop as functions, and `impl Integrator`, which runs them.
pub(crate) fn programs(
    step: &Step,
    options: &Options,
    group: &TokenStream,
    solver: &TokenStream,
) -> TokenStream {
    let Options { krate, name, .. } = options;
    let (kernel, operations) = (step.kernel(), step_operations(step));
    let functions = Part::ALL.iter().filter_map(|&(part, name)| {
        Some(function(kernel, (part, name), part.program(kernel)?, options, operations))
    });
    let steps = steps(kernel, options, operations);
    let [phase, asked, state] = ["phase", "asked", "state"].map(|name| options.bound(name));
    quote! {
        #(#functions)*

        #steps

        impl<T: #krate::Scalar> #krate::solve::Integrator for #name<T> {
            #solver

            #[inline(always)]
            fn drive(
                &self,
                #phase: &mut #krate::Phase<#group>,
                #asked: u64,
            ) -> #krate::plumbing::DrivenOf<Self> {
                let #state = #krate::plumbing::load(#phase);
                #krate::plumbing::store(#phase, steps(&self.coefficients, #state, #asked))
            }
        }
    }
}

/// A program as a function of its coefficients and inputs.
fn function(
    kernel: &Kernel,
    (part, name): (Part, &str),
    program: &Program,
    options: &Options,
    operations: usize,
) -> TokenStream {
    let krate = &options.krate;
    let name = format_ident!("{name}");
    let (inputs, outputs) = part.variables(kernel);
    let field = |&variable: &Variable| {
        let name = options.bound(variable.name());
        match variable.kind(kernel) {
            Kind::Array(len) => Field::array(name, len),
            Kind::Number | Kind::Count => Field::number(name),
        }
    };
    let inputs: Vec<Field> = inputs.iter().map(field).collect();
    let parameters: Vec<_> = inputs.iter().map(Field::parameter).collect();
    let scope = Scope { krate, inputs, operations: Some(operations), suffix: options.suffix };
    let Body { statements, outputs: values } = body(program, &scope);
    let mut values = values.into_iter();
    let (kinds, results): (Vec<_>, Vec<_>) = outputs
        .iter()
        .map(|output| match output.kind(kernel) {
            Kind::Array(len) => {
                let values = values.by_ref().take(len);
                let results = quote!([#(#values),*]);
                let len = Literal::usize_unsuffixed(len);
                (quote!([T; #len]), results)
            }
            Kind::Number | Kind::Count => {
                let value = values.next();
                (quote!(T), quote!(#value))
            }
        })
        .unzip();
    let tuple = |list: &[TokenStream]| match list {
        [one] => one.clone(),
        several => quote!((#(#several),*)),
    };
    let (kind, result) = (tuple(&kinds), tuple(&results));
    let c = options.bound("c");
    quote! {
        #[inline(always)]
        fn #name<T: #krate::plumbing::Number, C: #krate::plumbing::Coefficients<T>>(
            #c: C, #(#parameters),*
        ) -> #kind {
            #statements
            #result
        }
    }
}
