//! The output of `simulate --format json` as tables of two rows: the start and the end.

use std::collections::BTreeMap;
use std::path::Path;

use coadjoint_learn::table::{Table, remark};
use serde_json::{Deserializer, Value};

use crate::error::CliError;
use crate::load;

/// A table for each run of ours in the file, which may hold one report, a list of them, or one a line.
///
/// # Errors
/// Fails if the file cannot be read or holds no such report.
pub(crate) fn tables(path: &Path) -> Result<Vec<Table>, CliError> {
    let damaged = |what: String| CliError::Option(format!("{}: {what}", path.display()));
    let text = load::text(path)?;
    let mut reports = Vec::new();
    for value in Deserializer::from_str(&text).into_iter::<Value>() {
        match value.map_err(|error| damaged(format!("no JSON: {error}")))? {
            Value::Array(list) => reports.extend(list),
            value => reports.push(value),
        }
    }
    // A method run beside ours has no step of its own to be judged by.
    reports.retain(|report| report["run"].get("step").is_some());
    if reports.is_empty() {
        return Err(damaged(
            "no report of `simulate --format json`; for an ensemble give the file of its states"
                .to_owned(),
        ));
    }
    let table = |report: &Value| {
        table(path, report).ok_or_else(|| {
            damaged("the report has no start and end that fit each other".to_owned())
        })
    };
    reports.iter().map(table).collect()
}

fn table(path: &Path, report: &Value) -> Option<Table> {
    let run = report["run"].as_object()?;
    let mut head: BTreeMap<String, String> =
        run.iter().map(|(name, value)| (name.clone(), remark(value))).collect();
    // A report is whole, and holds no records between start and end.
    head.remove("every");
    head.insert("complete".to_owned(), "true".to_owned());
    let start = numbers(&report["run"]["initial_momentum"])?;
    let end = numbers(&report["momentum"])?;
    let momenta = (1..=end.len()).map(|i| format!("mu_{i}"));
    let mut names: Vec<String> = std::iter::once("time".to_owned()).chain(momenta).collect();
    // A run that does not say when it starts does so at time 0.
    let start_time = run.get("initial_time").map_or(Some(0.0), Value::as_f64)?;
    let mut rows = [vec![start_time], vec![report["time"].as_f64()?]];
    rows[0].extend(start);
    rows[1].extend(end);
    // The blocks of the group element with the number, from 0, of the first row and column of each.
    let blocks = report["group_element_blocks"].as_array()?;
    let block = |block: &Value| {
        let matrix = block["matrix"].as_array()?.iter().map(numbers).collect::<Option<Vec<_>>>()?;
        Some((usize::try_from(block["first_row"].as_u64()?).ok()?, matrix))
    };
    let blocks = blocks.iter().map(block).collect::<Option<Vec<_>>>()?;
    let size = blocks.iter().map(|(first, matrix)| first + matrix.len()).max().unwrap_or(0);
    let separator = if size > 9 { "_" } else { "" };
    let given = match run.get("initial_group_element") {
        Some(given) => Some(numbers(given)?),
        None => None,
    };
    for (first, matrix) in blocks {
        for (i, cells) in (first..).zip(matrix) {
            for (j, value) in (first..).zip(cells) {
                let one = if i == j { 1.0 } else { 0.0 };
                rows[0].push(given.as_ref().map_or(Some(one), |g| g.get(i * size + j).copied())?);
                rows[1].push(value);
                names.push(format!("g_{}{separator}{}", i + 1, j + 1));
            }
        }
    }
    if let Some(energy) = report["energy"].as_object() {
        let [start, end] = ["start", "end"].map(|name| energy.get(name).and_then(Value::as_f64));
        rows[0].push(start.unwrap_or(f64::NAN));
        rows[1].push(end.unwrap_or(f64::NAN));
        names.push("energy".to_owned());
    }
    let fits = rows.iter().all(|row| row.len() == names.len());
    let width = names.len();
    fits.then(|| Table::of_rows(path, names, width, rows.concat()).saying(head))
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}
