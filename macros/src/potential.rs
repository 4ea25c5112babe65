//! Expansion of `#[potential]`: read, derive, emit.

use proc_macro2::TokenStream;
use syn::ItemFn;

use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::emit;
use coadjoint_codegen::integrator::Kick;
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
    let potential = rust::potential(arguments, function).map_err(Diagnostics::into_syn_error)?;
    let struct_and_methods = emit::kick(&Kick::build(potential), options);
    Ok(emit::Items { struct_and_methods, ..emit::Items::default() })
}

/// The expansion for a potential that is at fault nowhere; if not even the signature or the group
/// can be read, methods that take whatever they are given.
fn stand_in(arguments: TokenStream, function: &ItemFn, options: &emit::Options) -> TokenStream {
    fallback::expansion(&arguments, function, |arguments, function| {
        generate(arguments, function, options).map(|items| items.struct_and_methods)
    })
    .unwrap_or_else(|| fallback::potential(function, options))
}
