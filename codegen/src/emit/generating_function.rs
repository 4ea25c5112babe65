//! The implementation of `coadjoint::GeneratingFunction`.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::body::body;
use super::scope::{Meaning, Orders, Scope};
use super::types::Types;
use super::writer::Body;
use crate::graph::Program;
use crate::integrator::{GradientParts, Integrator, Predictor};
use crate::problem::Solver;

/// `impl GeneratingFunction for name`.
#[must_use]
pub fn generating_function(
    integrator: &Integrator,
    krate: &TokenStream,
    name: &Ident,
    types: &Types,
    scope: &Scope,
) -> TokenStream {
    let Types { dim, group, chart, vector, matrix, .. } = types;
    let all = Orders { first: 1, last: integrator.problem.truncation };
    let kept = Orders { last: integrator.plan.hessian_truncation, ..all };
    let value = scalar_function(&integrator.value, &scope.of(Meaning::Value));
    let gradient = vector_function(&integrator.gradient, vector, &scope.of(Meaning::Gradient(all)));
    let hessian = integrator.hessian.as_ref().map(|program| {
        let scope = scope.of(Meaning::Hessian(all));
        let function = hessian_function(program, *dim, vector, matrix, &scope);
        quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn gradient_and_hessian(&self, input: &#vector) -> (#vector, #matrix) {
                let c = &self.coefficients;
                #function
            }
        }
    });
    let guess = match integrator.plan.predictor {
        Predictor::Explicit(_) => Meaning::Guess,
        Predictor::Flow(_) => Meaning::Increment,
    };
    let predictor = vector_function(&integrator.predictor, vector, &scope.of(guess));
    let predictor = match integrator.plan.predictor {
        Predictor::Explicit(_) => quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn predict(&self, input: &#vector) -> #vector {
                let c = &self.coefficients;
                #predictor
            }
        },
        Predictor::Flow(_) => quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn predict_increment(&self, input: &#vector) -> ::core::option::Option<#vector> {
                let c = &self.coefficients;
                ::core::option::Option::Some({ #predictor })
            }
        },
    };
    let continuation = integrator.continuation.as_ref().map(|program| {
        let twice_even = vector_function(program, vector, &scope.of(Meaning::EvenGuess));
        quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn predict_after(&self, last: &#vector, input: &#vector) -> #vector {
                let c = &self.coefficients;
                let twice_even = { #twice_even };
                twice_even - last
            }
        }
    });
    let newton = integrator.newton.as_ref().map(|program| {
        let scope = scope.of(Meaning::Hessian(kept));
        let function = hessian_function(program, *dim, vector, matrix, &scope);
        quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn newton_model(&self, input: &#vector) -> (#vector, #matrix) {
                let c = &self.coefficients;
                #function
            }
        }
    });
    let lagged = integrator
        .parts
        .as_ref()
        .map(|parts| lagged_model(parts, name, *dim, vector, &scope.of(Meaning::Gradient(kept))));
    let rest = Orders { first: kept.last + 2, ..all };
    let fine_part = integrator
        .parts
        .as_ref()
        .map(|parts| fine_part(&parts.fine, name, *dim, &scope.of(Meaning::Gradient(rest))));
    let wide_step = integrator.parts.as_ref().and_then(|step| wide_step(step, name, types, scope));
    let method = method(integrator, krate, name, wide_step.is_some());
    let last = Literal::usize_unsuffixed(*dim);
    let frame = (!integrator.frame.is_empty()).then(|| {
        let parts = integrator.frame.iter().enumerate().map(|(part, program)| {
            let function = vector_function(program, vector, &scope.of(Meaning::Frame));
            quote!(#part => ::core::option::Option::Some({ #function }),)
        });
        quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn frame(&self, motion: usize, input: &#vector) -> ::core::option::Option<#vector> {
                let c = &self.coefficients;
                match motion {
                    #(#parts)*
                    _ => ::core::option::Option::None,
                }
            }
        }
    });
    // In a comoving frame x is short where S is far from quadratic.
    let of_chart = integrator.problem.is_quadratic() && integrator.problem.comoving.is_none();
    let bend = of_chart.then(|| {
        quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn bend(&self, x: T) -> T {
                x * x * T::of(0.25)
            }
        }
    });
    let defect = (!integrator.defect.is_empty()).then(|| {
        quote! {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn hessian_defect(&self, size: T) -> T {
                #krate::plumbing::polynomial(&self.defect, size)
            }
        }
    });
    let newton_model = (integrator.plan.solver == Solver::Newton).then(|| {
        quote! {
            impl<T: #krate::Scalar> #krate::solve::NewtonModel for #name<T> {
                #newton

                #bend

                #defect
            }
        }
    });
    let judged =
        (integrator.coefficients.last_terms(integrator.problem.truncation) > 0).then(|| {
            quote! {
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn radius(&self) -> T {
                    self.radius
                }

                #[cold]
                fn series_ratio(&self, p: &#vector) -> T {
                    #krate::plumbing::series_ratio::<T, #last>(
                        Self::table(),
                        &self.last,
                        Self::TRUNCATION,
                        &::core::convert::Into::into(*p),
                    )
                }
            }
        });
    quote! {
        #fine_part

        #wide_step

        impl<T: #krate::Scalar> #krate::GeneratingFunction for #name<T> {
            type Group = #group;
            type Chart = #chart;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn group(&self) -> &#group {
                const { &<#group>::new() }
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

            #hessian

            #frame

            #judged
        }

        impl<T: #krate::Scalar> #krate::solve::Predict for #name<T> {
            #predictor

            #continuation
        }

        #newton_model

        #lagged

        #method
    }
}

