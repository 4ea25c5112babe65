//! The watch over a run: its state, and the largest drift of every invariant.

use coadjoint::Phase;
use coadjoint_codegen::lie::LieAlgebra;
pub use coadjoint_codegen::step::{Conserved, Drift, Scales};
use coadjoint_codegen::step::{Start, casimir_scale, energy_scale};
use nalgebra::DVector;

use super::blocks::{Block, blocks};
use super::mover::Seen;
use super::outlet::Begun;
use super::warning::{Steep, Warning};
use crate::backend::Used;
use crate::engine::{Energy, Group, STEEP};
use crate::number::{largest, maximum};
use crate::rounding::measured;

/// The measurements at a moment.
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

/// The outcome of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Steps made.
    pub steps: u64,
    /// The time reached.
    pub time: f64,
    /// Warnings about the run.
    pub warnings: Vec<Warning>,
    /// The backends that made the steps, where they are programs.
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
    /// The sizes that drifts are relative to.
    pub scales: Scales,
    /// From these times on drifts cannot be measured: of the spatial momentum, the Casimirs, the energy.
    pub unmeasured: [Option<f64>; 3],
    /// Why a drift is `None`.
    pub unknown: Unknown,
    /// How many Casimirs were watched.
    pub casimirs: usize,
    /// Whether a potential breaks the symmetry.
    pub potential: bool,
    /// How many independent components of the spatial momentum are conserved, and were watched.
    pub momenta: usize,
    /// How the solves went, where they are ours and one a step.
    pub solver: Option<Solver>,
}

/// Why a drift is `None`: in the order spatial momentum, Casimirs, energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unknown(pub [Option<&'static str>; 3]);

impl Unknown {
    /// Of these a drift is known at the start.
    pub fn known(&self) -> [bool; 3] {
        self.0.map(|why| why.is_none())
    }
}

/// The quantities watched in a run.
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

impl Watched<'_> {
    /// Drifts that are all unknown, with this number of Casimirs.
    fn unknown(&self, casimirs: usize) -> Unknown {
        let potential = self.symmetries.is_some();
        let spatial = match self.symmetries {
            _ if !self.attitude => Some("not known: the data leave the attitude open"),
            Some([]) => Some("not conserved: the potential breaks the symmetry"),
            _ => None,
        };
        let casimirs = match (casimirs, potential) {
            (0, false) => Some("none known"),
            (0, true) => Some("none that the kicks keep"),
            _ => None,
        };
        let energy = self.energy.is_none().then_some("not known: a learned map has no Hamiltonian");
        Unknown([spatial, casimirs, energy])
    }

    /// The components of a spatial momentum that are conserved, each relative to the largest component of its ξ.
    fn conserved(&self, spatial: &DVector<f64>) -> Vec<f64> {
        match self.symmetries {
            _ if !self.attitude => Vec::new(),
            None => spatial.as_slice().to_vec(),
            Some(list) => list.iter().map(|xi| xi.dot(spatial) / xi.amax()).collect(),
        }
    }
}

/// The maxima and sums so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// The largest drifts.
    pub drift: Drift,
    /// From these times on drifts cannot be measured: of the spatial momentum, the Casimirs, the energy.
    pub unmeasured: [Option<f64>; 3],
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
    start: Start,
    unknown: Unknown,
    /// The maxima so far.
    pub tally: Tally,
}

/// The conserved quantities of a state with this momentum, spatial momentum and energy.
fn conserved<G: Group>(
    group: &G,
    watched: &Watched<'_>,
    momentum: &DVector<f64>,
    spatial: &DVector<f64>,
    energy: Option<f64>,
) -> Conserved {
    let casimir = |index| group.casimir(index, momentum);
    let casimirs = (0..group.casimir_count()).map(casimir).collect();
    Conserved { momenta: watched.conserved(spatial), casimirs, energy }
}

