//! A run that has ended, for reports and pictures.

use std::path::PathBuf;

use coadjoint_run::Used;
pub use coadjoint_run::simulate::Drift;
use coadjoint_run::simulate::{Block, Outcome, Scales, Solver, Unknown, Warning};

use super::header::Header;

/// A moment kept for pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// t.
    pub time: f64,
    /// μ.
    pub momentum: Vec<f64>,
    /// H_red(μ), plus V(g) where there is a potential.
    pub energy: f64,
    /// The largest differences since the record before.
    pub drift: Drift,
}

/// A whole run.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// The method, for tables and pictures.
    pub label: String,
    /// The identity of the run.
    pub header: Header,
    /// K; `None` for a method beside ours.
    pub truncation: Option<usize>,
    /// Names of the momentum's coordinates.
    pub coordinates: Vec<String>,
    /// A bounded choice of the moments of the run, the start first and the end last; empty where no picture is
    /// asked for.
    pub records: Vec<Record>,
    /// Steps made.
    pub steps: u64,
    /// The time reached.
    pub time: f64,
    /// A line about the step, where another was used than was asked for.
    pub announcement: Option<String>,
    /// Warnings about the run.
    pub warnings: Vec<Warning>,
    /// The backends that made the steps, where they are programs.
    pub backend: Option<Used>,
    /// The momentum at the end.
    pub momentum: Vec<f64>,
    /// The blocks of the group's matrices; all other entries are 0.
    pub blocks: Vec<Block>,
    /// The entries of the blocks at the end, row by row.
    pub element: Vec<f64>,
    /// The energy at the start and at the end; none of a learned map.
    pub energy: Option<[f64; 2]>,
    /// The maxima over all steps, recorded or not.
    pub drift: Drift,
    /// The sizes that drifts are relative to.
    pub scales: Scales,
    /// From these times on drifts cannot be measured: of the spatial momentum, the Casimirs, the energy.
    pub unmeasured: [Option<f64>; 3],
    /// Why a drift is not there.
    pub unknown: Unknown,
    /// How many Casimirs were watched.
    pub casimirs: usize,
    /// Whether a potential breaks the symmetry.
    pub potential: bool,
    /// How many independent components of the spatial momentum are conserved, and were watched.
    pub momenta: usize,
    /// How the solves went, where they are ours and one a step.
    pub solver: Option<Solver>,
    /// The file with the records, and how many there are.
    pub out: Option<(PathBuf, u64)>,
}

impl Trajectory {
    /// The trajectory of an outcome; the caller adds the rest.
    pub fn of(outcome: Outcome, label: String, header: Header, coordinates: &[String]) -> Self {
        let Outcome { steps, time, warnings, backend, momentum, blocks, .. } = outcome;
        let Outcome { element, energy, drift, casimirs, potential, momenta, solver, .. } = outcome;
        let Outcome { scales, unmeasured, unknown, .. } = outcome;
        Self {
            label,
            header,
            truncation: None,
            coordinates: coordinates.to_vec(),
            records: Vec::new(),
            steps,
            time,
            announcement: None,
            warnings,
            backend,
            momentum,
            blocks,
            element,
            energy,
            drift,
            scales,
            unmeasured,
            unknown,
            casimirs,
            potential,
            momenta,
            solver,
            out: None,
        }
    }
}
