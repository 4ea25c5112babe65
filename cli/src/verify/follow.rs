//! Following the motion from row to row by the right solution of each step.

use std::path::Path;

use coadjoint_codegen::judge::{Branch, Judge, Motion, Stop};
use coadjoint_codegen::lie::casimirs;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;
use serde_json::{Map, Value, json};

use super::record::Columns;
use super::table::Table;
use crate::error::CliError;

/// The unit roundoff of what is judged.
const UNIT: f64 = f64::EPSILON / 2.0;
/// A row's time may be this far from a whole number of steps.
const SLACK: f64 = 1e-6;
/// Steps between two rows at most: beyond, the bound on what rounding does says nothing.
const FARTHEST: u64 = 100_000;
/// Casimirs may drift by this much a step, relative to the sum of the absolute values of their terms.
const DRIFT: f64 = 64.0 * f64::EPSILON;

/// Steps of one size, in doubled precision.
pub struct Follower<'a> {
    judge: &'a Judge,
    step: f64,
    symbols: Vec<f64>,
    casimirs: Vec<Polynomial>,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Rows that were reached from another.
    rows: u64,
    /// Steps made.
    steps: u64,
    /// The largest deviation over its bound, of momenta and of group elements.
    momentum: f64,
    element: f64,
    /// The largest drift of a Casimir from row to row, relative to its terms.
    casimir: f64,
    /// Rows that could not be judged.
    untold: u64,
    /// What is wrong with the first wrong row.
    pub wrong: Option<String>,
}

impl Found {
    /// For people.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("{} rows by {} steps in doubled precision", self.rows, self.steps),
            format!("worst momentum: {:.2e} of its bound", self.momentum),
            format!("worst group element: {:.2e} of its bound", self.element),
            format!("worst drift of a Casimir from row to row: {:.2e}", self.casimir),
        ];
        if self.untold > 0 {
            lines.push(format!("{} rows could not be judged", self.untold));
        }
        let closing = if self.wrong.is_some() { "wrong" } else { "no row is wrong" };
        lines.push(closing.to_owned());
        lines
    }

    /// For programs.
    pub fn object(&self) -> Map<String, Value> {
        let list = [
            ("rows", json!(self.rows)),
            ("steps", json!(self.steps)),
            ("momentum", json!(self.momentum)),
            ("group_element", json!(self.element)),
            ("casimir", json!(self.casimir)),
            ("not_judged", json!(self.untold)),
            ("wrong", json!(self.wrong)),
        ];
        list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn blame(&mut self, what: String) {
        self.wrong.get_or_insert(what);
    }
}

/// The larger of two numbers; NaN where one is.
fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

impl<'a> Follower<'a> {
    /// For steps of this size.
    ///
    /// # Errors
    /// Where a parameter is not finite.
    pub fn new(
        judge: &'a Judge,
        problem: &Problem,
        step: f64,
        symbols: Vec<f64>,
    ) -> Result<Self, CliError> {
        judge.at(step, &symbols).map_err(|error| CliError::Option(error.to_string()))?;
        let casimirs = casimirs(&problem.algebra, 2).unwrap_or_default();
        Ok(Self { judge, step, symbols, casimirs })
    }

