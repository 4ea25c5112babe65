//! Following the motion from row to row by the right solution of each step.

use std::collections::BTreeSet;
use std::path::Path;

use coadjoint_codegen::cancel;
use coadjoint_codegen::judge::{Branch, Inside, Judge, Motion, Setting, Stop};
use nalgebra::DVector;

use super::Rows;
use super::found::{Found, maximum};
use super::invariants::{DRIFT, Invariants};
use super::record::Columns;
use super::twins::{Twins, matrix};
use crate::error::RunError;

/// The unit roundoff of what is judged.
const UNIT: f64 = f64::EPSILON / 2.0;
/// A row's time may be this far from a whole number of steps.
const SLACK: f64 = 1e-6;
/// Steps between two rows at most: beyond, the bound on what rounding does says nothing.
const FARTHEST: u64 = 100_000;
/// The bounds on rounding are multiplied up to this number of steps; over more of them they say nothing.
const PROVEN: u64 = 3;
/// Where rounding may do more than this, relative to the numbers, nothing is said of them.
const VAGUE: f64 = 1e-3;
/// Of matrices with larger entries rounding may leave no inverse.
const LONG: f64 = 1e5;
/// The ratio of the last two terms of the series up to which a step is accepted, and what rounding may add.
const LARGEST_RATIO: f64 = 0.5 * (1.0 + 1e-9);

/// Steps of one size, in doubled precision.
pub struct Follower<'a> {
    judge: &'a Judge,
    step: f64,
    symbols: Vec<f64>,
    invariants: Invariants,
    sample: Option<Sample>,
    told: &'a dyn Fn(u64),
}

/// The number of rows of a file that stand for all of them: evenly spread, the last among them.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// How many rows are judged.
    pub wanted: u64,
    /// How many rows there are to choose from.
    pub of: u64,
}

impl Sample {
    /// Whether it has row `number`, counted from 1.
    fn holds(self, number: u64) -> bool {
        let before = |number: u64| {
            u128::from(number) * u128::from(self.wanted.min(self.of)) / u128::from(self.of.max(1))
        };
        before(number) > before(number - 1)
    }
}

/// A state of a file.
type State = (Vec<f64>, Option<Vec<f64>>);

/// A reason for which the judge of a step stops.
enum Trouble {
    /// The step is wrong.
    Wrong(String),
    /// Nothing can be said of it.
    Unknown(String),
}

impl<'a> Follower<'a> {
    /// For steps of this size.
    ///
    /// # Errors
    /// Where a parameter is not finite.
    pub fn new(
        judge: &'a Judge,
        invariants: Invariants,
        step: f64,
        symbols: Vec<f64>,
    ) -> Result<Self, RunError> {
        judge.at(step, &symbols).map_err(|error| RunError::Option(error.to_string()))?;
        Ok(Self { judge, step, symbols, invariants, sample: None, told: &|_| {} })
    }

    /// The same, for a sample of the rows; `told` hears how many steps have been judged.
    #[must_use]
    pub fn watched(self, sample: Option<Sample>, told: &'a dyn Fn(u64)) -> Self {
        Self { sample, told, ..self }
    }

