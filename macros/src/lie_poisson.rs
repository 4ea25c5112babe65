//! Expansion of `#[lie_poisson]`: read, build, emit.

use proc_macro2::TokenStream;
use syn::ItemFn;

use coadjoint_codegen::emit;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::parse::rust;

use crate::expansion::{self, options};
use crate::fallback;

/// The function itself, followed by its integrator or by the errors.
pub fn expand(arguments: TokenStream, item: TokenStream) -> TokenStream {
    expansion::expand(item, |function| integrator(arguments, function), fallback::lie_poisson)
}

fn integrator(arguments: TokenStream, function: &ItemFn) -> syn::Result<TokenStream> {
    let problem = rust::lie_poisson(arguments, function)?;
    let integrator = Integrator::build(problem, TermLimit::default())
        .map_err(|error| syn::Error::new(function.sig.ident.span(), error))?;
    emit::check_size(&integrator)
        .map_err(|error| syn::Error::new(function.sig.ident.span(), error))?;
    Ok(emit::tokens(&integrator, &options(function)))
}
