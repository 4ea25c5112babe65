//! Sums over sites in text: `sum(i, 0..64, x[i]*x[(i + 1) % 64])`, and the index expressions in
//! their names.

use std::iter::Peekable;
use std::ops::Range;
use std::str::Chars;

use super::names::{Name, Names};
use crate::number::integer;

/// The most terms one sum may have.
pub(super) const MOST_TERMS: i64 = 10_000;

/// Names, and the values of the indices of the sums around.
#[derive(Clone, Debug)]
pub(super) struct Scope<'a> {
    pub names: &'a Names,
    pub indices: Vec<(String, i64)>,
}

impl Scope<'_> {
    /// What a name stands for, its indices worked out; or the name that is not known.
    pub fn get(&self, name: &str) -> Result<Name, String> {
        if let Some((_, value)) = self.indices.iter().find(|(index, _)| index == name) {
            return Ok(Name::Number(integer(*value)));
        }
        let full = self.resolved(name).unwrap_or_else(|| name.to_owned());
        self.names.get(&full).cloned().ok_or(full)
    }

    /// `x[(i + 1) % 64]` as `x[1]` where i is 0.
    fn resolved(&self, name: &str) -> Option<String> {
        let mut parts = name.split('[');
        let mut result = parts.next()?.to_owned();
        for part in parts {
            let value = self.integer(part.strip_suffix(']')?)?;
            result.push_str(&format!("[{value}]"));
        }
        Some(result)
    }

    /// The value of an integer expression with `+`, `-`, `*`, `%` and parentheses; `%` is never
    /// negative, so that `(i - 1) % 64` goes round a ring.
    pub fn integer(&self, text: &str) -> Option<i64> {
        let mut reader = Reader { scope: self, rest: text.chars().peekable() };
        let value = reader.sum()?;
        reader.skip();
        reader.rest.next().is_none().then_some(value)
    }
}

struct Reader<'a> {
    scope: &'a Scope<'a>,
    rest: Peekable<Chars<'a>>,
}

impl Reader<'_> {
    fn skip(&mut self) {
        while self.rest.next_if(|c| c.is_whitespace()).is_some() {}
    }

    fn next_of(&mut self, wanted: &[char]) -> Option<char> {
        self.skip();
        self.rest.next_if(|c| wanted.contains(c))
    }

    fn sum(&mut self) -> Option<i64> {
        let mut value = self.product()?;
        while let Some(sign) = self.next_of(&['+', '-']) {
            let next = self.product()?;
            value = if sign == '+' { value.checked_add(next)? } else { value.checked_sub(next)? };
        }
        Some(value)
    }

    fn product(&mut self) -> Option<i64> {
        let mut value = self.operand()?;
        while let Some(operator) = self.next_of(&['*', '%']) {
            let next = self.operand()?;
            value = match operator {
                '*' => value.checked_mul(next)?,
                _ => value.checked_rem_euclid(next)?,
            };
        }
        Some(value)
    }

    fn operand(&mut self) -> Option<i64> {
        // One sign only: `i - -1` is a slip, and repeated signs would nest without end.
        let negative = self.next_of(&['-']).is_some();
        let value = if self.next_of(&['(']).is_some() {
            let value = self.sum()?;
            self.next_of(&[')'])?;
            value
        } else {
            self.skip();
            let mut word = String::new();
            while let Some(c) = self.rest.next_if(|c| c.is_alphanumeric() || *c == '_') {
                word.push(c);
            }
            let index = self.scope.indices.iter().find(|(name, _)| *name == word);
            index.map(|(_, value)| *value).or_else(|| word.parse().ok())?
        };
        if negative { value.checked_neg() } else { Some(value) }
    }
}

/// The three arguments of a sum, as places in `text`.
pub(super) struct Form {
    /// The name of the index.
    pub index: String,
    /// The range of its values, unread.
    pub values: Range<usize>,
    /// What is summed.
    pub body: Range<usize>,
    /// Behind the closing parenthesis.
    pub end: usize,
}

/// Reads `(index, first..last, body)` from the opening parenthesis on; where that is not what
/// stands there, the end of what does.
pub(super) fn form(text: &str, open: usize) -> Result<Form, usize> {
    let mut depth = 0_usize;
    let mut commas = Vec::new();
    let mut end = text.len();
    for (at, c) in text[open..].char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            ',' if depth == 1 => commas.push(open + at),
            _ => {}
        }
        if depth == 0 && c == ')' {
            end = open + at + 1;
            break;
        }
    }
    match commas[..] {
        [first, second] if text[..end].ends_with(')') => Ok(Form {
            index: text[open + 1..first].trim().to_owned(),
            values: first + 1..second,
            body: second + 1..end - 1,
            end,
        }),
        _ => Err(end),
    }
}
