//! Mistakes at their places in the fields.

use std::ops::Range;

use serde::Serialize;

/// A mistake, or a refusal, in one of the fields.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// The field; none where it is of the system as a whole.
    pub field: Option<&'static str>,
    /// The bytes of the field.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// The message.
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
    /// The same at these bytes of its field.
    #[must_use]
    pub fn at(self, range: Range<usize>) -> Self {
        Self { start: range.start, end: range.end, ..self }
    }
}
