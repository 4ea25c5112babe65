//! The trait for everything that advances rows of states.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use coadjoint::groups::{Cayley, Exponential};
use coadjoint::groups::{CayleyMatrixGroup, DirectProduct, MatrixGroup};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::{Problem, Solver};
use coadjoint_codegen::step;
use coadjoint_codegen::system::System;
use coadjoint_native::cards::{Card, Device};
use coadjoint_program::Precision;

use super::layout::{Layout, Shape};
use super::rows::Rows;
use super::steps::Steps;
use crate::backend::Backend;
use crate::engine::{Kept, cayley_group, product_group};
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

/// The largest drifts over an ensemble, each row's relative to its own [scales](coadjoint_codegen::step::Scales).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// The drifts of the quantities known to be conserved; energies are not measured.
    pub conserved: step::Drift,
    /// Rows at whose end rounding of large numbers hides a drift.
    pub unmeasured: u64,
    /// The largest ratio of the last two terms of the series at the states looked at (the start, the end, and every so
    /// many steps), where it is worth a warning; else 0.
    pub ratio: f64,
}

impl Drift {
    /// The larger of each, and the rows of both.
    pub fn max(mut self, other: Self) -> Self {
        self.conserved.raise(other.conserved);
        self.unmeasured += other.unmeasured;
        self.ratio = larger(self.ratio, other.ratio);
        self
    }
}

/// Something that advances rows of states.
pub trait Engine: Sync {
    /// The shape of a row.
    fn shape(&self) -> Shape;

    /// How many Casimirs are watched.
    fn casimirs(&self) -> usize;

    /// Advances every row in place by `steps` steps. Rows that fail become NaN and are added to
    /// `rows.rejected`. The bits do not depend on how rows are cut into pieces or on threads.
    ///
    /// # Errors
    /// Where a device fails, or [`RunError::Halted`] where the watch asks to stop; nothing is known of the rows then.
    fn advance(
        &self,
        layout: &Layout,
        steps: u64,
        rows: &mut Rows,
        watch: &Watch<'_>,
    ) -> Result<Drift, RunError>;

    /// The device that makes the steps, and what it has left to others; `None` where this processor makes them.
    fn device(&self) -> Option<Use>;

    /// The backend that evaluates steps now, in a few words: it may change while a compiler works.
    fn backend(&self) -> String;

    /// Notes on backends that are not available so far.
    fn notes(&self) -> Vec<String>;
}

/// Who looks on while rows are advanced.
pub struct Watch<'a> {
    /// Is told, again and again, how many steps every row has made.
    pub made: &'a dyn Fn(u64),
    /// Is looked at every few milliseconds; set it to stop.
    pub stop: &'a AtomicBool,
}

impl Watch<'_> {
    /// Whether to stop.
    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

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

/// The backend that makes the steps.
#[derive(Clone, Copy, Debug)]
pub struct How {
    /// The backend that evaluates programs.
    pub backend: Backend,
    /// About how many steps all lanes together make.
    pub work: f64,
    /// The device, where one is named.
    pub device: Option<Asked>,
}

/// The engine of a system, which is called by its path in messages; what is kept of the same integrator is used again.
///
/// # Errors
/// Where the step makes no sense, or the backend or device that the user named cannot be had.
pub fn engine<'a>(
    path: &Path,
    integrator: &'a Integrator,
    step: f64,
    how: How,
    kept: &Kept,
) -> Result<Box<dyn Engine + 'a>, RunError> {
    let group = product_group(path, &integrator.problem.algebra)?;
    Ok(match integrator.problem.chart {
        lie::Chart::Exponential => {
            type On<'a> = Steps<'a, DirectProduct<MatrixGroup>, Exponential>;
            Box::new(On::new(integrator, group, step, how, kept)?)
        }
        lie::Chart::Cayley => {
            type On<'a> = Steps<'a, DirectProduct<CayleyMatrixGroup>, Cayley>;
            Box::new(On::new(integrator, cayley_group(path, &group)?, step, how, kept)?)
        }
    })
}

/// The larger of two numbers; what is no number is larger than any.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
