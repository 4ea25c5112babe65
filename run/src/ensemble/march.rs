//! Trajectories side by side, on this processor or on a device.

use std::array::from_fn;
use std::collections::BTreeSet;
use std::mem::take;
use std::sync::atomic::{AtomicBool, Ordering};

use coadjoint::LieGroup;
use coadjoint_native::cards::{Card, DeviceError, Refused, Row};
use coadjoint_program::states::{States, into_lane, of_lane};
use coadjoint_program::{Precision, WIDTH};
use rayon::prelude::*;

use super::course::Course;
use crate::engine::{Motion, Numbers};
use crate::number::maximum;
use crate::simulate::Stop;

/// Steps that all trajectories make before the next: each is then about as far, and what is told of it is true.
pub(super) const STRETCH: u64 = 256;

/// The motion of a row, and its limits.
pub(super) struct March<'a, 's> {
    /// Makes them, and is asked for the ratio of the series after each stretch.
    pub motion: &'a Motion<'s>,
    /// Stops all rows once it is set.
    pub stop: &'a AtomicBool,
}

/// A trajectory on its way: what is known of it beside its state.
#[derive(Clone, Debug, Default)]
pub(super) struct Way {
    /// The number of the step that could not be made, from 1, and why: the state is the one before it; 0 where the row itself
    /// is at fault, and there is no state.
    pub stopped: Option<(u64, String)>,
    /// The largest ratio seen.
    pub ratio: f64,
    /// The steps that the generic solver made.
    pub rescued: u64,
    /// The states kept on the way.
    pub kept: Vec<Numbers>,
}

impl Way {
    /// True if there is a state.
    fn has_state(&self) -> bool {
        self.stopped.as_ref().is_none_or(|(step, _)| *step > 0)
    }
}

impl March<'_, '_> {
    /// The numbers of g of a state.
    fn element(&self, block: &[f64]) -> usize {
        block.len() / WIDTH - self.motion.space().group.dim()
    }

    /// The state in a lane of a block.
    pub(super) fn state(&self, block: &[f64], lane: usize) -> Numbers {
        let mut numbers = of_lane(block, lane);
        let g = numbers.by_ref().take(self.element(block)).collect();
        Numbers { g, mu: numbers.collect() }
    }

    /// Puts a state into a lane of a block.
    pub(super) fn put(block: &mut [f64], lane: usize, state: &Numbers) {
        into_lane(block, lane, state.g.iter().chain(&state.mu).copied());
    }

    /// Takes the ratios of where the trajectories of a block are into account.
    pub(super) fn look(&self, ways: &mut [Way], block: &[f64]) {
        let own = &block[self.element(block) * WIDTH..];
        let dim = own.len() / WIDTH;
        let lanes: Vec<usize> = (0..ways.len()).filter(|&lane| ways[lane].has_state()).collect();
        let momenta: Vec<f64> = lanes.iter().flat_map(|&lane| of_lane(own, lane)).collect();
        let momenta: Vec<&[f64]> = momenta.chunks_exact(dim).collect();
        let ratios = self.motion.ratios(&momenta);
        for (lane, ratio) in lanes.into_iter().zip(ratios) {
            ways[lane].ratio = maximum(ways[lane].ratio, ratio);
        }
    }

    /// Takes the ratio of where a trajectory is into account.
    fn look_at(&self, way: &mut Way, state: &Numbers) {
        way.ratio = maximum(way.ratio, self.motion.ratio(&state.mu));
    }

    /// Makes steps `first` to `end` of a trajectory by itself.
    fn alone(&self, way: &mut Way, state: &mut Numbers, first: u64, end: u64) {
        let made = self.motion.advance(state, first, end - first);
        way.rescued += made.as_ref().ok().and_then(|solves| *solves).map_or(0, |own| own.rescued);
        way.stopped = made.err().map(|(done, error)| (first + done + 1, error.to_string()));
    }