    /// Counts the rows of a file, and the steps from the first to the last, 0 where rows have no time.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn survey<T: Rows>(
        &self,
        table: &mut T,
        columns: &Columns,
    ) -> Result<(u64, f64), T::Error> {
        let (mut rows, mut first, mut last) = (0, None, 0.0);
        while let Some(row) = table.next_row()? {
            rows += 1;
            last = columns.time.map_or(0.0, |time| row[time]);
            first.get_or_insert(last);
        }
        Ok((rows, (last - first.unwrap_or(last)) / self.step))
    }

    /// Whether a row is to be judged, counted from 1; takes note where it is not.
    fn samples(&self, number: u64, found: &mut Found) -> bool {
        let chosen = self.sample.is_none_or(|sample| sample.holds(number));
        found.left_out += u64::from(!chosen);
        chosen
    }

    /// Rows of one motion. Between rows that are not a whole number of steps apart the last step is shorter.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn rows<T: Rows>(
        &self,
        table: &mut T,
        columns: &Columns,
        file: &Path,
    ) -> Result<Found, T::Error> {
        let Some(time) = columns.time else {
            return Err(RunError::Option(format!(
                "{}: no column time: for the output of an ensemble give --input STATES and --steps N",
                file.display()
            ))
            .into());
        };
        let mut found = Found::default();
        let mut last: Option<Vec<f64>> = None;
        let mut number = 0;
        while let Some(row) = table.next_row()? {
            number += 1;
            let mut grid = true;
            let place = format!("row {number}, time {}", row[time]);
            if last.is_none()
                && row[time] == 0.0
                && let Some(start) = table.numbers("initial_momentum")
                && start != columns.momentum(&row)
            {
                found.blame(format!(
                    "{place}: the momentum is not that which the file names as the start"
                ));
            }
            self.judge_energy(&place, columns, &row, &mut found);
            if let Some(last) = &last {
                let steps = (row[time] - last[time]) / self.step;
                let whole = steps.round();
                grid = (steps - whole).abs() <= SLACK * whole.max(1.0);
                if !(steps >= -SLACK) || whole > FARTHEST as f64 {
                    let what = format!(
                        "{place}: {steps} steps of {} after the last row; give the run's --step",
                        self.step
                    );
                    return Err(RunError::Option(format!("{}: {what}", file.display())).into());
                }
                let (count, rest) = if grid {
                    (whole as u64, 0.0)
                } else {
                    (steps.floor() as u64, self.step * (steps - steps.floor()))
                };
                let state = |row: &[f64]| (columns.momentum(row), columns.element(row));
                if self.samples(number - 1, &mut found) {
                    self.judge_row(&place, &state(last), &state(&row), (count, rest), &mut found);
                }
            }
            // A row beside the grid is where a step of its own led: the motion goes on from the grid.
            if grid {
                last = Some(row);
            }
        }
        if number == 0 {
            found.pass_over("the file has no rows".to_owned());
        }
        self.judge_end(table, number, &mut found);
        Ok(found)
    }

    /// Checks the statements of the file about its end.
    fn judge_end<T: Rows>(&self, table: &T, rows: u64, found: &mut Found) {
        found.part = table.value("part").map(str::to_owned);
        if let Some(said) = table.value("complete").and_then(|text| text.split(' ').next())
            && let Ok(said) = said.parse::<u64>()
            && said != rows
        {
            found.blame(format!("there are {rows} rows, and the file says that it has {said}"));
        }
        if table.value("complete").is_some_and(|text| text == "false") {
            found.part.get_or_insert_with(|| "it was not completed".to_owned());
        }
    }

    /// Rows of end states, each with its start; those in `refused` have none, by what the run says.
    ///
    /// # Errors
    /// Where a file cannot be read, or has fewer rows than the other.
    pub fn pairs<T: Rows>(
        &self,
        (starts, before): (&mut T, &Columns),
        (ends, columns): (&mut T, &Columns),
        steps: u64,
        refused: &BTreeSet<u64>,
        file: &Path,
    ) -> Result<Found, T::Error> {
        let mut found = Found::default();
        let mut number = 0;
        while let Some(end) = ends.next_row()? {
            number += 1;
            let Some(start) = starts.next_row()? else {
                return Err(RunError::Option(format!(
                    "{}: row {number} has no start in the input",
                    file.display()
                ))
                .into());
            };
            if columns.is_refused(&end) && refused.contains(&number) {
                found.refused += 1;
                continue;
            }
            let place = format!("row {number}");
            let before = (before.momentum(&start), before.element(&start));
            let after = (columns.momentum(&end), columns.element(&end));
            if self.samples(number, &mut found) {
                self.judge_row(&place, &before, &after, (steps, 0.0), &mut found);
            }
        }
        if starts.next_row()?.is_some() {
            found.blame(format!("the input has more than the {number} rows of the output"));
        }
        if number == 0 {
            found.pass_over("the file has no rows".to_owned());
        }
        Ok(found)
    }

    /// From one state to another in `steps` steps, and one more of another size if that is not 0.
    fn judge_row(
        &self,
        place: &str,
        before: &State,
        after: &State,
        (steps, rest): (u64, f64),
        found: &mut Found,
    ) {
        let made = found.steps;
        found.rows += 1;
        found.steps += steps + u64::from(rest != 0.0);
        let finite = |state: &State| {
            state.0.iter().chain(state.1.iter().flatten()).all(|value| value.is_finite())
        };
        if !finite(before) || !finite(after) {
            found.blame(format!("{place}: a number is not finite"));
            return;
        }
        let mut motion = Motion::new(&before.0);
        let mut twins = (steps > PROVEN).then(|| Twins::new(&before.0));
        for (size, count) in [(self.step, steps), (rest, u64::from(rest != 0.0))] {
            let Ok(mut setting) = self.judge.at(size, &self.symbols) else { return };
            for done in 1..=count {
                cancel::check();
                (self.told)(made + done);
                match advance(&mut motion, twins.as_mut(), &mut setting) {
                    Ok(()) => {}
                    Err(Trouble::Wrong(what)) => {
                        found.blame(format!("{place}: step {done} of {count} {what}"));
                        return;
                    }
                    Err(Trouble::Unknown(what)) => {
                        found.pass_over(format!("{place}: step {done} of {count}: {what}"));
                        return;
                    }
                }
            }
        }
        self.judge_invariants(place, before, after, (&motion, steps), found);
        let moved = steps > 0 || rest != 0.0;
        let deviations = match twins {
            Some(twins) => match compare(&motion, &twins, before, after) {
                Ok(deviations) => deviations,
                Err(why) => return found.pass_over(format!("{place}: {why}")),
            },
            None if moved => {
                let element = before.1.as_ref().zip(after.1.as_ref());
                let element = element.map(|(g, next)| motion.element_deviation(g, next));
                (motion.momentum_deviation(&after.0), element)
            }
            None => (if before.0 == after.0 { 0.0 } else { f64::INFINITY }, None),
        };
        let (momentum, element) = deviations;
        found.momentum = maximum(found.momentum, momentum);
        if !(momentum <= 1.0) {
            found.blame(format!("{place}: the momentum is off by {momentum:.2e} times its bound"));
        }
        if let Some(element) = element {
            found.element = maximum(found.element, element);
            if !(element <= 1.0) {
                let what = format!("the group element is off by {element:.2e} times its bound");
                found.blame(format!("{place}: {what}"));
            }
        }
    }

    /// Checks the quantities that this motion conserves from one state to another. Rounding is relative to numbers that may be
    /// larger on the way than what is left of them, by as much as the group's element stretches.
    fn judge_invariants(
        &self,
        place: &str,
        before: &State,
        after: &State,
        (motion, steps): (&Motion, u64),
        found: &mut Found,
    ) {
        let entries = self.invariants.matrix_size().pow(2);
        let element = matrix(motion, entries);
        // Where the motion stretches by more than numbers tell apart, nothing is measured.
        let Some(inverse) = element.clone().try_inverse() else { return };
        let size = element.nrows().max(1) as f64;
        let stretch = (element.norm() * inverse.norm() / size).max(1.0);
        let most = DRIFT * (steps + 1) as f64 * stretch;
        for (index, drift) in self.invariants.casimir_drifts(&before.0, &after.0).enumerate() {
            found.casimir = maximum(found.casimir, drift);
            if !(drift <= most) {
                found.blame(format!("{place}: Casimir {} drifts by {drift:.2e}", index + 1));
            }
        }
        let (Some(g), Some(next)) = (&before.1, &after.1) else { return };
        match self.invariants.spatial_drift((g, &before.0), (next, &after.0)) {
            // Of long elements rounding leaves no inverse: momentum and element are judged all the same.
            None if [g, next].iter().any(|g| g.iter().any(|x| x.abs() > LONG)) => {}
            None => found.blame(format!("{place}: the group element has no inverse")),
            Some(drift) => {
                found.spatial = maximum(found.spatial, drift);
                if !(drift <= most) {
                    found.blame(format!("{place}: the spatial momentum drifts by {drift:.2e}"));
                }
            }
        }
    }

    /// The energy that a row holds must be that of its momentum.
    fn judge_energy(&self, place: &str, columns: &Columns, row: &[f64], found: &mut Found) {
        let Some(said) = columns.energy.map(|column| row[column]) else { return };
        let (energy, size) = self.invariants.energy(&columns.momentum(row));
        if !((said - energy).abs() <= DRIFT * size) {
            found.blame(format!("{place}: the energy is {energy}, and the file says {said}"));
        }
    }
}

