//! Pairs to fit and pairs to test, with the rows of a table that every model fills in.

use coadjoint::Chart;

use super::report::{Cell, Table};
use crate::data::{PairRows, ReducedData, RowPolicy, Tolerances, reduce};
use crate::error::LearnError;
use crate::evaluate::{Figures, evaluate};
use crate::function::{Generating, MomentumFunction, Scaled, Zero};
use crate::gaussian_process::{GaussianProcessOptions, fit_gaussian_process};
use crate::group::DataGroup;
use crate::polynomial::{Basis, fit_polynomial};

pub(super) const COLUMNS: [&str; 9] = [
    "model",
    "mse x",
    "mse momentum",
    "mse group",
    "max x",
    "max momentum",
    "max group",
    "unsolved",
    "paper's mse",
];

pub(super) fn row(name: impl Into<Cell>, figures: &Figures, paper: Option<f64>) -> Vec<Cell> {
    let (mse, largest) = (&figures.mse, &figures.max_error);
    vec![
        name.into(),
        mse.x.into(),
        mse.momentum.into(),
        mse.group.into(),
        largest.x.into(),
        largest.momentum.into(),
        largest.group.into(),
        (figures.unsolved.len() as f64).into(),
        paper.into(),
    ]
}

/// Pairs to fit, pairs to test, and their reductions in a chart.
pub(super) struct Task<'a, G: DataGroup> {
    pub(super) group: &'a G,
    pub(super) train: ReducedData,
    pub(super) test_pairs: PairRows<G>,
    test: ReducedData,
}

impl<'a, G: DataGroup> Task<'a, G> {
    pub(super) fn new<C: Chart<G>>(
        group: &'a G,
        train: &PairRows<G>,
        test_pairs: PairRows<G>,
    ) -> Result<Self, LearnError> {
        let reduced = |pairs: &PairRows<G>| {
            reduce::<G, C>(group, pairs, Tolerances::default(), RowPolicy::Refuse).map(|r| r.data)
        };
        let (train, test) = (reduced(train)?, reduced(&test_pairs)?);
        Ok(Self { group, train, test_pairs, test })
    }

    pub(super) fn figures<C: Chart<G>>(&self, function: impl MomentumFunction) -> Figures {
        let map = Generating::<G, C, &dyn MomentumFunction>::new(self.group.clone(), &function);
        evaluate(&map, self.group, &self.test_pairs, &self.test)
    }

    /// The answers that need no data.
    pub(super) fn trivial<C: Chart<G>>(
        &self,
        truth: &impl MomentumFunction,
        step: f64,
        table: &mut Table,
    ) {
        let dim = self.group.dim();
        let identity = self.figures::<C>(Zero { dim });
        table.push(row("x = 0, mu'' = mu'", &identity, None));
        let scaled = self.figures::<C>(Scaled { factor: step, function: truth });
        table.push(row("S = dt H", &scaled, None));
    }

    /// Polynomials of the degrees the samples determine.
    pub(super) fn polynomials<C: Chart<G>>(
        &self,
        degrees: &[usize],
        remark: &str,
        say: &mut dyn FnMut(&str),
        table: &mut Table,
    ) {
        for &degree in degrees {
            if Basis::size(self.group.dim(), degree) > 1000 {
                continue;
            }
            let from = std::time::Instant::now();
            if let Ok(model) = fit_polynomial(&self.train, degree, 0.0) {
                let name = format!("polynomial degree {degree}{remark}");
                say(&format!("  {name}: {:.1} ms", 1e3 * from.elapsed().as_secs_f64()));
                table.push(row(name, &self.figures::<C>(&model), None));
            }
        }
    }

    pub(super) fn gaussian_process<C: Chart<G>>(
        &self,
        largest: usize,
        table: &mut Table,
    ) -> Result<(), LearnError> {
        let options = GaussianProcessOptions { largest, ..Default::default() };
        let process = fit_gaussian_process(&self.train, &options)?;
        table.push(row("Gaussian process", &self.figures::<C>(&process), None));
        Ok(())
    }
}
