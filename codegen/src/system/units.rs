//! The table `[units]`: texts for the people who read plots and reports.

use super::table::Table;

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
pub(super) fn read(root: &Table<'_>, coordinates: &[String]) -> Units {
    let mut units = Units::default();
    let Some(table) = root.table("units") else { return units };
    let mut all = None;
    let mut own: Vec<Option<String>> = vec![None; coordinates.len()];
    for (key, place, _) in table.entries() {
        let places: Vec<usize> = (0..coordinates.len())
            .filter(|&i| key == coordinates[i] || key == head(&coordinates[i]))
            .collect();
        if !matches!(key, "time" | "momentum") && places.is_empty() {
            // Without coordinates there was a mistake in them, and every key would be unknown.
            if !coordinates.is_empty() {
                table.unknown_key(key, place, &known(coordinates));
            }
            continue;
        }
        let Some((text, span)) = table.string(key, &format!("{key} = \"kg m²/s\"")) else {
            continue;
        };
        let Some(unit) = unit(text) else {
            let what = format!(
                "a unit is a text of 1 to {LONGEST} printable characters; leave it out where there is none"
            );
            table.refuse(span, &what, EXAMPLE);
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
fn known(coordinates: &[String]) -> Vec<&str> {
    let mut known = vec!["time", "momentum"];
    for name in coordinates.iter().map(|name| head(name)) {
        if !known.contains(&name) {
            known.push(name);
        }
    }
    known
}
