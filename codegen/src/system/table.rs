//! Reading values of a TOML table, with a mistake for each that does not fit.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::Arena;
use crate::number::{Rational, nearest_float};
use crate::parse::{Names, fraction, rows, text};
use crate::pass::{Formula, constant};
use crate::problem::Parameter;

pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// A table of the file, with the name it has in messages.
#[derive(Clone, Debug)]
pub(super) struct Table<'a> {
    entries: &'a DeTable<'a>,
    name: String,
    pub span: Span,
    /// The text of the file.
    pub file: &'a str,
    /// The constants that its numbers may use.
    pub constants: &'a Names,
    pub diagnostics: &'a Diagnostics,
}

impl<'a> Table<'a> {
    pub(super) fn root(
        entries: &'a DeTable<'a>,
        file: &'a str,
        constants: &'a Names,
        diagnostics: &'a Diagnostics,
    ) -> Self {
        let (name, span) = ("the file".to_owned(), Span::Whole);
        Self { entries, name, span, file, constants, diagnostics }
    }

    /// The table with other constants.
    pub(super) fn with<'b>(&self, constants: &'b Names) -> Table<'b>
    where
        'a: 'b,
    {
        Table { constants, ..self.clone() }
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    pub(super) fn get(&self, key: &str) -> Option<&'a Value<'a>> {
        self.entries.get(key)
    }

    pub(super) fn entries(&self) -> Vec<(&'a str, Span, &'a Value<'a>)> {
        let mut list: Vec<_> = self.entries.iter().collect();
        list.sort_by_key(|(key, _)| key.span().start);
        let entry = |(key, value): (&'a Spanned<_>, _)| {
            let name: &std::borrow::Cow<'a, str> = key.get_ref();
            (name.as_ref(), Span::text(key.span()), value)
        };
        list.into_iter().map(entry).collect()
    }

    /// Reports every key that is not among `known`.
    pub(super) fn check_keys(&self, known: &[&str]) {
        for (key, span, _) in self.entries().iter().filter(|(key, ..)| !known.contains(key)) {
            self.unknown_key(key, *span, known);
        }
    }

    pub(super) fn unknown_key(&self, key: &str, span: Span, known: &[&str]) {
        self.diagnostics.report(span, Mistake::unknown_key(key, &self.name, known));
    }

    pub(super) fn missing(&self, key: &str, example: &str) {
        // Of the file as a whole at its beginning.
        let place = if self.span.is_text() { self.span } else { Span::text(0..0) };
        self.diagnostics.report(place, Mistake::missing_key(key, &self.name, example));
    }

    /// Reports a value that is not what was expected.
    pub(super) fn wrong_kind(&self, key: &str, expected: &str, value: &Value<'_>, example: &str) {
        let found = match value.get_ref() {
            DeValue::String(_) => "a text".to_owned(),
            DeValue::Integer(n) => n.to_string(),
            DeValue::Float(n) => n.to_string(),
            DeValue::Boolean(_) => "a truth value".to_owned(),
            DeValue::Datetime(_) => "a date".to_owned(),
            DeValue::Array(_) => "an array".to_owned(),
            DeValue::Table(_) => "a table".to_owned(),
        };
        let [key, expected, example] = [key, expected, example].map(str::to_owned);
        self.diagnostics.report(span(value), Mistake::WrongKind(key, expected, found, example));
    }

    /// Reports a value that makes no sense.
    pub(super) fn refuse(&self, place: Span, what: &str, example: &str) {
        self.diagnostics.report_other(place, what, &format!("write for example {example}"));
    }

    pub(super) fn table(&self, key: &str) -> Option<Self> {
        let table = self.entry(key, self.get(key)?, &format!("[{key}] on a line of its own"))?;
        // The header line itself, not all of the table.
        let span = self.entries.get_key_value(key).map(|(key, _)| key.span());
        Some(Table { span: span.map_or(Span::Whole, Span::text), ..table })
    }

    /// The table that this value of `key`, or an entry of it, is.
    pub(super) fn entry(&self, key: &str, value: &'a Value<'a>, example: &str) -> Option<Self> {
        let DeValue::Table(entries) = value.get_ref() else {
            self.wrong_kind(key, "a table", value, example);
            return None;
        };
        Some(Table { entries, name: format!("[{key}]"), span: span(value), ..self.clone() })
    }

    /// The value of `key`, true or false; false if it is missing.
    pub(super) fn flag(&self, key: &str, example: &str) -> bool {
        let Some(value) = self.get(key) else { return false };
        if let DeValue::Boolean(flag) = value.get_ref() {
            return *flag;
        }
        self.wrong_kind(key, "true or false", value, example);
        false
    }

    pub(super) fn string(&self, key: &str, example: &str) -> Option<(&'a str, Span)> {
        let value = self.get(key)?;
        let DeValue::String(text) = value.get_ref() else {
            self.wrong_kind(key, "a text in quotes", value, example);
            return None;
        };
        Some((text.as_ref(), span(value)))
    }

    pub(super) fn array(&self, key: &str, example: &str) -> Option<(Vec<&'a Value<'a>>, Span)> {
        let value = self.get(key)?;
        let DeValue::Array(list) = value.get_ref() else {
            self.wrong_kind(key, "an array", value, example);
            return None;
        };
        Some((list.iter().collect(), span(value)))
    }

    /// Texts with their places, which `expected` describes, and the place of the whole list.
    pub(super) fn strings(
        &self,
        key: &str,
        expected: &str,
        example: &str,
    ) -> Option<(Vec<(String, Span)>, Span)> {
        let (list, whole) = self.array(key, example)?;
        let mut texts = Vec::new();
        for value in list {
            match value.get_ref() {
                DeValue::String(text) => texts.push((text.to_string(), span(value))),
                _ => self.wrong_kind(key, expected, value, example),
            }
        }
        Some((texts, whole))
    }

    /// Names in a list, or in a text with blanks or commas between them, with their places, and the place of all.
    pub(super) fn names(&self, key: &str, example: &str) -> Option<(Vec<(String, Span)>, Span)> {
        let value = self.get(key)?;
        let DeValue::String(text) = value.get_ref() else {
            return self.strings(key, "a list of names", example);
        };
        let names = text.split([' ', ',', '\t', '\n']).filter(|name| !name.is_empty());
        Some((names.map(|name| (name.to_owned(), span(value))).collect(), span(value)))
    }

    pub(super) fn integer(&self, key: &str, example: &str) -> Option<(usize, Span)> {
        let value = self.get(key)?;
        if let DeValue::Integer(n) = value.get_ref()
            && let Ok(n) = usize::from_str_radix(n.as_str(), n.radix())
        {
            return Some((n, span(value)));
        }
        self.wrong_kind(key, "a whole number from 1", value, example);
        None
    }

    pub(super) fn number(&self, key: &str, example: &str) -> Option<(f64, Span)> {
        let value = self.get(key)?;
        Some((nearest_float(&self.exact(key, value, example)?), span(value)))
    }

    /// The number a value is: a decimal, an integer, or a text such as `"2/3"` or `"sqrt(2)*I1"`.
    pub(super) fn exact(&self, key: &str, value: &Value<'_>, example: &str) -> Option<Rational> {
        let text = match value.get_ref() {
            DeValue::Float(number) => number.as_str().to_owned(),
            DeValue::Integer(number) => {
                match i128::from_str_radix(number.as_str(), number.radix()) {
                    Ok(integer) => integer.to_string(),
                    Err(_) => number.as_str().to_owned(),
                }
            }
            DeValue::String(text) => return self.expression(text, span(value), &[]),
            _ => {
                let expected = "a number, or an expression such as \"2/3\"";
                self.wrong_kind(key, expected, value, example);
                return None;
            }
        };
        let number = self.diagnostics.check(span(value), fraction(&text))?;
        if !nearest_float(&number).is_finite() {
            let what = format!("{text} is too large: numbers reach 1.8e308");
            self.refuse(span(value), &what, example);
        }
        Some(number)
    }

    /// The number that the text of a value is, an expression in numbers, the constants and integers `indices`.
    pub(super) fn expression(
        &self,
        text: &str,
        place: Span,
        indices: &[(&str, i64)],
    ) -> Option<Rational> {
        let (mut arena, offset) = (Arena::new(), self.offset(place, text));
        let names = self.constants;
        let root = text::parse(text, offset, indices, names, &mut arena, self.diagnostics);
        constant(&arena, root, self.diagnostics)
    }

    pub(super) fn numbers<'v>(
        &self,
        key: &str,
        list: impl IntoIterator<Item = &'v Value<'v>>,
        example: &str,
    ) -> Option<Vec<Rational>> {
        list.into_iter().map(|value| self.exact(key, value, example)).collect()
    }

    /// A square or rectangular matrix of exact numbers, row by row.
    pub(super) fn matrix<'v>(
        &self,
        key: &str,
        value: &'v Value<'v>,
        example: &str,
    ) -> Option<Vec<Vec<Rational>>> {
        let list = |value: &'v Value<'v>| {
            if !value.get_ref().is_array() {
                self.wrong_kind(key, "a matrix, row by row", value, example);
            }
            value.get_ref().as_array()
        };
        let row = |row| Some((self.numbers(key, list(row)?.iter(), example)?, span(row)));
        rows(list(value)?.iter().map(row), self.diagnostics)
    }

    /// The energy under `key` in these names.
    pub(super) fn energy(
        &self,
        key: &str,
        example: &str,
        names: &Names,
        parameters: Vec<Parameter>,
    ) -> Option<Formula> {
        let (text, place) = self.string(key, example)?;
        Some(Formula { parameters, ..self.formula(text, place, names) })
    }

    /// The formula that the text of a value is, in these names.
    pub(super) fn formula(&self, text: &str, place: Span, names: &Names) -> Formula {
        let (mut arena, offset) = (Arena::new(), self.offset(place, text));
        let root = text::parse(text, offset, &[], names, &mut arena, self.diagnostics);
        let root = Some((root, place));
        Formula { arena, root, parameters: Vec::new(), source: text.to_owned() }
    }

    /// The offset in the file of a string's content.
    pub(super) fn offset(&self, place: Span, content: &str) -> usize {
        let Span::Text { start, end } = place else { return 0 };
        // Strings with escapes do not occur literally; their places are then approximate.
        let inside = self.file.get(start..end).and_then(|raw| raw.find(content)).unwrap_or(1);
        start + inside
    }
}

pub(super) fn span(value: &Value<'_>) -> Span {
    Span::text(value.span())
}
