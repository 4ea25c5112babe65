//! Mistakes in the user's input: what is wrong, where, and what to write instead.
//!
//! Every front end collects into one [`Diagnostics`], so that all mistakes are reported at once.

#[cfg(feature = "system")]
mod encoding;
mod mistake;

use std::borrow::Cow;
use std::cell::RefCell;
use std::fmt::{Display, Write};
use std::ops::Range;

use quote::{ToTokens, quote_spanned};

pub use coadjoint_symbolic::nearest::nearest;
#[cfg(feature = "system")]
pub(crate) use encoding::unclosed_quote;
#[cfg(feature = "system")]
pub use encoding::{check_table, read_text};
pub(crate) use mistake::Mistake;

/// Nobody reads more mistakes than this.
const MOST: usize = 100;

/// One mistake at its place.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// Its place.
    pub span: Span,
    pub(crate) mistake: Mistake,
}

impl Diagnostic {
    /// The mistake.
    #[must_use]
    pub fn message(&self) -> String {
        self.mistake.to_string()
    }

    /// A correction, where there is more to say than the message does.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        self.mistake.help()
    }

    /// The message and the help on one line each.
    fn text(&self) -> String {
        match self.mistake.help() {
            Some(help) => format!("{}\nhelp: {help}", self.mistake),
            None => self.mistake.to_string(),
        }
    }
}

/// All mistakes found so far. Readers share it: recording a mistake takes a shared reference.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: RefCell<Vec<Diagnostic>>,
}

impl Diagnostics {
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Records a mistake, unless the very same one is already recorded at this place, or in text at any place, or
    /// there are a hundred already. Input that could not be read is no mistake beside those that say why.
    pub(crate) fn report(&self, span: Span, mistake: Mistake) {
        let mut list = self.list.borrow_mut();
        let repeated =
            |d: &Diagnostic| mistake.is_of_a_name() && d.span.is_text() && span.is_text();
        let known =
            |d: &Diagnostic| d.mistake == mistake && (d.span.same_place(span) || repeated(d));
        let needless = mistake == Mistake::Unreadable && !list.is_empty();
        if list.len() < MOST && !needless && !list.iter().any(known) {
            list.push(Diagnostic { mistake, span });
        }
    }

    /// Records a mistake that has no variant of its own: its message, and a correction, which may be empty.
    pub(crate) fn report_other(&self, span: Span, message: impl Into<String>, help: &str) {
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.report(span, Mistake::Other(message.into(), help));
    }

    /// The value of a result; a mistake in its place is recorded.
    pub(crate) fn check<T>(&self, span: Span, result: Result<T, Mistake>) -> Option<T> {
        result.map_err(|mistake| self.report(span, mistake)).ok()
    }

    /// True if nothing is wrong.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(crate) fn len(&self) -> usize {
        self.list.borrow().len()
    }

    /// The mistakes, in the order they were found.
    #[must_use]
    pub fn list(&self) -> Vec<Diagnostic> {
        self.list.borrow().clone()
    }

    /// `value`, if nothing is wrong.
    ///
    /// # Errors
    /// All mistakes. Where there is no value either, the input could not be read.
    pub(crate) fn into_result<T>(self, value: Option<T>) -> Result<T, Self> {
        match value {
            Some(value) if self.is_empty() => Ok(value),
            _ => {
                self.report(Span::Whole, Mistake::Unreadable);
                Err(self)
            }
        }
    }

    /// The mistakes as one `syn::Error`, each at its tokens.
    #[must_use]
    pub fn into_syn_error(self) -> syn::Error {
        let list = self.list.into_inner();
        let mut errors = list.iter().map(|d| d.span.syn_error(d.text()));
        let first = errors.next().unwrap_or_else(|| {
            syn::Error::new(proc_macro2::Span::call_site(), Mistake::Unreadable.to_string())
        });
        errors.fold(first, |mut all, error| {
            all.combine(error);
            all
        })
    }
}

/// Lines longer than this are not shown.
const WIDEST: usize = 200;

impl Diagnostics {
    /// The mistakes as text, ordered by place: `file:line:column: error: …`, the line itself with
    /// a marker, and `help: …`.
    #[must_use]
    pub fn render(&self, file: &str, text: &str) -> String {
        let mut ordered = self.list();
        ordered.sort_by_key(|d| match d.span {
            Span::Text { start, .. } => start,
            _ => 0,
        });
        let mut out = String::new();
        for diagnostic in &ordered {
            // Writing into a string cannot fail.
            let _ = one(&mut out, diagnostic, file, text);
        }
        visible(&out).into_owned()
    }
}

/// A text without the control characters that a terminal would obey: each as its escape, `\u{1b}`; lines and tabs stay.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    let obeyed = |c: char| {
        let of_direction = matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        of_direction || c.is_control() && !matches!(c, '\n' | '\r' | '\t')
    };
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| match obeyed(c) {
        true => c.escape_unicode().to_string(),
        false => c.to_string(),
    };
    Cow::Owned(text.chars().map(shown).collect())
}

