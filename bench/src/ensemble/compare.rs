//! Interleaved timing of the ensemble and its errors.

use std::{fmt::Write as _, time::Instant};

use super::{EnsembleMethod, TaylorBatch};
use crate::{
    arithmetic::Vector,
    measure::median,
    method::{RunError, Setting},
    problem::Problem,
    report::Machine,
    state::State,
};

/// One method at one setting.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Row {
    /// The method's name.
    pub method: String,
    /// The setting, as text.
    pub setting: String,
    /// The largest error of an end state in (Π, R).
    pub largest: f64,
    /// The median error.
    pub median: f64,
    /// Nanoseconds of one core per trajectory and unit of time: the median over the rounds.
    pub nanoseconds: f64,
}

/// Runs every method at every setting once per round.
///
/// # Errors
/// When a method fails on a body.
pub fn compare(
    template: &Problem,
    momenta: &[Vector],
    methods: &[Box<dyn EnsembleMethod>],
    rounds: usize,
) -> Result<Vec<Row>, RunError> {
    let exact = converged(template, momenta)?;
    let runs: Vec<(&dyn EnsembleMethod, Setting)> = methods
        .iter()
        .flat_map(|method| method.settings().into_iter().map(|setting| (method.as_ref(), setting)))
        .collect();
    let mut times = vec![Vec::with_capacity(rounds); runs.len()];
    let mut errors = vec![Vec::new(); runs.len()];
    for _ in 0..rounds {
        for (number, (method, setting)) in runs.iter().enumerate() {
            let start = Instant::now();
            let ends = method.run(template, momenta, *setting)?;
            times[number].push(start.elapsed().as_secs_f64());
            if errors[number].is_empty() {
                errors[number] =
                    ends.iter().zip(&exact).map(|(e, x)| e.error(x, &template.scale)).collect();
            }
        }
    }
    let rows =
        runs.into_iter().zip(times).zip(errors).map(|(((method, setting), times), errors)| Row {
            method: method.name().to_owned(),
            setting: setting.to_string(),
            largest: errors.iter().copied().fold(0.0, f64::max),
            median: median(errors),
            nanoseconds: median(times) * 1e9 / (momenta.len() as f64 * template.end),
        });
    Ok(rows.collect())
}

/// The end states by Taylor's method of order 20 at a step far below where it converges. (The exact solution by
/// Jacobi's functions loses digits for bodies near the separatrix.)
fn converged(template: &Problem, momenta: &[Vector]) -> Result<Vec<State>, RunError> {
    TaylorBatch::<21, 4>::default().run(template, momenta, Setting::Tolerance(1e-20))
}

/// The rows as a table.
#[must_use]
pub fn markdown(template: &Problem, count: usize, machine: &Machine, rows: &[Row]) -> String {
    let mut text = format!(
        "## {count} free bodies, T = {}\n\nNanoseconds of one core per trajectory and unit of time. {machine}.\n\n\
         | method | setting | largest error | median error | ns |\n|---|---|---:|---:|---:|\n",
        template.end
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {} | {} | {:.1e} | {:.1e} | {:.0} |",
            row.method, row.setting, row.largest, row.median, row.nanoseconds
        );
    }
    text
}
