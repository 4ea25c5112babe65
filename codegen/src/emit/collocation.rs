//! An integrator by collocation: for Hamiltonians that are no polynomials.

use coadjoint_program::print::{Dialect, Field, Signature};
use coadjoint_program::quoting::rust_comment;
use proc_macro2::{Group, Ident, Literal, TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::generating_function::unit;
use super::program::{Rust, tokens};
use crate::emit::group::Types;
use crate::emit::item::{Arguments, Items, arguments};
use crate::emit::{Options, allow, fresh, parameter};
use crate::graph::Program;
use crate::lie::Chart;
use crate::smooth::Smooth;

/// The integrator of a smooth Hamiltonian as items: a struct with the energy that it integrates, and the programs of this.
#[must_use]
pub(crate) fn collocation(smooth: &Smooth, options: &Options) -> Items {
    let Options { krate, visibility, name, attributes, .. } = options;
    let types = Types::new(&smooth.algebra, Chart::Exponential, options);
    let Types { definition, tables, aliases, .. } = &types;
    let (group, vector) = (over_f64(types.group.clone()), over_f64(types.vector.clone()));
    let energy = format_ident!("{name}Energy");
    let size = Literal::usize_unsuffixed;
    let (nodes, symbols) = (size(smooth.nodes()), size(smooth.symbols.len()));
    let (truncation, order) = (size(smooth.truncation), size(2 * smooth.nodes()));
    let integrator = quote!(#krate::collocation::Collocation<#group, #energy, #nodes>);
    let blank = (!attributes.is_empty()).then(|| quote!(#[doc = ""]));
    let summary = [
        format!(" Hamiltonian: `{}`", rust_comment(&smooth.source)),
        String::new(),
        format!(
            " Group: {}. Collocation at {} nodes, order of accuracy {}.",
            rust_comment(smooth.algebra.name()),
            smooth.nodes(),
            2 * smooth.nodes()
        ),
    ];
    let about = format!(" The Hamiltonian of [`{name}`], with the values of its parameters.");
    let Arguments { arguments, names, scalars } = arguments(&smooth.parameters, krate);
    let step = format_ident!("{}", fresh(&options.bound("step").to_string(), &names));
    let names = ["time", "phase", "steps", "mu", "symbols", "collocation"];
    let [time, phase, steps, mu, symbols_given, collocation] =
        names.map(|name| options.bound(name));
    let values = parameter::symbols(&smooth.symbols, &scalars);
    let texts = smooth.symbols.iter().map(|s| &s.text);
    let allow = allow();
    // If H depends on the time, methods take the time of the state.
    let argument = smooth.moves.then(|| quote!(#time: f64,));
    let now = if smooth.moves { quote!(#time) } else { quote!(0.0) };
    let of = if smooth.moves { "(t, μ)" } else { "(μ)" };
    let reduced =
        format!(" The reduced Hamiltonian H_red{of}, with the parameters given at construction.");
    let constructor = over_f64(quote! {
        /// Steps of size `step` (negative: backwards in time) with these parameters.
        ///
        /// # Errors
        /// `StepError::InvalidStep` for a step that is zero or not finite,
        /// `StepError::InvalidParameter` where a parameter expression is not finite.
        pub fn new(
            #step: T,
            #(#arguments),*
        ) -> ::core::result::Result<Self, #krate::StepError> {
            let #symbols_given = #krate::plumbing::finite([#(#texts),*], [#(#values),*])?;
            let #collocation = #krate::collocation::Collocation::new(
                <#group>::new(),
                #energy { symbols: #symbols_given },
                #step,
            )?;
            ::core::result::Result::Ok(Self { collocation: #collocation })
        }
    });
    let struct_and_methods = quote! {
        #definition

        #attributes
        #blank
        #(#[doc = #summary])*
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #visibility struct #name {
            collocation: #integrator,
        }

        #[doc = #about]
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #visibility struct #energy {
            /// The parameters, as expressions of them stand in the Hamiltonian.
            symbols: [f64; #symbols],
        }

        #allow
        const _: () = {
            #aliases
            use #krate::Scalar as _;
            use #krate::nalgebra::{SimdComplexField as _, SimdRealField as _};

            impl #name {
                /// K, as it was asked for.
                pub const TRUNCATION: usize = #truncation;
                /// The order of accuracy, K + 1.
                pub const ORDER: usize = #order;

                #constructor

                /// The step size h.
                #[inline]
                pub fn step(&self) -> f64 {
                    self.collocation.step()
                }

                /// Advances (g, μ) by one step; on error `phase` is left as it was. Where a step goes on from the end of
                /// the one before, it begins with a better guess.
                ///
                /// # Errors
                /// `StepError`: why there is no right step.
                #[inline]
                pub fn advance(
                    &mut self,
                    #phase: &mut #krate::Phase<#group>,
                    #argument
                ) -> ::core::result::Result<#krate::steps::StepReport<f64>, #krate::StepError> {
                    self.collocation.advance(#phase, #now)
                }

                /// Advances (g, μ) by `steps` steps; the report is of the worst of them, and on error `phase` is left
                /// before the step that failed.
                ///
                /// # Errors
                /// `Stopped`: how many steps were made, and why the next was not.
                pub fn advance_by(
                    &mut self,
                    #phase: &mut #krate::Phase<#group>,
                    #argument
                    #steps: u64,
                ) -> ::core::result::Result<#krate::steps::StepReport<f64>, #krate::steps::Stopped> {
                    self.collocation.advance_by(#phase, #now, #steps)
                }

                #[doc = #reduced]
                #[inline]
                pub fn energy(&self, #argument #mu: &#vector) -> f64 {
                    #krate::collocation::Energy::value(self.collocation.energy(), #now, #mu)
                }
            }
        };
    };
    let programs = programs(smooth, options, &types, &energy);
    let programs = quote! {
        #programs

        #tables
    };
    let opening = format!(
        "Written by coadjoint-codegen from H = {}; do not edit. `{name}` makes steps of order {} by collocation at {} nodes; \
         it needs the crate coadjoint.",
        rust_comment(&smooth.source),
        2 * smooth.nodes(),
        smooth.nodes()
    );
    Items { opening: vec![opening], struct_and_methods, programs, legend: Vec::new() }
}

/// `impl Energy`: value, gradient, reach, and what is outside its domain.
fn programs(smooth: &Smooth, options: &Options, types: &Types, energy: &Ident) -> TokenStream {
    let Options { krate, .. } = options;
    let vector = over_f64(types.vector.clone());
    let dialect = Rust::alone(options.suffix);
    let function = |name: &str, program: &Program, states: &[[&str; 2]]| {
        let fields = |[mu, time]: &[&str; 2]| {
            [Field::array(&dialect.bound(mu), types.dim), Field::number(&dialect.bound(time))]
        };
        let inputs = states.iter().flat_map(fields).collect();
        let outputs = vec![Field::array("", program.outputs().len())];
        let signature = Signature { name: name.to_owned(), program, inputs, outputs };
        tokens(&dialect.function(&signature, &dialect.body(&signature)))
    };
    let value = function("value", &smooth.value, &[["mu", "time"]]);
    let gradient = function("gradient", &smooth.gradient, &[["mu", "time"]]);
    let watched = function("watched", &smooth.watched, &[["mu", "time"]]);
    let reach = function("reach", &smooth.reach, &[["mu", "time"], ["next", "then"]]);
    let expressions = &smooth.expressions;
    let (allow, aliases) = (allow(), &types.aliases);
    let unit = unit(&smooth.units);
    quote! {
        #allow
        const _: () = {
            #aliases

            impl #krate::collocation::Energy<#vector> for #energy {
                fn value(&self, time: f64, mu: &#vector) -> f64 {
                    let [value] = value(&self.symbols, &mu.data.0[0], time);
                    value
                }

                #[inline]
                fn gradient(&self, time: f64, mu: &#vector) -> #vector {
                    <#vector as From<_>>::from(gradient(&self.symbols, &mu.data.0[0], time))
                }

                fn reach(
                    &self,
                    (time, mu): (f64, &#vector),
                    (then, next): (f64, &#vector),
                ) -> ::core::option::Option<f64> {
                    let [mu, next] = [&mu.data.0[0], &next.data.0[0]];
                    let [square] = reach(&self.symbols, mu, time, next, then);
                    ::core::option::Option::Some(square)
                }

                #unit

                #[cold]
                fn undefined(
                    &self,
                    time: f64,
                    mu: &#vector,
                ) -> ::core::option::Option<#krate::collocation::Undefined> {
                    let watched = watched(&self.symbols, &mu.data.0[0], time);
                    #krate::plumbing::undefined(&[#(#expressions),*], &watched)
                }
            }

            #value

            #gradient

            #watched

            #reach
        };
    }
}

/// Replaces the numbers `T` by `f64`.
fn over_f64(tokens: TokenStream) -> TokenStream {
    let replaced = tokens.into_iter().map(|token| match token {
        TokenTree::Ident(ident) if ident == "T" => {
            TokenTree::Ident(Ident::new("f64", ident.span()))
        }
        TokenTree::Group(group) => {
            let mut inner = Group::new(group.delimiter(), over_f64(group.stream()));
            inner.set_span(group.span());
            TokenTree::Group(inner)
        }
        other => other,
    });
    replaced.collect()
}