impl<'a, G: Group> Recorder<'a, G> {
    /// Measures drifts against `phase`, which is `seen` as all that come after it are.
    pub fn new(group: &'a G, watched: Watched<'a>, phase: &Phase<G>, seen: &dyn Seen) -> Self {
        let (spatial, energy) = (seen.spatial_momentum(), watched.energy.map(|e| seen.energy(e)));
        let conserved = conserved(group, &watched, seen.momentum(), &spatial, energy);
        let casimir = |index| {
            let value = |mu: &[f64]| group.casimir(index, &DVector::from_column_slice(mu));
            casimir_scale(value, phase.momentum.as_slice())
        };
        let magnitude = watched.energy.map_or(0.0, |energy| energy.magnitude(group, phase));
        let scales = Scales {
            spatial_momentum: largest(spatial.iter().copied()),
            casimirs: (0..group.casimir_count()).map(casimir).collect(),
            energy: energy_scale(conserved.energy.unwrap_or(0.0), magnitude),
        };
        Self {
            group,
            watched,
            blocks: blocks(watched.algebra, group.blocks()),
            start: Start { conserved, scales },
            unknown: watched.unknown(group.casimir_count()),
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

    /// The facts a run begins with.
    pub fn begun(&self) -> Begun<'_> {
        Begun {
            blocks: self.recorded(),
            known: self.unknown.known(),
            energy: self.watched.energy.is_some(),
            scales: &self.start.scales,
        }
    }

    /// Takes note of how the solves of some steps went: the most iterations of one, and the largest residual.
    ///
    /// # Errors
    /// The name of a number that is not finite.
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

    /// Measures the moment of this time, and takes its drift into account.
    ///
    /// # Errors
    /// The name of a number that is not finite.
    pub fn visit(&mut self, time: f64, state: &dyn Seen) -> Result<Moment, String> {
        let moment = self.measure(state)?;
        let drifts = moment.drift.numbers();
        for ((since, drift), known) in
            self.tally.unmeasured.iter_mut().zip(drifts).zip(self.unknown.known())
        {
            if known && drift.is_nan() {
                since.get_or_insert(time);
            }
        }
        self.tally.drift.raise(moment.drift);
        Ok(moment)
    }

    /// Measures this moment. A quantity has a drift until rounding of the state hides it.
    ///
    /// # Errors
    /// The name of a number that is not finite.
    pub fn measure(&self, state: &dyn Seen) -> Result<Moment, String> {
        for (name, value) in self.watched.coordinates.iter().zip(state.momentum().iter()) {
            finite(&format_args!("the momentum {name}"), *value)?;
        }
        if let Some(bad) = state.flaw() {
            finite("an entry of the group element", bad)?;
        }
        let energy = self.watched.energy.map(|energy| state.energy(energy));
        finite("the energy", energy.unwrap_or(0.0))?;
        let of = |momentum: &_, spatial: &_, energy| {
            conserved(self.group, &self.watched, momentum, spatial, energy)
        };
        let now = of(state.momentum(), &state.spatial_momentum(), energy);
        let (momentum, spatial, other) = state.nudged(self.watched.energy);
        let beside = of(&momentum, &spatial, other);
        let mut drift = measured(&self.start, &now, beside).numbers();
        for (drift, since) in drift.iter_mut().zip(self.tally.unmeasured) {
            if since.is_some() {
                *drift = f64::NAN;
            }
        }
        Ok(Moment { energy: now.energy, drift: Drift::of_numbers(drift) })
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
        let Tally { drift, unmeasured, iterations, residual, steep } = self.tally;
        Outcome {
            steps,
            time,
            backend: None,
            warnings: steep.map(Warning::Steep).into_iter().collect(),
            momentum: phase.momentum.iter().copied().collect(),
            element: if self.watched.attitude { self.entries(phase).collect() } else { Vec::new() },
            energy: self.start.conserved.energy.zip(moment.energy).map(|(start, end)| [start, end]),
            drift,
            unmeasured,
            unknown: self.unknown,
            casimirs: self.group.casimir_count(),
            potential: self.watched.symmetries.is_some(),
            momenta: self.start.conserved.momenta.len(),
            scales: self.start.scales,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_named() {
        assert_eq!(finite("the energy", f64::NAN), Err("the energy is NaN".to_owned()));
        assert_eq!(finite("the energy", 1.0), Ok(()));
    }
}
