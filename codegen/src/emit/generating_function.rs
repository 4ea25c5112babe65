//! The implementation of `coadjoint::GeneratingFunction`.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::program::{Rust, list, tuple};
use crate::emit::Options;
use crate::emit::group::Types;
use crate::graph::Program;
use crate::integrator::{FoldTable, Integrator, Predictor};
use crate::problem::Solver;

/// `impl GeneratingFunction for name`; `slots` is the number of coefficients.
pub(crate) fn generating_function(
    integrator: &Integrator,
    options: &Options,
    types: &Types,
    slots: usize,
) -> TokenStream {
    let Options { krate, name, .. } = options;
    let [p, mu, c, motion] = ["p", "mu", "c", "motion"].map(|name| options.bound(name));
    let Types { dim, group, chart, vector, matrix, .. } = types;
    let value = scalar_function(&integrator.value, options, "p");
    let gradient = vector_function(&integrator.gradient, vector, options, "p");
    let index = Literal::usize_unsuffixed;
    let n = index(*dim);
    let hessian = integrator.hessian.as_ref().map(|program| {
        let function = hessian_function(program, types, options);
        quote! {
            #[inline(never)]
            fn gradient_and_hessian(&self, #p: &#vector) -> (#vector, #matrix) {
                let (#p, #c): (&[T; #n], _) = (&#p.data.0[0], &self.coefficients);
                #function
            }
        }
    });
    let frame = (!integrator.frame.is_empty()).then(|| {
        let parts = integrator.frame.iter().enumerate().map(|(part, program)| {
            let function = vector_function(program, vector, options, "mu");
            quote!(#part => ::core::option::Option::Some({ #function }),)
        });
        quote! {
            fn frame(&self, #motion: usize, #mu: &#vector) -> ::core::option::Option<#vector> {
                let (#mu, #c): (&[T; #n], _) = (&#mu.data.0[0], &self.coefficients);
                match #motion {
                    #(#parts)*
                    _ => ::core::option::Option::None,
                }
            }
        }
    });
    let radius_at = FoldTable::radius_at(integrator);
    let (last_at, radius) = (index(radius_at + 1), index(radius_at));
    let judged = (slots > radius_at + 1).then(|| {
        quote! {
            #[inline]
            fn radius(&self) -> T {
                #krate::nalgebra::SimdComplexField::simd_sqrt(self.coefficients[#radius])
            }

            fn series_ratio(&self, #p: &#vector) -> T {
                #krate::plumbing::series_ratio::<T, #n>(
                    &LAST,
                    &self.coefficients[#last_at..],
                    &#p.data.0[0],
                )
            }
        }
    });
    let units = unit(&integrator.units);
    let largest_rate = integrator.largest_rate.map(|rate| {
        quote! {
            #[inline]
            fn largest_rate(&self) -> f64 {
                #rate
            }
        }
    });
    quote! {
        impl<T: #krate::Scalar> #krate::GeneratingFunction for #name<T> {
            type Group = #group;
            type Chart = #chart;

            #[inline(always)]
            fn group(&self) -> &#group {
                const { &<#group>::new() }
            }

            fn value(&self, #p: &#vector) -> T {
                let (#p, #c): (&[T; #n], _) = (&#p.data.0[0], &self.coefficients);
                #value
            }

            fn gradient(&self, #p: &#vector) -> #vector {
                let (#p, #c): (&[T; #n], _) = (&#p.data.0[0], &self.coefficients);
                #gradient
            }

            #hessian

            #frame

            #judged

            #units

            #largest_rate
        }
    }
}

/// The method that names the solver; none if the dimension implies it.
pub(crate) fn solver(integrator: &Integrator, krate: &TokenStream) -> TokenStream {
    let solver = integrator.problem.solver();
    if solver == Solver::of_dimension(integrator.problem.algebra.dim()) {
        return TokenStream::new();
    }
    let name = format_ident!("{solver:?}");
    quote! {
        fn solver(&self) -> #krate::solve::Solver {
            #krate::solve::Solver::#name
        }
    }
}

/// `impl Integrator` of a function whose steps are too long to be printed.
pub(crate) fn without_programs(
    integrator: &Integrator,
    options: &Options,
    types: &Types,
) -> TokenStream {
    let Options { krate, name, .. } = options;
    let [at, mu, c, x, group] = ["at", "mu", "c", "x", "group"].map(|name| options.bound(name));
    let Types { vector, chart, dim, .. } = types;
    let n = Literal::usize_unsuffixed(*dim);
    let guess = vector_function(&integrator.predictor, vector, options, "mu");
    let guess = match integrator.plan.predictor {
        Predictor::Explicit(_) => guess,
        Predictor::Flow(_) => quote! {
            let #x = { #guess };
            let #group = #krate::GeneratingFunction::group(self);
            #krate::groups::Chart::pull_back(#chart, #group, &#x, #at)
        },
    };
    let solver = solver(integrator, krate);
    quote! {
        impl<T: #krate::Scalar> #krate::solve::Integrator for #name<T> {
            #solver

            fn predict(&self, #at: &#vector) -> #vector {
                let (#mu, #c): (&[T; #n], _) = (&#at.data.0[0], &self.coefficients);
                #guess
            }
        }
    }
}

/// The body of a function with one output; it reads `input` and `c`.
pub(crate) fn scalar_function(program: &Program, options: &Options, input: &str) -> TokenStream {
    Rust::alone(options.suffix).block(program, input, tuple)
}

/// The body of a function with as many outputs as `vector` has entries.
pub(crate) fn vector_function(
    program: &Program,
    vector: &TokenStream,
    options: &Options,
    input: &str,
) -> TokenStream {
    let result = |outputs: &[String]| format!("<{vector} as From<_>>::from({})", list(outputs));
    Rust::alone(options.suffix).block(program, input, result)
}

fn hessian_function(program: &Program, types: &Types, options: &Options) -> TokenStream {
    let Types { dim, vector, matrix, .. } = types;
    let dim = *dim;
    Rust::alone(options.suffix).block(program, "p", |outputs| {
        let (gradient, triangle) = outputs.split_at(dim.min(outputs.len()));
        // Entry (i, j) of an upper triangle, row by row.
        let entry = |i: usize, j: usize| triangle.get(i * dim - i * (i + 1) / 2 + j);
        let column = |j: usize| list((0..dim).filter_map(|i| entry(i.min(j), i.max(j))));
        let columns: Vec<String> = (0..dim).map(column).collect();
        format!("(<{vector}>::from({}), <{matrix}>::from({}))", list(gradient), list(&columns))
    })
}

/// The method that gives the factors of coordinates where sizes are compared, where these are not 1.
pub(super) fn unit(units: &[f64]) -> Option<TokenStream> {
    let n = Literal::usize_unsuffixed(units.len());
    units.iter().any(|unit| *unit != 1.0).then(|| {
        quote! {
            #[inline]
            fn unit(&self, i: usize) -> f64 {
                const UNITS: [f64; #n] = [#(#units),*];
                UNITS[i]
            }
        }
    })
}
