//! Events: `[[event]]`, functions of the state whose changes of sign a run looks for.

use coadjoint_program::Program;

use super::table::Table;
use crate::lie::LieAlgebra;
use crate::parse::{Name, Names};
use crate::pass::{entries, function};

const EVENT: &str = "[[event]] with when = \"g[2][2]\"";
const WHEN: &str = "when = \"g[2][2]\"";
const NAME: &str = "name = \"upright\"";
const DIRECTION: &str = "direction = \"up\"";
const STOP: &str = "stop = true";

/// An event that a run is to look for.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Its name; the function's text where it has none.
    pub name: String,
    /// The function, with one output. Its inputs are the momentum, the entries of the matrix of g row by row, and the time.
    pub function: Program,
    /// The slots of the function.
    pub slots: Vec<f64>,
    /// The sign of the slope at the changes that count; 0 where all do.
    pub direction: i8,
    /// The run ends at the event.
    pub stop: bool,
}

pub(super) fn read(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    coordinates: &[String],
) -> Vec<Event> {
    let Some((list, _)) = root.array("event", EVENT) else { return Vec::new() };
    let Some(algebra) = algebra else { return Vec::new() };
    let size = algebra.matrix_size();
    let inputs = [coordinates.to_vec(), entries(size)].concat();
    let mut names = Names::default();
    for (place, name) in inputs.iter().enumerate() {
        names.known(name, Name::Coordinate(place));
    }
    for i in 0..coordinates.len() {
        names.alias(format!("mu[{i}]"), Name::Coordinate(i));
    }
    names.include(root.constants);
    names.known("t", Name::Time);
    let tables = list.into_iter().filter_map(|value| root.entry("event", value, EVENT));
    tables.filter_map(|table| event(&table, &names, &inputs)).collect()
}

fn event(table: &Table<'_>, names: &Names, inputs: &[String]) -> Option<Event> {
    table.check_keys(&["name", "when", "direction", "stop"]);
    if !table.has("when") {
        table.missing("when", WHEN);
    }
    let direction = match table.string("direction", DIRECTION) {
        Some(("up", _)) => 1,
        Some(("down", _)) => -1,
        Some(("both", _)) | None => 0,
        Some((_, place)) => {
            table.refuse(place, "`direction` is up, down or both", DIRECTION);
            0
        }
    };
    let stop = table.flag("stop", STOP);
    let energy = table.energy("when", WHEN, names, Vec::new())?;
    let name = table.string("name", NAME).map(|(name, _)| name.to_owned());
    let name = name.unwrap_or_else(|| energy.source.clone());
    let (root, _) = energy.root?;
    let (function, slots) = function((&energy.arena, &[root]), inputs, table.diagnostics)?;
    Some(Event { name, function, slots, direction, stop })
}
