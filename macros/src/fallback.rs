//! What stands in for the generated items when the function could not be read, so that the compiler
//! reports the mistakes themselves and not the absence of what is used elsewhere.
//!
//! Where the signature and the group can be read, it is the expansion for the constant 0, which offers
//! all that the real one does. Otherwise it is a struct whose methods take whatever they are given.
//! Neither ever runs: the crate does not compile.

use coadjoint_codegen::diagnostic::nearest;
use coadjoint_codegen::emit::Options;
use coadjoint_codegen::lie::catalogue;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use syn::{FnArg, ItemFn, Type, parse_quote};

/// The function with 0 for its body.
pub fn without_body(function: &ItemFn) -> ItemFn {
    ItemFn { block: parse_quote!({ 0.0 }), ..function.clone() }
}

/// Arguments with which the expansion may succeed: all, or those that say most, or with the group that
/// was probably meant.
pub fn attempts(arguments: TokenStream) -> impl Iterator<Item = TokenStream> {
    let group_and_chart = only(&arguments, &["group", "chart"]);
    let group = only(&arguments, &["group"]);
    let name: String = group.clone().into_iter().skip(2).map(|token| token.to_string()).collect();
    let name = name.trim_matches(['"', ',']).to_owned();
    let meant =
        nearest(&name, catalogue::names().iter().copied()).map(|name| quote!(group = #name));
    [arguments, group_and_chart, group].into_iter().chain(meant)
}

/// Those of the arguments `key = value, …` with one of these keys.
fn only(arguments: &TokenStream, keys: &[&str]) -> TokenStream {
    let tokens: Vec<TokenTree> = arguments.clone().into_iter().collect();
    let comma = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    let kept = |entry: &&[TokenTree]| {
        entry.first().is_some_and(|key| keys.iter().any(|known| key.to_string() == *known))
    };
    tokens.split_inclusive(comma).filter(kept).flatten().cloned().collect()
}

/// The types of the parameters.
fn types(function: &ItemFn) -> Vec<&Type> {
    let inputs = function.sig.inputs.iter().skip(1);
    let ty = |argument| match argument {
        &FnArg::Typed(ref typed) => Some(&*typed.ty),
        FnArg::Receiver(_) => None,
    };
    inputs.filter_map(ty).collect()
}

/// In place of a potential.
pub fn potential(function: &ItemFn, options: &Options) -> TokenStream {
    let Options { krate, visibility, name, .. } = options;
    let types = types(function);
    quote! {
        #[allow(dead_code)]
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
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

/// In place of an integrator.
pub fn lie_poisson(function: &ItemFn, options: &Options) -> TokenStream {
    let Options { krate, visibility, name, .. } = options;
    let types = types(function);
    let result = quote!(::core::result::Result);
    quote! {
        #[allow(dead_code)]
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #visibility struct #name<T = f64>(::core::marker::PhantomData<T>);

        const _: () = {
            #[allow(dead_code, unused_variables, clippy::all)]
            impl<T> #name<T> {
                pub const TRUNCATION: usize = 1;
                pub const ORDER: usize = 2;

                pub fn new(step: T, #(_: #types),*) -> #result<Self, #krate::StepError> {
                    loop {}
                }

                pub fn tuned<M>(
                    step: T,
                    #(_: #types,)*
                    momenta: M,
                ) -> #result<Self, #krate::StepError> {
                    loop {}
                }

                pub fn step(&self) -> T {
                    loop {}
                }

                pub fn energy<V>(&self, mu: &V) -> T {
                    loop {}
                }

                pub fn advance<P>(
                    &self,
                    phase: &mut P,
                ) -> #result<#krate::StepReport<T>, #krate::StepError> {
                    loop {}
                }

                pub fn advance_by<P>(
                    &self,
                    phase: &mut P,
                    steps: u64,
                ) -> #result<#krate::StepReport<T>, #krate::StepError> {
                    loop {}
                }

                pub fn poisson_map<V>(&self, mu: &V) -> #result<V, #krate::StepError> {
                    loop {}
                }
            }
        };
    }
}
