//! What stands in for the generated struct when the function could not be read, so that the compiler
//! reports the mistakes themselves and not its absence.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::{FnArg, ItemFn, Type};

use coadjoint_codegen::emit::camel_case;

/// The struct's name, and the types of the parameters.
fn outline(function: &ItemFn) -> (Ident, Vec<&Type>) {
    let name = Ident::new(&camel_case(&function.sig.ident.to_string()), Span::call_site());
    let types = function.sig.inputs.iter().skip(1).filter_map(|argument| match argument {
        FnArg::Typed(typed) => Some(&*typed.ty),
        FnArg::Receiver(_) => None,
    });
    (name, types.collect())
}

/// In place of a potential.
pub fn potential(function: &ItemFn, krate: &TokenStream) -> TokenStream {
    let (name, types) = outline(function);
    let visibility = &function.vis;
    quote! {
        #[allow(dead_code)]
        #visibility struct #name<T = f64>(::core::marker::PhantomData<T>);

        const _: () = {
            #[allow(dead_code, unused_variables, clippy::all)]
            impl<T> #name<T> {
                pub fn new(#(_: #types),*) -> ::core::result::Result<Self, #krate::StepError> {
                    loop {}
                }

                pub fn energy<E>(&self, g: &E) -> T {
                    loop {}
                }

                pub fn torque<E, V>(&self, g: &E) -> V {
                    loop {}
                }
            }
        };
    }
}

/// In place of an integrator: a struct of the right name whose methods type-check at their uses. It never runs: the crate
/// does not compile.
pub fn lie_poisson(function: &ItemFn, krate: &TokenStream) -> TokenStream {
    let (name, types) = outline(function);
    let visibility = &function.vis;
    quote! {
        #[allow(dead_code)]
        #visibility struct #name<T = f64>(::core::marker::PhantomData<T>);

        const _: () = {
            #[allow(dead_code, unused_variables, clippy::all)]
            impl<T> #name<T> {
                pub fn new(
                    step: T,
                    #(_: #types),*
                ) -> ::core::result::Result<Self, #krate::StepError> {
                    loop {}
                }

                pub fn advance<P>(
                    &self,
                    phase: &mut P,
                ) -> ::core::result::Result<#krate::StepReport<T>, #krate::StepError> {
                    loop {}
                }

                pub fn poisson_map<V>(
                    &self,
                    mu: &V,
                ) -> ::core::result::Result<V, #krate::StepError> {
                    loop {}
                }

                pub fn energy<V>(&self, mu: &V) -> T {
                    loop {}
                }

                pub fn step(&self) -> T {
                    loop {}
                }
            }
        };
    }
}
