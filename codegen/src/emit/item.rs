//! The struct of an integrator and its implementations.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::body::{Body, body};
use super::{header, parameter, table};
use crate::graph::Program;
use crate::integrator::Integrator;
use crate::problem::Shape;

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
    let parts = Parts::new(integrator, krate);
    let Parts { dim, group, chart, vector, .. } = &parts;
    let summary = header::lines(integrator);
    let slots = Literal::usize_unsuffixed(integrator.coefficients.slots().len());
    let defects = Literal::usize_unsuffixed(integrator.defect_len());
    let constructor = constructor(integrator, krate, &parts, &summary);
    let generating = generating_function(integrator, krate, name, &parts);
    let definition = group_definition(integrator, krate);
    let energy = scalar_function(&integrator.energy);
    let truncation = Literal::usize_unsuffixed(integrator.problem.truncation);
    let order = Literal::usize_unsuffixed(integrator.order());
    let _ = dim;
    let chart_doc = format!("Chart {}.", integrator.problem.chart);
    let _ = (chart, chart_doc);
    quote! {
        #attributes
        #[doc = ""]
        #(#[doc = #summary])*
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #visibility struct #name<T = f64> {
            step: T,
            coefficients: [T; #slots],
            /// A bound on the part of the Hessian that Newton's method leaves out, by degree.
            defect: [T; #defects],
        }

        #[allow(clippy::all, clippy::pedantic, clippy::nursery, unused_variables)]
        const _: () = {
            #definition

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
                /// `StepError`: no convergence, or a state that is not finite.
                #[inline]
                pub fn advance(
                    &self,
                    phase: &mut #krate::Phase<#group>,
                ) -> ::core::result::Result<#krate::StepReport<T>, #krate::StepError> {
                    #krate::advance(self, phase)
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
        };
    }
}

/// The types a step mentions.
struct Parts {
    dim: usize,
    group: TokenStream,
    group_value: TokenStream,
    chart: TokenStream,
    vector: TokenStream,
    matrix: TokenStream,
}

