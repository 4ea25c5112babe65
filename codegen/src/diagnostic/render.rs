//! Mistakes as text for a terminal.

use std::fmt::Write;

use super::{Diagnostic, Diagnostics, Span};

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
        out
    }
}

fn one(out: &mut String, diagnostic: &Diagnostic, file: &str, text: &str) -> std::fmt::Result {
    let mistake = &diagnostic.mistake;
    if let Span::Text { start, end } = diagnostic.span {
        let place = Place::find(text, start, end);
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
struct Place<'a> {
    line: usize,
    column: usize,
    width: usize,
    source: &'a str,
}

impl<'a> Place<'a> {
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

#[cfg(test)]
mod tests {
    use super::super::{Diagnostics, Mistake};
    use super::*;

    #[test]
    fn places_are_counted_in_characters_from_one() {
        let text = "a\nΠx + ω\n";
        let start = text.find('ω').unwrap();
        let place = Place::find(text, start, start + 'ω'.len_utf8());
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
