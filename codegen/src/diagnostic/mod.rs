//! Mistakes in the user's input: what is wrong, where, and what to write instead.
//!
//! Every front end collects into one [`Diagnostics`], so that all mistakes are reported at once.

#[cfg(feature = "system")]
mod encoding;
mod mistake;
#[cfg(feature = "system")]
mod quote;
mod render;
mod span;

pub use coadjoint_symbolic::nearest::nearest;
#[cfg(feature = "system")]
pub use encoding::{check_table, read_text};
pub(crate) use mistake::Mistake;
#[cfg(feature = "system")]
pub(crate) use quote::unclosed_quote;
pub use span::Span;

use std::cell::RefCell;

/// Nobody reads more mistakes than this.
const MOST: usize = 100;

/// One mistake at its place.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// Where.
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
    /// No mistakes yet.
    #[must_use]
    pub fn new() -> Self {
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

    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of mistakes.
    #[must_use]
    pub fn len(&self) -> usize {
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
