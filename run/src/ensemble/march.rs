//! Trajectories side by side, on this processor or on a device.

use std::array::from_fn;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use coadjoint::LieGroup;
use coadjoint_native::cards::{Card, DeviceError, ENDED, Refused};
use coadjoint_program::states::{States, abreast, into_lane, of_lane};
use coadjoint_program::{Evaluation, Precision, WIDTH};
use rayon::prelude::*;

use super::course::Course;
use crate::engine::{Compiled, Motion, Numbers};
use crate::simulate::Stop;

/// Steps that all trajectories make before the next: each is then about as far, and what is told of it is true.
pub(super) const STRETCH: u64 = 256;

/// The motion of rows, and its limits.
pub(super) struct March<'a, 's> {
    /// Makes them, and is asked for the ratio of the series after each stretch.
    pub motion: &'a Motion<'s>,
    /// Stops all rows once it is set.
    pub stop: &'a AtomicBool,
    /// Is told of all rows.
    pub overall: &'a Overall,
}

/// Findings about all trajectories together.
#[derive(Debug, Default)]
pub(super) struct Overall {
    /// The largest ratio, as bits, which are ordered as numbers that are not negative, with NaN above all.
    ratio: AtomicU64,
    /// The steps that the generic solver made.
    rescued: AtomicU64,
}

impl Overall {
    /// The largest ratio.
    pub(super) fn ratio(&self) -> f64 {
        f64::from_bits(self.ratio.load(Ordering::Relaxed))
    }

    /// The steps that the generic solver made.
    pub(super) fn rescued(&self) -> u64 {
        self.rescued.load(Ordering::Relaxed)
    }

    fn raise(&self, ratio: f64) {
        // Most are not larger, and need not be written.
        if self.ratio.load(Ordering::Relaxed) < ratio.to_bits() {
            self.ratio.fetch_max(ratio.to_bits(), Ordering::Relaxed);
        }
    }
}

/// A trajectory on its way: what is known of it beside its state.
#[derive(Clone, Debug, Default)]
pub(super) struct Way {
    /// The number of the step that could not be made, from 1, and why: the state is the one before it; 0 where the row itself
    /// is at fault, and there is no state.
    pub stopped: Option<(u64, String)>,
    /// The states kept on the way.
    pub kept: Vec<Numbers>,
}

/// Trajectories on their ways; most have nothing to say.
pub(super) type Ways = [Option<Box<Way>>];

/// True if a trajectory moves no further.
fn is_stopped(way: &Option<Box<Way>>) -> bool {
    way.as_ref().is_some_and(|way| way.stopped.is_some())
}

/// Stops a trajectory, unless it has stopped before.
pub(super) fn stop(way: &mut Option<Box<Way>>, stopped: Option<(u64, String)>) {
    if let Some(stopped) = stopped {
        way.get_or_insert_default().stopped.get_or_insert(stopped);
    }
}

