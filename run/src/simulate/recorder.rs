//! The watch over a run: its state, and the largest drift of every invariant.

use coadjoint_codegen::lie::LieAlgebra;
pub use coadjoint_codegen::step::{Drift, Scales};
use coadjoint_codegen::step::{Invariants, Start, rounding};

use super::blocks::{Block, off_group};
use super::event::Crossing;
use super::orbit::Orbit;
use super::sink::Begun;
use super::tally::{Effort, Measured, Moment, Steep, Tally, Warning};
use super::unknown::Unknown;
use crate::backend::Used;
use crate::engine::{Numbers, STEEP, Solved, Space};
use crate::number::maximum;

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
    /// The largest entry of gᵀg − 1 at the end, of what in g is orthogonal or unitary; none where nothing is.
    pub off_group: Option<f64>,
    /// The energy at the start and at the end; none of a learned map.
    pub energy: Option<[f64; 2]>,
    /// With a torque: the energy at the start and at the end, and the work ∫⟨τ, ω⟩ dt of the torque between them. None where it is not
    /// known.
    pub work: Option<[f64; 3]>,
    /// The maxima over all steps, recorded or not.
    pub drift: Drift,
    /// The sizes that drifts are relative to.
    pub scales: Scales,
    /// From these times on drifts cannot be measured: of the spatial momentum, the Casimirs, the energy.
    pub unmeasured: [Option<f64>; 3],
    /// The reasons for drifts that there are not: of the spatial momentum, the Casimirs, the energy.
    pub unknown: [Option<&'static str>; 3],
    /// The number of Casimirs watched.
    pub casimirs: usize,
    /// True if a potential breaks the symmetry.
    pub potential: bool,
    /// The number of independent components of the spatial momentum that are conserved and were watched.
    pub momenta: usize,
    /// The events that occurred, in the order of time.
    pub events: Vec<Crossing>,
    /// Statistics of the solves, if there is one of ours in each step.
    pub solver: Option<Effort>,
    /// An estimate of the error at the end, the larger of the relative errors of μ and of the matrix of g in Euclidean norms;
    /// or why there is none.
    pub estimated_error: Result<f64, Unknown>,
}

/// Warnings of what every step conserves and has moved by more than rounding explains in this many steps.
pub fn drifting(drift: Drift, steps: u64) -> impl Iterator<Item = Warning> {
    let bound = rounding(steps);
    let drifts = [("spatial momentum", drift.spatial_momentum), ("Casimirs", drift.casimirs)];
    drifts.into_iter().filter_map(move |(quantity, drift)| {
        let drift = drift.filter(|drift| *drift > bound)?;
        Some(Warning::Drift { quantity, drift, bound })
    })
}

/// The quantities that are watched in a run.
#[derive(Clone, Copy)]
pub(crate) struct Watched<'a> {
    /// The algebra.
    pub algebra: &'a LieAlgebra,
    /// Names of the momentum's coordinates.
    pub coordinates: &'a [String],
    /// The conserved quantities.
    pub invariants: &'a Invariants,
    /// The blocks of the group's matrices; none of maps learned from momenta alone, whose attitudes are not known.
    pub blocks: &'a [Block],
    /// The effect of a velocity on the energy, if there is one.
    pub damped: Option<&'static str>,
}

impl Watched<'_> {
    /// The reasons for drifts that there are not.
    fn unknown(&self) -> [Option<&'static str>; 3] {
        let Invariants { directions, casimirs, energy, no_energy, potential, .. } = self.invariants;
        let spatial = match directions.as_deref() {
            _ if self.blocks.is_empty() => Some("not known: the data leave the attitude open"),
            Some([]) if *potential => Some("not conserved: the potential breaks the symmetry"),
            Some([]) => Some("not conserved: a torque acts"),
            _ => None,
        };
        let forced = directions.is_some();
        let none = if forced { "none that the force keeps" } else { "none known" };
        let unknown = "not known: a learned map has no Hamiltonian";
        let energy = no_energy.or(self.damped).or_else(|| (!energy).then_some(unknown));
        [spatial, (*casimirs == 0).then_some(none), energy]
    }
}

