//! The networks of the tables.

use coadjoint::Chart;

use super::report::Table;
use super::run::RunOptions;
use super::task::{Task, row};
use crate::error::LearnError;
use crate::group::DataGroup;
use crate::hybrid::fit_hybrid;
use crate::network::{TrainingOptions, fit_network};

/// A table's networks: the seed, and the name its checkpoints begin with.
#[derive(Clone, Debug)]
pub(super) struct Training<'a> {
    pub(super) options: &'a RunOptions,
    pub(super) seed: u64,
    pub(super) label: String,
}

impl Training<'_> {
    /// The paper's net and budget; small ones in the short version.
    pub(super) fn options(&self, name: &str) -> TrainingOptions {
        let checkpoint = self.options.checkpoint(&format!("{}.{name}", self.label));
        let full = TrainingOptions { seed: self.seed, checkpoint, ..Default::default() };
        let quick = TrainingOptions {
            widths: vec![64, 64],
            adam_steps: 50,
            lbfgs_steps: 350,
            ..full.clone()
        };
        self.options.pick(full, quick)
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
        let (hybrid, _) = fit_hybrid(&task.train, 2, &self.options("hybrid"), &mut |_| {})?;
        timed("hybrid", from, say);
        table.push(row("hybrid, symmetric", &task.figures::<C>(&hybrid), None));
        Ok(())
    }
}

fn timed(name: &str, from: std::time::Instant, say: &mut dyn FnMut(&str)) {
    say(&format!("  {name}: {:.0} s", from.elapsed().as_secs_f64()));
}
