//! The networks of the tables, where the build has them.

use coadjoint::Chart;

use super::report::Table;
use super::run::RunOptions;
use super::task::Task;
use crate::error::LearnError;
use crate::group::DataGroup;

/// A table's networks: the seed, and the name its checkpoints begin with.
#[derive(Clone, Debug)]
pub(super) struct Training<'a> {
    pub(super) options: &'a RunOptions,
    pub(super) seed: u64,
    pub(super) label: String,
}

#[cfg(not(feature = "neural"))]
impl Training<'_> {
    /// Says that there are none.
    #[allow(clippy::unnecessary_wraps, clippy::extra_unused_type_parameters)]
    pub(super) fn symmetric<G: DataGroup, C: Chart<G>>(
        &self,
        _task: &Task<'_, G>,
        _paper: Option<f64>,
        _say: &mut dyn FnMut(&str),
        table: &mut Table,
    ) -> Result<(), LearnError> {
        let text = format!("{}: networks left out: built without the feature neural", self.label);
        table.push(vec![text.into()]);
        let _ = (self.options, self.seed);
        Ok(())
    }
}

#[cfg(feature = "neural")]
impl Training<'_> {
    /// The paper's net and budget; small ones in the short version.
    pub(super) fn options(&self, name: &str) -> crate::network::TrainingOptions {
        let checkpoint = self.options.checkpoint(&format!("{}.{name}", self.label));
        let full =
            crate::network::TrainingOptions { seed: self.seed, checkpoint, ..Default::default() };
        let quick = crate::network::TrainingOptions {
            widths: vec![64, 64],
            adam_steps: 100,
            lbfgs_steps: 300,
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
        use super::task::row;
        let from = std::time::Instant::now();
        let (network, _) =
            crate::network::fit_network(&task.train, &self.options("network"), &mut |_| {})?;
        timed("network", from, say);
        table.push(row("network, symmetric", &task.figures::<C>(&network), paper));
        let from = std::time::Instant::now();
        let (hybrid, _) =
            crate::hybrid::fit_hybrid(&task.train, 2, &self.options("hybrid"), &mut |_| {})?;
        timed("hybrid", from, say);
        table.push(row("hybrid, symmetric", &task.figures::<C>(&hybrid), None));
        Ok(())
    }
}

#[cfg(feature = "neural")]
fn timed(name: &str, from: std::time::Instant, say: &mut dyn FnMut(&str)) {
    say(&format!("  {name}: {:.0} s", from.elapsed().as_secs_f64()));
}
