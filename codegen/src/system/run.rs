//! The run a system file describes: `[run]` and the step or the tolerance.

use super::table::{Table, nearest_float, refuse};
use super::tolerance;
use crate::diagnostic::Diagnostics;
use crate::tolerance::Region;

/// Where to start, how far and in which steps; `None` where the file does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// The step size h, finite and not zero.
    pub step: Option<f64>,
    /// The error asked for at the end, instead of a step size.
    pub tolerance: Option<f64>,
    /// Where the momentum stays, for `tolerance`.
    pub region: Option<Region>,
    /// The truncation, if the file gives one.
    pub truncation: Option<usize>,
    /// The duration T, finite and positive.
    pub time: Option<f64>,
    /// Every n-th step is recorded, n ≥ 1.
    pub every: Option<usize>,
    /// The body momentum μ at the start.
    pub momentum: Option<Vec<f64>>,
    /// The group element at the start, row by row; the identity if it is not given.
    pub group_element: Option<Vec<Vec<f64>>>,
}

/// Reads `[run]`, and `step` and `tolerance` of `[integrator]`.
pub(super) fn read(
    root: &Table<'_>,
    integrator: Option<&Table<'_>>,
    diagnostics: &mut Diagnostics,
) -> Run {
    let mut run = Run::default();
    if let Some((step, place)) =
        integrator.and_then(|table| table.number("step", "step = 0.1", diagnostics))
    {
        let step = nearest_float(&step);
        if step == 0.0 || !step.is_finite() {
            refuse(place, "the step must be finite and other than zero", "step = 0.1", diagnostics);
        }
        run.step = Some(step);
    }
    if let Some(table) = integrator {
        (run.tolerance, run.region) = tolerance::read(table, diagnostics);
    }
    if let Some(table) = root.table("run", diagnostics) {
        table.check_keys(&["time", "every"], diagnostics);
        if let Some((time, place)) = table.number("time", "time = 100.0", diagnostics) {
            let time = nearest_float(&time);
            if time <= 0.0 || !time.is_finite() {
                refuse(place, "the time must be finite and positive", "time = 100.0", diagnostics);
            }
            run.time = Some(time);
        }
        if let Some((every, place)) = table.integer("every", "every = 1", diagnostics) {
            if every == 0 {
                refuse(place, "`every` counts steps from 1", "every = 1", diagnostics);
            }
            run.every = Some(every);
        }
    }
    run
}
