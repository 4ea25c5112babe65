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
use crate::pass::{Draft, Formula, assemble, assemble_either, assemble_potential};
use crate::potential::Potential;
use crate::problem::{Problem, Shape};
use crate::smooth::Hamiltonian;
pub use drive::{faultless, without_attributes};
use evaluate::Evaluator;
use signature::Variable;

/// Reads `#[lie_poisson(arguments)] function`.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body, each at its tokens.
pub fn lie_poisson(arguments: TokenStream, function: &ItemFn) -> Result<Problem, Diagnostics> {
    assembled(arguments, function, assemble)
}

/// Reads `#[lie_poisson(arguments)] function`, whose Hamiltonian need not be a polynomial.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body, each at its tokens.
pub fn hamiltonian(arguments: TokenStream, function: &ItemFn) -> Result<Hamiltonian, Diagnostics> {
    assembled(arguments, function, assemble_either)
}

fn assembled<T>(
    arguments: TokenStream,
    function: &ItemFn,
    assemble: fn(Draft, &Diagnostics) -> Option<T>,
) -> Result<T, Diagnostics> {
    let diagnostics = Diagnostics::new();
    let (algebra, choice, time) = arguments::read(arguments, Variable::Momentum, &diagnostics);
    let (variable, mut hamiltonian) = read(function, Variable::Momentum, time, &diagnostics);
    // Without a momentum every name would be unknown: one mistake is enough.
    let Some((_, coordinates, coordinates_span)) = variable else { return Err(diagnostics) };
    let name = function.sig.ident.to_string();
    let (parameters, signals) = (&mut hamiltonian.parameters, Vec::new());
    let drive = drive::read(function, algebra.as_ref(), &coordinates, parameters, &diagnostics);
    let draft = Draft {
        name,
        algebra,
        coordinates,
        coordinates_span,
        hamiltonian,
        signals,
        drive,
        breaks: (Vec::new(), Span::Whole),
        choice,
    };
    let assembled = assemble(draft, &diagnostics);
    diagnostics.into_result(assembled)
}

/// Reads `#[potential(arguments)] function`.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body.
pub fn potential(arguments: TokenStream, function: &ItemFn) -> Result<Potential, Diagnostics> {
    let diagnostics = Diagnostics::new();
    let (algebra, ..) = arguments::read(arguments, Variable::Element, &diagnostics);
    drive::refuse(function, &diagnostics);
    let (variable, energy) = read(function, Variable::Element, None, &diagnostics);
    let Some((Shape::Grid(rows, columns) | Shape::Matrix(rows, columns), _, span)) = variable
    else {
        return Err(diagnostics);
    };
    let (name, declared) = (function.sig.ident.to_string(), Some(((rows, columns), span)));
    let potential = assemble_potential(name, algebra, declared, &energy, &diagnostics);
    diagnostics.into_result(potential)
}

/// The shape of a function's first argument, the names of its entries, and where; and the energy that it computes. `time` is
/// the name of the argument that is the time, and where it is said.
fn read(
    function: &ItemFn,
    variable: Variable,
    time: Option<(String, Span)>,
    diagnostics: &Diagnostics,
) -> (Option<(Shape, Vec<String>, Span)>, Formula) {
    let mut evaluator = Evaluator::new(diagnostics);
    let (variable, parameters) = signature::read(&function.sig, variable, time, &mut evaluator);
    // Without its variable every name of the body would be unknown.
    let root = variable.is_some().then(|| evaluator.body(&function.block)).flatten();
    let source = evaluate::source(&function.block);
    (variable, Formula { arena: evaluator.into_arena(), root, parameters, source })
}
