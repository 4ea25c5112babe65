//! Following the motion from row to row by the right solution of each step.

use std::collections::BTreeSet;
use std::path::Path;

use coadjoint_codegen::cancel;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::problem::Parameter;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_learn::table::Table;

use super::course::{Judged, Trouble};
use super::found::Found;
use super::said::Said;
use super::states::{Columns, Invariants, Measured, Reading, next, refused};
use crate::ensemble::Shape;
use crate::error::RunError;
use crate::grid::Grid;
use crate::number::maximum;

/// A row's time may be this far from a whole number of steps.
const SLACK: f64 = 1e-6;
/// Steps between two rows at most: beyond, the bound on what rounding does says nothing.
const FARTHEST: u64 = 100_000;

/// The exact judge of a system, which is called `file` in messages.
///
/// # Errors
/// Fails if the series is too large, or the Hamiltonian a function without formula.
pub fn judge_of(file: &Path, hamiltonian: &Hamiltonian) -> Result<Judge, RunError> {
    Judge::of(hamiltonian, TermLimit::default())
        .map_err(|error| RunError::Option(format!("{}: {error}", file.display())))
}

/// The number of rows of a file that stand for all of them: evenly spread, the last among them.
#[derive(Clone, Copy, Debug)]
pub struct Quota {
    /// The number of rows judged.
    pub wanted: u64,
    /// The number of rows to choose from.
    pub of: u64,
}

impl Quota {
    /// True if it has row `number`, counted from 1.
    fn holds(self, number: u64) -> bool {
        let before = |number: u64| {
            u128::from(number) * u128::from(self.wanted.min(self.of)) / u128::from(self.of.max(1))
        };
        before(number) > before(number - 1)
    }
}

/// Steps of one size, in doubled precision.
pub struct Follower<'a> {
    judge: &'a Judge,
    hamiltonian: &'a Hamiltonian,
    grid: Grid,
    symbols: Vec<f64>,
    invariants: Invariants,
    /// Rows of the group's matrices.
    size: usize,
    /// All parameters of the system's file, after which no column may be named.
    pub parameters: &'a [Parameter],
    /// The rows that are judged, where these are not all.
    pub sample: Option<Quota>,
    /// Is told how many steps have been judged.
    pub told: &'a dyn Fn(u64),
}

impl<'a> Follower<'a> {
    /// For the steps of this grid; the start of rows with times is known by these.
    ///
    /// # Errors
    /// Fails if the step makes no sense, or a parameter is not finite.
    pub fn new(
        judge: &'a Judge,
        hamiltonian: &'a Hamiltonian,
        grid: Grid,
    ) -> Result<Self, RunError> {
        let Grid { start, step } = grid;
        if !start.is_finite() {
            return Err(RunError::Option("--t0 must be finite".into()));
        }
        if step == 0.0 || !step.is_finite() {
            return Err(RunError::Option("--step must be finite and other than zero".into()));
        }
        // Parameters are substituted; what symbols are left (sqrt(2)) need none.
        let symbols = hamiltonian.symbols();
        judge.at(step, &symbols).map_err(|error| RunError::Option(error.to_string()))?;
        let invariants = Invariants::new(hamiltonian)?;
        let size = Shape::of(hamiltonian.facts().algebra).matrix_size;
        let (parameters, sample, told): (_, _, &dyn Fn(u64)) = (&[], None, &|_| {});
        Ok(Self { judge, hamiltonian, grid, symbols, invariants, size, parameters, sample, told })
    }

    /// Rows of one motion. Between rows that are not a whole number of steps apart the last step is shorter.
    ///
    /// # Errors
    /// Fails if the file cannot be read, or has no states with times.
    pub fn rows(&self, table: &mut Table) -> Result<Found, RunError> {
        let columns = Columns::find(self.hamiltonian, self.parameters, table)?;
        let Some(time) = columns.time else {
            let what =
                "no column time: for the output of an ensemble give --input STATES and --steps N";
            return Err(refused(table, what));
        };
        let mut found = Found::default();
        let of = (self.hamiltonian, &self.invariants);
        let mut said = Said::new(of, self.grid, table, &mut found);
        let mut last: Option<(f64, Measured)> = None;
        while let Some(row) = next(table)? {
            let (number, now) = (table.number(), row[time]);
            let known = || self.invariants.at(now, columns.state(&row));
            let (place, state) = (format!("row {number}, time {now}"), known());
            if number == 1 && now == self.grid.start {
                said.begin((table, &self.invariants), known(), &mut found);
            }
            said.row((number, now), (&columns, &row), &state, &mut found);
            let mut grid = true;
            if let Some((then, before)) = &last {
                let step = self.grid.step;
                let (steps, rounding) = ((now - then) / step, 4.0 * f64::EPSILON * now / step);
                let whole = steps.round();
                grid = (steps - whole).abs() <= SLACK * whole.max(1.0) + rounding.abs();
                if !(steps >= -SLACK - rounding.abs()) || whole > FARTHEST as f64 {
                    let what = format!(
                        "{place}: {steps} steps of {step} after the last row; give the run's --step",
                    );
                    return Err(refused(table, what));
                }
                let (count, rest) = if grid {
                    (whole as u64, 0.0)
                } else {
                    (steps.floor() as u64, step * (steps - steps.floor()))
                };
                let ends = (before, &state);
                self.row((number - 1, &place), ends, (*then, count, rest), &mut found);
            }
            // A row beside the grid is where a step of its own led: the motion goes on from the grid.
            if grid {
                last = Some((now, state));
            }
        }
        let rows = table.number();
        said.end(table, &mut found);
        Ok(ended(found, rows))
    }

