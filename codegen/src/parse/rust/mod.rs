//! Hamiltonians as Rust functions, `#[lie_poisson(group = SO3, truncation = 7)]`, and potentials,
//! `#[potential(group = SO3)]`.
//!
//! The function is run once, with symbols for its arguments: what it computes
//! along the way becomes an expression. The subset of Rust that is read is documented at
//! `coadjoint::lie_poisson`.

mod algebra;
mod arguments;
mod drive;
mod evaluate;
mod signature;
mod value;

use proc_macro2::TokenStream;
use syn::ItemFn;

use crate::diagnostic::{Diagnostics, Span};
use crate::pass::{Draft, assemble_either, assemble_potential};
use crate::potential::Potential;
use crate::smooth::Hamiltonian;
pub use drive::{faultless, without_attributes};
use signature::{ELEMENT, MOMENTUM};

/// Reads `#[lie_poisson(arguments)] function`, whose Hamiltonian need not be a polynomial.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body, each at its tokens.
pub fn hamiltonian(arguments: TokenStream, function: &ItemFn) -> Result<Hamiltonian, Diagnostics> {
    let diagnostics = Diagnostics::new();
    let (algebra, choice, time) = arguments::read(arguments, &MOMENTUM, &diagnostics);
    let (variable, mut hamiltonian) = signature::read(function, &MOMENTUM, time, &diagnostics);
    // Without a momentum every name would be unknown: one mistake is enough.
    let Some((_, coordinates, coordinates_span)) = variable else { return Err(diagnostics) };
    let parameters = &mut hamiltonian.parameters;
    let drive = drive::read(function, algebra.as_ref(), &coordinates, parameters, &diagnostics);
    let draft = Draft {
        name: function.sig.ident.to_string(),
        algebra,
        coordinates,
        coordinates_span,
        hamiltonian,
        signals: Vec::new(),
        drive,
        breaks: (Vec::new(), Span::Whole),
        choice,
    };
    let assembled = assemble_either(draft, &diagnostics);
    diagnostics.into_result(assembled)
}

/// Reads `#[potential(arguments)] function`.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body.
pub fn potential(arguments: TokenStream, function: &ItemFn) -> Result<Potential, Diagnostics> {
    let diagnostics = Diagnostics::new();
    let (algebra, ..) = arguments::read(arguments, &ELEMENT, &diagnostics);
    drive::refuse(function, &diagnostics);
    let (variable, energy) = signature::read(function, &ELEMENT, None, &diagnostics);
    let Some((shape, _, span)) = variable else { return Err(diagnostics) };
    let declared = <[usize; 2]>::try_from(shape.lengths()).ok().map(|[m, n]| ((m, n), span));
    let name = function.sig.ident.to_string();
    let potential = assemble_potential(name, algebra, declared, &energy, &diagnostics);
    diagnostics.into_result(potential)
}
