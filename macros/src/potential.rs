//! Expansion of `#[potential]`: read, derive, emit.

use proc_macro2::TokenStream;
use syn::ItemFn;

use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::emit;
use coadjoint_codegen::integrator::Kick;
use coadjoint_codegen::parse::rust;

use crate::expansion::{self, options};
use crate::fallback;

/// The function itself, followed by its torque or by the errors.
pub fn expand(arguments: TokenStream, item: TokenStream) -> TokenStream {
    expansion::expand(item, |function| kick(arguments, function), fallback::potential)
}

fn kick(arguments: TokenStream, function: &ItemFn) -> syn::Result<TokenStream> {
    let potential = rust::potential(arguments, function).map_err(Diagnostics::into_syn_error)?;
    Ok(emit::kick(&Kick::build(potential), &options(function)))
}
