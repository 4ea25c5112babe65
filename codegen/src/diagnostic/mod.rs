//! Mistakes in the user's input: what is wrong, where, and what to write instead.
//!
//! Every front end collects into one [`Diagnostics`], so that all mistakes are reported at once.

#[cfg(feature = "system")]
mod encoding;
mod mistake;
mod quote;
mod render;
mod span;

pub use coadjoint_symbolic::nearest::nearest;
#[cfg(feature = "system")]
pub use encoding::{check_table, read_text};
pub use mistake::Mistake;
pub use quote::unclosed_quote;
pub use span::Span;

use proc_macro2::TokenStream;

/// Nobody reads more mistakes than this.
const MOST: usize = 100;

/// One mistake at its place.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// The mistake.
    pub mistake: Mistake,
    /// Where.
    pub span: Span,
}

impl Diagnostic {
    /// The message and the help on one line each.
    fn text(&self) -> String {
        match self.mistake.help() {
            Some(help) => format!("{}\nhelp: {help}", self.mistake),
            None => self.mistake.to_string(),
        }
    }
}

/// All mistakes found so far.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// No mistakes yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Records a mistake, unless the very same one is already recorded at this place, or in text at any place, or
    /// there are a hundred already. Input that could not be read is no mistake beside those that say why.
    pub fn report(&mut self, span: Span, mistake: Mistake) {
        let repeated =
            |d: &Diagnostic| mistake.is_of_a_name() && d.span.is_text() && span.is_text();
        let known =
            |d: &Diagnostic| d.mistake == mistake && (d.span.same_place(span) || repeated(d));
        if mistake == Mistake::Unreadable && !self.list.is_empty() {
            return;
        }
        if self.list.len() < MOST && !self.list.iter().any(known) {
            self.list.push(Diagnostic { mistake, span });
        }
    }

    /// Records the mistakes of `other`.
    pub fn append(&mut self, other: Self) {
        for diagnostic in other.list {
            self.report(diagnostic.span, diagnostic.mistake);
        }
    }

    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The number of mistakes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// The mistakes, in the order they were found.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// `value`, if nothing is wrong.
    ///
    /// # Errors
    /// All mistakes, if there are any.
    pub fn into_result<T>(self, value: Option<T>) -> Result<T, Self> {
        match value {
            Some(value) if self.list.is_empty() => Ok(value),
            _ => Err(self),
        }
    }

    /// The mistakes as one `syn::Error`, each at its tokens.
    #[must_use]
    pub fn into_syn_error(self) -> syn::Error {
        let mut errors = self.list.iter().map(|d| d.span.syn_error(d.text()));
        let first = errors.next().unwrap_or_else(|| {
            syn::Error::new(proc_macro2::Span::call_site(), Mistake::Unreadable.to_string())
        });
        errors.fold(first, |mut all, error| {
            all.combine(error);
            all
        })
    }

    /// The mistakes as `compile_error!` invocations, each at its tokens.
    #[must_use]
    pub fn into_compile_error(self) -> TokenStream {
        self.into_syn_error().into_compile_error()
    }
}

impl From<syn::Error> for Diagnostics {
    fn from(errors: syn::Error) -> Self {
        let mut result = Self::new();
        for error in errors {
            result.report(Span::from_tokens(error.span()), Mistake::Other(error.to_string(), None));
        }
        result
    }
}
