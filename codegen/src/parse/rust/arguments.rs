//! The arguments of the attributes.

use proc_macro2::{TokenStream, TokenTree};

use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::lie::{LieAlgebra, catalogue};
use crate::pass::Choice;

/// `crate` is taken out by the attributes before.
const OF_SYSTEM: [&str; 8] =
    ["group", "truncation", "chart", "solver", "frame", "time", "method", "crate"];
const OF_POTENTIAL: [&str; 2] = ["group", "crate"];

/// Reads `group = SO3, truncation = 7, chart = exp`: the algebra, `None` where it was missing or wrong, which is reported;
/// the method; and the name of the argument that is the time, and its place.
pub(super) fn lie_poisson(
    tokens: TokenStream,
    diagnostics: &Diagnostics,
) -> (Option<LieAlgebra>, Choice, Option<(String, Span)>) {
    let (mut algebra, mut choice, mut time) = (None, Choice::default(), None);
    let owner = "#[lie_poisson(…)]";
    read(tokens, owner, &OF_SYSTEM, diagnostics, |key, value, place| match key {
        "group" => algebra = group(value, place, diagnostics),
        "truncation" => match syn::parse2(value).and_then(|n: syn::LitInt| n.base10_parse()) {
            Ok(k) => choice.set_truncation(k, place, diagnostics),
            Err(_) => {
                choice.truncation = None;
                diagnostics.report(place, Mistake::TruncationNumber);
            }
        },
        "time" => time = Some((text(value), place)),
        "crate" => {}
        _ => choice.set_named(key, &text(value), place, diagnostics),
    });
    (algebra, choice, time)
}

/// Reads `group = SO3`, all that a potential needs.
pub(super) fn potential(tokens: TokenStream, diagnostics: &Diagnostics) -> Option<LieAlgebra> {
    let mut algebra = None;
    read(tokens, "#[potential(…)]", &OF_POTENTIAL, diagnostics, |key, value, place| {
        if key == "group" {
            algebra = group(value, place, diagnostics);
        }
    });
    algebra
}

/// Reads `key = value, …` of the attribute `owner`, each known key once; `group` must be there. Values are any tokens up to
/// the next comma, so that groups may be written as people write them: `SO3 * SO3`, `SO3^4`.
fn read(
    tokens: TokenStream,
    owner: &str,
    known: &[&str],
    diagnostics: &Diagnostics,
    mut each: impl FnMut(&str, TokenStream, Span),
) {
    let mut seen: Vec<String> = Vec::new();
    let comma = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for entry in tokens.split(comma).filter(|entry| !entry.is_empty()) {
        let (key, value) = match entry {
            [TokenTree::Ident(key), TokenTree::Punct(equals), value @ ..]
                if equals.as_char() == '=' && !value.is_empty() =>
            {
                (key, value.iter().cloned().collect())
            }
            _ => {
                let whole: TokenStream = entry.iter().cloned().collect();
                let message = format!("`{whole}` is no argument of the form key = value");
                let help = "write for example group = SO3, truncation = 7";
                diagnostics.report_other(Span::of(&whole), message, help);
                continue;
            }
        };
        let (span, key) = (Span::from_tokens(key.span()), key.to_string());
        if seen.contains(&key) {
            diagnostics.report(span, Mistake::RepeatedKey(key));
        } else if known.contains(&key.as_str()) {
            let place = Span::of(&value);
            each(&key, value, place);
            seen.push(key);
        } else {
            diagnostics.report(span, Mistake::unknown_key(&key, owner, known));
        }
    }
    if !seen.iter().any(|key| key == "group") {
        let missing = Mistake::missing_key("group", owner, "group = SO3");
        diagnostics.report(Span::from_tokens(proc_macro2::Span::call_site()), missing);
    }
}

/// The text of a value: a string literal's content, or the tokens themselves.
fn text(value: TokenStream) -> String {
    let text = value.to_string();
    syn::parse2(value).map_or(text, |literal: syn::LitStr| literal.value())
}

fn group(value: TokenStream, span: Span, diagnostics: &Diagnostics) -> Option<LieAlgebra> {
    if let Some(algebra) = super::algebra::read(&value, diagnostics) {
        return algebra;
    }
    let found = catalogue::lookup(&text(value));
    diagnostics.check(span, found.map_err(|error| Mistake::Group(error.to_string())))
}
