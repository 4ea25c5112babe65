//! The records of a run, kept for NumPy.

use std::sync::atomic::Ordering;

use coadjoint_run::simulate::{Begun, Block, Halt, Record, Resume, Sink};

use crate::control::Control;

/// Columns of a run, a row for each record.
#[derive(Debug, Default)]
pub struct Trace {
    /// t.
    pub time: Vec<f64>,
    /// μ, row by row.
    pub momentum: Vec<f64>,
    /// The entries of the blocks of g, row by row.
    pub element: Vec<f64>,
    /// Ad*_g μ, row by row.
    pub spatial: Vec<f64>,
    /// H.
    pub energy: Vec<f64>,
    /// The drifts of the spatial momentum, the Casimirs and the energy, row by row.
    pub drift: Vec<f64>,
    /// The first row and the number of rows of each block of g.
    pub blocks: Vec<(usize, usize)>,
    /// The names of all columns, as the command has them.
    pub columns: Vec<String>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Keeps the records of a run, and hears whether it is to stop.
pub struct Keeper<'a> {
    /// The records.
    pub table: Trace,
    /// Stops the run on request.
    pub control: &'a Control,
}

impl Sink for Keeper<'_> {
    fn begin(&mut self, begun: &Begun<'_>) -> Result<Option<Resume>, Halt> {
        let place = |block: &Block| (block.range.start, block.range.len());
        self.table.columns = begun.columns();
        self.table.blocks = begun.blocks.iter().map(place).collect();
        Ok(None)
    }

    fn record(&mut self, record: &Record<'_>) -> Result<(), Halt> {
        let Trace { time, momentum, element, spatial, energy, drift, .. } = &mut self.table;
        time.push(record.time);
        momentum.extend_from_slice(record.momentum);
        if !record.element.is_empty() {
            element.extend_from_slice(record.element);
            spatial.extend_from_slice(record.spatial_momentum);
        }
        energy.push(record.moment.energy.unwrap_or(f64::NAN));
        drift.extend(record.moment.drift.numbers());
        Ok(())
    }

    fn pause(&mut self, steps: u64, _: bool, _: &dyn Fn() -> Resume) -> Result<(), Halt> {
        self.control.done.store(steps, Ordering::Relaxed);
        if self.control.stop.load(Ordering::Relaxed) { Err(Halt) } else { Ok(()) }
    }

    fn stop(&mut self) -> bool {
        self.control.stop.load(Ordering::Relaxed)
    }

    fn warn(&mut self, text: &str) {
        self.table.warnings.push(text.to_owned());
    }
}
