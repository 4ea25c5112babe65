//! The struct of an integrator and its implementations.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::constructor::constructor;
use super::generating_function::{generating_function, scalar_function};
use super::options::Options;
use super::scope::{Meaning, Scope};
use super::table::table_item;
use super::types::Types;
use super::{allow, header};
use crate::integrator::{Integrator, Products};

/// The integrator as items: a struct and its implementations, tables last.
#[must_use]
pub fn tokens(integrator: &Integrator, options: &Options) -> TokenStream {
    let Options { krate, visibility, name, attributes } = options;
    let types = Types::new(&integrator.problem.algebra, integrator.problem.chart, options);
    let Types { group, vector, definition, tables, aliases, .. } = &types;
    let summary = header::lines(integrator);
    let blank = (!attributes.is_empty()).then(|| quote!(#[doc = ""]));
    let slots = Literal::usize_unsuffixed(integrator.coefficients.slots().len());
    let defects = Literal::usize_unsuffixed(integrator.defect_len());
    let constructor = constructor(integrator, krate, group);
    let scope = Scope {
        krate: krate.clone(),
        input: vector.clone(),
        slots: integrator.coefficients.slots().len(),
        lifted: false,
        dim: types.dim,
        meaning: Meaning::Unnamed,
    };
    let generating = generating_function(integrator, krate, name, &types, &scope);
    let symbols = Literal::usize_unsuffixed(integrator.problem.symbols.len());
    let last = integrator.coefficients.last_terms(integrator.problem.truncation);
    let last = Literal::usize_unsuffixed(last);
    let lanes = lanes(krate, name);
    let energy = scalar_function(&integrator.energy, &scope.of(Meaning::Energy));
    let table =
        table_item(krate, &integrator.coefficients, &Products::of(&integrator.coefficients));
    let truncation = Literal::usize_unsuffixed(integrator.problem.truncation);
    let order = Literal::usize_unsuffixed(integrator.order());
    let allow = allow();
    quote! {
        #definition

        #attributes
        #blank
        #(#[doc = #summary])*
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #[allow(clippy::trailing_empty_array)]
        #visibility struct #name<T = f64> {
            /// The step size h.
            step: T,
            /// The parameters, as expressions of them stand in the coefficients.
            symbols: [T; #symbols],
            /// The coefficients of the programs below, folded for h and the parameters.
            coefficients: [T; #slots],
            /// A bound on the part of the Hessian that Newton's method leaves out, by degree.
            defect: [T; #defects],
            /// The coefficients of the last two terms of the series, and the |μ| up to which their ratio is small.
            last: [T; #last],
            radius: T,
        }

        #allow
        const _: () = {
            #aliases

            impl<T: #krate::Scalar> #name<T> {
                /// K: the series S₁ … S_K of the generating function is kept.
                pub const TRUNCATION: usize = #truncation;
                /// The order of accuracy, K + 1.
                pub const ORDER: usize = #order;

                #constructor

                /// The step size h.
                #[inline]
                pub fn step(&self) -> T {
                    self.step
                }

                /// Advances (g, μ) by one step; on error `phase` is left as it was.
                ///
                /// # Errors
                /// `StepError`: why there is no right step, and a step size that works where one is found.
                #[inline]
                pub fn advance(
                    &self,
                    phase: &mut #krate::Phase<#group>,
                ) -> ::core::result::Result<#krate::StepReport<T>, #krate::StepError> {
                    #krate::advance(self, phase).map_err(|error| self.advise(error, phase))
                }

                /// Advances (g, μ) by `steps` steps, faster than one by one; the report is of the
                /// worst of them, and on error `phase` is left before the step that failed.
                ///
                /// # Errors
                /// `Stopped`: how many steps were made, and why the next was not.
                pub fn advance_by(
                    &self,
                    phase: &mut #krate::Phase<#group>,
                    steps: u64,
                ) -> ::core::result::Result<#krate::StepReport<T>, #krate::Stopped> {
                    #krate::advance_by(self, phase, steps).map_err(|stopped| #krate::Stopped {
                        error: self.advise(stopped.error, phase),
                        ..stopped
                    })
                }

                /// The Poisson map μ ↦ μ″ of one step on 𝔤*.
                ///
                /// # Errors
                /// As `advance`.
                #[inline]
                pub fn poisson_map(
                    &self,
                    mu: &#vector,
                ) -> ::core::result::Result<#vector, #krate::StepError> {
                    #krate::poisson_map(self, mu)
                }

                /// The reduced Hamiltonian H_red(μ), with the parameters given at construction.
                #[inline]
                pub fn energy(&self, mu: &#vector) -> T {
                    let input = mu;
                    let c = &self.coefficients;
                    #energy
                }
            }

            #generating

            #lanes

            impl<T> #name<T> {
                fn table() -> &'static #krate::plumbing::Table {
                    &TABLE
                }
            }

            #table
        };

        #tables
    }
}

/// `impl Lanes`: the coefficients in every lane.
fn lanes(krate: &TokenStream, name: &Ident) -> TokenStream {
    let lane = quote!(#krate::Scalar + #krate::nalgebra::SimdValue<Element = f64>);
    quote! {
        impl #krate::lanes::Lanes for #name<f64> {
            type Over<L: #lane> = #name<L>;

            fn splat<L: #lane>(&self) -> #name<L> {
                #name {
                    step: L::splat(self.step),
                    symbols: self.symbols.map(L::splat),
                    coefficients: self.coefficients.map(L::splat),
                    defect: self.defect.map(L::splat),
                    last: self.last.map(L::splat),
                    radius: L::splat(self.radius),
                }
            }
        }
    }
}