/// Puts the elements of a block onto the group.
fn settle(settled: &mut Evaluation<'_, WIDTH>, block: &mut [f64]) {
    settled.run(|i| abreast(block, i));
    let places = block.as_chunks_mut().0.iter_mut();
    places.zip(settled.results()).for_each(|(place, numbers)| *place = numbers);
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

    /// Takes the ratios of where the trajectories of a block are into account. There are none without a state.
    pub(super) fn look(&self, block: &[f64]) {
        let momenta = &block[self.element(block) * WIDTH..];
        self.overall.raise(self.motion.largest_ratio((momenta, WIDTH)));
    }

    /// Takes the ratio of where a trajectory is into account.
    fn look_at(&self, state: &Numbers) {
        self.overall.raise(self.motion.ratio(&state.mu));
    }

    /// Makes steps `first` to `end` of a trajectory by itself.
    fn alone(&self, way: &mut Option<Box<Way>>, state: &mut Numbers, first: u64, end: u64) {
        let made = self.motion.advance(state, first, end - first);
        if let Some(solves) = made.as_ref().ok().and_then(|solves| *solves) {
            self.overall.rescued.fetch_add(solves.rescued, Ordering::Relaxed);
        }
        stop(way, made.err().map(|(done, error)| (first + done + 1, error.to_string())));
    }

    /// Makes steps `first` to `end` of the trajectories of a block side by side. A trajectory goes alone from the step on
    /// that it cannot make with the others, so that none depends on its neighbours.
    fn abreast(&self, ways: &mut Ways, block: &mut [f64], first: u64, end: u64) {
        if self.stop.load(Ordering::Relaxed) {
            return;
        }
        let mut made = [0; WIDTH];
        // A step with breaks is made row by row.
        let whole = self.motion.divided(first) != Some(first);
        if let Some(compiled) = self.motion.lanes().filter(|_| whole) {
            let (g, mu) = block.split_at_mut(self.element(block) * WIDTH);
            let live = from_fn(|lane| ways.get(lane).is_some_and(|way| !is_stopped(way)));
            let (start, steps) = (self.motion.grid().start, [first, end - first]);
            made = compiled.advance_lanes(g, mu, start, steps, live);
        }
        for (lane, (way, made)) in ways.iter_mut().zip(made).enumerate() {
            if first + made < end && !is_stopped(way) {
                let mut state = self.state(block, lane);
                self.alone(way, &mut state, first + made, end);
                into_lane(block, lane, state.parts());
            }
        }
        self.look(block);
    }

    /// Makes steps `first` to `end` of all trajectories, a stretch of each before the next, which is then told to `told`.
    pub(super) fn march(
        &self,
        ways: &mut Ways,
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
        ways: &mut Ways,
        states: &States,
        act: impl Fn(&mut Option<Box<Way>>, &dyn Fn() -> Numbers) + Sync,
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
    pub(super) fn follow(&self, way: &mut Option<Box<Way>>, state: &mut Numbers, course: &Course) {
        let stopped = || self.stop.load(Ordering::Relaxed);
        self.look_at(state);
        for (first, end, at) in course.legs() {
            let mut done = first;
            while done < end && !is_stopped(way) && !stopped() {
                let next = end.min(done + STRETCH);
                self.alone(way, state, done, next);
                self.look_at(state);
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
    pub(super) fn keep(
        &self,
        way: &mut Option<Box<Way>>,
        state: &Numbers,
        Stop { step, part }: Stop,
    ) {
        if is_stopped(way) {
            return;
        }
        let time = self.motion.grid().time(step);
        let made = match part == 0.0 {
            true => Ok(state.clone()),
            false => self.motion.beside(state, time, part),
        };
        let defined = |state: Numbers| self.motion.defined(&state, time + part).map(|()| state);
        match made.and_then(defined) {
            Ok(state) => way.get_or_insert_default().kept.push(state),
            Err(error) => stop(way, Some((step + u64::from(part != 0.0), error.to_string()))),
        }
    }

    /// Stops a trajectory whose end, after `steps` steps, is no state in which everything is defined, as runs do.
    pub(super) fn end(&self, way: &mut Option<Box<Way>>, state: &Numbers, steps: u64) {
        let time = self.motion.grid().time(steps);
        if let (false, Err(error)) = (is_stopped(way), self.motion.defined(state, time)) {
            stop(way, Some((steps, error.to_string())));
        }
    }

    /// Moves a trajectory, whose next step was refused elsewhere, from step `made` to step `end`, with the bits that
    /// [`march`](Self::march) gives it: to the end of its stretch alone, then in lanes.
    fn redo(&self, state: &mut Numbers, made: u64, end: u64) -> Option<Box<Way>> {
        let (mut way, mut done) = (None, end.min(made - made % STRETCH + STRETCH));
        self.look_at(state);
        self.alone(&mut way, state, made, done);
        self.look_at(state);
        let mut block = vec![f64::NAN; (state.g.len() + state.mu.len()) * WIDTH];
        into_lane(&mut block, 0, state.parts());
        while done < end && !is_stopped(&way) {
            let next = end.min(done + STRETCH);
            self.abreast(std::slice::from_mut(&mut way), &mut block, done, next);
            done = next;
        }
        *state = self.state(&block, 0);
        way
    }

    /// Makes `steps` steps of all trajectories on a device; how many of them had steps that it refused, which are made here, and
    /// for how long it ran.
    ///
    /// In double precision the states have the bits of [`march`](Self::march). States of single precision are put onto the
    /// group before steps are made here, and at the end.
    ///
    /// # Errors
    /// Fails if the device fails; the states are lost then.
    pub(super) fn march_on(
        &self,
        card: &mut Card,
        ways: &mut Ways,
        states: &mut States,
        steps: u64,
        told: &dyn Fn(u64),
    ) -> Result<(u64, Duration), DeviceError> {
        let settled = match card.precision {
            Precision::Double => None,
            Precision::Single => self.motion.lanes().map(Compiled::settled),
        };
        let settled = || settled.as_ref().map(|program| Evaluation::new(program, &[]));
        let length = states.length();
        let count = |way: &Option<Box<Way>>| if is_stopped(way) { ENDED } else { 0 };
        let mut made: Vec<u64> = ways.iter().map(count).collect();
        let mut redone = BTreeSet::new();
        let mut others = |states: &mut States, made: &mut [u64], refused: &[Refused], end: u64| {
            let block = |place: usize| place / WIDTH * length..(place / WIDTH + 1) * length;
            let redo = |&Refused { place, .. }: &Refused| {
                let mut own = states.blocks()[block(place)].to_vec();
                settled().iter_mut().for_each(|settled| settle(settled, &mut own));
                let mut state = self.state(&own, place % WIDTH);
                let way = self.redo(&mut state, made[place], end);
                (place, way, state)
            };
            let ends: Vec<_> = refused.par_iter().map(redo).collect();
            for (place, way, state) in ends {
                into_lane(&mut states.blocks_mut()[block(place)], place % WIDTH, state.parts());
                made[place] = if is_stopped(&way) { ENDED } else { end };
                redone.insert(place);
                ways[place] = way;
            }
        };
        let advanced = card.advance(states, &mut made, steps, &mut others, told)?;
        states.blocks_mut().par_chunks_mut(length).for_each_init(settled, |settled, block| {
            settled.iter_mut().for_each(|settled| settle(settled, block));
            self.look(block);
        });
        Ok((redone.len() as u64, advanced.running))
    }
}
