//! Reading values of a TOML table, with a mistake for each that does not fit.

use num_traits::ToPrimitive;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::Arena;
use crate::number::Rational;
use crate::parse::{Names, NumberError, rational, text};
use crate::pass::constant;

type Value<'a> = Spanned<DeValue<'a>>;

/// A table of the file, with the name it has in messages.
#[derive(Clone, Debug)]
pub(super) struct Table<'a> {
    entries: &'a DeTable<'a>,
    /// The constants its numbers may use.
    pub constants: &'a Names,
    name: String,
    pub span: Span,
}

impl<'a> Table<'a> {
    pub(super) fn root(entries: &'a DeTable<'a>, constants: &'a Names) -> Self {
        Self { entries, constants, name: "the file".to_owned(), span: Span::Whole }
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn get(&self, key: &str) -> Option<&'a Value<'a>> {
        self.entries.get(key)
    }

    /// Keys and values in the order of the file.
    pub(super) fn entries(&self) -> Vec<(&'a str, Span, &'a Value<'a>)> {
        let mut list: Vec<_> = self
            .entries
            .iter()
            .map(|(key, value)| (key.get_ref().as_ref(), key.span(), value))
            .collect();
        list.sort_by_key(|(_, span, _)| span.start);
        list.into_iter().map(|(key, span, value)| (key, Span::text(span), value)).collect()
    }

    /// Reports every key that is not among `known`.
    pub(super) fn check_keys(&self, known: &[&str], diagnostics: &mut Diagnostics) {
        for (key, span, _) in self.entries() {
            if !known.contains(&key) {
                let suggestion = nearest(key, known.iter().copied()).map(str::to_owned);
                let known = known.iter().map(|&k| k.to_owned()).collect();
                let unknown =
                    Mistake::UnknownKey(key.to_owned(), self.name.clone(), suggestion, known);
                diagnostics.report(span, unknown);
            }
        }
    }

    /// The table under `key`, if there is one.
    pub(super) fn table(&self, key: &str, diagnostics: &mut Diagnostics) -> Option<Self> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::Table(entries) => {
                let name = format!("[{key}]");
                // The header line itself, not all of the table.
                let span = self.entries.get_key_value(key).map(|(key, _)| key.span());
                let span = span.map_or(Span::Whole, Span::text);
                Some(Table { entries, constants: self.constants, name, span })
            }
            _ => {
                wrong_kind(
                    key,
                    "a table",
                    value,
                    &format!("[{key}] on a line of its own"),
                    diagnostics,
                );
                None
            }
        }
    }

    pub(super) fn string(
        &self,
        key: &str,
        example: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<(&'a str, Span)> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::String(text) => Some((text.as_ref(), span(value))),
            _ => {
                wrong_kind(key, "a text in quotes", value, example, diagnostics);
                None
            }
        }
    }

    pub(super) fn array(
        &self,
        key: &str,
        example: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<(Vec<&'a Value<'a>>, Span)> {
        let value = self.get(key)?;
        match value.get_ref() {
            DeValue::Array(list) => Some((list.iter().collect(), span(value))),
            _ => {
                wrong_kind(key, "an array", value, example, diagnostics);
                None
            }
        }
    }

    /// A whole number from 0.
    pub(super) fn integer(
        &self,
        key: &str,
        example: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<(usize, Span)> {
        let value = self.get(key)?;
        if let DeValue::Integer(n) = value.get_ref()
            && let Ok(n) = usize::from_str_radix(n.as_str(), n.radix())
        {
            return Some((n, span(value)));
        }
        wrong_kind(key, "a whole number from 0", value, example, diagnostics);
        None
    }

    /// An exact number.
    pub(super) fn number(
        &self,
        key: &str,
        example: &str,
        diagnostics: &mut Diagnostics,
    ) -> Option<(Rational, Span)> {
        let value = self.get(key)?;
        let number = exact(key, value, example, self.constants, diagnostics);
        number.map(|number| (number, span(value)))
    }
}

/// Where a value stands.
pub(super) fn span(value: &Value<'_>) -> Span {
    Span::text(value.span())
}

/// The number that an expression in numbers, `constants` and integers `indices` is, its text from byte `offset` on.
pub(super) fn expression(
    text: &str,
    offset: usize,
    indices: &[(&str, i64)],
    constants: &Names,
    diagnostics: &mut Diagnostics,
) -> Option<Rational> {
    let mut arena = Arena::new();
    let root = text::parse_with(text, offset, indices, constants, &mut arena, diagnostics);
    constant(&arena, root, diagnostics)
}

/// The number a value is: a decimal, an integer, or a text such as `"2/3"` or `"sqrt(2)*I1"`.
pub(super) fn exact(
    key: &str,
    value: &Value<'_>,
    example: &str,
    constants: &Names,
    diagnostics: &mut Diagnostics,
) -> Option<Rational> {
    let text = match value.get_ref() {
        DeValue::Float(number) => number.as_str().to_owned(),
        DeValue::Integer(number) => match i128::from_str_radix(number.as_str(), number.radix()) {
            Ok(integer) => integer.to_string(),
            Err(_) => number.as_str().to_owned(),
        },
        DeValue::String(text) => {
            // After the opening quote.
            return expression(text, value.span().start + 1, &[], constants, diagnostics);
        }
        _ => {
            let expected = "a number, or an expression such as \"2/3\"";
            wrong_kind(key, expected, value, example, diagnostics);
            return None;
        }
    };
    match rational(&text) {
        Ok(number) => Some(number),
        Err(error) => {
            let mistake = match error {
                NumberError::Form => Mistake::Number(text),
                NumberError::Size => Mistake::NumberSize(text.chars().take(24).collect()),
            };
            diagnostics.report(span(value), mistake);
            None
        }
    }
}

/// The nearest `f64` of an exact number.
pub(super) fn nearest_float(number: &Rational) -> f64 {
    number.to_f64().unwrap_or(f64::NAN)
}

/// A square or rectangular matrix of exact numbers, row by row.
pub(super) fn matrix(
    key: &str,
    value: &Value<'_>,
    example: &str,
    constants: &Names,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Vec<Rational>>> {
    let expected = "a matrix, row by row";
    let DeValue::Array(rows) = value.get_ref() else {
        wrong_kind(key, expected, value, example, diagnostics);
        return None;
    };
    let mut result: Vec<Vec<Rational>> = Vec::new();
    for row in rows.iter() {
        let DeValue::Array(entries) = row.get_ref() else {
            wrong_kind(key, expected, row, example, diagnostics);
            return None;
        };
        let numbers: Option<Vec<Rational>> = entries
            .iter()
            .map(|entry| exact(key, entry, example, constants, diagnostics))
            .collect();
        let numbers = numbers?;
        if let Some(first) = result.first()
            && first.len() != numbers.len()
        {
            let message =
                format!("this row has {} entries, the first one {}", numbers.len(), first.len());
            let help = "give every row as many entries".to_owned();
            diagnostics.report(span(row), Mistake::Other(message, Some(help)));
            return None;
        }
        result.push(numbers);
    }
    Some(result)
}

/// Reports a value that is not what was expected.
pub(super) fn wrong_kind(
    key: &str,
    expected: &str,
    value: &Value<'_>,
    example: &str,
    diagnostics: &mut Diagnostics,
) {
    let found = match value.get_ref() {
        DeValue::String(_) => "a text".to_owned(),
        DeValue::Integer(n) => n.to_string(),
        DeValue::Float(n) => n.to_string(),
        DeValue::Boolean(_) => "a truth value".to_owned(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(_) => "an array".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    };
    let mistake =
        Mistake::WrongKind(key.to_owned(), expected.to_owned(), found, example.to_owned());
    diagnostics.report(span(value), mistake);
}

/// Reports a value that no run can have.
pub(super) fn refuse(place: Span, what: &str, example: &str, diagnostics: &mut Diagnostics) {
    let help = Some(format!("write for example {example}"));
    diagnostics.report(place, Mistake::Other(what.to_owned(), help));
}
