//! What both attributes do around their own work: read the function, keep it, report mistakes.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::ItemFn;

use coadjoint_codegen::emit;

/// The function itself, followed by what `generate` makes of it, or by the errors and a stand-in.
pub fn expand(
    item: TokenStream,
    generate: impl FnOnce(&ItemFn) -> syn::Result<TokenStream>,
    fallback: impl FnOnce(&ItemFn, &TokenStream) -> TokenStream,
) -> TokenStream {
    let function: ItemFn = match syn::parse2(item.clone()) {
        Ok(function) => function,
        Err(error) => {
            // Not a function: say so, and leave the item in place.
            let error = error.into_compile_error();
            return quote!(#error #item);
        }
    };
    let generated = match generate(&function) {
        Ok(tokens) => tokens,
        Err(errors) => {
            let errors = errors.into_compile_error();
            let stand_in = fallback(&function, &quote!(::coadjoint));
            quote!(#errors #stand_in)
        }
    };
    // Many users only want what is generated; then the function is not dead code either.
    quote!(#[allow(dead_code)] #function #generated)
}

/// Named after the function, as visible as it, with its doc comments.
pub fn options(function: &ItemFn) -> emit::Options {
    let name = &function.sig.ident;
    let docs = function.attrs.iter().filter(|attribute| attribute.path().is_ident("doc"));
    emit::Options {
        krate: quote!(::coadjoint),
        visibility: function.vis.to_token_stream(),
        name: Ident::new(&emit::camel_case(&name.to_string()), name.span()),
        attributes: quote!(#(#docs)*),
    }
}
