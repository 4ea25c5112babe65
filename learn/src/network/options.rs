//! Options of training a network, and reports of its progress.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// Options of training a network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingOptions {
    /// Widths of the hidden layers; the paper's are 500, 500.
    pub widths: Vec<usize>,
    /// Full-batch steps of Adam; the paper's are 1000.
    pub adam_steps: usize,
    /// Adam's first step size; the paper's is 0.001.
    pub rate: f64,
    /// The step size falls along half a cosine to this fraction of the first (1: constant, as in the paper).
    pub final_fraction: f64,
    /// Evaluations of the loss by L-BFGS after Adam.
    pub lbfgs_steps: usize,
    /// Seed of the first weights.
    pub seed: u64,
    /// The file in which training keeps its state. If it holds the state of this task, training continues from it and ends
    /// with the bits of an uninterrupted run; the state of another task is refused.
    #[serde(skip)]
    pub checkpoint: Option<PathBuf>,
}

impl Default for TrainingOptions {
    /// The paper's net and budget.
    fn default() -> Self {
        Self::budget(1000)
    }
}

impl TrainingOptions {
    /// The paper's net with this many evaluations of the loss: a twentieth by Adam to approach the minimum, the others by
    /// L-BFGS.
    pub fn budget(evaluations: usize) -> Self {
        Self {
            widths: vec![500, 500],
            adam_steps: evaluations / 20,
            rate: 1e-3,
            final_fraction: 0.01,
            lbfgs_steps: evaluations - evaluations / 20,
            seed: 0,
            checkpoint: None,
        }
    }

    /// Adam's step size at a step.
    pub(super) fn rate(&self, step: usize) -> f64 {
        let (end, phase) = (self.final_fraction, step as f64 / self.adam_steps.max(1) as f64);
        let falling = 0.5 * (1.0 + (phase * std::f64::consts::PI).cos());
        self.rate * (end + (1.0 - end) * falling)
    }
}

/// The progress of training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Evaluations made.
    pub step: usize,
    /// Evaluations allowed.
    pub total: usize,
    /// The loss, in normalised units: 1 is the variance of the data.
    pub loss: f64,
    /// The loss on validation data, if there are any; Adam computes it every tenth step.
    pub validation: Option<f64>,
}
