//! What is watched of a run: its state, and the largest drift of every invariant.

use coadjoint::Phase;
use coadjoint_codegen::lie::LieAlgebra;
use nalgebra::DVector;

use super::blocks::{Block, blocks};
use super::mover::Seen;
use super::warning::{Steep, Warning};
use crate::backend::Used;
use crate::engine::{Energy, Group, STEEP};
use crate::number::{largest, maximum};

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
    /// Takes the larger of each; NaN where one is NaN.
    pub fn raise(&mut self, other: Self) {
        self.spatial_momentum = maximum(self.spatial_momentum, other.spatial_momentum);
        self.casimirs = maximum(self.casimirs, other.casimirs);
        self.energy = maximum(self.energy, other.energy);
    }
}

/// What is measured at a moment.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// H_red(μ), plus V(g) where there is a potential; none where no energy is known.
    pub energy: Option<f64>,
    /// The differences at this moment.
    pub drift: Drift,
}

/// The solves of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Solver {
    /// The most Newton iterations, or evaluations of the fixed point, of a step.
    pub most_iterations: u64,
    /// The largest residual left, relative to the momentum.
    pub max_residual: f64,
}

/// What a run has come to.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Steps made.
    pub steps: u64,
    /// The time reached.
    pub time: f64,
    /// What the user should know of the run.
    pub warnings: Vec<Warning>,
    /// What made the steps, where they are programs.
    pub backend: Option<Used>,
    /// The momentum at the end.
    pub momentum: Vec<f64>,
    /// The blocks of the group's matrices; all other entries are 0. None where attitudes mean nothing.
    pub blocks: Vec<Block>,
    /// The entries of the blocks at the end, row by row.
    pub element: Vec<f64>,
    /// The energy at the start and at the end; none of a learned map.
    pub energy: Option<[f64; 2]>,
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

/// What is watched of a run.
#[derive(Clone, Copy)]
pub struct Watched<'a> {
    /// The algebra.
    pub algebra: &'a LieAlgebra,
    /// Names of the momentum's coordinates.
    pub coordinates: &'a [String],
    /// The energy, where it is known.
    pub energy: Option<&'a Energy>,
    /// Whether attitudes mean something; maps learned from momenta alone have none.
    pub attitude: bool,
    /// Where a potential breaks the symmetry, the ξ with ⟨J_L, ξ⟩ conserved.
    pub symmetries: Option<&'a [DVector<f64>]>,
}

/// The maxima and sums so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// The largest drifts.
    pub drift: Drift,
    /// The most iterations of a step.
    pub iterations: u64,
    /// The largest residual, where residuals were measured.
    pub residual: Option<f64>,
    /// The first step before which the last terms of the series had a ratio worth a warning.
    pub steep: Option<Steep>,
}

/// Watches a run.
pub struct Recorder<'a, G: Group> {
    group: &'a G,
    watched: Watched<'a>,
    blocks: Vec<Block>,
    start: Invariants,
    /// What the energy's drift is measured against.
    energy_scale: f64,
    /// The size of the spatial momentum.
    momentum_scale: f64,
    /// What each Casimir's drift is measured against.
    casimir_scales: Vec<f64>,
    /// The maxima so far.
    pub tally: Tally,
}

struct Invariants {
    momenta: DVector<f64>,
    casimirs: Vec<f64>,
    energy: Option<f64>,
}

impl Invariants {
    fn of<G: Group>(group: &G, watched: &Watched<'_>, state: &dyn Seen) -> Self {
        let spatial = state.spatial_momentum();
        let momenta = match watched.symmetries {
            None => spatial,
            // Each relative to the largest component of its ξ.
            Some(list) => {
                let along = list.iter().map(|xi| xi.dot(&spatial) / xi.amax());
                DVector::from_iterator(list.len(), along)
            }
        };
        let casimir = |index| group.casimir(index, state.momentum());
        Self {
            momenta,
            casimirs: (0..group.casimir_count()).map(casimir).collect(),
            energy: watched.energy.map(|energy| state.energy(energy)),
        }
    }
}

impl<'a, G: Group> Recorder<'a, G> {
    /// Measures drifts against `phase`, which is `seen` as all that come after it are.
    pub fn new(group: &'a G, watched: Watched<'a>, phase: &Phase<G>, seen: &dyn Seen) -> Self {
        let algebra = watched.algebra;
        Self {
            group,
            watched,
            blocks: blocks(algebra, group.blocks()),
            start: Invariants::of(group, &watched, seen),
            energy_scale: watched.energy.map_or(0.0, |energy| energy.magnitude(group, phase)),
            momentum_scale: largest(seen.spatial_momentum().iter().copied()),
            casimir_scales: casimir_scales(group, &phase.momentum),
            tally: Tally::default(),
        }
    }

    /// The blocks of the group's matrices.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The blocks that records hold: all, or none where attitudes mean nothing.
    pub fn recorded(&self) -> &[Block] {
        if self.watched.attitude { &self.blocks } else { &[] }
    }

    /// Takes note of how the solves of so many steps went: the most iterations of one, and the largest residual.
    ///
    /// # Errors
    /// What is not finite.
    pub fn solved(&mut self, iterations: u32, residual: f64) -> Result<(), String> {
        self.tally.iterations = self.tally.iterations.max(u64::from(iterations));
        let most = maximum(self.tally.residual.unwrap_or(0.0), residual);
        self.tally.residual = Some(most);
        finite("the residual of the solve", residual)
    }

