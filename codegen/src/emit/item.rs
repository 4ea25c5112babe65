//! The struct of an integrator and its implementations.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::constructor::constructor;
use super::generating_function::{generating_function, scalar_function};
use super::group::group_type;
use super::header;
use super::parts::Scope;
use crate::integrator::Integrator;

/// How the Rust is to look from outside.
#[derive(Clone, Debug)]
pub struct Options {
    /// The path of the runtime crate, `::coadjoint` unless renamed.
    pub krate: TokenStream,
    /// The visibility of the struct.
    pub visibility: TokenStream,
    /// The struct's name.
    pub name: Ident,
    /// Attributes for the struct: the user's doc comments.
    pub attributes: TokenStream,
}

impl Options {
    /// Public, `::coadjoint`, named after the problem in camel case.
    #[must_use]
    pub fn for_problem(name: &str) -> Self {
        Self {
            krate: quote!(::coadjoint),
            visibility: quote!(pub),
            name: Ident::new(&camel_case(name), Span::call_site()),
            attributes: TokenStream::new(),
        }
    }
}

/// `rigid_body` and `rigid-body` as `RigidBody`.
#[must_use]
pub fn camel_case(name: &str) -> String {
    let mut result = String::new();
    for word in name.split(|c: char| !c.is_alphanumeric()) {
        let mut letters = word.chars();
        if let Some(first) = letters.next() {
            result.extend(first.to_uppercase());
            result.push_str(letters.as_str());
        }
    }
    match result.chars().next() {
        Some(first) if first.is_alphabetic() => result,
        _ => format!("System{result}"),
    }
}

/// The integrator as items: a struct and its implementations.
#[must_use]
pub fn tokens(integrator: &Integrator, options: &Options) -> TokenStream {
    let Options { krate, visibility, name, attributes } = options;
    let parts = Parts::new(integrator, options);
    let Parts { group, vector, definition, .. } = &parts;
    let summary = header::lines(integrator);
    let slots = Literal::usize_unsuffixed(integrator.coefficients.slots().len());
    let defects = Literal::usize_unsuffixed(integrator.defect_len());
    let constructor = constructor(integrator, krate, group, vector);
    let scope = Scope {
        krate: krate.clone(),
        input: vector.clone(),
        slots: integrator.coefficients.slots().len(),
        lifted: false,
    };
    let generating = generating_function(integrator, krate, name, &parts, &scope);
    let symbols = Literal::usize_unsuffixed(integrator.problem.symbols.len());
    let last = integrator.coefficients.last_terms(integrator.problem.truncation);
    let last = Literal::usize_unsuffixed(last);
    let adjustable = adjustable(krate, name, &last);
    let lanes = lanes(krate, name);
    let energy = scalar_function(&integrator.energy, &scope);
    let truncation = Literal::usize_unsuffixed(integrator.problem.truncation);
    let order = Literal::usize_unsuffixed(integrator.order());
    quote! {
        #definition

        #attributes
        #[doc = ""]
        #(#[doc = #summary])*
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #visibility struct #name<T = f64> {
            step: T,
            /// The parameters, as expressions of them stand in the coefficients.
            symbols: [T; #symbols],
            coefficients: [T; #slots],
            /// A bound on the part of the Hessian that Newton's method leaves out, by degree.
            defect: [T; #defects],
            /// The coefficients of the last two terms of the series, and the |μ| up to which their ratio is small.
            last: [T; #last],
            radius: T,
        }

        #[allow(clippy::all, clippy::pedantic, clippy::nursery, dead_code, non_snake_case, unused_variables, unexpected_cfgs)]
        const _: () = {
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

                /// The reduced Hamiltonian H_red(μ), with the parameters given at construction.
                #[inline]
                pub fn energy(&self, mu: &#vector) -> T {
                    let input = mu;
                    let c = &self.coefficients;
                    #energy
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
            }

            #generating

            #adjustable

            #lanes
        };
    }
}

/// `impl Adjustable`.
fn adjustable(krate: &TokenStream, name: &Ident, last: &Literal) -> TokenStream {
    quote! {
        impl<T: #krate::Scalar> #krate::generating::Adjustable for #name<T> {
            fn truncation(&self) -> usize {
                Self::TRUNCATION
            }

            fn terms(&self) -> usize {
                #krate::plumbing::terms(Self::table())
            }

            fn term(&self, number: usize) -> #krate::generating::Term<'_> {
                #krate::plumbing::term(Self::table(), number)
            }

            fn adjusted(&self, corrections: &[T]) -> Self {
                let mut coefficients = self.coefficients;
                #krate::plumbing::adjust(Self::table(), &mut coefficients, corrections);
                // Whoever adjusts the series judges it where it is used.
                let last = [T::of(0.0); #last];
                Self::with(self.step, self.symbols, coefficients, last, T::of(f64::MAX))
            }
        }
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

/// The types a step mentions.
pub(super) struct Parts {
    pub dim: usize,
    pub group: TokenStream,
    /// Items the group needs.
    pub definition: TokenStream,
    pub chart: TokenStream,
    pub vector: TokenStream,
    pub matrix: TokenStream,
}

impl Parts {
    fn new(integrator: &Integrator, options: &Options) -> Self {
        let Options { krate, visibility, name, .. } = options;
        let dim = integrator.problem.algebra.dim();
        let n = Literal::usize_unsuffixed(dim);
        let chart = match integrator.problem.chart {
            crate::lie::Chart::Exponential => quote!(#krate::Exponential),
            crate::lie::Chart::Cayley => quote!(#krate::Cayley),
        };
        let group = group_type(&integrator.problem.algebra, name, visibility, krate);
        Self {
            dim,
            group: group.ty,
            definition: group.definition,
            chart,
            vector: quote!(#krate::nalgebra::SVector<T, #n>),
            matrix: quote!(#krate::nalgebra::SMatrix<T, #n, #n>),
        }
    }
}
