//! Tokens of the Hamiltonian's text.

use std::ops::Range;

use super::decimal::decimal;
#[cfg(feature = "system")]
use super::names::is_word;
use super::names::{begins_name, continues_name};
use crate::diagnostic::Mistake;
use crate::number::Rational;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Number(Rational),
    /// A name, possibly with indices: `x1`, `mu[0]`, `a[0][1]`.
    Name(String),
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Open,
    Close,
    Comma,
    /// Anything that is none of these.
    Wrong(Mistake),
}

pub(super) struct Tokens<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str, at: usize) -> Self {
        Self { text, at }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// The length of the longest prefix whose characters satisfy `test`.
    fn run(&self, from: usize, test: impl Fn(char) -> bool) -> usize {
        let rest = &self.rest()[from..];
        rest.find(|c| !test(c)).unwrap_or(rest.len())
    }

    fn number(&self) -> usize {
        let digit = |c: char| c.is_ascii_digit() || c == '_';
        // All that looks like part of the number, so that 1.2.3 is one mistake.
        let mut length = self.run(0, |c| digit(c) || c == '.');
        let bytes = self.rest().as_bytes();
        if matches!(bytes.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
            let digits = self.run(length + 1 + sign, |c| c.is_ascii_digit());
            if digits > 0 {
                length += 1 + sign + digits;
            }
        }
        length
    }

    fn name(&self) -> usize {
        let mut length = self.run(0, continues_name);
        let rest = self.rest();
        // `a.x` is a component.
        if rest[length..].strip_prefix('.').is_some_and(|rest| rest.starts_with(begins_name)) {
            length += 1 + self.run(length + 1, continues_name);
        }
        // `inv(J)` is the name of a matrix, `len(P)` of a number.
        if let Some(inside) = rest.strip_prefix("inv(").or_else(|| rest.strip_prefix("len("))
            && let Some((matrix, _)) = inside.split_once(')')
        {
            length += matrix.len() + 2;
        }
        while let Some(inside) = bracketed(&rest[length..]) {
            length += inside;
        }
        // One that cannot be read is one mistake.
        if rest[length..].starts_with('[') {
            length += rest[length..].find(']').map_or(rest.len() - length, |end| end + 1);
        }
        length
    }
}

/// The words of a text: names without their indices.
#[cfg(feature = "system")]
pub(crate) fn words(text: &str) -> impl Iterator<Item = String> + '_ {
    let word = |c: char| !continues_name(c);
    text.split(word).filter(|word| is_word(word)).map(str::to_owned)
}

/// The length of an index in brackets that `text` begins with: a number, or an expression in indices of sums and
/// parameters.
pub(super) fn bracketed(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '[' => depth += 1,
            ']' if depth == 1 => return (at > 1).then_some(at + 1),
            ']' => depth -= 1,
            _ if depth > 0 && (c.is_alphanumeric() || "_+-*%() ".contains(c)) => {}
            _ => return None,
        }
        if depth == 0 {
            return None;
        }
    }
    None
}

impl Iterator for Tokens<'_> {
    type Item = (Token, Range<usize>);

    fn next(&mut self) -> Option<Self::Item> {
        self.at += self.run(0, char::is_whitespace);
        let rest = self.rest();
        let first = rest.chars().next()?;
        let (token, length) = match first {
            '0'..='9' | '.' => {
                let length = self.number();
                let token = decimal(&rest[..length]).map_or_else(Token::Wrong, Token::Number);
                (token, length)
            }
            c if begins_name(c) => {
                let length = self.name();
                (Token::Name(rest[..length].to_owned()), length)
            }
            '*' if rest.starts_with("**") => (Token::Power, 2),
            '+' => (Token::Plus, 1),
            '-' => (Token::Minus, 1),
            '*' => (Token::Times, 1),
            '/' => (Token::Over, 1),
            '^' => (Token::Power, 1),
            '(' => (Token::Open, 1),
            ')' => (Token::Close, 1),
            ',' => (Token::Comma, 1),
            c => (Token::Wrong(Mistake::Character(c)), c.len_utf8()),
        };
        let start = self.at;
        self.at += length;
        Some((token, start..self.at))
    }
}
