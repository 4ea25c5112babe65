//! The arguments of the attribute.

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::lie::{Chart, LieAlgebra, catalogue};
use crate::pass::{DEFAULT_TRUNCATION, check_truncation, frame, solver};
use crate::problem::{FrameChoice, Solver};

/// `crate` is taken out by the attribute before.
const KEYS: [&str; 6] = ["group", "truncation", "chart", "solver", "frame", "crate"];
const OWNER: &str = "#[lie_poisson(…)]";

/// The values of the arguments; `None` where one was missing or wrong, which is reported.
pub(super) struct Arguments {
    pub algebra: Option<LieAlgebra>,
    pub truncation: Option<usize>,
    pub chart: (Chart, Span),
    pub solver: Option<Solver>,
    pub frame: (FrameChoice, Span),
}

/// Reads `group = SO3, truncation = 7, chart = exp`.
pub(super) fn read(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Arguments {
    let mut arguments = Arguments {
        algebra: None,
        truncation: None,
        chart: (Chart::default(), Span::Whole),
        solver: None,
        frame: (FrameChoice::default(), Span::Whole),
    };
    let mut seen: Vec<String> = Vec::new();
    for (key, span, value) in entries(tokens, diagnostics) {
        if seen.contains(&key) {
            diagnostics.report(span, Mistake::RepeatedKey(key));
            continue;
        }
        let place = Span::of(&value);
        match key.as_str() {
            "group" => arguments.algebra = group(&value, place, diagnostics),
            "truncation" => arguments.truncation = truncation(&value, place, diagnostics),
            "chart" => arguments.chart = (chart(&value, place, diagnostics), place),
            "solver" => match solver(&text(&value)) {
                Ok(solver) => arguments.solver = Some(solver),
                Err(mistake) => diagnostics.report(place, mistake),
            },
            "frame" => match frame(&text(&value)) {
                Ok(frame) => arguments.frame = (frame, place),
                Err(mistake) => diagnostics.report(place, mistake),
            },
            _ => {
                let suggestion = nearest(&key, KEYS).map(str::to_owned);
                let known = KEYS.map(str::to_owned).to_vec();
                let unknown = Mistake::UnknownKey(key, OWNER.to_owned(), suggestion, known);
                diagnostics.report(span, unknown);
                continue;
            }
        }
        seen.push(key);
    }
    let missing = |key: &str| !seen.iter().any(|k| k == key);
    if missing("group") {
        let mistake =
            Mistake::MissingKey("group".to_owned(), OWNER.to_owned(), "group = SO3".to_owned());
        diagnostics.report(Span::from_tokens(proc_macro2::Span::call_site()), mistake);
    }
    if missing("truncation") {
        arguments.truncation = Some(DEFAULT_TRUNCATION);
    }
    arguments
}

/// Reads `group = SO3`, all a potential needs.
pub(super) fn potential(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Option<LieAlgebra> {
    const OWNER: &str = "#[potential(…)]";
    let mut found = None;
    for (key, span, value) in entries(tokens, diagnostics) {
        match key.as_str() {
            "group" if found.is_some() => diagnostics.report(span, Mistake::RepeatedKey(key)),
            "group" => found = Some(group(&value, Span::of(&value), diagnostics)),
            _ => {
                let suggestion = nearest(&key, ["group", "crate"]).map(str::to_owned);
                let known = vec!["group".to_owned(), "crate".to_owned()];
                let unknown = Mistake::UnknownKey(key, OWNER.to_owned(), suggestion, known);
                diagnostics.report(span, unknown);
            }
        }
    }
    if found.is_none() {
        let mistake =
            Mistake::MissingKey("group".to_owned(), OWNER.to_owned(), "group = SO3".to_owned());
        diagnostics.report(Span::from_tokens(proc_macro2::Span::call_site()), mistake);
    }
    found.flatten()
}

/// Splits `key = value, …`. Values are any tokens up to the next comma, so that groups may be
/// written as people write them: `SO3 * SO3`, `SO3^4`.
fn entries(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Vec<(String, Span, TokenStream)> {
    let mut result = Vec::new();
    let mut entry: Vec<TokenTree> = Vec::new();
    let comma = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    let mut tokens = tokens.into_iter();
    loop {
        let token = tokens.next();
        match token {
            Some(token) if !comma(&token) => entry.push(token),
            end => {
                if let Some(read) = one_entry(std::mem::take(&mut entry), diagnostics) {
                    result.push(read);
                }
                if end.is_none() {
                    return result;
                }
            }
        }
    }
}

fn one_entry(
    entry: Vec<TokenTree>,
    diagnostics: &mut Diagnostics,
) -> Option<(String, Span, TokenStream)> {
    let whole: TokenStream = entry.iter().cloned().collect();
    let mut rest = entry.into_iter();
    let key = rest.next()?;
    let equals = rest.next();
    let value: TokenStream = rest.collect();
    let span = Span::from_tokens(key.span());
    match (&key, equals) {
        (TokenTree::Ident(key), Some(TokenTree::Punct(p)))
            if p.as_char() == '=' && !value.is_empty() =>
        {
            Some((key.to_string(), span, value))
        }
        _ => {
            let help = "write for example group = SO3, truncation = 7".to_owned();
            let message = format!("`{whole}` is no argument of the form key = value");
            diagnostics.report(Span::of(&whole), Mistake::Other(message, Some(help)));
            None
        }
    }
}

/// The text of a value: a string literal's content, or the tokens themselves.
fn text(value: &TokenStream) -> String {
    match syn::parse2::<syn::LitStr>(value.clone()) {
        Ok(literal) => literal.value(),
        Err(_) => value.to_string(),
    }
}

fn group(value: &TokenStream, span: Span, diagnostics: &mut Diagnostics) -> Option<LieAlgebra> {
    if let Some(algebra) = super::algebra::read(value, diagnostics) {
        return algebra;
    }
    match catalogue::lookup(&text(value)) {
        Ok(algebra) => Some(algebra),
        Err(error) => {
            diagnostics.report(span, Mistake::Group(error.to_string()));
            None
        }
    }
}

fn truncation(value: &TokenStream, span: Span, diagnostics: &mut Diagnostics) -> Option<usize> {
    let number = syn::parse2::<syn::LitInt>(value.clone()).and_then(|n| n.base10_parse::<usize>());
    match number {
        Ok(k) => check_truncation(k, span, diagnostics),
        Err(_) => {
            diagnostics.report(span, Mistake::TruncationNumber);
            None
        }
    }
}

fn chart(value: &TokenStream, span: Span, diagnostics: &mut Diagnostics) -> Chart {
    let name = text(&value.to_token_stream());
    match crate::pass::chart(&name) {
        Ok(chart) => chart,
        Err(mistake) => {
            diagnostics.report(span, mistake);
            Chart::default()
        }
    }
}
