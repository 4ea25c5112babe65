//! The struct of an integrator and its implementations.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::constructor::constructor;
use super::generating_function::{generating_function, scalar_function, solver, without_programs};
use super::options::Options;
use super::programs::{MOST_OPERATIONS, programs, step_operations};
use super::table::{fold_item, last_item};
use super::types::Types;
use super::{allow, header};
use crate::integrator::{FoldTable, Integrator};
use crate::step::Step;

/// An integrator as items.
#[derive(Debug, Default)]
pub struct Items {
    /// Paragraphs for the opening of a file.
    pub opening: Vec<String>,
    /// The struct, and what users call.
    pub struct_and_methods: TokenStream,
    /// The programs and tables, which are long; the names they bind end with [`Options::suffix`].
    pub programs: TokenStream,
}

/// The integrator as items: a struct and its implementations, tables last.
#[must_use]
pub fn tokens(integrator: &Integrator, options: &Options) -> TokenStream {
    let Items { struct_and_methods, programs, .. } = items(integrator, options);
    quote!(#struct_and_methods #programs)
}

/// The integrator as items, its programs and tables apart.
#[must_use]
pub fn items(integrator: &Integrator, options: &Options) -> Items {
    let Options { krate, visibility, name, attributes, .. } = options;
    let types = Types::new(&integrator.problem.algebra, integrator.problem.chart, options);
    let Types { group, vector, definition, tables, aliases, .. } = &types;
    let step = match types.by_tables {
        true => Step::on_matrices(integrator),
        false => Step::build(integrator),
    };
    // Kicks are items of their own.
    let step = step
        .ok()
        .filter(|step| step.kernel().flows().is_none() && step_operations(step) <= MOST_OPERATIONS);
    let summary = header::lines(integrator, step.as_ref());
    let blank = (!attributes.is_empty()).then(|| quote!(#[doc = ""]));
    let fold = FoldTable::new(integrator);
    let count = fold.len();
    let slots = Literal::usize_unsuffixed(count);
    let constructor = constructor(integrator, krate, group);
    let generating = generating_function(integrator, options, &types, count);
    let programs = match &step {
        Some(step) => programs(step, options, group, &solver(integrator, krate)),
        None => without_programs(integrator, options, &types),
    };
    let n = Literal::usize_unsuffixed(types.dim);
    let symbols = Literal::usize_unsuffixed(integrator.problem.symbols.len());
    let lanes = lanes(options, step.is_some());
    let energy = scalar_function(&integrator.energy, options, "mu");
    let (table, last) = (fold_item(krate, &fold), last_item(krate, integrator));
    let truncation = Literal::usize_unsuffixed(integrator.problem.truncation);
    let order = Literal::usize_unsuffixed(integrator.order());
    let allow = allow();
    let [mu, c] = ["mu", "c"].map(|name| options.bound(name));
    let struct_and_methods = quote! {
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
            /// The coefficients of the programs below, folded for h and the parameters; after them those of the bound on
            /// what is left out of the Hessian, the square of the |μ| up to which the series can be trusted, and the
            /// coefficients of its last two terms.
            coefficients: [T; #slots],
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
                ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::StepError> {
                    #krate::steps::advance(self, phase).map_err(|error| self.advise(error, phase))
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
                ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::steps::Stopped> {
                    #krate::steps::advance_by(self, phase, steps).map_err(|stopped| #krate::steps::Stopped {
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
                    #krate::steps::poisson_map(self, mu)
                }
            }
        };
    };
    let programs = quote! {
        #allow
        const _: () = {
            #aliases

            #programs

            #lanes

            #generating

            impl<T: #krate::Scalar> #name<T> {
                /// The reduced Hamiltonian H_red(μ), with the parameters given at construction.
                #[inline]
                pub fn energy(&self, #mu: &#vector) -> T {
                    let (#mu, #c): (&[T; #n], _) = (&#mu.data.0[0], &self.coefficients);
                    #energy
                }

                fn table() -> &'static #krate::plumbing::Fold<'static> {
                    &FOLD
                }
            }

            #table

            #last
        };

        #tables
    };
    let opening = header::opening(integrator, options, step.as_ref());
    Items { opening, struct_and_methods, programs }
}

/// `impl Lanes`: steps in lanes, where the programs of the step are printed.
fn lanes(options: &Options, printed: bool) -> TokenStream {
    let Options { krate, name, .. } = options;
    let names = ["registers", "phases", "asked", "state", "run", "c"];
    let [registers, phases, asked, state, run, c] = names.map(|name| options.bound(name));
    let drive = printed.then(|| {
        quote! {
            #[inline(always)]
            fn drive_lanes<R: #krate::plumbing::Registers>(
                &self,
                #registers: R,
                #phases: &mut [(usize, &mut #krate::Phase<<Self as #krate::GeneratingFunction>::Group>)],
                #asked: u64,
            ) -> bool {
                let #c = R::coefficients(#registers, &self.coefficients);
                let #state = #krate::plumbing::load_lanes(#registers, #phases);
                let #run = steps(#c, #state, #asked);
                #krate::plumbing::store_lanes(#registers, #phases, #asked, #run)
            }
        }
    });
    quote! {
        impl #krate::lanes::Lanes for #name<f64> {
            #drive
        }
    }
}
