//! Hamiltonians as Rust functions: `#[lie_poisson(group = SO3, truncation = 7)]`.
//!
//! The function is run once, with symbols for the momentum and the parameters: what it computes
//! along the way becomes an expression. So every body works whose course is known beforehand:
//! `let`, patterns, constants, literal loops, iterator chains, closures.

mod algebra;
mod arguments;
mod evaluate;
mod function;
mod iterate;
mod method;
mod operate;
mod pattern;
mod place;
mod scope;
mod signature;
mod statement;
mod value;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::ItemFn;

use crate::diagnostic::{Diagnostics, Span};
use crate::pass::{Draft, assemble};
use crate::problem::Problem;
use evaluate::Evaluator;

/// Reads `#[lie_poisson(arguments)] function`.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body, each at its tokens.
pub fn lie_poisson(arguments: TokenStream, function: &ItemFn) -> syn::Result<Problem> {
    read(arguments, function).map_err(Diagnostics::into_syn_error)
}

/// As [`lie_poisson`], with the mistakes as data.
///
/// # Errors
/// As [`lie_poisson`].
pub fn read(arguments: TokenStream, function: &ItemFn) -> Result<Problem, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let arguments = arguments::read(arguments, &mut diagnostics);
    let mut evaluator = Evaluator::new(&mut diagnostics);
    let signature = signature::read(&function.sig, &mut evaluator);
    // Without a momentum every name would be unknown: one mistake is enough.
    let hamiltonian = signature.coordinates.is_some().then(|| evaluator.body(&function.block));
    let arena = evaluator.into_arena();
    if signature.coordinates.is_none() {
        return Err(diagnostics);
    }
    let (coordinates, coordinates_span) = signature.coordinates.unwrap_or_default();
    let draft = Draft {
        name: function.sig.ident.to_string(),
        algebra: arguments.algebra,
        coordinates,
        coordinates_span,
        arena,
        hamiltonian: hamiltonian.flatten(),
        parameters: signature.parameters,
        source: function.block.stmts.iter().map(source).collect::<Vec<_>>().join(" "),
        chart: arguments.chart,
        truncation: arguments.truncation,
    };
    assemble(draft, diagnostics)
}

/// What the user wrote, as far as the compiler tells.
fn source(statement: &syn::Stmt) -> String {
    let tokens = statement.to_token_stream();
    let text = match Span::of(statement) {
        Span::Tokens { first, last } => first.join(last).and_then(|whole| whole.source_text()),
        _ => None,
    };
    text.unwrap_or_else(|| tokens.to_string())
}