fn one(out: &mut String, diagnostic: &Diagnostic, file: &str, text: &str) -> std::fmt::Result {
    let mistake = &diagnostic.mistake;
    if let Span::Text { start, end } = diagnostic.span {
        let place = Location::find(text, start, end);
        writeln!(out, "{file}:{}:{}: error: {mistake}", place.line, place.column)?;
        if place.source.chars().count() <= WIDEST && !place.source.trim().is_empty() {
            let number = place.line.to_string();
            let margin = " ".repeat(number.len());
            let marker = format!("{}{}", " ".repeat(place.column - 1), "^".repeat(place.width));
            writeln!(out, " {margin} |\n {number} | {}\n {margin} | {marker}", place.source)?;
        }
    } else {
        writeln!(out, "{file}: error: {mistake}")?;
    }
    if let Some(help) = mistake.help() {
        writeln!(out, "  help: {help}")?;
    }
    Ok(())
}

/// A range of bytes as line, column and width in characters, counted from 1.
struct Location<'a> {
    line: usize,
    column: usize,
    width: usize,
    source: &'a str,
}

impl<'a> Location<'a> {
    fn find(text: &'a str, start: usize, end: usize) -> Self {
        let start = floor_boundary(text, start);
        let end = floor_boundary(text, end.max(start));
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        let width = text[start..end.min(line_end).max(start)].chars().count().max(1);
        Self {
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            width,
            source: text[line_start..line_end].trim_end_matches('\r'),
        }
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// A place in what the user wrote.
#[derive(Clone, Copy, Debug, Default)]
pub enum Span {
    /// No place in particular: the input as a whole.
    #[default]
    Whole,
    /// Bytes `start..end` of a text.
    Text {
        /// The first byte.
        start: usize,
        /// One past the last byte.
        end: usize,
    },
    /// Rust tokens. Stable Rust cannot join their spans, so both ends are kept.
    Tokens {
        /// The first token.
        first: proc_macro2::Span,
        /// The last token.
        last: proc_macro2::Span,
    },
}

impl Span {
    pub(crate) fn text(range: Range<usize>) -> Self {
        Self::Text { start: range.start, end: range.end }
    }

    pub(crate) fn from_tokens(span: proc_macro2::Span) -> Self {
        Self::Tokens { first: span, last: span }
    }

    /// All tokens of a piece of syntax.
    pub(crate) fn of(syntax: &impl ToTokens) -> Self {
        let mut tokens = syntax.to_token_stream().into_iter();
        let Some(first) = tokens.next().map(|token| token.span()) else {
            return Self::Whole;
        };
        Self::Tokens { first, last: tokens.last().map_or(first, |token| token.span()) }
    }

    /// From the start of this span to the end of `other`.
    pub(crate) fn to(self, other: Self) -> Self {
        match (self, other) {
            (Self::Text { start, .. }, Self::Text { end, .. }) => Self::Text { start, end },
            (Self::Tokens { first, .. }, Self::Tokens { last, .. }) => Self::Tokens { first, last },
            (Self::Whole, span) | (span, _) => span,
        }
    }

    /// A span of text, moved `by` bytes to the right.
    pub(crate) fn shifted(self, by: usize) -> Self {
        match self {
            Self::Text { start, end } => Self::Text { start: start + by, end: end + by },
            other => other,
        }
    }

    /// True if both are certainly the same place; tokens cannot be compared, so never for them.
    pub(super) fn same_place(self, other: Self) -> bool {
        match (self, other) {
            (Self::Whole, Self::Whole) => true,
            (Self::Text { start: a, end: b }, Self::Text { start: c, end: d }) => a == c && b == d,
            _ => false,
        }
    }

    pub(crate) fn is_text(self) -> bool {
        matches!(self, Self::Text { .. })
    }

    pub(super) fn syn_error(self, message: impl Display) -> syn::Error {
        match self {
            Self::Tokens { first, last } => {
                // An error over a token stream covers it from its first to its last token.
                let (first, last) = (quote_spanned!(first=> _), quote_spanned!(last=> _));
                syn::Error::new_spanned(quote::quote!(#first #last), message)
            }
            _ => syn::Error::new(proc_macro2::Span::call_site(), message),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_in_characters_from_one() {
        let text = "a\nΠx + ω\n";
        let start = text.find('ω').unwrap();
        let place = Location::find(text, start, start + 'ω'.len_utf8());
        assert_eq!((place.line, place.column, place.width), (2, 6, 1));
        assert_eq!(place.source, "Πx + ω");
    }

    #[test]
    fn the_order_is_that_of_the_text_and_the_end_is_a_place() {
        let text = "x + y";
        let diagnostics = Diagnostics::new();
        diagnostics.report(Span::text(5..5), Mistake::Unfinished);
        diagnostics.report(Span::text(0..1), Mistake::NoDependence);
        insta::assert_snapshot!(diagnostics.render("h.toml", text));
    }
}