    /// Rows of end states, each with its start; those in `refused` have none, by what the run says.
    ///
    /// # Errors
    /// Fails if a file cannot be read, or has fewer rows than the other.
    pub fn pairs(
        &self,
        starts: &mut Table,
        ends: &mut Table,
        steps: u64,
        listed: &BTreeSet<u64>,
    ) -> Result<Found, RunError> {
        let [before, after] =
            [&*starts, ends].map(|table| Columns::find(self.hamiltonian, self.parameters, table));
        let (before, after) = (before?, after?);
        let mut found = Found::default();
        while let Some(end) = next(ends)? {
            let number = ends.number();
            let Some(start) = next(starts)? else {
                return Err(refused(ends, format_args!("row {number} has no start in the input")));
            };
            let made = (self.grid.start, steps, 0.0);
            let start = self.invariants.at(made.0, before.state(&start));
            let end = self.invariants.at(self.grid.time(steps), after.state(&end));
            // An ensemble refuses a row by NaN in all that the state is made of.
            let Reading { momentum, element } = &end.state;
            let lost = momentum.iter().all(|value| value.is_nan())
                && element.as_ref().is_none_or(|g| g.iter().any(|value| value.is_nan()));
            if lost && listed.contains(&number) {
                found.refused += 1;
                continue;
            }
            let place = format!("row {number}");
            self.row((number, &place), (&start, &end), made, &mut found);
        }
        let rows = ends.number();
        if next(starts)?.is_some() {
            found.blame(format!("the input has more than the {rows} rows of the output"));
        }
        Ok(ended(found, rows))
    }

    /// From one state, at the time `then`, to another in `steps` steps, and one more of another size if that is not 0.
    fn row(
        &self,
        (number, place): (u64, &str),
        (from, to): (&Measured, &Measured),
        (then, steps, rest): (f64, u64, f64),
        found: &mut Found,
    ) {
        if self.sample.is_some_and(|sample| !sample.holds(number)) {
            *found.not_sampled.get_or_insert(0) += 1;
            return;
        }
        let (before, after) = (&from.state, &to.state);
        let made = found.steps;
        found.rows += 1;
        found.steps += steps + u64::from(rest != 0.0);
        if !before.numbers().chain(after.numbers()).all(f64::is_finite) {
            return found.blame(format!("{place}: a number is not finite"));
        }
        let mut course = Judged::new(&before.momentum, steps, self.size);
        let grid = Grid { start: then, ..self.grid };
        let last = grid.time(steps);
        for (then, size, count) in [(then, grid.step, steps), (last, rest, u64::from(rest != 0.0))]
        {
            let Ok(mut setting) = self.judge.at(size, &self.symbols) else { return };
            for done in 1..=count {
                cancel::check();
                (self.told)(made + done);
                setting.start(then, done - 1);
                match course.step(&mut setting) {
                    Ok(()) => {}
                    Err(Trouble::Wrong(what)) => {
                        return found.blame(format!("{place}: step {done} of {count} {what}"));
                    }
                    Err(Trouble::Unknown(what)) => {
                        return found.pass_over(format!("{place}: step {done} of {count}: {what}"));
                    }
                }
            }
        }
        self.judge_invariants(place, (from, to), (&course, steps), found);
        let deviations = if steps > 0 || rest != 0.0 {
            course.deviations(before, after)
        } else {
            let same = before.momentum == after.momentum;
            Ok((if same { 0.0 } else { f64::INFINITY }, None))
        };
        let (momentum, element) = match deviations {
            Ok(deviations) => deviations,
            Err(why) => return found.pass_over(format!("{place}: {why}")),
        };
        let compare = |worst: &mut f64, what: &str, deviation: f64| {
            *worst = maximum(*worst, deviation);
            (!(deviation <= 1.0))
                .then(|| format!("{place}: the {what} is off by {deviation:.2e} times its bound"))
        };
        let wrong = compare(&mut found.momentum, "momentum", momentum);
        let other = element.and_then(|g| compare(&mut found.group_element, "group element", g));
        wrong.into_iter().chain(other).for_each(|what| found.blame(what));
    }

    /// The quantities that must be conserved from one state to another by this motion. Rounding is relative to numbers that
    /// may be larger on the way than what is left of them, by as much as the group's element stretches.
    fn judge_invariants(
        &self,
        place: &str,
        (before, after): (&Measured, &Measured),
        (course, steps): (&Judged, u64),
        found: &mut Found,
    ) {
        // Nothing is measured if the motion stretches by more than numbers can resolve.
        let Some(stretch) = course.stretch() else { return };
        let more = (steps + 1) as f64 * (stretch / self.size.max(1) as f64).max(1.0);
        let [spatial, casimirs, _] = before.drifts(after);
        let judge = |worst: &mut f64, what: &str, drift: Option<(f64, f64)>| {
            let (drift, bound) = drift?;
            *worst = maximum(*worst, drift);
            (!(drift <= more * bound)).then(|| format!("{place}: the {what} by {drift:.2e}"))
        };
        let wrong = judge(&mut found.casimir, "Casimirs drift", casimirs);
        let other = judge(&mut found.spatial_momentum, "spatial momentum drifts", spatial);
        wrong.into_iter().chain(other).for_each(|what| found.blame(what));
    }
}

/// A file without rows is not right.
fn ended(mut found: Found, rows: u64) -> Found {
    if rows == 0 {
        found.pass_over("the file has no rows".to_owned());
    }
    found
}
