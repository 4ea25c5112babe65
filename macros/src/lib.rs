//! The attributes `lie_poisson` and `potential` of the crate `coadjoint`, which re-exports and
//! documents them.
//!
//! This crate only wires: the reading of the function, the derivation and the emission are in
//! `coadjoint-codegen`.

mod arguments;
mod dependency;
mod expansion;
mod fallback;
mod lie_poisson;
mod potential;

/// Turns a function computing a reduced Hamiltonian into an integrator. See
/// `coadjoint::lie_poisson`.
#[proc_macro_attribute]
pub fn lie_poisson(
    arguments: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    lie_poisson::ATTRIBUTE.expand(arguments.into(), item.into()).into()
}

/// Turns a function computing a potential into its torque. See `coadjoint::potential`.
#[proc_macro_attribute]
pub fn potential(
    arguments: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    potential::ATTRIBUTE.expand(arguments.into(), item.into()).into()
}
