//! The arguments of the attributes.

use proc_macro2::{TokenStream, TokenTree};

use super::algebra::{self, text};
use super::signature::Variable;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::lie::LieAlgebra;
use crate::pass::Choice;

/// Reads `key = value, …`, such as `group = SO3, truncation = 7, chart = exp`, each known key once; `group` must be there.
/// Values are any tokens up to the next comma, so that groups may be written as people write them: `SO3 * SO3`, `SO3^4`.
/// The result is the algebra, `None` where it was missing or wrong, which is reported; the method; and the name of the
/// argument that is the time, and its place.
pub(super) fn read(
    tokens: TokenStream,
    variable: &Variable,
    diagnostics: &Diagnostics,
) -> (Option<LieAlgebra>, Choice, Option<(String, Span)>) {
    let (mut algebra, mut choice, mut time) = (None, Choice::default(), None);
    let &Variable { attribute: owner, keys: known, .. } = variable;
    let mut seen: Vec<String> = Vec::new();
    let comma = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for entry in tokens.split(comma).filter(|entry| !entry.is_empty()) {
        let (key, value): (_, TokenStream) = match entry {
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
        let (span, key, place) = (Span::from_tokens(key.span()), key.to_string(), Span::of(&value));
        if !known.contains(&key.as_str()) {
            diagnostics.report(span, Mistake::unknown_key(&key, owner, known));
            continue;
        }
        if seen.contains(&key) {
            diagnostics.report(span, Mistake::RepeatedKey(key));
            continue;
        }
        match key.as_str() {
            "group" => algebra = algebra::read(&value, place, diagnostics),
            "truncation" => match text(&value).parse() {
                Ok(k) => choice.set_truncation(k, place, diagnostics),
                Err(_) => {
                    choice.truncation = None;
                    diagnostics.report(place, Mistake::TruncationNumber);
                }
            },
            "time" => time = Some((text(&value), place)),
            "crate" => {}
            named => choice.set_named(named, &text(&value), place, diagnostics),
        }
        seen.push(key);
    }
    if !seen.iter().any(|key| key == "group") {
        let missing = Mistake::missing_key("group", owner, "group = SO3");
        diagnostics.report(Span::from_tokens(proc_macro2::Span::call_site()), missing);
    }
    (algebra, choice, time)
}
