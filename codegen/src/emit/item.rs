//! The struct of an integrator and its implementations.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::generating_function::{
    generating_function, scalar_function, solver, without_programs,
};
use crate::emit::group::Types;
use crate::emit::header::Method;
use crate::emit::programs::{MOST_OPERATIONS, programs, step_operations};
use crate::emit::table::{fold_item, last_item};
use crate::emit::{Options, allow, fresh, header, identifier, parameter};
use crate::integrator::{FoldTable, Integrator, Kicks};
use crate::problem::{Parameter, Shape, Symbol};
use crate::smooth::Facts;
use crate::step::{Step, StepError};

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

/// What the items of an integrator differ in by its method.
pub(super) struct Parts<'a> {
    pub facts: Facts<'a>,
    pub method: Method<'a>,
    pub symbols: &'a [Symbol],
    pub types: Types,
    pub fold: FoldTable,
    pub order: usize,
    /// The programs of the step, where they are printed.
    pub step: Option<Step>,
    /// Lines about the truncation, and about the coefficients.
    pub about: [&'static str; 2],
    /// The steps that lanes make together, where these are not a block.
    pub together: Option<TokenStream>,
    /// The value of the Hamiltonian from `mu`, `c` and the time.
    pub energy: TokenStream,
    /// More methods.
    pub methods: TokenStream,
    /// The implementations that make its steps, and what these need.
    pub programs: TokenStream,
}

/// A step if it is short enough to be printed, and no kicks belong to it, which are items of their own.
pub(super) fn printed(step: Result<Step, StepError>) -> Option<Step> {
    let step = step.ok()?;
    let short = step.kernel().flows().is_none() && step_operations(&step) <= MOST_OPERATIONS;
    short.then_some(step)
}

