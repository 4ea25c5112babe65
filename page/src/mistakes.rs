//! Mistakes at their places in the fields.

use coadjoint_codegen::diagnostic::{Diagnostics, Span};
use serde::Serialize;

use crate::file::File;

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
}

/// The mistakes of a file in the order of the fields, then of their places.
#[must_use]
pub fn of_file(file: &File, diagnostics: &Diagnostics) -> Vec<Mistake> {
    let mut list: Vec<Mistake> = file
        .unwritten
        .iter()
        .map(|mistake| Mistake {
            field: Some(mistake.field),
            start: mistake.range.start,
            end: mistake.range.end,
            message: mistake.message.clone(),
            help: Some(mistake.help.clone()),
        })
        .collect();
    for diagnostic in diagnostics.iter() {
        let (message, help) = (diagnostic.mistake.to_string(), diagnostic.mistake.help());
        let place = match diagnostic.span {
            Span::Text { start, end } => file.place(start, end),
            _ => None,
        };
        list.push(match place {
            Some((field, range)) => {
                Mistake { field: Some(field), start: range.start, end: range.end, message, help }
            }
            None => Mistake { field: None, start: 0, end: 0, message, help },
        });
    }
    list.sort_by_key(|mistake| (mistake.field, mistake.start));
    list
}
