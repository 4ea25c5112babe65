//! Inputs whose tables are files, and how far they reach.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use coadjoint_codegen::signal::{Columns, Interpolation, Signal, SignalError};
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::system::System;
use coadjoint_learn::table::{Cells, Table};
use sha2::{Digest, Sha256};

use crate::error::RunError;
use crate::number::shortest;

/// The SHA-256 of the numbers of inputs; `None` where there are none.
pub fn inputs_hash(signals: &[Signal]) -> Option<String> {
    let mut hash = Sha256::new();
    for signal in signals {
        hash.update(&signal.name);
        // Splines have the hash that they had before there was another course.
        if !signal.breaks().is_empty() {
            hash.update([signal.between as u8]);
        }
        signal.table().concat().iter().for_each(|number| hash.update(number.to_le_bytes()));
    }
    (!signals.is_empty()).then(|| format!("{:x}", hash.finalize()))
}

/// The files that hold the tables of inputs, for the system of this file.
pub fn inputs_files(system: &Path, signals: &[Signal]) -> BTreeSet<PathBuf> {
    let columns = signals.iter().filter_map(|signal| signal.columns.as_ref());
    columns.map(|columns| beside(system, columns)).collect()
}

/// The file of a table.
fn beside(system: &Path, columns: &Columns) -> PathBuf {
    system.parent().unwrap_or(Path::new("")).join(&columns.file)
}

/// Columns of a file, by their names.
type Read = BTreeMap<String, Vec<f64>>;

/// Reads the tables of inputs that stand in files, which are named relative to that of the system; every file once.
///
/// # Errors
/// The file, and the row and the column where it is wrong.
pub(crate) fn fill(system: &Path, read: &mut System<Hamiltonian>) -> Result<(), RunError> {
    let signals = read.problem.signals_mut();
    // Given signals have their numbers already.
    let unread = |signal: &&Signal| signal.table()[0].is_empty();
    let mut files: BTreeMap<PathBuf, Read> = BTreeMap::new();
    for columns in signals.iter().filter(unread).filter_map(|signal| signal.columns.as_ref()) {
        let of_file = files.entry(beside(system, columns)).or_default();
        of_file.entry(columns.times.clone()).or_default();
        of_file.entry(columns.values.clone()).or_default();
    }
    for (path, columns) in &mut files {
        fill_columns(system, path, columns)?;
    }
    for signal in signals {
        if let (Some(columns), [[], _]) = (signal.columns.clone(), signal.table()) {
            let path = beside(system, &columns);
            *signal = from_columns((&signal.name, signal.between), &columns, &files[&path])
                .map_err(|what| RunError::of(&path)(what))?;
            signal.columns = Some(columns);
        }
    }
    Ok(())
}

fn fill_columns(system: &Path, path: &Path, columns: &mut Read) -> Result<(), RunError> {
    let refuse = |what: String| RunError::of(path)(what);
    let unread = |error| RunError::of(system)(format!("`table` of [inputs]: {error}"));
    let mut table = Table::open(path).map_err(unread)?;
    let names = table.names().to_vec();
    if let Some(name) = columns.keys().find(|name| !names.contains(name)) {
        return Err(refuse(format!("column {name} is missing; there are {}", names.join(", "))));
    }
    let mut row = Cells::default();
    while table.read(&mut row).map_err(unread)? {
        for (place, column) in names.iter().enumerate() {
            let Some(numbers) = columns.get_mut(column) else { continue };
            match row.number(place) {
                Ok(number) if number.is_finite() => numbers.push(number),
                other => {
                    let (at, cell) = (table.number(), other.map_or_else(|cell| cell, shortest));
                    let place = format!("row {at}, column {column}");
                    return Err(refuse(format!("{place}: `{cell}` is no finite number")));
                }
            }
        }
    }
    Ok(())
}

fn from_columns(
    (name, between): (&str, Interpolation),
    columns: &Columns,
    read: &Read,
) -> Result<Signal, String> {
    let [times, values] = [&columns.times, &columns.values].map(|column| read[column].clone());
    Signal::new(name.to_owned(), times, values, between).map_err(|error| match error {
        SignalError::Times(at, time) => format!(
            "row {}, column {}: {} must be after the time of the row before",
            at + 1,
            columns.times,
            shortest(time)
        ),
        SignalError::Close(_, at, reached) => format!(
            "rows {} and {}, column {}: the times are so close that the spline through `{name}` reaches {reached:.1e}, far from \
             the values of column {}: for values that jump write hold = \"previous\", for lines between them hold = \"linear\"",
            at + 1,
            at + 2,
            columns.times,
            columns.values
        ),
        other => other.to_string(),
    })
}

/// Checks that inputs have a value from one time to the other.
///
/// # Errors
/// The first that has not, in the system that is called `file`.
pub(crate) fn reach(
    file: &Path,
    signals: &[Signal],
    [start, end]: [f64; 2],
) -> Result<(), RunError> {
    let [from, to] = [end.min(start), end.max(start)];
    let short = signals.iter().find(|signal| {
        let [first, last] = signal.range();
        // The last step may end beyond by rounding; its nodes are within it.
        let rounding = 1e-12 * start.abs().max(end.abs());
        !(first <= from + rounding && to <= last + rounding)
    });
    let Some(signal) = short else { return Ok(()) };
    let ([first, last], [from, to]) = (signal.range().map(shortest), [from, to].map(shortest));
    Err(RunError::of(file)(format!(
        "the table of the input `{}` goes from time {first} to {last}, and the run from {from} to {to}: give a longer \
         table, or end the run earlier with --time",
        signal.name
    )))
}
