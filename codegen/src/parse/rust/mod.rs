//! Hamiltonians as Rust functions, `#[lie_poisson(group = SO3, truncation = 7)]`, and potentials,
//! `#[potential(group = SO3)]`.
//!
//! The function is run once, with symbols for its arguments: what it computes
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
use crate::expr::{Arena, ExprId};
use crate::pass::{Draft, PotentialDraft, assemble, assemble_potential};
use crate::potential::Potential;
use crate::problem::{Parameter, Problem, Shape};
use evaluate::Evaluator;
use signature::Variable;

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
    let function = Function::read(function, Variable::Momentum, &mut diagnostics);
    // Without a momentum every name would be unknown: one mistake is enough.
    let Some((_, coordinates, coordinates_span)) = function.variable else {
        return Err(diagnostics);
    };
    let draft = Draft {
        name: function.name,
        algebra: arguments.algebra,
        coordinates,
        coordinates_span,
        arena: function.arena,
        hamiltonian: function.energy,
        parameters: function.parameters,
        source: function.source,
        chart: arguments.chart,
        truncation: arguments.truncation,
        solver: arguments.solver,
        frame: arguments.frame,
    };
    assemble(draft, diagnostics)
}

/// Reads `#[potential(arguments)] function`.
///
/// # Errors
/// Every mistake of the arguments, the signature and the body.
pub fn potential(arguments: TokenStream, function: &ItemFn) -> Result<Potential, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let algebra = arguments::potential(arguments, &mut diagnostics);
    let function = Function::read(function, Variable::Element, &mut diagnostics);
    let declared = match function.variable {
        Some((Shape::Grid(rows, columns) | Shape::Matrix(rows, columns), _, span)) => {
            Some(((rows, columns), span))
        }
        _ => return Err(diagnostics),
    };
    let draft = PotentialDraft {
        name: function.name,
        algebra,
        declared,
        arena: function.arena,
        energy: function.energy,
        parameters: function.parameters,
        source: function.source,
    };
    assemble_potential(draft, diagnostics)
}

/// A function as it was read.
struct Function {
    name: String,
    variable: Option<(Shape, Vec<String>, Span)>,
    parameters: Vec<Parameter>,
    arena: Arena,
    energy: Option<(ExprId, Span)>,
    source: String,
}

impl Function {
    fn read(function: &ItemFn, variable: Variable, diagnostics: &mut Diagnostics) -> Self {
        let mut evaluator = Evaluator::new(diagnostics);
        let signature = signature::read(&function.sig, variable, &mut evaluator);
        // Without its variable every name of the body would be unknown.
        let energy = signature.variable.is_some().then(|| evaluator.body(&function.block));
        Self {
            name: function.sig.ident.to_string(),
            variable: signature.variable,
            parameters: signature.parameters,
            arena: evaluator.into_arena(),
            energy: energy.flatten(),
            source: function.block.stmts.iter().map(source).collect::<Vec<_>>().join(" "),
        }
    }
}

/// The user's source text, as far as the compiler tells.
fn source(statement: &syn::Stmt) -> String {
    let tokens = statement.to_token_stream();
    let text = match Span::of(statement) {
        Span::Tokens { first, last } => first.join(last).and_then(|whole| whole.source_text()),
        _ => None,
    };
    text.unwrap_or_else(|| tokens.to_string())
}