impl Parts {
    fn new(integrator: &Integrator, krate: &TokenStream) -> Self {
        let dim = integrator.problem.algebra.dim();
        let n = Literal::usize_unsuffixed(dim);
        let chart = match integrator.problem.chart {
            crate::lie::Chart::Exponential => quote!(#krate::Exponential),
            crate::lie::Chart::Cayley => quote!(#krate::Cayley),
        };
        let group = super::group::group_type(&integrator.problem, krate);
        Self {
            dim,
            group_value: group.value,
            group: group.ty,
            chart,
            vector: quote!(#krate::nalgebra::SVector<T, #n>),
            matrix: quote!(#krate::nalgebra::SMatrix<T, #n, #n>),
        }
    }
}

fn group_definition(integrator: &Integrator, krate: &TokenStream) -> TokenStream {
    super::group::group_type(&integrator.problem, krate).definition
}

fn constructor(
    integrator: &Integrator,
    krate: &TokenStream,
    parts: &Parts,
    summary: &[String],
) -> TokenStream {
    let _ = (parts, summary);
    let problem = &integrator.problem;
    let mut arguments = Vec::new();
    let mut scalars = Vec::new();
    for parameter in &problem.parameters {
        let name = format_ident!("{}", parameter.name);
        match &parameter.shape {
            Shape::Scalar => {
                arguments.push(quote!(#name: T));
                scalars.push(quote!(#name));
            }
            Shape::Array(n) => {
                let size = Literal::usize_unsuffixed(*n);
                arguments.push(quote!(#name: [T; #size]));
                scalars.extend((0..*n).map(|i| {
                    let i = Literal::usize_unsuffixed(i);
                    quote!(#name[#i])
                }));
            }
            Shape::Vector(n) => {
                let size = Literal::usize_unsuffixed(*n);
                arguments.push(quote!(#name: #krate::nalgebra::SVector<T, #size>));
                scalars.extend((0..*n).map(|i| {
                    let i = Literal::usize_unsuffixed(i);
                    quote!(#name[#i])
                }));
            }
        }
    }
    let symbols = problem.symbols.iter().map(|s| parameter::expression(&s.expr, &scalars));
    let texts = problem.symbols.iter().map(|s| &s.text);
    let count = Literal::usize_unsuffixed(problem.symbols.len());
    let bases = Literal::usize_unsuffixed(integrator.coefficients.bases().len());
    let slots = Literal::usize_unsuffixed(integrator.coefficients.slots().len());
    let table = table::table(krate, &integrator.coefficients);
    let defects = Literal::usize_unsuffixed(integrator.defect_len());
    let defect = integrator.defect.iter().map(|term| {
        let slot = Literal::usize_unsuffixed(term.slot);
        let weight = Literal::f64_unsuffixed(term.weight);
        let degree = Literal::u32_unsuffixed(term.degree);
        quote!((#slot, #weight, #degree))
    });
    quote! {
        /// Folds all coefficients for the step size `step` (negative: backwards in time) and the
        /// parameters.
        ///
        /// # Errors
        /// `StepError::InvalidStep` for a step that is zero or not finite,
        /// `StepError::InvalidParameter` where a parameter expression is not finite.
        pub fn new(
            step: T,
            #(#arguments),*
        ) -> ::core::result::Result<Self, #krate::StepError> {
            static TABLE: #krate::plumbing::Table<#count> = #table;
            let symbols: [T; #count] = [#(#symbols),*];
            let coefficients = #krate::plumbing::fold::<T, #count, #bases, #slots>(
                &TABLE,
                &[#(#texts),*],
                step,
                &symbols,
            )?;
            let defect = #krate::plumbing::bound::<T, #defects>(&coefficients, &[#(#defect),*]);
            ::core::result::Result::Ok(Self { step, coefficients, defect })
        }
    }
}

fn generating_function(
    integrator: &Integrator,
    krate: &TokenStream,
    name: &Ident,
    parts: &Parts,
) -> TokenStream {
    let Parts { dim, group, group_value, chart, vector, matrix } = parts;
    let value = scalar_function(&integrator.value);
    let gradient = vector_function(&integrator.gradient, vector);
    let hessian = hessian_function(&integrator.hessian, *dim, vector, matrix);
    let predictor = vector_function(&integrator.predictor, vector);
    let newton = integrator.newton.as_ref().map(|program| {
        let function = hessian_function(program, *dim, vector, matrix);
        quote! {
            #[inline(always)]
            fn newton_model(&self, input: &#vector) -> (#vector, #matrix) {
                let c = &self.coefficients;
                #function
            }
        }
    });
    let bend = integrator.is_quadratic().then(|| {
        quote! {
            #[inline(always)]
            fn bend(&self, x: T) -> T {
                x * x * T::of(0.25)
            }
        }
    });
    let defect = (!integrator.defect.is_empty()).then(|| {
        quote! {
            #[inline(always)]
            fn hessian_defect(&self, size: T) -> T {
                #krate::plumbing::polynomial(&self.defect, size)
            }
        }
    });
    quote! {
        impl<T: #krate::Scalar> #krate::GeneratingFunction for #name<T> {
            type Group = #group;
            type Chart = #chart;

            #[inline(always)]
            fn group(&self) -> &#group {
                #group_value
            }

            #[inline]
            fn value(&self, input: &#vector) -> T {
                let c = &self.coefficients;
                #value
            }

            #[inline]
            fn gradient(&self, input: &#vector) -> #vector {
                let c = &self.coefficients;
                #gradient
            }

            #[inline(always)]
            fn gradient_and_hessian(&self, input: &#vector) -> (#vector, #matrix) {
                let c = &self.coefficients;
                #hessian
            }

            #[inline(always)]
            fn predict(&self, input: &#vector) -> #vector {
                let c = &self.coefficients;
                #predictor
            }

            #newton

            #bend

            #defect
        }
    }
}

fn scalar_function(program: &Program) -> TokenStream {
    let Body { statements, outputs } = body(program);
    quote!(#statements #(#outputs)*)
}

fn vector_function(program: &Program, vector: &TokenStream) -> TokenStream {
    let Body { statements, outputs } = body(program);
    quote!(#statements <#vector>::from([#(#outputs),*]))
}

fn hessian_function(
    program: &Program,
    dim: usize,
    vector: &TokenStream,
    matrix: &TokenStream,
) -> TokenStream {
    let Body { statements, outputs } = body(program);
    let (gradient, triangle) = outputs.split_at(dim.min(outputs.len()));
    let mut entry = triangle.iter();
    let mut names = vec![vec![TokenStream::new(); dim]; dim];
    let mut lets = TokenStream::new();
    for i in 0..dim {
        for j in i..dim {
            let name = format_ident!("h{i}_{j}");
            if let Some(value) = entry.next() {
                lets.extend(quote!(let #name = #value;));
            }
            names[i][j] = quote!(#name);
            names[j][i] = quote!(#name);
        }
    }
    let columns = names.iter().map(|column| quote!([#(#column),*]));
    quote! {
        #statements
        #lets
        (<#vector>::from([#(#gradient),*]), <#matrix>::from([#(#columns),*]))
    }
}
