//! What is kept of a run: records, and the largest drift of every invariant.

use std::ops::Range;

use coadjoint::Phase;
use coadjoint_codegen::integrator::Integrator;
use nalgebra::DVector;

use crate::engine::{Energy, Group};

/// The largest differences from the start so far, each relative to the largest value at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Of the spatial momentum J_L, or of the components that a potential leaves conserved,
    /// relative to its largest coordinate.
    pub spatial_momentum: f64,
    /// Of all Casimirs watched, each relative to the size of its terms.
    pub casimirs: f64,
    /// Of the energy, relative to the size of its terms.
    pub energy: f64,
}

impl Drift {
    fn raise(&mut self, other: Self) {
        self.spatial_momentum = self.spatial_momentum.max(other.spatial_momentum);
        self.casimirs = self.casimirs.max(other.casimirs);
        self.energy = self.energy.max(other.energy);
    }
}

/// A recorded moment.
#[derive(Clone, Debug)]
pub struct Record {
    /// t.
    pub time: f64,
    /// μ.
    pub momentum: Vec<f64>,
    /// g, the diagonal blocks row by row.
    pub element: Vec<f64>,
    /// H_red(μ), plus V(g) where there is a potential.
    pub energy: f64,
    /// The differences at this moment.
    pub drift: Drift,
}

/// The solves of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Solver {
    /// Newton iterations, or evaluations of the fixed point, per step.
    pub mean_iterations: f64,
    /// The largest residual left, relative to the momentum.
    pub max_residual: f64,
}

/// A whole run.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// What made it, for tables and pictures.
    pub label: String,
    /// K; `None` for a method beside ours.
    pub truncation: Option<usize>,
    /// Names of the momentum's coordinates.
    pub coordinates: Vec<String>,
    /// The recorded moments, the start first.
    pub records: Vec<Record>,
    /// Steps made.
    pub steps: u64,
    /// The end: momentum and group element.
    pub momentum: Vec<f64>,
    /// Row by row.
    pub group_element: Vec<Vec<f64>>,
    /// The rows of each diagonal block of the group's matrices; all other entries are 0.
    pub blocks: Vec<Range<usize>>,
    /// The maxima over all steps, recorded or not.
    pub drift: Drift,
    /// How many Casimirs were watched.
    pub casimirs: usize,
    /// Whether a potential breaks the symmetry.
    pub potential: bool,
    /// How many independent components of the spatial momentum are conserved, and were watched.
    pub momenta: usize,
    /// How the solves went, where they are ours and one a step.
    pub solver: Option<Solver>,
}

impl Trajectory {
    /// The time reached.
    pub fn time(&self) -> f64 {
        self.records.last().map_or(0.0, |record| record.time)
    }
}

/// What is watched of a run.
#[derive(Clone, Copy)]
pub struct Watched<'a> {
    /// The energy.
    pub energy: &'a Energy,
    /// Where a potential breaks the symmetry, the ξ with ⟨J_L, ξ⟩ conserved.
    pub symmetries: Option<&'a [DVector<f64>]>,
}

/// Watches a run.
pub struct Recorder<'a, G: Group> {
    group: &'a G,
    watched: Watched<'a>,
    start: Invariants,
    /// What the energy's drift is measured against.
    energy_scale: f64,
    /// The size of the spatial momentum.
    momentum_scale: f64,
    /// What each Casimir's drift is measured against.
    casimir_scales: Vec<f64>,
    iterations: u64,
    trajectory: Trajectory,
}

struct Invariants {
    momenta: DVector<f64>,
    casimirs: Vec<f64>,
    energy: f64,
}

impl<'a, G: Group> Recorder<'a, G> {
    /// Starts at `phase`, which is recorded.
    pub fn new(
        group: &'a G,
        watched: Watched<'a>,
        phase: &Phase<G>,
        integrator: &Integrator,
        label: String,
    ) -> Self {
        let start = invariants(group, &watched, phase);
        let trajectory = Trajectory {
            label,
            truncation: Some(integrator.problem.truncation),
            coordinates: integrator.problem.coordinates.clone(),
            records: Vec::new(),
            steps: 0,
            momentum: Vec::new(),
            group_element: Vec::new(),
            blocks: group.blocks(),
            drift: Drift::default(),
            casimirs: group.casimir_count(),
            potential: watched.symmetries.is_some(),
            momenta: start.momenta.len(),
            solver: None,
        };
        let momentum_scale = phase.spatial_momentum(group).amax();
        let casimir_scales = casimir_scales(group, &phase.momentum);
        let mut recorder = Self {
            group,
            watched,
            start,
            energy_scale: watched.energy.magnitude(group, phase),
            momentum_scale,
            casimir_scales,
            iterations: 0,
            trajectory,
        };
        recorder.visit(0.0, phase, true);
        recorder
    }

