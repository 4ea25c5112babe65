//! What stands in for the integrator when the function could not be read, so that the compiler
//! reports the mistakes themselves and not the integrator's absence.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::{FnArg, ItemFn};

use coadjoint_codegen::emit::camel_case;

/// A struct of the right name whose methods type-check at their uses. It never runs: the crate
/// does not compile.
pub fn fallback(function: &ItemFn, krate: &TokenStream) -> TokenStream {
    let name = Ident::new(&camel_case(&function.sig.ident.to_string()), Span::call_site());
    let visibility = &function.vis;
    let types = function.sig.inputs.iter().skip(1).filter_map(|argument| match argument {
        FnArg::Typed(typed) => Some(&typed.ty),
        FnArg::Receiver(_) => None,
    });
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
