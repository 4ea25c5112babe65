//! Whole ensembles in memory, piece by piece.

use coadjoint_codegen::problem::{Problem, Solver};
use coadjoint_codegen::system::System;

use super::engine::{Drift, Engine, Watch};
use super::layout::Layout;
use super::rows::{Rejected, Rows};
use crate::error::RunError;

/// The problem of an ensemble of this system.
///
/// # Errors
/// Where it has a potential.
pub fn problem_of(system: System) -> Result<Problem, RunError> {
    let System { mut problem, potential, .. } = system;
    if potential.is_some() {
        return Err(RunError::Option(
            "ensembles do not run systems with a potential: simulate them one by one, or emit the step \
             and see `Kicked`"
                .into(),
        ));
    }
    // Lanes are solved by Newton's method whatever the dimension: its Hessian is then exact.
    problem.solver = Some(Solver::Newton);
    Ok(problem)
}

/// Rows taken at a time: enough for all threads, little enough to be noted often. A card has as many threads as rows.
pub fn piece(width: usize, steps: u64, card: bool) -> u64 {
    if card {
        return ((256 << 20) / (width as u64 * 8)).clamp(512, 1 << 20);
    }
    let memory = (8 << 20) / (width as u64 * 8);
    (2_000_000 / steps.max(1)).min(memory).clamp(512, 65_536)
}

/// Advances all rows in place. Rows that fail become NaN and are reported. The watch receives the steps of all rows together.
///
/// # Errors
/// As [`Engine::advance`].
pub fn advance_all(
    engine: &dyn Engine,
    layout: &Layout,
    steps: u64,
    values: &mut [f64],
    watch: &Watch<'_>,
) -> Result<(Vec<Rejected>, Drift), RunError> {
    let width = layout.width();
    let card = engine.device().is_some_and(|by| !by.processor);
    let length = piece(width, steps, card) as usize;
    let mut rows = Rows::default();
    let (mut rejected, mut drift) = (Vec::new(), Drift::default());
    for (number, own) in values.chunks_mut(length * width).enumerate() {
        let first = (number * length) as u64;
        rows.clear(first + 1);
        rows.values.extend_from_slice(own);
        let count = (own.len() / width) as u64;
        let made = |made: u64| (watch.made)(first.saturating_mul(steps) + count * made);
        let found = engine.advance(layout, steps, &mut rows, &Watch { made: &made, ..*watch })?;
        drift = drift.max(found);
        own.copy_from_slice(&rows.values);
        rejected.append(&mut rows.rejected);
    }
    Ok((rejected, drift))
}