    /// Takes note of how a solve went.
    pub fn solved(&mut self, iterations: u32, residual: f64) {
        self.iterations += u64::from(iterations);
        let solver = self.trajectory.solver.get_or_insert_default();
        solver.max_residual = solver.max_residual.max(residual);
    }

    /// Measures the drift at this moment, and records it if asked to.
    pub fn visit(&mut self, time: f64, phase: &Phase<G>, record: bool) {
        let now = invariants(self.group, &self.watched, phase);
        let start = &self.start;
        let casimirs = start.casimirs.iter().zip(&now.casimirs).zip(&self.casimir_scales);
        let drift = Drift {
            spatial_momentum: relative(largest(&now.momenta, &start.momenta), self.momentum_scale),
            casimirs: casimirs.map(|((c, d), scale)| relative(c - d, *scale)).fold(0.0, f64::max),
            energy: relative(now.energy - start.energy, self.energy_scale),
        };
        self.trajectory.drift.raise(drift);
        if record {
            let momentum = phase.momentum.iter().copied().collect();
            let element = self.element(phase);
            let energy = now.energy;
            self.trajectory.records.push(Record { time, momentum, element, energy, drift });
        }
    }

    /// The entries of the diagonal blocks.
    fn element(&self, phase: &Phase<G>) -> Vec<f64> {
        let entry = |i, j| self.group.matrix_entry(&phase.group_element, i, j);
        let blocks = self.trajectory.blocks.iter();
        let row = |block: &Range<usize>, i| block.clone().map(move |j| (i, j)).collect::<Vec<_>>();
        let places = blocks.flat_map(|block| block.clone().flat_map(|i| row(block, i)));
        places.map(|(i, j)| entry(i, j)).collect()
    }

    fn matrix(&self, phase: &Phase<G>) -> Vec<Vec<f64>> {
        let size = self.group.matrix_size();
        let entry = |i, j| self.group.matrix_entry(&phase.group_element, i, j);
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    }

    /// The run, which ended at `phase`.
    pub fn finish(mut self, steps: u64, phase: &Phase<G>) -> Trajectory {
        self.trajectory.steps = steps;
        self.trajectory.momentum = phase.momentum.iter().copied().collect();
        self.trajectory.group_element = self.matrix(phase);
        if let Some(solver) = &mut self.trajectory.solver {
            solver.mean_iterations = self.iterations as f64 / steps.max(1) as f64;
        }
        self.trajectory
    }
}

fn invariants<G: Group>(group: &G, watched: &Watched<'_>, phase: &Phase<G>) -> Invariants {
    let count = group.casimir_count();
    let spatial = phase.spatial_momentum(group);
    let momenta = match watched.symmetries {
        None => spatial,
        // Each relative to the largest component of its ξ.
        Some(list) => {
            DVector::from_iterator(list.len(), list.iter().map(|xi| xi.dot(&spatial) / xi.amax()))
        }
    };
    Invariants {
        momenta,
        casimirs: (0..count).map(|i| group.casimir(i, &phase.momentum)).collect(),
        energy: watched.energy.value(group, phase),
    }
}

/// The largest difference; 0 for vectors without entries.
fn largest(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The largest value each Casimir takes at ±|μ₁|, … with at most one sign changed: one that starts
/// at zero, such as Π·Γ for a top, is measured against the size of its terms, not against rounding.
fn casimir_scales<G: Group>(group: &G, momentum: &DVector<f64>) -> Vec<f64> {
    let scale = |index: usize| {
        let mut point = momentum.abs();
        let value = |point: &DVector<f64>| group.casimir(index, point).abs();
        let mut largest = value(momentum).max(value(&point));
        for i in 0..point.len() {
            point[i] = -point[i];
            largest = largest.max(value(&point));
            point[i] = -point[i];
        }
        largest
    };
    (0..group.casimir_count()).map(scale).collect()
}

fn relative(difference: f64, size: f64) -> f64 {
    if size == 0.0 { difference.abs() } else { (difference / size).abs() }
}