/// The deviations of momentum and element over what rounding may have done in many steps.
///
/// # Errors
/// Where that is so much that nothing can be said.
fn compare(
    motion: &Motion,
    twins: &Twins,
    before: &State,
    after: &State,
) -> Result<(f64, Option<f64>), String> {
    let over = |error: f64, size: f64, bound: f64| match error {
        0.0 => Ok(0.0),
        _ if !(bound <= VAGUE) => {
            Err(format!("rounding may do as much as {bound:.1e} in that many steps"))
        }
        error => Ok(error / (size * bound)),
    };
    let vector = |values: &[f64]| DVector::from_column_slice(values);
    let here = vector(&motion.momentum());
    let error = (&here - vector(&after.0)).norm();
    let (Some(g), Some(next)) = (&before.1, &after.1) else {
        return Ok((over(error, here.norm(), twins.bounds(1.0).momentum)?, None));
    };
    let whole = matrix(motion, g.len());
    let inverse = whole.clone().try_inverse().ok_or("the group element has no inverse")?;
    let bounds = twins.bounds(whole.norm() * inverse.norm());
    let led = vector(&motion.element_from(g));
    let apart = (&led - vector(next)).norm();
    let element = over(apart, vector(g).norm() * whole.norm(), bounds.element)?;
    Ok((over(error, here.norm(), bounds.momentum)?, Some(element)))
}

