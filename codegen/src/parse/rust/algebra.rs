//! An algebra written into the attribute: `group = algebra(basis = [[[0, -1], [1, 0]]])`, or
//! `group = algebra(generators = [a, b, c], brackets = ["[a, b] = c", "[a, c] = -1/2*b"])`.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ExprArray, ExprCall};

use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::lie::{LieAlgebra, LieAlgebraError, RationalMatrix, catalogue};
use crate::parse::{Names, bracket, fraction, rows};

const KEYS: [&str; 3] = ["basis", "generators", "brackets"];
const EXAMPLE: &str = "write for example algebra(basis = [[[0, -1], [1, 0]]]) or \
                       algebra(generators = [a, b, c], brackets = [\"[a, b] = c\"])";
/// The name of every algebra written in place; the catalogue has none of this name.
const NAME: &str = "algebra(…)";

/// Reads the group: its name, or `algebra(…)`.
pub(super) fn read(
    value: &TokenStream,
    place: Span,
    diagnostics: &Diagnostics,
) -> Option<LieAlgebra> {
    if let Ok(call) = syn::parse2::<ExprCall>(value.clone())
        && matches!(&*call.func, Expr::Path(path) if path.path.is_ident("algebra"))
    {
        return of_call(&call, diagnostics);
    }
    let found = catalogue::lookup(&text(value));
    diagnostics.check(place, found.map_err(|error| Mistake::Group(error.to_string())))
}

fn of_call(call: &ExprCall, diagnostics: &Diagnostics) -> Option<LieAlgebra> {
    let before = diagnostics.len();
    let (mut basis, mut generators, mut brackets) = (None, None, None);
    for argument in &call.args {
        let Some((key, list)) = entry(argument, diagnostics) else { continue };
        match key.as_str() {
            "basis" => basis = list.elems.iter().map(|one| matrix(one, diagnostics)).collect(),
            "generators" => {
                let named = list.elems.iter().map(|element| (text(element), Span::of(element)));
                generators = Some(named.collect::<Vec<_>>());
            }
            "brackets" => brackets = Some(list),
            _ => {
                let unknown = Mistake::unknown_key(&key, NAME, &KEYS);
                diagnostics.report(Span::of(argument), unknown);
            }
        }
    }
    if diagnostics.len() > before {
        return None;
    }
    let whole = Span::of(call);
    let names = generators.as_ref().map(|list| list.iter().map(|(name, _)| name.clone()).collect());
    let algebra = match (basis, generators, brackets) {
        (Some(basis), _, None) => match names {
            None => LieAlgebra::from_basis(NAME, basis),
            Some(names) => LieAlgebra::from_named_basis(NAME, names, basis),
        },
        (None, Some(generators), Some(list)) => by_brackets(&generators, list, diagnostics),
        _ => {
            let message = "an algebra is given by a basis, or by generators and brackets";
            diagnostics.report_other(whole, message, EXAMPLE);
            return None;
        }
    };
    // Mistakes in single brackets make the rest meaningless.
    if diagnostics.len() > before {
        return None;
    }
    diagnostics.check(whole, algebra.map_err(Mistake::Algebra))
}

/// `key = [ … ]`.
fn entry<'a>(argument: &'a Expr, diagnostics: &Diagnostics) -> Option<(String, &'a ExprArray)> {
    if let Expr::Assign(assign) = argument
        && let (Expr::Path(key), Expr::Array(list)) = (&*assign.left, &*assign.right)
        && let Some(key) = key.path.get_ident()
    {
        return Some((key.to_string(), list));
    }
    diagnostics.report_other(Span::of(argument), "this is not of the form key = [ … ]", EXAMPLE);
    None
}

/// The text of a value: a string literal's content, or the tokens themselves.
pub(super) fn text(value: &impl ToTokens) -> String {
    let value = value.to_token_stream();
    let text = value.to_string().replace(' ', "");
    syn::parse2(value).map_or(text, |literal: syn::LitStr| literal.value())
}

fn matrix(expression: &Expr, diagnostics: &Diagnostics) -> Option<RationalMatrix> {
    let number = |entry| diagnostics.check(Span::of(entry), fraction(&text(entry)));
    let row = |row| {
        let entries = array(row, diagnostics)?.elems.iter().map(number);
        Some((entries.collect::<Option<_>>()?, Span::of(row)))
    };
    let rows = rows(array(expression, diagnostics)?.elems.iter().map(row), diagnostics)?;
    Some(RationalMatrix::from_rows(rows))
}

fn array<'a>(expression: &'a Expr, diagnostics: &Diagnostics) -> Option<&'a ExprArray> {
    let Expr::Array(array) = expression else {
        let message = "a basis is a list of matrices, each a list of rows";
        let help = "write for example [[[0, -1], [1, 0]]]";
        diagnostics.report_other(Span::of(expression), message, help);
        return None;
    };
    Some(array)
}

/// The algebra of these brackets, as far as they can be read.
fn by_brackets(
    generators: &[(String, Span)],
    list: &ExprArray,
    diagnostics: &Diagnostics,
) -> Result<LieAlgebra, LieAlgebraError> {
    let known = Names::of_coordinates(generators, diagnostics);
    let mut brackets = Vec::new();
    for element in &list.elems {
        let place = Span::of(element);
        // Bytes inside a string literal have no span: its mistakes are reported at the literal.
        let inside = Diagnostics::new();
        brackets.extend(bracket(&text(element), 0, place, &known, &inside));
        for found in inside.list() {
            diagnostics.report(place, found.mistake);
        }
    }
    let names = generators.iter().map(|(name, _)| name.clone()).collect();
    LieAlgebra::from_brackets(NAME, names, brackets)
}
