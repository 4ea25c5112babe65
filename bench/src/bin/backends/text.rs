//! A system as a file has it.

use std::time::{Duration, Instant};

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::{REACH, Step};
use coadjoint_codegen::system::{Options, System, read};

use crate::Failure;

/// A system as a file has it, where it starts and how.
pub struct Text {
    /// What the table calls it.
    pub name: &'static str,
    /// The group.
    pub group: &'static str,
    /// H in m0, m1, …
    pub hamiltonian: String,
    /// K.
    pub truncation: usize,
    /// h.
    pub step: f64,
    /// μ at the start.
    pub momentum: Vec<f64>,
}

/// Its programs.
pub struct Programs {
    /// The lowered series.
    pub integrator: Integrator,
    /// The step.
    pub step: Step,
    /// How long the series took.
    pub derived: Duration,
    /// How long the programs took.
    pub built: Duration,
}

impl Text {
    /// The file, read.
    pub fn system(&self) -> Result<System, Failure> {
        let coordinates: Vec<String> =
            (0..self.momentum.len()).map(|i| format!("\"m{i}\"")).collect();
        let file = format!(
            "group = \"{}\"\ncoordinates = [{}]\nhamiltonian = \"{}\"\n",
            self.group,
            coordinates.join(", "),
            self.hamiltonian
        );
        let options = Options { truncation: Some(self.truncation), ..Options::default() };
        read(&file, options).map_err(|mistakes| mistakes.render("the file", &file).into())
    }

    /// Its programs, timed.
    pub fn programs(&self) -> Result<Programs, Failure> {
        let begun = Instant::now();
        let integrator = Integrator::build(self.system()?.problem, TermLimit::default())?;
        let derived = begun.elapsed();
        let step = Step::build(&integrator, REACH)?;
        let built = begun.elapsed() - derived;
        Ok(Programs { integrator, step, derived, built })
    }
}

/// Σ wᵢ mᵢ²/2.
pub fn squares(weights: &[f64]) -> String {
    let term = |(i, w): (usize, &f64)| format!("{w}*m{i}^2/2");
    weights.iter().enumerate().map(term).collect::<Vec<_>>().join(" + ")
}
