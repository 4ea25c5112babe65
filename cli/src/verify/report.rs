//! The output of `simulate --format json`, as tables of two rows: the start and the end.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Deserializer, Map, Value};

use super::table::{Table, damaged};
use crate::error::CliError;
use crate::load;

/// A table for each run of ours in the file, which may hold one report, a list of them, or one a line.
///
/// # Errors
/// Where it cannot be read or holds no such report.
pub fn tables(path: &Path) -> Result<Vec<Table>, CliError> {
    let text = load::text(path)?;
    let mut reports = Vec::new();
    for value in Deserializer::from_str(&text).into_iter::<Value>() {
        match value.map_err(|error| damaged(path, &format!("no JSON: {error}")))? {
            Value::Array(list) => reports.extend(list),
            value => reports.push(value),
        }
    }
    // A method run beside ours has no step of its own to be judged by.
    let ours = |report: &&Value| report["run"].get("step").is_some();
    let tables: Vec<Table> =
        reports.iter().filter(ours).map(|report| table(path, report)).collect::<Result<_, _>>()?;
    if tables.is_empty() {
        let what =
            "no report of `simulate --format json`; for an ensemble give the file of its states";
        return Err(damaged(path, &what));
    }
    Ok(tables)
}

fn table(path: &Path, report: &Value) -> Result<Table, CliError> {
    let missing = |what: &str| damaged(path, &format!("the report has no {what}"));
    let run = report["run"].as_object().ok_or_else(|| missing("`run`"))?;
    let head: BTreeMap<String, String> =
        run.iter().map(|(name, value)| (name.clone(), text(value))).collect();
    let start =
        numbers(run.get("initial_momentum")).ok_or_else(|| missing("`initial_momentum`"))?;
    let end = numbers(report.get("momentum")).ok_or_else(|| missing("`momentum`"))?;
    let time = report["time"].as_f64().ok_or_else(|| missing("`time`"))?;
    let (names, entries) = element(&report["group_element_blocks"])
        .ok_or_else(|| missing("`group_element_blocks`"))?;
    let before = first(run, &names).ok_or_else(|| missing("start that fits its end"))?;
    let mut all = vec!["time".to_owned()];
    all.extend((1..=end.len()).map(|i| format!("mu_{i}")));
    all.extend(names.into_iter().map(|Entry { name, .. }| name));
    let row = |time: f64, momentum: Vec<f64>, element: Vec<f64>| -> Vec<f64> {
        std::iter::once(time).chain(momentum).chain(element).collect()
    };
    let mut rows = vec![row(0.0, start, before), row(time, end, entries)];
    if let Some(energy) = report["energy"].as_object() {
        all.push("energy".to_owned());
        for (row, name) in rows.iter_mut().zip(["start", "end"]) {
            row.push(energy.get(name).and_then(Value::as_f64).unwrap_or(f64::NAN));
        }
    }
    if rows.iter().any(|row| row.len() != all.len()) {
        return Err(missing("start that fits its end"));
    }
    Ok(Table::of_rows(path, head, all, rows))
}

/// A column of the group element: its name, and its place in the whole matrix, from 0.
struct Entry {
    name: String,
    row: usize,
    column: usize,
    size: usize,
}

/// The entries of the blocks of the group element, and their values.
fn element(blocks: &Value) -> Option<(Vec<Entry>, Vec<f64>)> {
    let mut parsed = Vec::new();
    for block in blocks.as_array()? {
        let first = usize::try_from(block["first_row"].as_u64()?).ok()?;
        let rows = block["matrix"].as_array()?.iter().map(|row| numbers(Some(row)));
        parsed.push((first, rows.collect::<Option<Vec<_>>>()?));
    }
    let size = parsed.iter().map(|(first, rows)| first + rows.len()).max().unwrap_or(0);
    let separator = if size > 9 { "_" } else { "" };
    let (mut entries, mut values) = (Vec::new(), Vec::new());
    for (first, rows) in parsed {
        for (i, cells) in rows.into_iter().enumerate() {
            for (j, value) in cells.into_iter().enumerate() {
                let (row, column) = (first + i, first + j);
                let name = format!("g_{}{separator}{}", row + 1, column + 1);
                entries.push(Entry { name, row, column, size });
                values.push(value);
            }
        }
    }
    Some((entries, values))
}

/// The entries of the group element at the start: those of `initial_group_element`, row by row, or of the identity.
fn first(run: &Map<String, Value>, entries: &[Entry]) -> Option<Vec<f64>> {
    let given = match run.get("initial_group_element") {
        Some(given) => Some(numbers(Some(given))?),
        None => None,
    };
    let value = |entry: &Entry| match &given {
        Some(given) => given.get(entry.row * entry.size + entry.column).copied(),
        None => Some(if entry.row == entry.column { 1.0 } else { 0.0 }),
    };
    entries.iter().map(value).collect()
}

fn numbers(value: Option<&Value>) -> Option<Vec<f64>> {
    value?.as_array()?.iter().map(Value::as_f64).collect()
}

/// A value as the head of a CSV file has it.
pub fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(list) => list.iter().map(text).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}