/// The integrator as items, its programs and tables apart.
#[must_use]
pub fn items(integrator: &Integrator, options: &Options) -> Items {
    let Options { krate, .. } = options;
    let problem = &integrator.problem;
    let types = Types::new(&problem.algebra, problem.chart, options);
    let Types { vector, elements, .. } = &types;
    let step = printed(Step::by_series(integrator, *elements));
    let fold = FoldTable::new(integrator);
    let programs = match &step {
        Some(step) => programs(step, options, &types.group, &solver(integrator, krate)),
        None => without_programs(integrator, options, &types),
    };
    let generating = generating_function(integrator, options, &types, fold.len());
    let last = last_item(integrator);
    let mu = options.bound("mu");
    let parts = Parts {
        facts: problem.facts(),
        method: Method::of_series(integrator),
        symbols: &problem.symbols,
        fold,
        order: integrator.order(),
        step,
        about: [
            " K: the series S₁ … S_K of the generating function is kept.",
            " The coefficients of the programs below, folded for h and the parameters; after them those of the bound on \
             what is left out of the Hessian, the square of the |μ| up to which the series can be trusted, and the \
             coefficients of its last two terms.",
        ],
        together: None,
        energy: scalar_function(&integrator.energy, options, "mu"),
        methods: quote! {
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
        },
        programs: quote!(#programs #generating #last),
        types,
    };
    let kicks = integrator.kicks.as_ref();
    Items {
        legend: header::legend(&integrator.coefficients),
        ..assemble(&parts, Some(integrator), kicks, options)
    }
}

/// The items of these parts, without a legend; those of a series say more of it.
pub(super) fn assemble(
    parts: &Parts<'_>,
    series: Option<&Integrator>,
    kicks: Option<&Kicks>,
    options: &Options,
) -> Items {
    let Options { krate, visibility, name, attributes, .. } = options;
    let Parts { facts, method, types, fold, step, energy, methods, programs, .. } = parts;
    let Types { group, vector, definition, tables, aliases, .. } = types;
    let summary = header::lines(*facts, method, series, step.as_ref());
    let blank = (!attributes.is_empty()).then(|| quote!(#[doc = ""]));
    let index = Literal::usize_unsuffixed;
    let (slots, n, symbols) = (index(fold.len()), index(types.dim), index(parts.symbols.len()));
    let (truncation, order) = (index(facts.truncation), index(parts.order));
    let [of_truncation, of_coefficients] = parts.about;
    let constructor = constructor(parts, options);
    let lanes = (!method.moves).then(|| lanes(parts, options));
    let table = fold_item(fold);
    let allow = allow();
    let names = ["mu", "c", "phase", "steps", "error", "stopped", "time"];
    let [mu, c, phase, steps, error, stopped, time] = names.map(|name| options.bound(name));
    let bound = bound(method.moves, krate);
    // If H depends on the time, methods take the time of the state.
    let (argument, now, then) = match method.moves {
        true => (
            Some(quote!(#time: T,)),
            quote!(#time),
            quote!(#time + T::of(#stopped.steps as f64) * self.step),
        ),
        false => (None, quote!(T::of(0.0)), quote!(T::of(0.0))),
    };
    let of = if method.moves { "(t, μ)" } else { "(μ)" };
    let reduced =
        format!(" The reduced Hamiltonian H_red{of}, with the parameters given at construction.");
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
            #[doc = #of_coefficients]
            coefficients: [T; #slots],
        }

        #allow
        const _: () = {
            #aliases

            impl<T: #bound> #name<T> {
                #[doc = #of_truncation]
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
                    #argument
                ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::StepError> {
                    plumbing::advance_at(self, #phase, #now)
                        .map_err(|#error| self.advise(#error, #phase, #now))
                }

                /// Advances (g, μ) by `steps` steps, faster than one by one; the report is of the
                /// worst of them, and on error `phase` is left before the step that failed.
                ///
                /// # Errors
                /// `Stopped`: how many steps were made, and why the next was not.
                pub fn advance_by(
                    &self,
                    #phase: &mut #krate::Phase<#group>,
                    #argument
                    #steps: u64,
                ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::steps::Stopped> {
                    plumbing::advance_from(self, #phase, #now, #steps).map_err(|#stopped| {
                        #krate::steps::Stopped {
                            error: self.advise(#stopped.error, #phase, #then),
                            ..#stopped
                        }
                    })
                }

                #methods
            }
        };
    };
    let programs = quote! {
        #allow
        const _: () = {
            #aliases

            #programs

            #lanes

            impl<T: #bound> #name<T> {
                #[doc = #reduced]
                #[inline]
                pub fn energy(&self, #argument #mu: &#vector) -> T {
                    let (#mu, #c): (&[T; #n], _) = (&#mu.data.0[0], &self.coefficients);
                    #energy
                }

                fn table() -> &'static #krate::plumbing::Fold<'static> {
                    &FOLD
                }
            }

            #table
        };

        #tables
    };
    let opening = header::opening(*facts, method, kicks, options, step.as_ref());
    Items { opening, struct_and_methods, programs, legend: Vec::new() }
}

/// The bound of numbers; those of 32 bits could not tell the times within a step apart.
pub(super) fn bound(moves: bool, krate: &TokenStream) -> TokenStream {
    if moves { quote!(#krate::Scalar<Element = f64>) } else { quote!(#krate::Scalar) }
}

/// `impl Lanes`: steps in lanes, where the programs of the step are printed.
fn lanes(parts: &Parts<'_>, options: &Options) -> TokenStream {
    let Options { krate, name, .. } = options;
    let names = ["registers", "phases", "asked", "state", "run", "c"];
    let [registers, phases, asked, state, run, c] = names.map(|name| options.bound(name));
    let together = parts.together.as_ref().map(|most| quote!(const TOGETHER: u64 = #most;));
    let drive = parts.step.as_ref().map(|_| {
        quote! {
            #together

            #[inline(always)]
            fn drive_lanes<R: #krate::plumbing::Registers>(
                &self,
                #registers: R,
                #phases: &mut [(usize, &mut #krate::Phase<<Self as plumbing::Steps>::Group>)],
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
fn constructor(parts: &Parts<'_>, options: &Options) -> TokenStream {
    let krate = &options.krate;
    let Parts { facts, symbols: all, types, fold, .. } = parts;
    let group = &types.group;
    let names = ["step", "symbols", "coefficients", "error", "phase", "time"];
    let [own, given, coefficients, error, phase, time] = names.map(|name| options.bound(name));
    let Arguments { arguments, names, scalars } = arguments(facts.parameters, krate);
    let step = format_ident!("{}", fresh(&own.to_string(), &names));
    let symbols = parameter::symbols(all, &scalars);
    let symbols = quote!([#(#symbols),*]);
    let texts = all.iter().map(|s| &s.text);
    let [count, room] = [all.len(), fold.lists().room()].map(Literal::usize_unsuffixed);
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
            #time: T,
        ) -> #krate::StepError {
            #krate::plumbing::advise(#error, #phase, [#time, self.step], |#own| {
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