    /// Rows of one motion. Between rows that are not a whole number of steps apart the last step is shorter.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn rows(
        &self,
        mut table: Table,
        columns: &Columns,
        file: &Path,
    ) -> Result<Found, CliError> {
        let Some(time) = columns.time else {
            return Err(CliError::Option(format!(
                "{}: no column time: for the output of an ensemble give --input STATES and --steps N",
                file.display()
            )));
        };
        let mut found = Found::default();
        let mut last: Option<Vec<f64>> = None;
        let mut number = 0;
        while let Some(row) = table.next_row()? {
            number += 1;
            let mut grid = true;
            if let Some(last) = &last {
                let steps = (row[time] - last[time]) / self.step;
                let whole = steps.round();
                grid = (steps - whole).abs() <= SLACK * whole.max(1.0);
                let place = format!("row {number}, time {}", row[time]);
                if !(steps >= -SLACK) || whole > FARTHEST as f64 {
                    let what = format!(
                        "{place}: {steps} steps of {} after the last row; give the run's --step",
                        self.step
                    );
                    return Err(CliError::Option(format!("{}: {what}", file.display())));
                }
                let (count, rest) = if grid {
                    (whole as u64, 0.0)
                } else {
                    (steps.floor() as u64, self.step * (steps - steps.floor()))
                };
                self.compare(&place, columns, last, &row, (count, rest), &mut found);
            }
            // A row beside the grid is where a step of its own led: the motion goes on from the grid.
            if grid {
                last = Some(row);
            }
        }
        Ok(found)
    }

    /// Rows of end states, each with its start.
    ///
    /// # Errors
    /// Where a file cannot be read, or has fewer rows than the other.
    pub fn pairs(
        &self,
        mut starts: Table,
        before: &Columns,
        mut ends: Table,
        columns: &Columns,
        steps: u64,
        file: &Path,
    ) -> Result<Found, CliError> {
        let mut found = Found::default();
        let mut number = 0;
        while let Some(end) = ends.next_row()? {
            number += 1;
            let Some(start) = starts.next_row()? else {
                return Err(CliError::Option(format!(
                    "{}: row {number} has no start in the input",
                    file.display()
                )));
            };
            let place = format!("row {number}");
            self.judge_row(
                &place,
                (before.momentum(&start), before.element(&start)),
                (columns.momentum(&end), columns.element(&end)),
                (steps, 0.0),
                &mut found,
            );
        }
        Ok(found)
    }

    fn compare(
        &self,
        place: &str,
        columns: &Columns,
        last: &[f64],
        row: &[f64],
        steps: (u64, f64),
        found: &mut Found,
    ) {
        let state = |row: &[f64]| (columns.momentum(row), columns.element(row));
        self.judge_row(place, state(last), state(row), steps, found);
    }

    /// From one state to another in so many steps, and one more of another size if that is not 0.
    fn judge_row(
        &self,
        place: &str,
        before: (Vec<f64>, Option<Vec<f64>>),
        after: (Vec<f64>, Option<Vec<f64>>),
        (steps, rest): (u64, f64),
        found: &mut Found,
    ) {
        found.rows += 1;
        found.steps += steps + u64::from(rest != 0.0);
        let finite = |state: &(Vec<f64>, Option<Vec<f64>>)| {
            state.0.iter().chain(state.1.iter().flatten()).all(|v| v.is_finite())
        };
        if !finite(&before) || !finite(&after) {
            found.blame(format!("{place}: a number is not finite"));
            return;
        }
        let mut motion = Motion::new(&before.0);
        for (size, count) in [(self.step, steps), (rest, u64::from(rest != 0.0))] {
            let Ok(mut setting) = self.judge.at(size, &self.symbols) else { return };
            for done in 0..count {
                match motion.step(&mut setting, None, UNIT) {
                    Ok(()) => {}
                    Err(Stop::Branch(Branch::Folds(s))) => {
                        found.blame(format!(
                            "{place}: step {} of {count} has no right solution: its continuation \
                             folds at s = {s:.4}",
                            done + 1
                        ));
                        return;
                    }
                    Err(_) => {
                        found.untold += 1;
                        return;
                    }
                }
            }
        }
        let deviation = if steps == 0 && rest == 0.0 {
            if before.0 == after.0 { 0.0 } else { f64::INFINITY }
        } else {
            motion.momentum_deviation(&after.0)
        };
        found.momentum = maximum(found.momentum, deviation);
        if !(deviation <= 1.0) {
            let what = format!("{place}: the momentum is off by {deviation:.2e} times its bound");
            found.blame(what);
        }
        if let (Some(g), Some(moved)) = (&before.1, &after.1)
            && (steps > 0 || rest != 0.0)
        {
            let deviation = motion.element_deviation(g, moved);
            found.element = maximum(found.element, deviation);
            if !(deviation <= 1.0) {
                found.blame(format!(
                    "{place}: the group element is off by {deviation:.2e} times its bound"
                ));
            }
        }
        for (index, casimir) in self.casimirs.iter().enumerate() {
            let (one, other) = (casimir.evaluate(&before.0), casimir.evaluate(&after.0));
            let sizes = casimir.factors().map(|(factors, value)| {
                let term = Polynomial::from_factors(before.0.len(), [(factors, value)]);
                maximum(term.evaluate(&before.0).abs(), term.evaluate(&after.0).abs())
            });
            let whole: f64 = sizes.sum();
            let drift = if one == other { 0.0 } else { (one - other).abs() / whole };
            found.casimir = maximum(found.casimir, drift);
            if !(drift <= DRIFT * (steps.max(1) as f64)) {
                found.blame(format!("{place}: Casimir {} drifts by {drift:.2e}", index + 1));
            }
        }
    }
}
