//! The networks of the tables.

use coadjoint::Chart;

use super::report::Table;
use super::run::RunOptions;
use super::task::{Task, row};
use crate::error::LearnError;
use crate::group::DataGroup;
use crate::hybrid::fit_hybrid;
use crate::network::{TrainingOptions, fit_network};

/// A table's networks: the seed, the name its checkpoints begin with, and whether networks are as wide
/// as the paper's.
#[derive(Clone, Debug)]
pub(super) struct Training<'a> {
    pub(super) options: &'a RunOptions,
    pub(super) seed: u64,
    pub(super) label: String,
    pub(super) wide: bool,
}

impl Training<'_> {
    /// The paper's net and budget; small ones in the short version.
    pub(super) fn options(&self, name: &str) -> TrainingOptions {
        let checkpoint = self.options.checkpoint(&format!("{}.{name}", self.label));
        let full = TrainingOptions { seed: self.seed, checkpoint, ..Default::default() };
        if self.wide && !self.options.quick { full } else { self.narrow(full) }
    }

    /// Of models that are not the paper's: 64-64, which loses little and takes a fortieth of the time.
    pub(super) fn small(&self, name: &str) -> TrainingOptions {
        self.narrow(self.options(name))
    }

    fn narrow(&self, full: TrainingOptions) -> TrainingOptions {
        let lbfgs_steps = self.options.pick(950, 350);
        TrainingOptions { widths: vec![64, 64], adam_steps: 50, lbfgs_steps, ..full }
    }

    /// A network for S, and the hybrid of degree 2.
    pub(super) fn symmetric<G: DataGroup, C: Chart<G>>(
        &self,
        task: &Task<'_, G>,
        paper: Option<f64>,
        say: &mut dyn FnMut(&str),
        table: &mut Table,
    ) -> Result<(), LearnError> {
        let from = std::time::Instant::now();
        let (network, _) = fit_network(&task.train, &self.options("network"), &mut |_| {})?;
        timed("network", from, say);
        table.push(row("network, symmetric", &task.figures::<C>(&network), paper));
        let from = std::time::Instant::now();
        let (hybrid, _) = fit_hybrid(&task.train, 2, &self.small("hybrid"), &mut |_| {})?;
        timed("hybrid", from, say);
        table.push(row("hybrid, symmetric", &task.figures::<C>(&hybrid), None));
        Ok(())
    }
}

fn timed(name: &str, from: std::time::Instant, say: &mut dyn FnMut(&str)) {
    say(&format!("  {name}: {:.0} s", from.elapsed().as_secs_f64()));
}
