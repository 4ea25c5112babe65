//! Pairs to fit and pairs to test, and the models that fill in the rows of a table.

use coadjoint::groups::Chart;
use coadjoint_learn::data::{PairRows, ReducedData, RowPolicy, Tolerances, reduce};
use coadjoint_learn::network::{TrainingOptions, fit_network};
use coadjoint_learn::polynomial::{Basis, fit_polynomial};
use coadjoint_learn::{
    DataGroup, Figures, Generating, MomentumFunction, Scaled, evaluate, fit_gaussian_process,
    fit_hybrid,
};
use serde_json::Value;

use super::options::{CHECKPOINT, Options};
use crate::outcome::{Fallible, Table, row};

pub const COLUMNS: &str = "model | mse x | mse momentum | mse group | max x | max momentum | max group | unsolved | paper's mse";

/// The row of a model; the last cell is the paper's error, where there is one.
pub fn row(name: impl Into<Value>, figures: &Figures, paper: Option<f64>) -> Vec<Value> {
    let unsolved = figures.unsolved.len() as f64;
    let errors = [&figures.mse, &figures.max_error];
    let errors = errors.into_iter().flat_map(|e| [e.x, e.momentum, e.group]).map(Value::from);
    std::iter::once(name.into()).chain(errors).chain(row![unsolved, paper]).collect()
}

/// Pairs to fit and to test, with their reductions in a chart, and how networks are trained on them.
pub struct Task<'a, G: DataGroup> {
    pub options: &'a Options,
    pub group: G,
    pub train: ReducedData,
    pub tests: PairRows<G>,
    pub test: ReducedData,
    /// Seed of the networks.
    pub seed: u64,
    /// The name their checkpoints begin with, which begins with the experiment's.
    pub label: String,
    /// Whether they are as wide as the paper's in the full version.
    pub wide: bool,
}

impl<'a, G: DataGroup> Task<'a, G> {
    /// The task of these pairs; networks have the seed 0 and no name.
    pub fn new<C: Chart<G>>(
        options: &'a Options,
        group: &G,
        train: &PairRows<G>,
        tests: PairRows<G>,
    ) -> Fallible<Self> {
        let reduced = |pairs: &PairRows<G>| {
            reduce::<G, C>(group, pairs, Tolerances::default(), RowPolicy::Refuse).map(|r| r.data)
        };
        let (train, test, group) = (reduced(train)?, reduced(&tests)?, group.clone());
        Ok(Self { options, group, train, tests, test, seed: 0, label: String::new(), wide: false })
    }

    /// The paper's network and budget, or a small one, which loses little and takes a fortieth of the time.
    pub fn training(&self, name: &str, wide: bool) -> TrainingOptions {
        let file = format!("{}.{name}.{CHECKPOINT}", self.label);
        let checkpoint = self.options.out.as_ref().map(|folder| folder.join(file));
        let full = TrainingOptions { seed: self.seed, checkpoint, ..Default::default() };
        if wide && self.wide && !self.options.quick {
            return full;
        }
        let lbfgs_steps = self.options.pick(950, 350);
        TrainingOptions { widths: vec![64, 64], adam_steps: 50, lbfgs_steps, ..full }
    }

    /// The errors of the map that a function generates.
    pub fn figures<C: Chart<G>>(&self, function: &dyn MomentumFunction) -> Figures {
        let map = Generating::<G, C, _>::new(self.group.clone(), function);
        evaluate(&map, &self.group, &self.tests, &self.test)
    }

    /// The answers that need no data, a network, and a hybrid of degree 2.
    pub fn begin<C: Chart<G>>(
        &self,
        truth: &impl MomentumFunction,
        step: f64,
        paper: Option<f64>,
        table: &mut Table,
    ) -> Fallible<()> {
        let mut enter = |name: &str, function: &dyn MomentumFunction, paper: Option<f64>| {
            table.rows.push(row(name, &self.figures::<C>(function), paper));
        };
        enter("x = 0, μ″ = μ′", &Scaled { factor: 0.0, function: truth }, None);
        enter("S = Δt·H", &Scaled { factor: step, function: truth }, None);
        eprintln!("  network");
        let (p, x) = (&self.train.p, &self.train.x);
        let network = fit_network(p, x, None, &self.training("network", true), &mut |_| {})?.0;
        enter("network, symmetric", &network, paper);
        eprintln!("  hybrid");
        let hybrid = fit_hybrid(p, x, 2, &self.training("hybrid", false), &mut |_| {})?.0;
        enter("hybrid, symmetric", &hybrid, None);
        Ok(())
    }

    /// Polynomials of the degrees that the samples determine.
    pub fn polynomials<C: Chart<G>>(&self, degrees: &[usize], remark: &str, table: &mut Table) {
        for &degree in degrees.iter().filter(|d| Basis::size(self.group.dim(), **d) <= 1000) {
            if let Ok(model) = fit_polynomial(&self.train, degree, 0.0) {
                let name = format!("polynomial degree {degree}{remark}");
                table.rows.push(row(name, &self.figures::<C>(&model), None));
            }
        }
    }

    /// A Gaussian process of at most this number of samples.
    pub fn gaussian_process<C: Chart<G>>(&self, largest: usize, table: &mut Table) -> Fallible<()> {
        eprintln!("  Gaussian process");
        let process = fit_gaussian_process(&self.train, largest)?;
        table.rows.push(row("Gaussian process", &self.figures::<C>(&process), None));
        Ok(())
    }
}
