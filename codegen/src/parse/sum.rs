//! Sums over sites in text: `sum(i, 0..64, x[i]*x[(i + 1) % 64])`, and the index expressions in
//! their names.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::iter::Peekable;
use std::ops::Range;
use std::rc::Rc;
use std::str::Chars;

use num_traits::ToPrimitive;

use super::names::{Name, Names};
use crate::diagnostic::Mistake;
use crate::expr::ExprId;
use crate::number::{Rational, integer};
use crate::parse::token::bracketed;

/// The most terms one sum may have.
pub(super) const MOST_TERMS: i64 = 10_000;

/// The most sums within sums, and parentheses in an index.
pub(super) const MOST_NESTED: usize = 64;

/// Names, and the values of the indices of the sums around.
#[derive(Clone, Debug)]
pub(super) struct Scope<'a> {
    pub names: &'a Names,
    pub indices: Vec<(String, i64)>,
    /// The parts read so far; `None` for one that is being read.
    pub parts: Rc<RefCell<BTreeMap<String, Option<ExprId>>>>,
}

impl Scope<'_> {
    /// The meaning of a name, its indices worked out.
    pub(crate) fn get(&self, name: &str) -> Result<Name, Mistake> {
        if let Some((_, value)) = self.indices.iter().find(|(index, _)| index == name) {
            return Ok(Name::Number(integer(*value)));
        }
        if let Some(list) = name.strip_prefix("len(").and_then(|list| list.strip_suffix(')')) {
            return self.length(list.trim()).map(|length| Name::Number(integer(length)));
        }
        let full = self.resolved(name)?;
        match self.names.get(&full) {
            Some(meaning) => Ok(meaning.clone()),
            None if full == "pi" => Ok(Name::Number(pi())),
            None => Err(self.unknown(&full)),
        }
    }

    /// `len(P)`.
    fn length(&self, list: &str) -> Result<i64, Mistake> {
        match self.names.entries(list) {
            Some(count) => Ok(count as i64),
            None if self.names.get(list).is_some() => Err(Mistake::NoList(list.to_owned())),
            None => Err(self.names.unknown(list)),
        }
    }

    /// The mistake of using a name that is not known, its indices worked out: one of them may be out of range.
    fn unknown(&self, name: &str) -> Mistake {
        for (at, _) in name.match_indices('[') {
            let (list, rest) = (&name[..at], &name[at + 1..]);
            let index = rest.split(']').next().unwrap_or(rest);
            if let Some(count) = self.names.entries(list)
                && !index.parse().is_ok_and(|index: usize| index < count)
            {
                let around = self.indices.iter().map(|(name, value)| format!("{name} = {value}"));
                let mut shown = format!("{index} of `{list}`");
                if !self.indices.is_empty() {
                    shown.push_str(&format!(" ({})", around.collect::<Vec<_>>().join(", ")));
                }
                return Mistake::IndexRange(shown, count);
            }
        }
        self.names.unknown(name)
    }

    /// `x[(i + 1) % 64]` as `x[1]` where i is 0.
    fn resolved(&self, name: &str) -> Result<String, Mistake> {
        let (head, mut rest) = name.split_at(name.find('[').unwrap_or(name.len()));
        let mut result: String = head.split_whitespace().collect();
        while let Some(length) = bracketed(rest) {
            let inside = &rest[1..length - 1];
            let value = self.integer(inside)?;
            result.push_str(&format!("[{value}]"));
            rest = &rest[length..];
        }
        match rest {
            "" => Ok(result),
            index => Err(Mistake::Index(index.trim_matches(['[', ']']).to_owned())),
        }
    }

    /// The value of an integer expression with `+`, `-`, `*`, `%` and parentheses, in indices of sums and
    /// parameters that are integers; `%` is never negative, so that `(i - 1) % 64` goes round a ring.
    ///
    /// # Errors
    /// A text that is none, or an entry of a list that is out of range or no integer.
    pub(crate) fn integer(&self, text: &str) -> Result<i64, Mistake> {
        let mut reader = Reader { scope: self, rest: text.chars().peekable(), mistake: None };
        // They are read by recursion.
        let readable = text.matches(['(', '[']).count() <= MOST_NESTED;
        let value = if readable { reader.sum() } else { None };
        reader.skip();
        value
            .filter(|_| reader.rest.next().is_none())
            .ok_or_else(|| reader.mistake.unwrap_or_else(|| Mistake::Index(text.to_owned())))
    }
}

struct Reader<'a> {
    scope: &'a Scope<'a>,
    rest: Peekable<Chars<'a>>,
    /// The reason why there is no value, where more is known than that.
    mistake: Option<Mistake>,
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
            match index.map(|(_, value)| *value).or_else(|| word.parse().ok()) {
                Some(value) => value,
                None => self.parameter(word)?,
            }
        };
        if negative { value.checked_neg() } else { Some(value) }
    }

    /// A parameter that is an integer, such an entry of a list of numbers, as `P[b]` in `x[P[b]]`, or the length of a list.
    fn parameter(&mut self, mut name: String) -> Option<i64> {
        if name == "len" && self.next_of(&['(']).is_some() {
            let list: String = std::iter::from_fn(|| self.rest.next_if(|c| *c != ')')).collect();
            self.next_of(&[')'])?;
            let length = self.scope.length(list.trim());
            return self.known(length);
        }
        let head = name.clone();
        while self.next_of(&['[']).is_some() {
            let at = self.sum()?;
            self.next_of(&[']'])?;
            name.push_str(&format!("[{at}]"));
        }
        match self.scope.names.get(&name) {
            Some(Name::Number(value)) if value.is_integer() => value.to_integer().to_i64(),
            Some(Name::Number(value)) => {
                self.known(Err(Mistake::IndexNumber(name, value.to_string())))
            }
            None if self.scope.names.entries(&head).is_some() => {
                self.known(Err(self.scope.unknown(&name)))
            }
            _ => None,
        }
    }

    /// The value, or none, and why.
    fn known(&mut self, value: Result<i64, Mistake>) -> Option<i64> {
        value.map_err(|mistake| self.mistake = Some(mistake)).ok()
    }
}

/// A fraction that agrees with π to 21 digits: more than any step computes with, and short.
pub(super) fn pi() -> Rational {
    Rational::new(21_053_343_141_i64.into(), 6_701_487_259_i64.into())
}

/// The three arguments of a sum, as places in `text`.
pub(super) struct Summation {
    /// The name of the index.
    pub index: String,
    /// The range of its values, unread.
    pub values: Range<usize>,
    /// The summand.
    pub body: Range<usize>,
    /// Behind the closing parenthesis.
    pub end: usize,
}

/// Reads `(index, first..last, body)` from the opening parenthesis on; where that is not what
/// stands there, the end of what does.
pub(super) fn form(text: &str, open: usize) -> Result<Summation, usize> {
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
        [first, second] if text[..end].ends_with(')') => Ok(Summation {
            index: text[open + 1..first].trim().to_owned(),
            values: first + 1..second,
            body: second + 1..end - 1,
            end,
        }),
        _ => Err(end),
    }
}
