//! A kernel as Rust: its programs as functions, the loop that calls them, and what the runtime asks of it.

use coadjoint_program::print::{Dialect, Field, signatures};
use coadjoint_program::schedule::Part;
use proc_macro2::TokenStream;
use quote::quote;

use super::Options;
use super::program::{Rust, tokens};
use super::steps::steps;
use crate::graph::Program;
use crate::step::Step;

/// Steps of more operations than this are not printed: the compiler would take minutes.
pub(crate) const MOST_OPERATIONS: usize = 20_000;

pub(crate) fn step_operations(step: &Step) -> usize {
    let programs = Part::ALL.iter().filter_map(|(part, _)| part.program(step.kernel()));
    programs.map(Program::operations).sum()
}

/// The programs of a step, and the loop that calls them, as functions.
pub(crate) fn functions(step: &Step, options: &Options) -> TokenStream {
    let dialect = Rust::new(options.suffix, step_operations(step));
    let named = |field: Field| Field { name: dialect.bound(&field.name), ..field };
    let functions = signatures(step.kernel(), "").map(|mut signature| {
        signature.inputs = signature.inputs.into_iter().map(named).collect();
        dialect.function(&signature, &dialect.body(&signature))
    });
    tokens(&(functions.collect::<String>() + &steps(step.kernel(), &dialect)))
}

/// The functions of a step of a series, and `impl Integrator`, which runs them.
pub(crate) fn programs(
    step: &Step,
    options: &Options,
    group: &TokenStream,
    solver: &TokenStream,
) -> TokenStream {
    let Options { krate, name, .. } = options;
    let functions = functions(step, options);
    let [phase, asked, state] = ["phase", "asked", "state"].map(|name| options.bound(name));
    quote! {
        #functions

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
