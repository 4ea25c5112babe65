//! Stand-ins for the generated items when the function could not be read, so that the compiler
//! reports the mistakes themselves and not the absence of what is used elsewhere.
//!
//! If the signature and the group can be read, the stand-in is the expansion for the first coordinate alone, which offers
//! all that the real one does. Otherwise it is a struct whose methods take any arguments. Neither ever runs: the crate does
//! not compile.

use coadjoint_codegen::diagnostic::nearest;
use coadjoint_codegen::emit::{Items, Options};
use coadjoint_codegen::lie::catalogue;
use coadjoint_codegen::parse::rust;
use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use syn::{Block, FnArg, ItemFn, parse_quote};

use crate::generate::Generate;

/// The expansion that succeeds for the function with its first coordinate for its body, which is at
/// fault nowhere; the stand-in if not even the signature or the group can be read.
pub(crate) fn items(
    arguments: TokenStream,
    function: &ItemFn,
    options: &Options,
    generate: Generate,
    first: &TokenStream,
) -> Items {
    // Of an array or a vector, of an array of arrays, of a matrix.
    let beside = rust::faultless(function);
    let bodies: [Block; 3] = [
        parse_quote!({ #(#beside)* coordinates[0] }),
        parse_quote!({ coordinates[0][0] }),
        parse_quote!({ coordinates[(0, 0)] }),
    ];
    let found = bodies.into_iter().find_map(|body| {
        let mut function = ItemFn { block: Box::new(body), ..function.clone() };
        if let Some(FnArg::Typed(first)) = function.sig.inputs.first_mut() {
            *first.pat = parse_quote!(coordinates);
        }
        attempts(arguments.clone())
            .find_map(|arguments| generate(arguments, &function, options).ok())
    });
    found.unwrap_or_else(|| Items {
        struct_and_methods: stand_in(function, options, first),
        ..Items::default()
    })
}

/// Arguments with which the expansion may succeed: all, or those that say most, or with the group that
/// was probably meant.
fn attempts(arguments: TokenStream) -> impl Iterator<Item = TokenStream> {
    let group_and_chart = only(&arguments, &["group", "chart", "time"]);
    let group = only(&arguments, &["group", "time"]);
    let name = only(&arguments, &["group"]);
    let name: String = name.into_iter().skip(2).map(|token| token.to_string()).collect();
    let name = name.trim_matches(['"', ',']).to_owned();
    let meant =
        nearest(&name, catalogue::names().iter().copied()).map(|name| quote!(group = #name));
    [arguments, group_and_chart, group].into_iter().chain(meant)
}

/// Keeps of the arguments `key = value, …` those with one of these keys.
fn only(arguments: &TokenStream, keys: &[&str]) -> TokenStream {
    let tokens: Vec<TokenTree> = arguments.clone().into_iter().collect();
    let comma = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    let kept = |entry: &&[TokenTree]| {
        entry.first().is_some_and(|key| keys.iter().any(|known| key.to_string() == *known))
    };
    tokens.split_inclusive(comma).filter(kept).flatten().cloned().collect()
}

/// A struct with the methods of an integrator and of a potential, which take whatever they are given.
fn stand_in(function: &ItemFn, options: &Options, first: &TokenStream) -> TokenStream {
    let Options { krate, visibility, name, .. } = options;
    let types = function.sig.inputs.iter().skip(1).filter_map(|argument| match argument {
        FnArg::Typed(typed) => Some(&*typed.ty),
        FnArg::Receiver(_) => None,
    });
    let result = quote!(::core::result::Result);
    let report = quote!(#result<#krate::steps::StepReport<T>, #krate::StepError>);
    quote! {
        #[allow(dead_code)]
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #visibility struct #name<T = f64>(::core::marker::PhantomData<T>);

        const _: () = {
            #[allow(dead_code, unused_variables, clippy::all)]
            impl<T> #name<T> {
                pub const TRUNCATION: usize = 1;
                pub const ORDER: usize = 2;

                pub fn new(#first #(_: #types),*) -> #result<Self, #krate::StepError> {
                    loop {}
                }

                pub fn step(&self) -> T {
                    loop {}
                }

                pub fn energy<V>(&self, _: &V) -> T {
                    loop {}
                }

                pub fn torque<E, V>(&self, _: &E) -> V {
                    loop {}
                }

                pub fn advance<P>(&self, _: &mut P) -> #report {
                    loop {}
                }

                pub fn advance_by<P>(&self, _: &mut P, _: u64) -> #report {
                    loop {}
                }

                pub fn poisson_map<V>(&self, _: &V) -> #result<V, #krate::StepError> {
                    loop {}
                }
            }
        };
    }
}
