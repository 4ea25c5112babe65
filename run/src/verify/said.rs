//! Statements of a file beside the states of its rows: its head, and the columns of energies and drifts.

use coadjoint_codegen::smooth::{Facts, Hamiltonian};
use coadjoint_learn::table::Table;

use super::found::Found;
use super::states::{Columns, Invariants, Measured, Reading};
use crate::engine::identity;
use crate::grid::Grid;
use crate::number::shortest;

/// A time may be this far from where the grid has it, relative to a step.
const SLACK: f64 = 1e-6;
/// The largest distance of numbers from those that follow from the head.
const NEAR: f64 = 1e-9;

/// The statements of a file, compared with its rows.
pub(super) struct Said {
    /// The start of the run, once it is known.
    start: Option<Measured>,
    /// The time at the end and the number of steps between records, where the head gives them.
    end: Option<f64>,
    every: Option<f64>,
    /// Records at times that are asked for, or at events, are not a fixed number of steps apart.
    others: bool,
    grid: Grid,
    last: Option<f64>,
}

impl Said {
    /// Compares the head with the system and the step.
    pub(super) fn new(
        (hamiltonian, invariants): (&Hamiltonian, &Invariants),
        grid: Grid,
        table: &Table,
        found: &mut Found,
    ) -> Self {
        let Facts { algebra, truncation, .. } = hamiltonian.facts();
        let number = |name: &str| table.value(name)?.parse::<f64>().ok();
        if let Some(group) = table.value("group").filter(|group| *group != algebra.name()) {
            found.blame(format!("the head says `group: {group}`, which is {}", algebra.name()));
        }
        let end = number("time");
        let steps = end.map(|end| (end - grid.start) / grid.step);
        for (name, right) in [("nodes", Some(truncation.div_ceil(2) as f64)), ("steps", steps)] {
            if let Some((said, right)) = number(name).zip(right)
                && !((said - right).abs() <= SLACK * right.abs().max(1.0))
            {
                let right = shortest(right);
                found.blame(format!("the head says `{name}: {said}`, which is {right}"));
            }
        }
        let others = table.value("at").or(table.value("events")).is_some();
        let momentum = table.values("initial_momentum");
        let momentum = momentum.filter(|momentum| momentum.len() == algebra.dim());
        let start = momentum.map(|momentum| Reading { momentum, element: None });
        let start = start.map(|state| invariants.at(grid.start, state));
        Self { start, end, every: number("every"), others, grid, last: None }
    }

    /// Compares a row with what the file says of it.
    pub(super) fn row(
        &mut self,
        (number, time): (u64, f64),
        (columns, row): (&Columns, &[f64]),
        known: &Measured,
        found: &mut Found,
    ) {
        let place = format!("row {number}, time {time}");
        if let (Some(every), Some(last), false) = (self.every, self.last, self.others) {
            let steps = (time - last) / self.grid.step;
            // The last record of a run may come earlier.
            let ends = self.end == Some(time) && steps > 0.0 && steps < every;
            if !((steps - every).abs() <= SLACK * every || ends) {
                let steps = shortest((steps / SLACK).round() * SLACK);
                found.blame(format!(
                    "{place}: {steps} steps after the last row, and the file says every {every}"
                ));
            }
        }
        self.last = Some(time);
        let drifts = self.start.as_ref().map_or([None; 3], |start| start.drifts(known));
        let names =
            ["spatial momentum", "Casimirs", "energy"].map(|name| format!("drift of the {name}"));
        let drifts = names.into_iter().zip(columns.drifts).zip(drifts);
        let energy = (("energy".to_owned(), columns.energy), known.energy());
        for ((name, column), right) in drifts.chain([energy]) {
            // A drift that cannot be measured is NaN in the file.
            let said = column.map(|column| row[column]).filter(|said| !said.is_nan());
            if let Some((said, (right, bound))) = said.zip(right)
                && !((said - right).abs() <= bound)
            {
                found
                    .blame(format!("{place}: the {name} is {right:e}, and the file says {said:e}"));
            }
        }
    }

    /// The start of the run is the first row, which the head describes too.
    pub(super) fn begin(
        &mut self,
        (table, invariants): (&Table, &Invariants),
        known: Measured,
        found: &mut Found,
    ) {
        let apart = |a: &[f64], b: &[f64], near: f64| {
            a.len() != b.len()
                || a.iter().zip(b).any(|(a, b)| !((a - b).abs() <= near * (1.0 + a.abs())))
        };
        let scales = &known.start.scales;
        let element = known.state.element.as_deref();
        let given = self.start.as_ref().zip(element).map(|(_, element)| {
            let given = table.values("initial_group_element");
            let given = given.unwrap_or_else(|| identity(element.len().isqrt()));
            invariants.nearest(&given).unwrap_or(given)
        });
        let spatial = element.and(table.values("spatial_momentum_scale"));
        for (name, said, right, near) in [
            ("momentum", table.values("initial_momentum"), &known.state.momentum[..], 0.0),
            ("group element", given, element.unwrap_or_default(), NEAR),
            ("scale of the spatial momentum", spatial, &[scales.spatial_momentum], NEAR),
            ("scale of the Casimirs", table.values("casimir_scales"), &scales.casimirs, NEAR),
            ("scale of the energy", table.values("energy_scale"), &[scales.energy], NEAR),
        ] {
            if said.is_some_and(|said| apart(right, &said, near)) {
                let time = self.grid.start;
                found.blame(format!(
                    "row 1, time {time}: the {name} is not that which the file names as the start"
                ));
            }
        }
        self.start = Some(known);
    }

    /// Compares the number of rows and the last time with what the file says of its end.
    pub(super) fn end(self, table: &Table, found: &mut Found) {
        let rows = table.number();
        found.part = table.value("part").map(str::to_owned);
        let complete = table.value("complete");
        if let Some(said) = complete.and_then(|text| text.split(' ').next()?.parse::<u64>().ok())
            && said != rows
        {
            found.blame(format!("there are {rows} rows, and the file says that it has {said}"));
        }
        if complete == Some("false") {
            found.part.get_or_insert_with(|| "it was not completed".to_owned());
        }
        let (Some(end), Some(last), None) = (self.end, self.last, &found.part) else { return };
        let reached = (end - last).abs() <= SLACK * self.grid.step.abs();
        let [last, end] = [last, end].map(shortest);
        match complete {
            // The last of the times asked for, or an event, may come before the end.
            _ if reached || complete.is_some() && self.others => {}
            Some(_) => found.blame(format!(
                "the last row is at time {last}, and the file says that the run ends at {end}"
            )),
            None => found.cut(format!(
                "the file ends at time {last} of {end}, and does not say that it is complete"
            )),
        }
    }
}
