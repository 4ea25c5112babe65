//! Turns a function and the arguments of its attribute into items: read, build, emit.

use proc_macro2::TokenStream;
use syn::{Error, ItemFn, Result};

use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::emit::{self, Items, Options};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Kick;
use coadjoint_codegen::parse::rust;
use coadjoint_codegen::step::Origin;

/// The items for a function, given the arguments but `crate`; programs bind names with an underscore at their ends.
pub(crate) type Generate = fn(TokenStream, &ItemFn, &Options) -> Result<Items>;

/// The items of `#[lie_poisson]`.
pub(crate) fn lie_poisson(
    arguments: TokenStream,
    function: &ItemFn,
    options: &Options,
) -> Result<Items> {
    let read = rust::hamiltonian(arguments, function).map_err(Diagnostics::into_syn_error)?;
    let place = function.sig.ident.span();
    let origin = Origin::derive(read, TermLimit::default());
    let origin = origin.map_err(|error| Error::new(place, error))?;
    emit::items_of(&origin, options).map_err(|error| Error::new(place, error))
}

/// The items of `#[potential]`.
pub(crate) fn potential(
    arguments: TokenStream,
    function: &ItemFn,
    options: &Options,
) -> Result<Items> {
    let potential = rust::potential(arguments, function).map_err(Diagnostics::into_syn_error)?;
    let struct_and_methods = emit::kick(&Kick::build(potential), options);
    Ok(Items { struct_and_methods, ..Items::default() })
}
