//! Trajectories on a device.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, PoisonError};

use coadjoint::{Chart, LieGroup, StepError};
use coadjoint_codegen::graph::Arithmetic;
use coadjoint_device::{Card, Device, DeviceError, Refused, Row};
use coadjoint_program::Precision;
use rayon::prelude::*;

use super::engine::larger;
use super::pack::{Manner, redo};
use super::rows::Stopped;
use crate::engine::{Interpreter, Numbers, card};
use crate::error::RunError;

/// The device that is to make the steps.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// Which.
    pub device: Device,
    /// Its numbers.
    pub precision: Precision,
}

/// The device that makes the steps.
#[derive(Clone, Debug)]
pub struct Use {
    /// Which.
    pub device: Device,
    /// Its name.
    pub name: String,
    /// Its numbers.
    pub precision: Precision,
    /// Whether the device is this machine's processor.
    pub processor: bool,
    /// Rows of which it has refused steps.
    pub redone: u64,
}

impl Use {
    /// The note on a device that has left this number of rows to others.
    pub fn of(card: &Card, redone: u64) -> Self {
        Self {
            device: card.device(),
            name: card.name().to_owned(),
            precision: card.precision(),
            processor: card.is_processor(),
            redone,
        }
    }
}

impl std::fmt::Display for Use {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}) in {} precision", self.device, self.name, self.precision)
    }
}

/// The steps of an interpreter on the device that is asked for.
///
/// # Errors
/// Where they are not made of programs, or the device cannot be had.
pub fn open<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>>(
    interpreter: &Interpreter<'_, G, C>,
    asked: Asked,
) -> Result<Card, RunError> {
    card(interpreter, asked.device, asked.precision)
}

/// The outcome of the trajectories.
#[derive(Debug)]
pub struct Moved {
    /// Why those stopped that did, by their places.
    pub failed: BTreeMap<usize, Stopped>,
    /// The largest ratio of the last two terms of the series that was met.
    pub ratio: f64,
    /// How many were moved in part by others, since the device refused a step.
    pub redone: u64,
}

/// Makes `steps` steps of all states on a device; what it refuses is made in `manner`, after `settle` has put a state
/// of the device's precision onto the group, as it does with those at the end. `told` is told how many steps have been made.
///
/// In double precision the states have the bits of [`march`](super::pack::march).
///
/// # Errors
/// Where the device fails; the states are lost then.
pub fn march(
    manner: &Manner<'_>,
    card: &mut Card,
    settle: &(dyn Fn(&mut Numbers) + Sync),
    states: &mut [Numbers],
    (steps, told): (u64, &dyn Fn(u64)),
) -> Result<Moved, RunError> {
    let mut rows: Vec<Row> = states
        .iter_mut()
        .map(|own| Row {
            g: std::mem::take(&mut own.g),
            mu: std::mem::take(&mut own.mu),
            ..Row::default()
        })
        .collect();
    let failed = Mutex::new(BTreeMap::new());
    let mut places = BTreeSet::new();
    let mut largest = 0.0_f64;
    let mut others = |refused: &mut [Refused<'_>], target: u64| {
        places.extend(refused.iter().map(|one| one.place));
        let ratios = refused.par_iter_mut().map(|Refused { place, row, .. }| {
            let mut own =
                Numbers { g: std::mem::take(&mut row.g), mu: std::mem::take(&mut row.mu) };
            settle(&mut own);
            let outcome = redo(manner, &mut own, row.made, target);
            (row.g, row.mu) = (own.g, own.mu);
            match outcome {
                Ok(ratio) => {
                    row.made = target;
                    ratio
                }
                Err((step, error)) => {
                    row.ended = true;
                    note(&failed, *place, step, error);
                    0.0
                }
            }
        });
        largest = ratios.chain([largest]).reduce(|| 0.0, larger);
    };
    let advanced = card.advance(&mut rows, steps, &mut others, told).map_err(stopped)?;
    debug_assert!(advanced.refused >= places.len() as u64);
    for (own, row) in states.iter_mut().zip(rows) {
        (own.g, own.mu) = (row.g, row.mu);
    }
    states.par_iter_mut().for_each(settle);
    let ends = states.par_iter().map(|own| (manner.ratio)(&own.mu));
    let ratio = larger(largest, ends.reduce(|| 0.0, larger));
    let failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Moved { failed, ratio, redone: places.len() as u64 })
}

fn note(failed: &Mutex<BTreeMap<usize, Stopped>>, index: usize, step: u64, error: StepError) {
    // A thread that panicked has added a whole entry or none.
    let mut failed = failed.lock().unwrap_or_else(PoisonError::into_inner);
    failed.insert(index, Stopped { index, step, error });
}

fn stopped(error: DeviceError) -> RunError {
    RunError::Device(error)
}
