//! Places in text and in Rust tokens.

use std::fmt::Display;
use std::ops::Range;

use quote::{ToTokens, quote_spanned};

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
    /// A range of bytes.
    pub(crate) fn text(range: Range<usize>) -> Self {
        Self::Text { start: range.start, end: range.end }
    }

    /// A single token.
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

    /// Whether both are certainly the same place; tokens cannot be compared, so never for them.
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
