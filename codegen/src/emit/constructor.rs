//! `new`: folding the coefficients for a step size and parameters.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::hygiene::fresh;
use super::options::identifier;
use super::parameter;
use crate::integrator::Integrator;
use crate::problem::{Parameter, Shape};

/// The constructor `new(step, parameters…)`, which folds.
#[must_use]
pub(crate) fn constructor(
    integrator: &Integrator,
    krate: &TokenStream,
    group: &TokenStream,
) -> TokenStream {
    let problem = &integrator.problem;
    let Arguments { arguments, names, scalars } = arguments(&problem.parameters, krate);
    let step = format_ident!("{}", fresh("step", &names));
    let symbols = problem.symbols.iter().map(|s| parameter::expression(&s.expr, &scalars));
    let symbols = quote!([#(#symbols),*]);
    let texts = problem.symbols.iter().map(|s| &s.text);
    let count = Literal::usize_unsuffixed(problem.symbols.len());
    quote! {
        /// Folds all coefficients for the step size `step` (negative: backwards in time) and the
        /// parameters.
        ///
        /// # Errors
        /// `StepError::InvalidStep` for a step that is zero or not finite,
        /// `StepError::InvalidParameter` where a parameter expression is not finite.
        pub fn new(
            #step: T,
            #(#arguments),*
        ) -> ::core::result::Result<Self, #krate::StepError> {
            Self::of_symbols(#step, &#symbols)
        }

        fn of_symbols(
            step: T,
            symbols: &[T; #count],
        ) -> ::core::result::Result<Self, #krate::StepError> {
            let coefficients = #krate::plumbing::fold(Self::table(), [#(#texts),*], step, symbols)?;
            ::core::result::Result::Ok(Self { step, symbols: *symbols, coefficients })
        }

        /// The error of a step, with a step size that works where one is found.
        #[cold]
        fn advise(
            &self,
            error: #krate::StepError,
            phase: &#krate::Phase<#group>,
        ) -> #krate::StepError {
            #krate::plumbing::advise(error, phase, self.step, |step| {
                Self::of_symbols(step, &self.symbols)
            })
        }
    }
}

/// Parameters as arguments of a function.
pub(crate) struct Arguments {
    /// `name: type` for each.
    pub arguments: Vec<TokenStream>,
    /// The names.
    pub names: BTreeSet<String>,
    /// How each of their scalars is reached.
    pub scalars: Vec<TokenStream>,
}

/// The arguments for these parameters.
#[must_use]
pub(crate) fn arguments(parameters: &[Parameter], krate: &TokenStream) -> Arguments {
    let mut names = parameters.iter().map(|parameter| parameter.name.clone()).collect();
    let mut result =
        Arguments { arguments: Vec::new(), names: BTreeSet::new(), scalars: Vec::new() };
    for parameter in parameters {
        let name = argument_name(&parameter.name, &mut names);
        let ty = parameter_type(&parameter.shape, krate);
        result.arguments.push(quote!(#name: #ty));
        result.scalars.extend(parameter.scalar_names().iter().map(|scalar| {
            // `inertia[0]`: the name, then how the scalar is reached.
            let access = scalar.strip_prefix(parameter.name.as_str()).unwrap_or_default();
            let access: TokenStream = access.parse().unwrap_or_default();
            quote!(#name #access)
        }));
    }
    result.names = names;
    result
}

/// A parameter's name as an argument; with another one, where it cannot be an identifier.
fn argument_name(name: &str, names: &mut BTreeSet<String>) -> Ident {
    let argument = identifier(name);
    if argument == name {
        return argument;
    }
    let argument = fresh(&argument.to_string(), names);
    names.insert(argument.clone());
    format_ident!("{argument}")
}

/// The type of a parameter over the scalar `T`.
fn parameter_type(shape: &Shape, krate: &TokenStream) -> TokenStream {
    let size = |n: &usize| Literal::usize_unsuffixed(*n);
    match shape {
        Shape::Scalar => quote!(T),
        Shape::Array(n) => {
            let n = size(n);
            quote!([T; #n])
        }
        Shape::Vector(n) => {
            let n = size(n);
            quote!(#krate::nalgebra::SVector<T, #n>)
        }
        Shape::Grid(rows, columns) => {
            let (rows, columns) = (size(rows), size(columns));
            quote!([[T; #columns]; #rows])
        }
        Shape::Matrix(rows, columns) => {
            let (rows, columns) = (size(rows), size(columns));
            quote!(#krate::nalgebra::SMatrix<T, #rows, #columns>)
        }
    }
}
