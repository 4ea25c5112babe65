//! The table `[units]`: texts for the people who read plots and reports.

use toml::de::DeValue;

use super::table::{Table, span, wrong_kind};
use crate::diagnostic::{Diagnostics, Mistake, nearest};

const EXAMPLE: &str = "momentum = \"kg m²/s\"";
/// A unit longer than this is a sentence, and would not fit beside an axis.
const LONGEST: usize = 40;

/// The units a file gives. They are shown and never computed with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// The unit of time.
    pub time: Option<String>,
    /// The unit of each coordinate of the momentum, in their order; empty where the file gives none.
    momentum: Vec<Option<String>>,
}

impl Units {
    /// The unit of the coordinate number `i`, counted from 0.
    #[must_use]
    pub fn coordinate(&self, i: usize) -> Option<&str> {
        self.momentum.get(i)?.as_deref()
    }
}

/// Reads `[units]`: `time`, `momentum` (of every coordinate without a unit of its own), and the names
/// of coordinates. In a power of a group the name of one copy's coordinate stands for all copies.
pub(super) fn read(
    root: &Table<'_>,
    coordinates: &[String],
    diagnostics: &mut Diagnostics,
) -> Units {
    let mut units = Units::default();
    let Some(table) = root.table("units", diagnostics) else { return units };
    let mut all = None;
    let mut own: Vec<Option<String>> = vec![None; coordinates.len()];
    for (key, place, value) in table.entries() {
        let places: Vec<usize> = (0..coordinates.len())
            .filter(|&i| key == coordinates[i] || key == head(&coordinates[i]))
            .collect();
        if !matches!(key, "time" | "momentum") && places.is_empty() {
            // Without coordinates there was a mistake in them, and every key would be unknown.
            if !coordinates.is_empty() {
                let known = known(coordinates);
                let near = nearest(key, known.iter().map(String::as_str)).map(str::to_owned);
                let owner = table.name().to_owned();
                let unknown = Mistake::UnknownKey(key.to_owned(), owner, near, known);
                diagnostics.report(place, unknown);
            }
            continue;
        }
        let DeValue::String(text) = value.get_ref() else {
            let example = format!("{key} = \"kg m²/s\"");
            wrong_kind(key, "a text in quotes", value, &example, diagnostics);
            continue;
        };
        let Some(unit) = unit(text) else {
            let message = format!(
                "a unit is a text of 1 to {LONGEST} printable characters; leave it out where there \
                 is none"
            );
            let help = Some(format!("write for example {EXAMPLE}"));
            diagnostics.report(span(value), Mistake::Other(message, help));
            continue;
        };
        match key {
            "time" => units.time = Some(unit),
            "momentum" => all = Some(unit),
            _ => places.iter().for_each(|&i| own[i] = Some(unit.clone())),
        }
    }
    units.momentum = own.into_iter().map(|unit| unit.or_else(|| all.clone())).collect();
    units
}

/// The text without spaces around it, if it can be a unit.
fn unit(text: &str) -> Option<String> {
    let text = text.trim();
    let length = text.chars().count();
    let fits = (1..=LONGEST).contains(&length) && !text.chars().any(char::is_control);
    fits.then(|| text.to_owned())
}

/// `x` of `x[3]`.
fn head(coordinate: &str) -> &str {
    coordinate.split('[').next().unwrap_or(coordinate)
}

/// The keys of the table: those of copies once.
fn known(coordinates: &[String]) -> Vec<String> {
    let mut known = vec!["time".to_owned(), "momentum".to_owned()];
    for name in coordinates.iter().map(|name| head(name)) {
        if known.last().is_none_or(|last| last != name) && !known.iter().any(|k| k == name) {
            known.push(name.to_owned());
        }
    }
    known
}
