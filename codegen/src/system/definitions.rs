//! The table `[let]`: parts of formulas with names of their own.

use super::table::{Table, Value, span};
use crate::diagnostic::Span;
use crate::parse::{Name, Names, components};

const EXAMPLE: &str = "B = [\"cos(t)\", \"sin(t)\", \"0\"]";

/// The parts of a file.
#[derive(Debug, Default)]
pub(super) struct Definitions(Vec<Definition>);

/// A part with its name and its place.
#[derive(Debug)]
struct Definition {
    name: String,
    place: Span,
    /// The text of a number or a vector, or those of a list, each with its place.
    texts: Vec<(String, Span)>,
    list: bool,
}

impl Definitions {
    /// Reads the table; a text that is a vector, such as cross(a, b), is a list of three.
    pub(super) fn read(root: &Table<'_>) -> Self {
        let Some(table) = root.table("let") else { return Self::default() };
        let part = |(name, place, value): (&str, Span, &Value<'_>)| {
            let (texts, list) = match value.get_ref().as_array() {
                Some(_) => (table.strings(name, "a list of formulas", EXAMPLE)?.0, true),
                None => {
                    let (text, _) = table.string(name, EXAMPLE)?;
                    (vec![(text.to_owned(), span(value))], false)
                }
            };
            Some(Definition { name: name.to_owned(), place, texts, list })
        };
        Self(table.entries().into_iter().filter_map(part).collect())
    }

    /// True if a part has this name.
    pub(super) fn define(&self, name: &str) -> bool {
        self.0.iter().any(|own| own.name == name)
    }

    /// Adds their names to others, which they are made of.
    pub(super) fn add_to(&self, root: &Table<'_>, names: &mut Names) {
        let part = |text: &str, (own, place): &(String, Span)| Name::Part {
            text: text.to_owned(),
            offset: root.offset(*place, own),
        };
        let add = |names: &mut Names, name: &str, meaning, place| {
            names.add(name, meaning, place, root.diagnostics);
        };
        let (lists, mut texts): (Vec<_>, Vec<_>) = self.0.iter().partition(|own| own.list);
        for Definition { name, place, texts, .. } in lists {
            for (i, own) in texts.iter().enumerate() {
                add(names, &format!("{name}[{i}]"), part(&own.0, own), *place);
            }
        }
        // Vectors may be made of vectors that are named later.
        loop {
            let before = texts.len();
            texts.retain(|Definition { name, place, texts, .. }| {
                let vector = texts.first().and_then(|own| Some((components(&own.0, names)?, own)));
                let Some((entries, own)) = vector else { return true };
                for (i, text) in entries.iter().enumerate() {
                    add(names, &format!("{name}[{i}]"), part(text, own), *place);
                }
                false
            });
            if texts.len() == before {
                break;
            }
        }
        for Definition { name, place, texts, .. } in texts {
            texts.iter().for_each(|own| add(names, name, part(&own.0, own), *place));
        }
    }
}
