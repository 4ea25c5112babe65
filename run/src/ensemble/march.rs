//! Trajectories side by side, on this processor or on a device.

use std::array::from_fn;
use std::collections::BTreeSet;
use std::mem::take;
use std::sync::atomic::{AtomicBool, Ordering};

use coadjoint_native::cards::{Card, DeviceError, Refused, Row};
use coadjoint_program::{Precision, WIDTH};
use rayon::prelude::*;

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

/// A trajectory on its way.
#[derive(Clone, Debug)]
pub(super) struct Way {
    /// The state reached.
    pub state: Numbers,
    /// The number of the step that could not be made, from 1, and why: the state is the one before it; 0 where the row itself
    /// is at fault.
    pub stopped: Option<(u64, String)>,
    /// The largest ratio seen.
    pub ratio: f64,
    /// The steps that the generic solver made.
    pub rescued: u64,
    /// The states kept on the way.
    pub kept: Vec<Numbers>,
}

impl From<Numbers> for Way {
    fn from(state: Numbers) -> Self {
        Self { state, stopped: None, ratio: 0.0, rescued: 0, kept: Vec::new() }
    }
}

impl March<'_, '_> {
    /// Takes the ratios of where trajectories are into account.
    pub(super) fn look(&self, ways: &mut [Way]) {
        let momenta: Vec<&[f64]> = ways.iter().map(|way| &way.state.mu[..]).collect();
        let ratios = self.motion.ratios(&momenta);
        ways.iter_mut().zip(ratios).for_each(|(way, ratio)| way.ratio = maximum(way.ratio, ratio));
    }

    /// Makes steps `first` to `end` of a trajectory by itself.
    pub(super) fn alone(&self, way: &mut Way, first: u64, end: u64) {
        let made = self.motion.advance(&mut way.state, first, end - first);
        way.rescued += made.as_ref().ok().and_then(|solves| *solves).map_or(0, |own| own.rescued);
        way.stopped = made.err().map(|(done, error)| (first + done + 1, error.to_string()));
    }

    /// Makes steps `first` to `end` of at most [`WIDTH`] trajectories side by side. A trajectory goes alone from the step on
    /// that it cannot make with the others, so that none depends on its neighbours.
    fn abreast(&self, ways: &mut [Way], first: u64, end: u64) {
        if self.stop.load(Ordering::Relaxed) {
            return;
        }
        let mut made = [0; WIDTH];
        if let Some(compiled) = self.motion.lanes() {
            // Number i of trajectory r is at `i * WIDTH + r`.
            let beside = |of: fn(&Numbers) -> &Vec<f64>| {
                let mut list = vec![0.0; ways.first().map_or(0, |w| of(&w.state).len()) * WIDTH];
                for (lane, way) in ways.iter().enumerate() {
                    let places = list.iter_mut().skip(lane).step_by(WIDTH);
                    places.zip(of(&way.state)).for_each(|(place, value)| *place = *value);
                }
                list
            };
            let (mut g, mut mu) = (beside(|state| &state.g), beside(|state| &state.mu));
            let live = from_fn(|lane| ways.get(lane).is_some_and(|w| w.stopped.is_none()));
            let (start, steps) = (self.motion.grid().start, [first, end - first]);
            made = compiled.advance_lanes(&mut g, &mut mu, start, steps, live);
            for (lane, Way { state, .. }) in ways.iter_mut().enumerate() {
                for (list, own) in [(&g, &mut state.g), (&mu, &mut state.mu)] {
                    let values = list.iter().skip(lane).step_by(WIDTH);
                    own.iter_mut().zip(values).for_each(|(own, value)| *own = *value);
                }
            }
        }
        for (way, made) in ways.iter_mut().zip(made) {
            if way.stopped.is_none() {
                self.alone(way, first + made, end);
            }
        }
        self.look(ways);
    }

    /// Makes steps `first` to `end` of all trajectories, a stretch of each before the next, which is then told to `told`.
    pub(super) fn march(&self, ways: &mut [Way], first: u64, end: u64, told: &dyn Fn(u64)) {
        let abreast = if self.motion.lanes().is_some() { WIDTH } else { 1 };
        let mut done = first;
        while done < end && !self.stop.load(Ordering::Relaxed) {
            let next = end.min(done + STRETCH);
            ways.par_chunks_mut(abreast).for_each(|ways| self.abreast(ways, done, next));
            done = next;
            told(done);
        }
    }

    /// Keeps the state of a trajectory at this stop, which its whole steps have reached.
    pub(super) fn keep(&self, way: &mut Way, Stop { step, part }: Stop) {
        if way.stopped.is_some() {
            return;
        }
        let time = self.motion.grid().time(step);
        let made = match part == 0.0 {
            true => Ok(way.state.clone()),
            false => self.motion.beside(&way.state, time, part),
        };
        let defined = |state: Numbers| self.motion.defined(&state, time + part).map(|()| state);
        match made.and_then(defined) {
            Ok(state) => way.kept.push(state),
            Err(error) => way.stopped = Some((step + u64::from(part != 0.0), error.to_string())),
        }
    }

    /// Stops a trajectory whose end, after `steps` steps, is no state in which everything is defined, as runs do.
    pub(super) fn end(&self, way: &mut Way, steps: u64) {
        let time = self.motion.grid().time(steps);
        if let (None, Err(error)) = (&way.stopped, self.motion.defined(&way.state, time)) {
            way.stopped = Some((steps, error.to_string()));
        }
    }

    /// Moves a trajectory, whose next step was refused elsewhere, from step `made` to step `end`, with the bits that
    /// [`march`](Self::march) gives it: to the end of its stretch alone, then in lanes.
    fn redo(&self, way: &mut Way, made: u64, end: u64) {
        let mut done = end.min(made - made % STRETCH + STRETCH);
        self.look(std::slice::from_mut(way));
        self.alone(way, made, done);
        self.look(std::slice::from_mut(way));
        while done < end && way.stopped.is_none() {
            let next = end.min(done + STRETCH);
            self.abreast(std::slice::from_mut(way), done, next);
            done = next;
        }
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
        steps: u64,
        told: &dyn Fn(u64),
    ) -> Result<u64, DeviceError> {
        let single = card.precision == Precision::Single;
        let settle = |own: &mut Numbers| {
            if single {
                own.g = self.motion.space().settled(&own.g);
            }
        };
        let row = |way: &mut Way| {
            let Numbers { g, mu } = &mut way.state;
            Row { g: take(g), mu: take(mu), ..Row::default() }
        };
        let mut rows: Vec<Row> = ways.iter_mut().map(row).collect();
        let mut redone = BTreeSet::new();
        let mut others = |refused: &mut [Refused<'_>], target: u64| {
            let redo = |Refused { place, row, .. }: &mut Refused<'_>| {
                let mut way = Way::from(Numbers { g: take(&mut row.g), mu: take(&mut row.mu) });
                settle(&mut way.state);
                self.redo(&mut way, row.made, target);
                (row.g, row.mu) = (take(&mut way.state.g), take(&mut way.state.mu));
                row.ended = way.stopped.is_some();
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
        ways.par_iter_mut().zip(rows).for_each(|(way, row)| {
            way.state = Numbers { g: row.g, mu: row.mu };
            settle(&mut way.state);
        });
        ways.par_chunks_mut(WIDTH).for_each(|ways| self.look(ways));
        Ok(redone.len() as u64)
    }
}