/// Watches a run.
pub(crate) struct Recorder<'a> {
    watched: Watched<'a>,
    /// The places of the entries of the blocks in the whole matrix, row by row.
    places: Vec<usize>,
    start: Start,
    unknown: [Option<&'static str>; 3],
    /// The maxima so far.
    pub tally: Tally,
}

impl<'a> Recorder<'a> {
    /// Measures drifts against a state of this time, which is the start.
    pub(crate) fn new(watched: Watched<'a>, time: f64, space: &Space, start: &Numbers) -> Self {
        let observed = space.observe(&[start.parts()]);
        let start = watched.invariants.start(time, observed.seen(0, &start.mu));
        let size = space.size();
        let places =
            watched.blocks.iter().flat_map(Block::places).map(|(i, j)| i * size + j).collect();
        let (unknown, tally) = (watched.unknown(), Tally::default());
        Self { watched, places, start, unknown, tally }
    }

    /// The orbit of the start, where all of the spatial momentum is conserved and known.
    pub(super) fn orbit(&self) -> Option<Orbit> {
        let Watched { algebra, invariants, blocks, .. } = self.watched;
        let known = invariants.directions.is_none() && !blocks.is_empty();
        known.then(|| Orbit::new(algebra, self.start.momenta().to_vec()))
    }