/// One step by its right solution, which must lie inside the chart and be of a series that means something.
fn advance(
    motion: &mut Motion,
    twins: Option<&mut Twins>,
    setting: &mut Setting<'_>,
) -> Result<(), Trouble> {
    let stop = |stop: Stop| match stop {
        Stop::Branch(Branch::Folds(s)) => {
            Trouble::Wrong(format!("has no right solution: its continuation folds at s = {s:.4}"))
        }
        Stop::Branch(_) => Trouble::Unknown("its right solution was not found".to_owned()),
        Stop::Judge(error) => Trouble::Unknown(error.to_string()),
    };
    let step = motion.here(setting).map_err(|error| stop(Stop::Judge(error)))?;
    let right = step.right_solution().map_err(|branch| stop(Stop::Branch(branch)))?;
    let x: Vec<f64> = right.x.iter().map(|x| x.to_f64()).collect();
    match step.inside(&x) {
        Inside::Yes => {}
        Inside::No(size) => {
            let what = format!("lies outside the chart: an eigenvalue has the size {size:.3}");
            return Err(Trouble::Wrong(what));
        }
        Inside::CannotTell => {
            return Err(Trouble::Unknown("it lies at the limit of the chart".to_owned()));
        }
    }
    if let Some(ratio) = step.series_ratio(&x, UNIT)
        && !(ratio <= LARGEST_RATIO)
    {
        let what = format!("is of a series whose last two terms have the ratio {ratio:.3}");
        return Err(Trouble::Wrong(what));
    }
    let Some(twins) = twins else {
        return motion.step(setting, Some(right), UNIT).map_err(stop);
    };
    let (momentum, _) = step.momentum();
    let size = DVector::from_iterator(x.len(), momentum.iter().map(|m| m.to_f64())).norm();
    let end = step.end(&right, UNIT).map_err(|error| stop(Stop::Judge(error)))?;
    motion.step(setting, Some(right), UNIT).map_err(stop)?;
    twins.step(setting, (&end, size), motion, UNIT).map_err(stop)
}
