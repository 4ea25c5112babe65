//! The attribute `lie_poisson` of the crate `coadjoint`, which re-exports and documents it.
//!
//! This crate only wires: the reading of the function, the derivation and the emission are in
//! `coadjoint-codegen`.

mod fallback;
mod lie_poisson;

/// Turns a function computing a reduced Hamiltonian into an integrator. See
/// `coadjoint::lie_poisson`.
#[proc_macro_attribute]
pub fn lie_poisson(
    arguments: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    lie_poisson::expand(arguments.into(), item.into()).into()
}
