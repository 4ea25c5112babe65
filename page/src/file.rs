//! Writes fields as the text of a system file, which the library reads, and maps places of mistakes back to the fields.

use std::ops::Range;

use coadjoint_codegen::diagnostic::{Diagnostics, Span};
use serde::Serialize;
use toml::de::DeValue;

use crate::fields::Fields;

/// A mistake, or a refusal, in one of the fields.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// The field; none where it is of the system as a whole.
    pub field: Option<&'static str>,
    pub start: usize,
    pub end: usize,
    pub message: String,
    /// A correction, where there is more to say.
    pub help: Option<String>,
}

impl Mistake {
    /// A refusal of the system as a whole.
    pub fn of_all(message: impl ToString, help: Option<&str>) -> Self {
        let help = help.map(str::to_owned);
        Self { field: None, start: 0, end: 0, message: message.to_string(), help }
    }

    /// One of a whole field.
    pub fn of(field: &'static str, message: impl ToString, help: &str) -> Self {
        Self { field: Some(field), ..Self::of_all(message, Some(help)) }
    }
    /// Moves the mistake to these bytes of its field.
    pub fn at(self, range: Range<usize>) -> Self {
        Self { start: range.start, end: range.end, ..self }
    }
}

/// The text of a system file, and which of its bytes are from which field.
#[derive(Clone, Debug, Default)]
pub struct File {
    pub text: String,
    pieces: Vec<Chunk>,
    /// Mistakes in fields that could not even be written as a file.
    pub unwritten: Vec<Mistake>,
}

/// Bytes of a field that stand in the text as they are.
#[derive(Clone, Debug)]
struct Chunk {
    text: Range<usize>,
    field: &'static str,
    offset: usize,
}

