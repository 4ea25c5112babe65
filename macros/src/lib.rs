//! The attributes `lie_poisson` and `potential` of the crate `coadjoint`, which re-exports and
//! documents them.
//!
//! This crate only wires: the reading of the function, the derivation and the emission are in
//! `coadjoint-codegen`.

mod arguments;
mod expansion;
mod fallback;
mod generate;

use quote::quote;

/// Turns a function computing a reduced Hamiltonian into an integrator. See
/// `coadjoint::lie_poisson`.
#[proc_macro_attribute]
pub fn lie_poisson(
    arguments: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    expansion::expand(arguments.into(), item.into(), generate::lie_poisson, quote!(_: T,)).into()
}

/// Turns a function computing a potential into its torque. See `coadjoint::potential`.
#[proc_macro_attribute]
pub fn potential(
    arguments: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    expansion::expand(arguments.into(), item.into(), generate::potential, quote!()).into()
}