    /// The facts before the first step.
    pub(crate) fn begun(&self) -> Begun<'_> {
        Begun {
            coordinates: self.watched.coordinates,
            blocks: self.watched.blocks,
            known: self.unknown.map(|why| why.is_none()),
            energy: self.watched.invariants.energy,
            scales: &self.start.scales,
        }
    }

    /// Takes note of how the solves of some steps went.
    ///
    /// # Errors
    /// The name of a number that is not finite.
    pub(crate) fn solved(&mut self, solved: Solved) -> Result<(), String> {
        let Solved { iterations, residual, rescued } = solved;
        let solver = self.tally.solver.get_or_insert_default();
        solver.most_iterations = solver.most_iterations.max(iterations.into());
        solver.max_residual = maximum(solver.max_residual, residual);
        solver.rescued += rescued;
        finite("the residual of the solve", residual)
    }

    /// Takes note of the ratio of the last terms of the series in the step from this time. Returns a warning the first time
    /// that it is large.
    pub(crate) fn steep(&mut self, step: u64, time: f64, ratio: f64) -> Option<Warning> {
        if self.tally.steep.is_some() || ratio <= STEEP {
            return None;
        }
        self.tally.steep = Some(Steep { step, time, ratio });
        self.tally.steep.map(Warning::Steep)
    }

    /// Takes the drift of a measured state of this time into account.
    pub(crate) fn count(&mut self, time: f64, measured: &mut Measured) {
        self.hide(measured);
        let drifts = measured.moment.drift.numbers().into_iter().zip(self.unknown);
        for (since, (drift, unknown)) in self.tally.unmeasured.iter_mut().zip(drifts) {
            if unknown.is_none() && drift.is_nan() {
                since.get_or_insert(time);
            }
        }
        self.tally.drift.raise(measured.moment.drift);
    }

    /// A quantity has a drift until rounding of the state hides it.
    pub(crate) fn hide(&self, measured: &mut Measured) {
        let mut drift = measured.moment.drift.numbers();
        for (drift, since) in drift.iter_mut().zip(self.tally.unmeasured) {
            if since.is_some() {
                *drift = f64::NAN;
            }
        }
        measured.moment.drift = Drift::of_numbers(drift);
    }

    /// Measures states of these times, up to the first in which something is not defined, as `defined` says, or not finite; and
    /// what that is.
    pub(crate) fn measure(
        &self,
        space: &Space,
        states: &[(f64, &Numbers)],
        defined: impl Fn(f64, &Numbers) -> Result<(), String>,
    ) -> (Vec<Measured>, Option<String>) {
        let mut wrong = None;
        let sound = states
            .iter()
            .map(|(time, state)| defined(*time, state).and_then(|()| self.sound(space, state)));
        let count = sound.map_while(|sound| sound.map_err(|what| wrong = Some(what)).ok()).count();
        let invariants = self.watched.invariants;
        // An energy that is conserved does not depend on the time.
        let time = states.first().map_or(f64::NAN, |(time, _)| *time);
        let states: Vec<_> = states[..count].iter().map(|(_, state)| state.parts()).collect();
        let (observed, conserved) = space.conserved(invariants, time, &states);
        let mut measured = Vec::with_capacity(count);
        for (at, [now, beside]) in conserved.each().enumerate() {
            let energy = invariants.energy_of(now);
            if let Err(what) = finite("the energy", energy.unwrap_or(0.0)) {
                wrong = Some(what);
                break;
            }
            let mut drift = self.start.measured(now, beside).numbers();
            for (drift, unknown) in drift.iter_mut().zip(self.unknown) {
                if unknown.is_some() {
                    *drift = f64::NAN;
                }
            }
            let moment = Moment { energy, drift: Drift::of_numbers(drift) };
            measured.push(Measured { moment, observed: observed.only(at) });
        }
        (measured, wrong)
    }

    /// Checks that all numbers of a state are finite.
    fn sound(&self, space: &Space, state: &Numbers) -> Result<(), String> {
        for (name, value) in self.watched.coordinates.iter().zip(&state.mu) {
            finite(&format_args!("the momentum {name}"), *value)?;
        }
        let g = space.compiled.as_ref().map_or(&state.g[..], |own| own.lasting(&state.g));
        g.iter().try_for_each(|number| finite("an entry of the group element", *number))
    }

    /// The entries of the blocks of a matrix, row by row.
    pub(crate) fn entries(&self, matrix: &[f64]) -> Vec<f64> {
        self.places.iter().map(|&place| matrix[place]).collect()
    }

    /// The outcome of the run, which ended at `state`.
    pub(crate) fn finish(
        self,
        (steps, time): (u64, f64),
        state: &Numbers,
        measured: &Measured,
    ) -> Outcome {
        let Tally { drift, unmeasured, solver, steep } = self.tally;
        let Watched { invariants, blocks, .. } = self.watched;
        let Measured { moment, observed } = measured;
        let element = self.entries(observed.matrix(0));
        let energy = invariants.energy_of(self.start.conserved());
        Outcome {
            steps,
            time,
            backend: None,
            warnings: steep.map(Warning::Steep).into_iter().collect(),
            momentum: state.mu.clone(),
            off_group: off_group(blocks, &element),
            element,
            energy: energy.zip(moment.energy).map(|(start, end)| [start, end]),
            work: None,
            drift,
            unmeasured,
            unknown: self.unknown,
            casimirs: invariants.casimirs,
            potential: invariants.potential,
            momenta: if blocks.is_empty() { 0 } else { invariants.momenta() },
            scales: self.start.scales,
            events: Vec::new(),
            solver,
            blocks: blocks.to_vec(),
            estimated_error: Err(Unknown::OFF),
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

    /// Ten times the drift that rounding explains in 100 steps, 1e-10 √100, and a tenth of it.
    #[test]
    fn drifts_above_rounding_are_warned_of() {
        let moved = |drift: f64| {
            let drifts = Drift { spatial_momentum: Some(drift), casimirs: None, energy: Some(1.0) };
            drifting(drifts, 100).map(|warning| warning.text()).collect::<Vec<_>>()
        };
        assert_eq!(moved(1e-10), Vec::<String>::new());
        let text =
            "the spatial momentum drifted by 1.0e-8, relatively, where rounding explains 1.0e-9: ";
        assert!(matches!(&moved(1e-8)[..], [only] if only.starts_with(text)), "{:?}", moved(1e-8));
    }

    #[test]
    fn what_is_not_finite_is_named() {
        assert_eq!(finite("the energy", f64::NAN), Err("the energy is NaN".to_owned()));
        assert_eq!(finite("the energy", 1.0), Ok(()));
    }
}
