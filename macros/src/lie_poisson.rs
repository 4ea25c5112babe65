//! Expansion of `#[lie_poisson]`: read, build, emit.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ItemFn;

use coadjoint_codegen::emit;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::parse::rust;

use crate::expansion::Attribute;
use crate::fallback;

/// The attribute.
pub(crate) const ATTRIBUTE: Attribute = Attribute { generate, stand_in };

fn generate(
    arguments: TokenStream,
    function: &ItemFn,
    options: &emit::Options,
) -> syn::Result<emit::Items> {
    let problem = rust::lie_poisson(arguments, function)?;
    let integrator = Integrator::build(problem, TermLimit::default())
        .map_err(|error| syn::Error::new(function.sig.ident.span(), error))?;
    emit::check_size(&integrator)
        .map_err(|error| syn::Error::new(function.sig.ident.span(), error))?;
    Ok(emit::items(&integrator, options))
}

/// The expansion for a Hamiltonian that is at fault nowhere; if not even the signature or the group
/// can be read, methods that take whatever they are given.
fn stand_in(arguments: TokenStream, function: &ItemFn, options: &emit::Options) -> TokenStream {
    fallback::expansion(&arguments, function, |arguments, function| {
        let emit::Items { struct_and_methods, programs, .. } =
            generate(arguments, function, options)?;
        Ok(quote!(#struct_and_methods #programs))
    })
    .unwrap_or_else(|| fallback::lie_poisson(function, options))
}
