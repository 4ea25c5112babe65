//! Inputs whose tables are files, and how far they reach.

use std::path::Path;

use coadjoint_codegen::potential::{Force, Potential};
use coadjoint_codegen::signal::{Columns, Signal, SignalError};
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::system::System;
use coadjoint_learn::table::{Row, Table};

use crate::error::RunError;
use crate::number::shortest;

/// Reads the tables of inputs that stand in files, which are named relative to that of the system.
///
/// # Errors
/// The file, and the row and the column where it is wrong.
pub fn fill(system: &Path, read: &mut System<Hamiltonian>) -> Result<(), RunError> {
    let of_energy = match &mut read.problem {
        Hamiltonian::Smooth(smooth) => &mut smooth.signals[..],
        Hamiltonian::Polynomial(_) => &mut [],
    };
    let of_torque = match &mut read.potential {
        Some((Potential { force: Force::Smooth(programs), .. }, _)) => &mut programs.signals[..],
        _ => &mut [],
    };
    for signal in of_energy.iter_mut().chain(of_torque) {
        if let Some(columns) = &signal.columns {
            let folder = system.parent().unwrap_or(Path::new(""));
            *signal = of_file(&signal.name, columns, &folder.join(&columns.file))?;
        }
    }
    Ok(())
}

fn of_file(name: &str, columns: &Columns, path: &Path) -> Result<Signal, RunError> {
    let refuse = |what: String| RunError::of(path)(what);
    let mut table = Table::open(path)?;
    let column = |name: &String| {
        let place = table.names().iter().position(|known| known == name);
        place.ok_or_else(|| {
            refuse(format!("column {name} is missing; there are {}", table.names().join(", ")))
        })
    };
    let places = [column(&columns.times)?, column(&columns.values)?];
    let (mut times, mut values, mut row) = (Vec::new(), Vec::new(), Row::default());
    while table.read(&mut row)? {
        let number = |column: &String, place| match row.number(place) {
            Ok(number) if number.is_finite() => Ok(number),
            other => {
                let cell = other.map_or_else(|cell| cell, shortest);
                let at = table.number();
                Err(refuse(format!("row {at}, column {column}: `{cell}` is no finite number")))
            }
        };
        times.push(number(&columns.times, places[0])?);
        values.push(number(&columns.values, places[1])?);
    }
    Signal::new(name.to_owned(), times, values).map_err(|error| match error {
        SignalError::Times(at, time) => {
            let (row, column, time) = (at + 1, &columns.times, shortest(time));
            refuse(format!(
                "row {row}, column {column}: {time} must be after the time of the row before"
            ))
        }
        other => refuse(other.to_string()),
    })
}

/// Whether inputs have a value from time 0 to `end`.
///
/// # Errors
/// The first that has not, in the system that is called `file`.
pub fn reach(file: &Path, signals: &[Signal], end: f64) -> Result<(), RunError> {
    let [from, to] = [end.min(0.0), end.max(0.0)];
    let short = signals.iter().find(|signal| {
        let [first, last] = signal.range();
        // The last step may end beyond by rounding; its nodes are within it.
        !(first <= from && to <= last + 1e-12 * to.abs())
    });
    let Some(signal) = short else { return Ok(()) };
    let ([first, last], [from, to]) = (signal.range().map(shortest), [from, to].map(shortest));
    Err(RunError::of(file)(format!(
        "the table of the input `{}` goes from time {first} to {last}, and the run from {from} to {to}: give a longer \
         table, or end the run earlier with --time",
        signal.name
    )))
}