/// Writes a part of a field, which begins at its byte `offset`.
type Write = fn(&mut File, field: &'static str, offset: usize, content: &str);

impl File {
    /// The system file of these fields.
    pub fn of(fields: &Fields) -> Self {
        let mut file = Self::default();
        file.entry("name", &fields.name, Self::string);
        if fields.algebra.trim().is_empty() {
            file.entry("group", &fields.group, Self::string);
        }
        // Without names the group's own are taken.
        if !words(&fields.coordinates).is_empty() {
            file.list("coordinates", &fields.coordinates, Self::string);
        }
        file.entry("hamiltonian", &fields.hamiltonian, Self::string);
        if !fields.algebra.trim().is_empty() {
            file.text.push_str("\n[algebra]\n");
            file.verbatim("algebra", 0, fields.algebra.trim_end());
            file.text.push('\n');
        }
        file.parameters(&fields.parameters);
        file.text.push_str("\n[integrator]\n");
        file.entry("truncation", &fields.truncation, Self::number);
        if fields.chart != "exp" {
            file.entry("chart", &fields.chart, Self::string);
        }
        for (key, choice) in [("frame", &fields.frame), ("method", &fields.method)] {
            if choice != "auto" {
                file.entry(key, choice, Self::string);
            }
        }
        file.entry("step", &fields.step, Self::number);
        file.text.push_str("\n[initial]\n");
        file.list("momentum", &fields.momentum, Self::number);
        if !fields.time.trim().is_empty() {
            file.text.push_str("\n[run]\n");
            file.entry("time", &fields.time, Self::number);
        }
        file
    }

    /// All mistakes in the order of the fields, then of their places.
    pub fn mistakes(self, diagnostics: &Diagnostics) -> Vec<Mistake> {
        let found = diagnostics.list().into_iter().map(|diagnostic| {
            let mistake = Mistake::of_all(diagnostic.message(), diagnostic.help().as_deref());
            let place = match diagnostic.span {
                Span::Text { start, end } => self.place(start, end),
                _ => None,
            };
            match place {
                Some((field, range)) => Mistake { field: Some(field), ..mistake }.at(range),
                None => mistake,
            }
        });
        let mut list: Vec<Mistake> = self.unwritten.iter().cloned().chain(found).collect();
        list.sort_by_key(|mistake| (mistake.field, mistake.start));
        list
    }

    /// The field that these bytes of the text are from, and which of its bytes they are.
    fn place(&self, start: usize, end: usize) -> Option<(&'static str, Range<usize>)> {
        let piece = self
            .pieces
            .iter()
            .find(|piece| piece.text.start <= start && start <= piece.text.end)
            // A whole list, quotes and brackets included.
            .or_else(|| {
                self.pieces.iter().find(|piece| start <= piece.text.start && piece.text.start < end)
            })?;
        let field = piece.field;
        let mut within = self.pieces.iter().filter(|other| other.field == field);
        let last = within.rfind(|other| other.text.start <= end).unwrap_or(piece);
        let inside = |piece: &Chunk, at: usize| {
            at.clamp(piece.text.start, piece.text.end) - piece.text.start + piece.offset
        };
        let from = inside(piece, start);
        Some((field, from..inside(last, end).max(from)))
    }

    fn verbatim(&mut self, field: &'static str, offset: usize, content: &str) {
        let start = self.text.len();
        self.text.push_str(content);
        self.pieces.push(Chunk { text: start..self.text.len(), field, offset });
    }

    /// A text in quotes that leave it as it is.
    fn string(&mut self, field: &'static str, offset: usize, content: &str) {
        let clean: String =
            content.chars().map(|c| if c == '\n' || !c.is_control() { c } else { ' ' }).collect();
        let (open, close) = if clean.contains('\n') {
            if clean.contains("\"\"\"") || clean.contains('\\') {
                ("'''\n", "'''")
            } else {
                ("\"\"\"\n", "\"\"\"")
            }
        } else if !clean.contains(['"', '\\']) {
            ("\"", "\"")
        } else if !clean.contains('\'') {
            ("'", "'")
        } else {
            ("'''\n", "'''")
        };
        self.text.push_str(open);
        self.verbatim(field, offset, &clean.replace("'''", "' '"));
        self.text.push_str(close);
    }

    /// The key named like the field.
    fn entry(&mut self, field: &'static str, content: &str, write: Write) {
        self.text.push_str(&format!("{field} = "));
        let lead = content.len() - content.trim_start().len();
        write(self, field, lead, content.trim());
        self.text.push('\n');
    }

    /// A number as TOML has it, or a text: `1/3`.
    fn number(&mut self, field: &'static str, offset: usize, content: &str) {
        if is_number(content) {
            self.verbatim(field, offset, content);
        } else {
            self.string(field, offset, content);
        }
    }

    fn list(&mut self, field: &'static str, content: &str, write: Write) {
        self.text.push_str(&format!("{field} = ["));
        for (number, (offset, word)) in words(content).into_iter().enumerate() {
            if number > 0 {
                self.text.push_str(", ");
            }
            write(self, field, offset, word);
        }
        self.text.push_str("]\n");
    }

    fn parameters(&mut self, content: &str) {
        let entries = split(content);
        if entries.is_empty() {
            return;
        }
        self.text.push_str("\n[parameters]\n");
        for (offset, entry) in entries {
            let Some((name, value)) = entry.split_once('=') else {
                let message = format!("`{entry}` is no parameter of the form name = value");
                let mistake = Mistake::of("parameters", message, "write for example I1 = 1.5");
                self.unwritten.push(mistake.at(offset..offset + entry.len()));
                continue;
            };
            let at = |part: &str| offset + (part.as_ptr() as usize - entry.as_ptr() as usize);
            let (name, value) = (name.trim(), value.trim());
            if !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
                self.verbatim("parameters", at(name), name);
            } else {
                self.string("parameters", at(name), name);
            }
            self.text.push_str(" = ");
            if value.starts_with('[') {
                self.verbatim("parameters", at(value), value);
            } else {
                self.number("parameters", at(value), value);
            }
            self.text.push('\n');
        }
    }
}

/// Words, with where they begin. Blanks inside parentheses and brackets part nothing, commas outside do.
fn words(content: &str) -> Vec<(usize, &str)> {
    parts(content, |c| c.is_whitespace() || c == ',' || c == ';')
}

/// Entries of a list by lines, commas or semicolons.
fn split(content: &str) -> Vec<(usize, &str)> {
    let parts = parts(content, |c| matches!(c, '\n' | ',' | ';'));
    let trimmed = parts
        .into_iter()
        .map(|(offset, part)| (offset + part.len() - part.trim_start().len(), part.trim()));
    trimmed.filter(|(_, part)| !part.is_empty()).collect()
}

fn parts(content: &str, separates: impl Fn(char) -> bool) -> Vec<(usize, &str)> {
    let (mut depth, mut start) = (0_usize, 0);
    let mut result = Vec::new();
    for (at, c) in content.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            c if depth == 0 && separates(c) => {
                result.push((start, &content[start..at]));
                start = at + c.len_utf8();
            }
            _ => {}
        }
    }
    result.push((start, &content[start..]));
    result.retain(|(_, part)| !part.is_empty());
    result
}

/// True if TOML reads it as a number with digits.
fn is_number(text: &str) -> bool {
    let number = DeValue::parse(text)
        .is_ok_and(|value| matches!(value.get_ref(), DeValue::Integer(_) | DeValue::Float(_)));
    number && !text.contains(['x', 'o', 'b', 'n'])
}
