//! Expansion: read, build, emit; on any mistake, report all of them and keep the function.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::ItemFn;

use coadjoint_codegen::emit;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::parse::rust;

use crate::fallback::fallback;

/// The function itself, followed by its integrator or by the errors.
pub fn expand(arguments: TokenStream, item: TokenStream) -> TokenStream {
    let function: ItemFn = match syn::parse2(item.clone()) {
        Ok(function) => function,
        Err(error) => {
            // Not a function: say so, and leave the item in place.
            let error = error.into_compile_error();
            return quote!(#error #item);
        }
    };
    let generated = match integrator(arguments, &function) {
        Ok(tokens) => tokens,
        Err(errors) => {
            let errors = errors.into_compile_error();
            let stand_in = fallback(&function, &quote!(::coadjoint));
            quote!(#errors #stand_in)
        }
    };
    // Many users only want the integrator; then the function is not dead code either.
    quote!(#[allow(dead_code)] #function #generated)
}

fn integrator(arguments: TokenStream, function: &ItemFn) -> syn::Result<TokenStream> {
    let problem = rust::lie_poisson(arguments, function)?;
    let span = function.sig.ident.span();
    let name = Ident::new(&emit::camel_case(&function.sig.ident.to_string()), span);
    let integrator = Integrator::build(problem, TermLimit::default())
        .map_err(|error| syn::Error::new(span, error))?;
    let docs = function.attrs.iter().filter(|attribute| attribute.path().is_ident("doc"));
    let options = emit::Options {
        krate: quote!(::coadjoint),
        visibility: function.vis.to_token_stream(),
        name,
        attributes: quote!(#(#docs)*),
    };
    Ok(emit::tokens(&integrator, &options))
}