    /// Makes steps `first` to `end` of the trajectories of a block side by side. A trajectory goes alone from the step on
    /// that it cannot make with the others, so that none depends on its neighbours.
    fn abreast(&self, ways: &mut [Way], block: &mut [f64], first: u64, end: u64) {
        if self.stop.load(Ordering::Relaxed) {
            return;
        }
        let mut made = [0; WIDTH];
        // A step with breaks is made row by row.
        let whole = self.motion.divided(first) != Some(first);
        if let Some(compiled) = self.motion.lanes().filter(|_| whole) {
            let (g, mu) = block.split_at_mut(self.element(block) * WIDTH);
            let live = from_fn(|lane| ways.get(lane).is_some_and(|w| w.stopped.is_none()));
            let (start, steps) = (self.motion.grid().start, [first, end - first]);
            made = compiled.advance_lanes(g, mu, start, steps, live);
        }
        for (lane, (way, made)) in ways.iter_mut().zip(made).enumerate() {
            if way.stopped.is_none() && first + made < end {
                let mut state = self.state(block, lane);
                self.alone(way, &mut state, first + made, end);
                Self::put(block, lane, &state);
            }
        }
        self.look(ways, block);
    }

    /// Makes steps `first` to `end` of all trajectories, a stretch of each before the next, which is then told to `told`.
    pub(super) fn march(
        &self,
        ways: &mut [Way],
        states: &mut States,
        first: u64,
        end: u64,
        told: &dyn Fn(u64),
    ) {
        let length = states.length();
        let mut done = first;
        while done < end && !self.stop.load(Ordering::Relaxed) {
            let next = end.min(done + STRETCH);
            let next = match self.motion.divided(done) {
                Some(divided) => next.min(divided.max(done + 1)),
                None => next,
            };
            let blocks = states.blocks_mut().par_chunks_mut(length);
            let blocks = blocks.zip(ways.par_chunks_mut(WIDTH));
            blocks.for_each(|(block, ways)| self.abreast(ways, block, done, next));
            done = next;
            told(done);
        }
    }

    /// Does something with each trajectory and its state.
    pub(super) fn each(
        &self,
        ways: &mut [Way],
        states: &States,
        act: impl Fn(&mut Way, &dyn Fn() -> Numbers) + Sync,
    ) {
        let length = states.length();
        let blocks = states.blocks().par_chunks(length).zip(ways.par_chunks_mut(WIDTH));
        blocks.for_each(|(block, ways)| {
            for (lane, way) in ways.iter_mut().enumerate() {
                act(way, &|| self.state(block, lane));
            }
        });
    }

    /// Makes the steps of a row alone, from its start on.
    pub(super) fn follow(&self, way: &mut Way, state: &mut Numbers, course: &Course) {
        let stopped = || self.stop.load(Ordering::Relaxed);
        self.look_at(way, state);
        for (first, end, at) in course.legs() {
            let mut done = first;
            while done < end && way.stopped.is_none() && !stopped() {
                let next = end.min(done + STRETCH);
                self.alone(way, state, done, next);
                self.look_at(way, state);
                done = next;
            }
            if let Some(at) = at {
                self.keep(way, state, at);
            }
        }
        if !stopped() {
            self.end(way, state, course.steps);
        }
    }

    /// Keeps the state of a trajectory at this stop, which its whole steps have reached.
    pub(super) fn keep(&self, way: &mut Way, state: &Numbers, Stop { step, part }: Stop) {
        if way.stopped.is_some() {
            return;
        }
        let time = self.motion.grid().time(step);
        let made = match part == 0.0 {
            true => Ok(state.clone()),
            false => self.motion.beside(state, time, part),
        };
        let defined = |state: Numbers| self.motion.defined(&state, time + part).map(|()| state);
        match made.and_then(defined) {
            Ok(state) => way.kept.push(state),
            Err(error) => way.stopped = Some((step + u64::from(part != 0.0), error.to_string())),
        }
    }

