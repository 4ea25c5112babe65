//! Statements of a file beside the states of its rows: its head, and the columns of energies and drifts.

use coadjoint_codegen::smooth::{Facts, Hamiltonian};
use coadjoint_codegen::step::Start;
use coadjoint_learn::table::Table;

use super::found::Found;
use super::states::{Columns, DRIFT, Invariants, State};
use crate::engine::identity;
use crate::grid::Grid;
use crate::number::shortest;

/// A time may be this far from where the grid has it, relative to a step.
const SLACK: f64 = 1e-6;
/// The largest distance of numbers from those that follow from the head.
const NEAR: f64 = 1e-9;

/// The statements of a file, compared with its rows.
pub(super) struct Said<'a> {
    invariants: &'a Invariants,
    /// The start of the run and what is conserved there, once it is known.
    start: Option<(State, Start)>,
    /// The time at the end and the number of steps between records, where the head gives them.
    end: Option<f64>,
    every: Option<f64>,
    /// Records at times that are asked for, or at events, are not a fixed number of steps apart.
    others: bool,
    grid: Grid,
    last: Option<f64>,
}

impl<'a> Said<'a> {
    /// Compares the head with the system and the step.
    pub(super) fn new(
        (hamiltonian, invariants): (&Hamiltonian, &'a Invariants),
        grid: Grid,
        table: &Table,
        found: &mut Found,
    ) -> Self {
        let Facts { algebra, truncation, .. } = hamiltonian.facts();
        let number = |name: &str| table.value(name)?.parse::<f64>().ok();
        let mut differ = |name: &str, right: String, same: bool| {
            let said = table.value(name).unwrap_or_default();
            if !same {
                found.blame(format!("the head says `{name}: {said}`, which is {right}"));
            }
        };
        if let Some(group) = table.value("group") {
            differ("group", algebra.name().to_owned(), group == algebra.name());
        }
        if let Some(nodes) = number("nodes") {
            let right = truncation.div_ceil(2);
            differ("nodes", right.to_string(), nodes == right as f64);
        }
        let end = number("time");
        if let (Some(end), Some(steps)) = (end, number("steps")) {
            let right = (end - grid.start) / grid.step;
            let same = (steps - right).abs() <= SLACK * right.abs().max(1.0);
            differ("steps", format!("{} by time and step", shortest(right)), same);
        }
        let (every, others) =
            (number("every"), table.value("at").or(table.value("events")).is_some());
        let momentum = table.values("initial_momentum");
        let momentum = momentum.filter(|momentum| momentum.len() == algebra.dim());
        let start = momentum.map(|momentum| {
            let state = State { momentum, element: None };
            let start = invariants.start(grid.start, &state);
            (state, start)
        });
        Self { invariants, start, end, every, others, grid, last: None }
    }

    /// Compares a row with what the file says of it.
    pub(super) fn row(
        &mut self,
        (number, time): (u64, f64),
        (columns, row): (&Columns, &[f64]),
        (table, state): (&Table, &State),
        found: &mut Found,
    ) {
        let place = format!("row {number}, time {time}");
        if let (Some(every), Some(last), false) = (self.every, self.last, self.others) {
            // The last record of a run may come earlier.
            let apart = (time - last) / (every * self.grid.step);
            let ends = self.end == Some(time) && apart > 0.0;
            if !((apart - 1.0).abs() <= SLACK || ends && apart < 1.0) {
                let steps = apart * every;
                let whole =
                    if (steps - steps.round()).abs() <= SLACK { steps.round() } else { steps };
                found.blame(format!(
                    "{place}: {} steps after the last row, and the file says every {every}",
                    shortest(whole)
                ));
            }
        }
        self.last = Some(time);
        if number == 1 && time == self.grid.start {
            self.begin(table, state, &place, found);
        }
        let energy = self.invariants.energy(time, &state.momentum);
        if let Some((said, (energy, size))) = columns.energy.map(|column| row[column]).zip(energy)
            && !((said - energy).abs() <= DRIFT * size)
        {
            found.blame(format!("{place}: the energy is {energy}, and the file says {said}"));
        }
        let Some((first, start)) = &self.start else { return };
        let drifts = self.invariants.drifts((first, start), (time, state));
        let names = ["spatial momentum", "Casimirs", "energy"];
        for ((name, column), drift) in names.iter().zip(columns.drifts).zip(drifts) {
            // Where a drift cannot be measured the file says that it is not a number.
            let said = column.map(|column| row[column]).filter(|said| !said.is_nan());
            if let Some((said, (drift, bound))) = said.zip(drift)
                && drift.is_finite()
                && !((said - drift).abs() <= bound)
            {
                found.blame(format!(
                    "{place}: the drift of the {name} is {drift:.1e}, and the file says {said:e}"
                ));
            }
        }
    }

    /// The start of the run is the first row, which the head describes too.
    fn begin(&mut self, table: &Table, state: &State, place: &str, found: &mut Found) {
        let said = self.start.as_ref().map(|(said, _)| &said.momentum);
        if said.is_some_and(|said| *said != state.momentum) {
            let what = "the momentum is not that which the file names as the start";
            found.blame(format!("{place}: {what}"));
        }
        let start = self.invariants.start(self.grid.start, state);
        let apart = |a: &[f64], b: &[f64]| {
            a.len() != b.len()
                || a.iter().zip(b).any(|(a, b)| !((a - b).abs() <= NEAR * (1.0 + a.abs())))
        };
        if let (Some(element), Some(_)) = (&state.element, said) {
            let given = table.values("initial_group_element");
            let given = given.unwrap_or_else(|| identity(element.len().isqrt()));
            let right = self.invariants.nearest(&given).unwrap_or(given);
            if apart(&right, element) {
                let what = "the group element is not that which the file names as the start";
                found.blame(format!("{place}: {what}"));
            }
        }
        let scales = [
            ("spatial_momentum_scale", vec![start.scales.spatial_momentum]),
            ("casimir_scales", start.scales.casimirs.clone()),
            ("energy_scale", vec![start.scales.energy]),
        ];
        for (name, right) in scales {
            let known = state.element.is_some() || name != "spatial_momentum_scale";
            if let Some(said) = table.values(name).filter(|_| known)
                && apart(&right, &said)
            {
                found.blame(format!("{place}: the head's `{name}` is not that of the start"));
            }
        }
        let state = State { momentum: state.momentum.clone(), element: state.element.clone() };
        self.start = Some((state, start));
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
        let last = shortest(last);
        match complete {
            // The last of the times asked for, or an event, may come before the end.
            _ if reached || complete.is_some() && self.others => {}
            Some(_) => found.blame(format!(
                "the last row is at time {last}, and the file says that the run ends at {}",
                shortest(end)
            )),
            None => found.cut(format!(
                "the file ends at time {last} of {}, and does not say that it is complete",
                shortest(end)
            )),
        }
    }
}