/// `impl Integrator`: how steps are solved.
fn method(
    integrator: &Integrator,
    krate: &TokenStream,
    name: &Ident,
    in_blocks: bool,
) -> TokenStream {
    let method = |method: TokenStream| {
        quote! {
            impl<T: #krate::Scalar> #krate::Integrator for #name<T> {
                type Method = #krate::solve::#method;

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn apart<R>(&self, seldom: impl ::core::ops::FnOnce(&Self) -> R) -> R {
                    seldom(&::core::clone::Clone::clone(self))
                }
            }
        }
    };
    match (integrator.plan.solver, &integrator.parts) {
        (Solver::FixedPoint, _) => method(quote!(FixedPoint)),
        (Solver::Newton, None) => method(quote!(Newton<Self>)),
        (Solver::Newton, Some(_)) if !in_blocks => method(quote!(LaggedNewton)),
        (Solver::Newton, Some(_)) => {
            // Where registers are narrow, several steps at once take longer than one by one.
            let (several, single) =
                (method(quote!(BlockNewton<Self>)), method(quote!(LaggedNewton)));
            quote! {
                #[cfg(target_feature = "avx2")]
                #several
                #[cfg(not(target_feature = "avx2"))]
                #single
            }
        }
    }
}

/// `impl LaggedModel`, and `impl BlockModel` where steps go in blocks.
fn lagged_model(
    parts: &GradientParts,
    name: &Ident,
    dim: usize,
    vector: &TokenStream,
    scope: &Scope,
) -> TokenStream {
    let Scope { krate, slots, .. } = scope;
    let coarse = vector_function(&parts.coarse, vector, scope);
    let both = Literal::usize_unsuffixed(2 * dim);
    let pair = Scope { input: quote!([T; #both]), ..scope.of(Meaning::Leading) };
    let leading = vector_function(&parts.leading, vector, &pair);
    let n = Literal::usize_unsuffixed(dim);
    let slots = Literal::usize_unsuffixed(*slots);
    let wide_registers = wide_registers();
    let blocks = parts.at_once.as_ref().map(|_| {
        quote! {
            #wide_registers
            impl<T: #krate::Scalar> #krate::solve::BlockModel for #name<T> {
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn linearise(
                    &self,
                    mu: &#vector,
                    substeps: u32,
                    found: &mut #krate::solve::LinearisedOf<Self>,
                ) -> bool {
                    let c = &self.coefficients;
                    #krate::plumbing::linearise::<T, #name<f64>, #slots, #n>(c, mu, substeps, found)
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn refine(&self, found: &mut #krate::solve::LinearisedOf<Self>) -> bool {
                    #krate::plumbing::refine::<T, #name<f64>, #slots, #n>(&self.coefficients, found)
                }
            }
        }
    });
    quote! {
        impl<T: #krate::Scalar> #krate::solve::LaggedModel for #name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn coarse_gradient(&self, input: &#vector) -> #vector {
                let c = &self.coefficients;
                #coarse
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fine_gradient(&self, p: &#vector) -> #vector {
                let fine = <Self as #krate::plumbing::FinePart<T, #slots, #n>>::fine(
                    &self.coefficients,
                    &::core::convert::Into::into(*p),
                );
                ::core::convert::Into::into(fine)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn leading_product(&self, p: &#vector, direction: &#vector) -> #vector {
                let c = &self.coefficients;
                let input: [T; #both] =
                    ::core::array::from_fn(|i| if i < #n { p[i] } else { direction[i - #n] });
                let input = &input;
                #leading
            }
        }

        #blocks
    }
}

/// The fine part of the gradient, over numbers that may be wider than the coefficients.
fn fine_part(program: &Program, name: &Ident, dim: usize, scope: &Scope) -> TokenStream {
    let Scope { krate, slots, .. } = scope;
    let dim = Literal::usize_unsuffixed(dim);
    let wide = Scope { input: quote!([T; #dim]), lifted: true, ..scope.of(scope.meaning) };
    let Body { statements, outputs } = body(program, &wide);
    let slots = Literal::usize_unsuffixed(*slots);
    quote! {
        impl<C: #krate::Scalar> #krate::plumbing::FinePart<C, #slots, #dim> for #name<C> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fine<T: #krate::Scalar + #krate::plumbing::Lift<C>>(
                c: &[C; #slots],
                input: &[T; #dim],
            ) -> [T; #dim] {
                #statements
                [#(#outputs),*]
            }
        }
    }
}

/// Stands before what only builds for wide registers need, or a test that asks for it: elsewhere the
/// compiler does not even read it.
fn wide_registers() -> TokenStream {
    quote!(#[cfg(any(target_feature = "avx2", coadjoint_at_once))])
}

/// The programs of a step over numbers that may be wider than the coefficients.
fn wide_step(
    step: &GradientParts,
    name: &Ident,
    types: &Types,
    scope: &Scope,
) -> Option<TokenStream> {
    let at_once = step.at_once.as_ref()?;
    let Types { dim, group, chart, vector, matrix, .. } = types;
    let Scope { krate, slots, .. } = scope;
    let wide = Scope { input: vector.clone(), lifted: true, ..scope.of(Meaning::Around) };
    let fine = if at_once.fine == step.fine {
        let (n, slots) = (Literal::usize_unsuffixed(*dim), Literal::usize_unsuffixed(*slots));
        quote! {
            ::core::convert::Into::into(<Self as #krate::plumbing::FinePart<C, #slots, #n>>::fine(
                c,
                &::core::convert::Into::into(*input),
            ))
        }
    } else {
        vector_function(&at_once.fine, vector, &wide.of(Meaning::Unnamed))
    };
    let coarse =
        hessian_function(&at_once.coarse, *dim, vector, matrix, &wide.of(Meaning::Unnamed));
    let Body { statements, outputs } = body(&at_once.around, &wide);
    let outputs = vectors(&outputs, *dim, vector);
    let more = Literal::usize_unsuffixed(dim + 1);
    let with_time = Scope { input: quote!([T; #more]), ..wide.of(Meaning::Onwards) };
    let onwards = vector_function(&at_once.onwards, vector, &with_time);
    let dim = Literal::usize_unsuffixed(*dim);
    let slots = Literal::usize_unsuffixed(*slots);
    let number = quote!(#krate::Scalar + #krate::plumbing::Lift<C>);
    let wide_registers = wide_registers();
    Some(quote! {
        #wide_registers
        impl<C: #krate::Scalar> #krate::plumbing::WideStep<C, #slots, #dim> for #name<C> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn onwards<T: #number>(c: &[C; #slots], mu: &#vector, steps: T) -> #vector {
                let input: &[T; #more] =
                    &::core::array::from_fn(|i| if i < #dim { mu[i] } else { steps });
                #onwards
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn around<T: #number>(c: &[C; #slots], input: &#vector) -> [#vector; 2] {
                #statements
                [#(#outputs),*]
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn pulled_back<T: #krate::Scalar>(x: &#vector, mu: &#vector) -> (#vector, #matrix) {
                let group = const { &<#group>::new() };
                <#chart as #krate::Chart<#group>>::pull_back_with_derivative(#chart, group, x, mu)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn coarse<T: #number>(c: &[C; #slots], input: &#vector) -> (#vector, #matrix) {
                #coarse
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fine<T: #number>(c: &[C; #slots], input: &#vector) -> #vector {
                #fine
            }
        }
    })
}

/// The body of a function with one output.
#[must_use]
pub fn scalar_function(program: &Program, scope: &Scope) -> TokenStream {
    let Body { statements, outputs } = body(program, scope);
    quote!(#statements #(#outputs)*)
}

/// The body of a function with as many outputs as `vector` has entries.
#[must_use]
pub fn vector_function(program: &Program, vector: &TokenStream, scope: &Scope) -> TokenStream {
    let Body { statements, outputs } = body(program, scope);
    quote!(#statements <#vector as From<_>>::from([#(#outputs),*]))
}

/// Outputs as vectors, one after the other.
fn vectors(
    outputs: &[TokenStream],
    dim: usize,
    vector: &TokenStream,
) -> impl Iterator<Item = TokenStream> {
    outputs.chunks(dim).map(move |entries| quote!(<#vector as From<_>>::from([#(#entries),*])))
}

fn hessian_function(
    program: &Program,
    dim: usize,
    vector: &TokenStream,
    matrix: &TokenStream,
    scope: &Scope,
) -> TokenStream {
    let Body { statements, outputs } = body(program, scope);
    let (gradient, triangle) = outputs.split_at(dim.min(outputs.len()));
    // Entry (i, j) of an upper triangle, row by row.
    let entry = |i: usize, j: usize| triangle.get(i * dim - i * (i + 1) / 2 + j);
    let columns = (0..dim).map(|j| {
        let column = (0..dim).map(|i| entry(i.min(j), i.max(j)));
        quote!([#(#column),*])
    });
    quote! {
        #statements
        let gradient: #vector = From::from([#(#gradient),*]);
        let hessian: #matrix = From::from([#(#columns),*]);
        (gradient, hessian)
    }
}