    /// Stops a trajectory whose end, after `steps` steps, is no state in which everything is defined, as runs do.
    pub(super) fn end(&self, way: &mut Way, state: &Numbers, steps: u64) {
        let time = self.motion.grid().time(steps);
        if let (None, Err(error)) = (&way.stopped, self.motion.defined(state, time)) {
            way.stopped = Some((steps, error.to_string()));
        }
    }

    /// Moves a trajectory, whose next step was refused elsewhere, from step `made` to step `end`, with the bits that
    /// [`march`](Self::march) gives it: to the end of its stretch alone, then in lanes.
    fn redo(&self, way: &mut Way, state: &mut Numbers, made: u64, end: u64) {
        let mut done = end.min(made - made % STRETCH + STRETCH);
        self.look_at(way, state);
        self.alone(way, state, made, done);
        self.look_at(way, state);
        let mut block = vec![f64::NAN; (state.g.len() + state.mu.len()) * WIDTH];
        Self::put(&mut block, 0, state);
        while done < end && way.stopped.is_none() {
            let next = end.min(done + STRETCH);
            self.abreast(std::slice::from_mut(way), &mut block, done, next);
            done = next;
        }
        *state = self.state(&block, 0);
    }

    /// Makes `steps` steps of all trajectories on a device; how many of them had steps that it refused, which are made here.
    ///
    /// In double precision the states have the bits of [`march`](Self::march). States of single precision are put onto the
    /// group before steps are made here, and at the end.
    ///
    /// # Errors
    /// Fails if the device fails; the states are lost then.
    pub(super) fn march_on(
        &self,
        card: &mut Card,
        ways: &mut [Way],
        states: &mut States,
        steps: u64,
        told: &dyn Fn(u64),
    ) -> Result<u64, DeviceError> {
        let single = card.precision == Precision::Single;
        let settle = |g: &mut Vec<f64>| {
            if single {
                *g = self.motion.space().settled(g);
            }
        };
        let length = states.length();
        let ended = |way: &Way| way.stopped.is_some();
        let row = |(place, way): (usize, &Way)| {
            let block = &states.blocks()[place / WIDTH * length..][..length];
            let Numbers { g, mu } = self.state(block, place % WIDTH);
            Row { g, mu, made: 0, ended: ended(way) }
        };
        let mut rows: Vec<Row> =
            ways.par_iter().enumerate().map(|(i, way)| row((i, way))).collect();
        let mut redone = BTreeSet::new();
        let mut others = |refused: &mut [Refused<'_>], target: u64| {
            let redo = |Refused { place, row, .. }: &mut Refused<'_>| {
                let mut way = Way::default();
                let mut state = Numbers { g: take(&mut row.g), mu: take(&mut row.mu) };
                settle(&mut state.g);
                self.redo(&mut way, &mut state, row.made, target);
                (row.g, row.mu) = (state.g, state.mu);
                row.ended = ended(&way);
                row.made = if row.ended { row.made } else { target };
                (*place, way)
            };
            let ends: Vec<_> = refused.par_iter_mut().map(redo).collect();
            for (place, Way { stopped, ratio, rescued, .. }) in ends {
                redone.insert(place);
                ways[place].stopped = stopped;
                ways[place].ratio = maximum(ways[place].ratio, ratio);
                ways[place].rescued += rescued;
            }
        };
        card.advance(&mut rows, steps, &mut others, told)?;
        let blocks = states.blocks_mut().par_chunks_mut(length);
        let blocks = blocks.zip(rows.par_chunks_mut(WIDTH)).zip(ways.par_chunks_mut(WIDTH));
        blocks.for_each(|((block, rows), ways)| {
            for (lane, row) in rows.iter_mut().enumerate() {
                settle(&mut row.g);
                into_lane(block, lane, row.g.iter().chain(&row.mu).copied());
            }
            self.look(ways, block);
        });
        Ok(redone.len() as u64)
    }
}
