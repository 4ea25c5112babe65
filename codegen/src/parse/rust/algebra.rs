//! An algebra written into the attribute: `group = algebra(basis = [[[0, -1], [1, 0]]])`, or
//! `group = algebra(generators = [a, b, c], brackets = ["[a, b] = c", "[a, c] = -1/2*b"])`.

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ExprArray, ExprCall, Lit};

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::lie::{LieAlgebra, LieAlgebraError, RationalMatrix};
use crate::number::Rational;
use crate::parse::{Name, Names, bracket, rational};

const KEYS: [&str; 3] = ["basis", "generators", "brackets"];
const EXAMPLE: &str = "algebra(basis = [[[0, -1], [1, 0]]]) or \
                       algebra(generators = [a, b, c], brackets = [\"[a, b] = c\"])";
/// The name of every algebra written in place; the catalogue has none of this name.
const NAME: &str = "algebra(…)";

/// Reads `algebra(…)`; `None` if `value` is not of this form, so that it names a group.
pub(super) fn read(
    value: &TokenStream,
    diagnostics: &mut Diagnostics,
) -> Option<Option<LieAlgebra>> {
    let call: ExprCall = syn::parse2(value.clone()).ok()?;
    let Expr::Path(path) = &*call.func else { return None };
    if !path.path.is_ident("algebra") {
        return None;
    }
    let before = diagnostics.len();
    let (mut basis, mut generators, mut brackets) = (None, None, None);
    for argument in &call.args {
        let Some((key, list)) = entry(argument, diagnostics) else { continue };
        match key.as_str() {
            "basis" => basis = matrices(list, diagnostics),
            "generators" => generators = Some(names(list)),
            "brackets" => brackets = Some(list),
            _ => {
                let suggestion = nearest(&key, KEYS).map(str::to_owned);
                let known = KEYS.map(str::to_owned).to_vec();
                let unknown = Mistake::UnknownKey(key, "algebra(…)".to_owned(), suggestion, known);
                diagnostics.report(Span::of(argument), unknown);
            }
        }
    }
    if diagnostics.len() > before {
        return Some(None);
    }
    let whole = Span::of(&call);
    let algebra = match (basis, generators, brackets) {
        (Some(basis), None, None) => LieAlgebra::from_basis(NAME, basis),
        (Some(basis), Some(names), None) => {
            let names = names.into_iter().map(|(name, _)| name).collect();
            LieAlgebra::from_named_basis(NAME, names, basis)
        }
        (None, Some(names), Some(list)) => by_brackets(names, list, diagnostics),
        _ => {
            let message = "an algebra is given by a basis, or by generators and brackets";
            let help = Some(format!("write for example {EXAMPLE}"));
            diagnostics.report(whole, Mistake::Other(message.to_owned(), help));
            return Some(None);
        }
    };
    Some(match algebra {
        Ok(algebra) if diagnostics.len() == before => Some(algebra),
        Ok(_) => None,
        Err(error) => {
            // Mistakes in single brackets make the rest meaningless.
            if diagnostics.len() == before {
                diagnostics.report(whole, Mistake::Algebra(error));
            }
            None
        }
    })
}

/// `key = [ … ]`.
fn entry<'a>(argument: &'a Expr, diagnostics: &mut Diagnostics) -> Option<(String, &'a ExprArray)> {
    if let Expr::Assign(assign) = argument
        && let (Expr::Path(key), Expr::Array(list)) = (&*assign.left, &*assign.right)
        && let Some(key) = key.path.get_ident()
    {
        return Some((key.to_string(), list));
    }
    let message = "this is not of the form key = [ … ]".to_owned();
    let help = Some(format!("write for example {EXAMPLE}"));
    diagnostics.report(Span::of(argument), Mistake::Other(message, help));
    None
}

/// Names as identifiers or string literals.
fn names(list: &ExprArray) -> Vec<(String, Span)> {
    list.elems.iter().map(|element| (text(element), Span::of(element))).collect()
}

/// The content of a string literal, or the tokens themselves.
fn text(expression: &Expr) -> String {
    match expression {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Str(text) => text.value(),
            other => other.to_token_stream().to_string(),
        },
        other => other.to_token_stream().to_string().replace(' ', ""),
    }
}

fn matrices(list: &ExprArray, diagnostics: &mut Diagnostics) -> Option<Vec<RationalMatrix>> {
    list.elems.iter().map(|matrix| self::matrix(matrix, diagnostics)).collect()
}

fn matrix(expression: &Expr, diagnostics: &mut Diagnostics) -> Option<RationalMatrix> {
    let rows = array(expression, diagnostics)?;
    let mut result: Vec<Vec<Rational>> = Vec::new();
    for row in &rows.elems {
        let entries = array(row, diagnostics)?;
        let numbers: Option<Vec<Rational>> =
            entries.elems.iter().map(|entry| number(entry, diagnostics)).collect();
        let numbers = numbers?;
        if let Some(first) = result.first()
            && first.len() != numbers.len()
        {
            let message =
                format!("this row has {} entries, the first one {}", numbers.len(), first.len());
            let help = Some("give every row as many entries".to_owned());
            diagnostics.report(Span::of(row), Mistake::Other(message, help));
            return None;
        }
        result.push(numbers);
    }
    Some(RationalMatrix::from_rows(result))
}

fn array<'a>(expression: &'a Expr, diagnostics: &mut Diagnostics) -> Option<&'a ExprArray> {
    match expression {
        Expr::Array(array) => Some(array),
        other => {
            let message = "a basis is a list of matrices, each a list of rows".to_owned();
            let help = Some("write for example [[[0, -1], [1, 0]]]".to_owned());
            diagnostics.report(Span::of(other), Mistake::Other(message, help));
            None
        }
    }
}

fn number(expression: &Expr, diagnostics: &mut Diagnostics) -> Option<Rational> {
    let text = text(expression);
    match rational(&text) {
        Ok(number) => Some(number),
        Err(_) => {
            diagnostics.report(Span::of(expression), Mistake::Number(text));
            None
        }
    }
}

/// The algebra of these brackets, as far as they can be read.
fn by_brackets(
    generators: Vec<(String, Span)>,
    list: &ExprArray,
    diagnostics: &mut Diagnostics,
) -> Result<LieAlgebra, LieAlgebraError> {
    let mut known = Names::default();
    for (i, (name, place)) in generators.iter().enumerate() {
        known.add(name, Name::Coordinate(i), *place, diagnostics);
    }
    let mut brackets = Vec::new();
    for element in &list.elems {
        let place = Span::of(element);
        // Bytes inside a string literal have no span: its mistakes are reported at the literal.
        let mut inside = Diagnostics::new();
        brackets.extend(bracket(&text(element), 0, place, &known, &mut inside));
        for found in inside.iter() {
            diagnostics.report(place, found.mistake.clone());
        }
    }
    let names = generators.into_iter().map(|(name, _)| name).collect();
    LieAlgebra::from_brackets(NAME, names, brackets)
}