    /// Takes note of the ratio of the last terms of the series in the step from this time; what there is to be said
    /// the first time that it is large.
    pub fn steep(&mut self, step: u64, time: f64, ratio: f64) -> Option<Warning> {
        if self.tally.steep.is_some() || ratio <= STEEP {
            return None;
        }
        let steep = Steep { step, time, ratio };
        self.tally.steep = Some(steep);
        Some(Warning::Steep(steep))
    }

    /// Measures this moment, and takes its drift into account.
    ///
    /// # Errors
    /// What is not finite.
    pub fn visit(&mut self, state: &dyn Seen) -> Result<Moment, String> {
        let moment = self.measure(state)?;
        self.tally.drift.raise(moment.drift);
        Ok(moment)
    }

    /// Measures this moment.
    ///
    /// # Errors
    /// What is not finite.
    pub fn measure(&self, state: &dyn Seen) -> Result<Moment, String> {
        for (name, value) in self.watched.coordinates.iter().zip(state.momentum().iter()) {
            finite(&format_args!("the momentum {name}"), *value)?;
        }
        if let Some(bad) = state.flaw() {
            finite("an entry of the group element", bad)?;
        }
        let now = Invariants::of(self.group, &self.watched, state);
        finite("the energy", now.energy.unwrap_or(0.0))?;
        for (number, casimir) in now.casimirs.iter().enumerate() {
            finite(&format_args!("Casimir {}", number + 1), *casimir)?;
        }
        let start = &self.start;
        let casimirs = start.casimirs.iter().zip(&now.casimirs).zip(&self.casimir_scales);
        let momenta = now.momenta.iter().zip(start.momenta.iter()).map(|(a, b)| a - b);
        let drift = Drift {
            spatial_momentum: relative(largest(momenta), self.momentum_scale),
            casimirs: largest(casimirs.map(|((c, d), scale)| relative(c - d, *scale))),
            energy: match (now.energy, start.energy) {
                (Some(now), Some(start)) => relative(now - start, self.energy_scale),
                _ => 0.0,
            },
        };
        finite("the drift of the spatial momentum", drift.spatial_momentum)?;
        finite("the drift of the Casimirs", drift.casimirs)?;
        finite("the drift of the energy", drift.energy)?;
        Ok(Moment { energy: now.energy, drift })
    }

    /// The entries of the blocks of g, row by row.
    pub fn entries(&self, phase: &Phase<G>) -> impl Iterator<Item = f64> {
        self.blocks.iter().flat_map(move |block| {
            let range = block.range.clone();
            let row = move |i| {
                range.clone().map(move |j| self.group.matrix_entry(&phase.group_element, i, j))
            };
            block.range.clone().flat_map(row)
        })
    }

    /// The run, which ended at `phase`.
    pub fn finish(self, (steps, time): (u64, f64), phase: &Phase<G>, moment: &Moment) -> Outcome {
        let Tally { drift, iterations, residual, steep } = self.tally;
        Outcome {
            steps,
            time,
            backend: None,
            warnings: steep.map(Warning::Steep).into_iter().collect(),
            momentum: phase.momentum.iter().copied().collect(),
            element: if self.watched.attitude { self.entries(phase).collect() } else { Vec::new() },
            energy: self.start.energy.zip(moment.energy).map(|(start, end)| [start, end]),
            drift,
            casimirs: self.group.casimir_count(),
            potential: self.watched.symmetries.is_some(),
            momenta: self.start.momenta.len(),
            solver: residual
                .map(|max_residual| Solver { most_iterations: iterations, max_residual }),
            blocks: if self.watched.attitude { self.blocks } else { Vec::new() },
        }
    }
}

/// Refuses NaN and infinities.
fn finite(what: &(impl std::fmt::Display + ?Sized), value: f64) -> Result<(), String> {
    if value.is_finite() { Ok(()) } else { Err(format!("{what} is {value}")) }
}

/// The largest value each Casimir takes at ±|μ₁|, … with at most one sign changed: one that starts
/// at zero, such as Π·Γ for a top, is measured against the size of its terms, not against rounding.
fn casimir_scales<G: Group>(group: &G, momentum: &DVector<f64>) -> Vec<f64> {
    let scale = |index: usize| {
        let mut point = momentum.abs();
        let value = |point: &DVector<f64>| group.casimir(index, point).abs();
        let mut largest = maximum(value(momentum), value(&point));
        for i in 0..point.len() {
            point[i] = -point[i];
            largest = maximum(largest, value(&point));
            point[i] = -point[i];
        }
        largest
    };
    (0..group.casimir_count()).map(scale).collect()
}

fn relative(difference: f64, size: f64) -> f64 {
    if size == 0.0 { difference.abs() } else { (difference / size).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drifts_keep_nan_and_name_what_is_not_finite() {
        let mut drift = Drift { energy: f64::NAN, ..Drift::default() };
        drift.raise(Drift { energy: 1.0, spatial_momentum: f64::NAN, casimirs: 2.0 });
        assert!(drift.energy.is_nan() && drift.spatial_momentum.is_nan() && drift.casimirs == 2.0);
        assert_eq!(finite("the energy", f64::NAN), Err("the energy is NaN".to_owned()));
        assert!(relative(f64::NAN, 0.0).is_nan() && relative(f64::NAN, 1.0).is_nan());
    }
}
