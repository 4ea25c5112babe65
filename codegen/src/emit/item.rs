//! The struct of an integrator and its implementations.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::generating_function::{
    generating_function, scalar_function, solver, without_programs,
};
use crate::emit::group::Types;
use crate::emit::programs::{MOST_OPERATIONS, programs, step_operations};
use crate::emit::table::{fold_item, last_item};
use crate::emit::{Options, allow, fresh, header, identifier, parameter};
use crate::integrator::{FoldTable, Integrator};
use crate::problem::{Parameter, Shape};
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
    /// A line for each coefficient of the series that programs read.
    pub legend: Vec<String>,
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
    let constructor = constructor(integrator, &fold, options, group);
    let generating = generating_function(integrator, options, &types, count);
    let programs = match &step {
        Some(step) => programs(step, options, group, &solver(integrator, krate)),
        None => without_programs(integrator, options, &types),
    };
    let n = Literal::usize_unsuffixed(types.dim);
    let symbols = Literal::usize_unsuffixed(integrator.problem.symbols.len());
    let lanes = lanes(options, step.is_some());
    let energy = scalar_function(&integrator.energy, options, "mu");
    let (table, last) = (fold_item(&fold), last_item(integrator));
    let truncation = Literal::usize_unsuffixed(integrator.problem.truncation);
    let order = Literal::usize_unsuffixed(integrator.order());
    let allow = allow();
    let names = ["mu", "c", "phase", "steps", "error", "stopped"];
    let [mu, c, phase, steps, error, stopped] = names.map(|name| options.bound(name));
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
                    #phase: &mut #krate::Phase<#group>,
                ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::StepError> {
                    #krate::steps::advance(self, #phase).map_err(|#error| self.advise(#error, #phase))
                }

                /// Advances (g, μ) by `steps` steps, faster than one by one; the report is of the
                /// worst of them, and on error `phase` is left before the step that failed.
                ///
                /// # Errors
                /// `Stopped`: how many steps were made, and why the next was not.
                pub fn advance_by(
                    &self,
                    #phase: &mut #krate::Phase<#group>,
                    #steps: u64,
                ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::steps::Stopped> {
                    #krate::steps::advance_by(self, #phase, #steps).map_err(|#stopped| #krate::steps::Stopped {
                        error: self.advise(#stopped.error, #phase),
                        ..#stopped
                    })
                }

                /// The Poisson map μ ↦ μ″ of one step on 𝔤*.
                ///
                /// # Errors
                /// As `advance`.
                #[inline]
                pub fn poisson_map(
                    &self,
                    #mu: &#vector,
                ) -> ::core::result::Result<#vector, #krate::StepError> {
                    #krate::steps::poisson_map(self, #mu)
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
    Items {
        opening,
        struct_and_methods,
        programs,
        legend: header::legend(&integrator.coefficients),
    }
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

/// The constructor `new(step, parameters…)`, which folds.
fn constructor(
    integrator: &Integrator,
    fold: &FoldTable,
    options: &Options,
    group: &TokenStream,
) -> TokenStream {
    let krate = &options.krate;
    let names = ["step", "symbols", "coefficients", "error", "phase"];
    let [own, given, coefficients, error, phase] = names.map(|name| options.bound(name));
    let problem = &integrator.problem;
    let Arguments { arguments, names, scalars } = arguments(&problem.parameters, krate);
    let step = format_ident!("{}", fresh(&own.to_string(), &names));
    let symbols = parameter::symbols(&problem.symbols, &scalars);
    let symbols = quote!([#(#symbols),*]);
    let texts = problem.symbols.iter().map(|s| &s.text);
    let [count, room] = [problem.symbols.len(), fold.lists().room()].map(Literal::usize_unsuffixed);
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
            #own: T,
            #given: &[T; #count],
        ) -> ::core::result::Result<Self, #krate::StepError> {
            let #coefficients = #krate::plumbing::fold(
                Self::table(),
                [#(#texts),*],
                (#own, #given),
                [0.0; #room],
            )?;
            ::core::result::Result::Ok(Self { step: #own, symbols: *#given, coefficients: #coefficients })
        }

        /// The error of a step, with a step size that works where one is found.
        #[cold]
        fn advise(
            &self,
            #error: #krate::StepError,
            #phase: &#krate::Phase<#group>,
        ) -> #krate::StepError {
            #krate::plumbing::advise(#error, #phase, self.step, |#own| {
                Self::of_symbols(#own, &self.symbols)
            })
        }
    }
}

pub(crate) struct Arguments {
    /// `name: type` for each.
    pub arguments: Vec<TokenStream>,
    /// The names.
    pub names: BTreeSet<String>,
    /// An expression for each of their scalars.
    pub scalars: Vec<String>,
}

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
            format!("{name}{access}")
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
