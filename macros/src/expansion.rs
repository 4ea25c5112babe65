//! The work that both attributes share: read the function, keep it, report mistakes.

use coadjoint_codegen::emit;
use coadjoint_codegen::parse::rust;
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::ItemFn;

use crate::arguments::{self, Meta, help_without_runtime};
use crate::fallback;
use crate::generate::Generate;

/// The function itself, followed by what is generated for it, or by the errors and a stand-in, whose `new` takes the
/// argument `first` before the parameters.
pub(crate) fn expand(
    arguments: TokenStream,
    item: TokenStream,
    generate: Generate,
    first: TokenStream,
) -> TokenStream {
    let function: ItemFn = match syn::parse2(item.clone()) {
        Ok(function) => function,
        Err(error) => {
            // Not a function: say so, and leave the item in place.
            let error = error.into_compile_error();
            return quote!(#error #item);
        }
    };
    let (Meta { krate, others }, error) = match arguments::split(arguments) {
        Ok(arguments) => (arguments, None),
        Err(error) => (Meta::default(), Some(error)),
    };
    if krate.is_none()
        && error.is_none()
        && let Some(help) = help_without_runtime()
    {
        // Without the runtime not even a stand-in compiles.
        let error = syn::Error::new(proc_macro2::Span::call_site(), help).into_compile_error();
        return quote!(#[allow(dead_code)] #function #error);
    }
    let options = options(&function, krate.unwrap_or_else(|| quote!(::coadjoint)));
    let generated = match error {
        Some(error) => Err(error),
        None => generate(others.clone(), &function, &options),
    };
    let emit::Items { struct_and_methods, programs, .. } = generated.unwrap_or_else(|errors| {
        let errors = errors.into_compile_error();
        let items = fallback::items(others, &function, &options, generate, &first);
        let own = items.struct_and_methods;
        emit::Items { struct_and_methods: quote!(#errors #own), ..items }
    });
    let function = rust::without_attributes(function);
    // Many users only want what is generated; then the function is not dead code either.
    quote!(#[allow(dead_code)] #function #struct_and_methods #programs)
}

/// Named after the function, as visible as it, with its doc comments.
fn options(function: &ItemFn, krate: TokenStream) -> emit::Options {
    let name = &function.sig.ident;
    let docs = function.attrs.iter().filter(|attribute| attribute.path().is_ident("doc"));
    emit::Options {
        krate,
        visibility: function.vis.to_token_stream(),
        name: Ident::new(&emit::camel_case(&name.to_string()), name.span()),
        attributes: quote!(#(#docs)*),
        suffix: "_",
    }
}
