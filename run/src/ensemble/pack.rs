//! Trajectories side by side, advanced by the programs of a step.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

use coadjoint::{StepError, StepReport};
use coadjoint_program::WIDTH;
use rayon::prelude::*;

use super::rows::Stopped;
use super::steps::STRETCH;
use crate::engine::{Compiled, Numbers};

/// Makes a step that the programs have refused.
pub type Rescue<'a> = dyn Fn(&mut Numbers) -> Result<StepReport<f64>, StepError> + Sync + 'a;

/// Evaluates the ratio of the last two terms of the series at a momentum.
pub type Ratio<'a> = dyn Fn(&[f64]) -> f64 + Sync + 'a;

/// How steps are made.
pub struct Manner<'a> {
    /// By these programs.
    pub compiled: &'a Compiled,
    /// Makes the steps that they refuse.
    pub rescue: &'a Rescue<'a>,
    /// The ratio checked after each stretch.
    pub ratio: &'a Ratio<'a>,
    /// Where it is set, nothing more is made.
    pub stop: &'a AtomicBool,
}

/// [`WIDTH`] trajectories side by side: number i of trajectory r is at `i * WIDTH + r`.
struct Pack {
    g: Vec<f64>,
    mu: Vec<f64>,
    live: [bool; WIDTH],
    stopped: [Option<(u64, StepError)>; WIDTH],
    /// The largest ratio seen.
    ratio: f64,
}

impl Pack {
    /// Of these states, at most [`WIDTH`]; lanes without one do not move.
    fn new(states: &[Numbers]) -> Self {
        let beside = |of: fn(&Numbers) -> &Vec<f64>| {
            let length = states.first().map_or(0, |state| of(state).len());
            let mut list = vec![0.0; length * WIDTH];
            for (lane, state) in states.iter().enumerate() {
                for (i, value) in of(state).iter().enumerate() {
                    list[i * WIDTH + lane] = *value;
                }
            }
            list
        };
        Self {
            g: beside(|state| &state.g),
            mu: beside(|state| &state.mu),
            live: std::array::from_fn(|lane| lane < states.len()),
            stopped: [const { None }; WIDTH],
            ratio: 0.0,
        }
    }

    /// The state of a lane.
    fn state(&self, lane: usize) -> Numbers {
        let own = |list: &[f64]| list.iter().skip(lane).step_by(WIDTH).copied().collect();
        Numbers { g: own(&self.g), mu: own(&self.mu) }
    }

    fn put(&mut self, lane: usize, state: &Numbers) {
        for (list, own) in [(&mut self.g, &state.g), (&mut self.mu, &state.mu)] {
            for (place, value) in list.iter_mut().skip(lane).step_by(WIDTH).zip(own) {
                *place = *value;
            }
        }
    }

    /// Makes `steps` steps after the first `first`. A lane that cannot go on with the others goes on alone, so that no
    /// trajectory depends on its neighbours.
    fn advance(&mut self, manner: &Manner<'_>, first: u64, steps: u64) {
        let Manner { compiled, rescue, ratio, stop } = manner;
        if stop.load(Ordering::Relaxed) {
            return;
        }
        let made = compiled.advance_lanes(&mut self.g, &mut self.mu, steps, self.live);
        for (lane, &made) in made.iter().enumerate() {
            if !self.live[lane] {
                continue;
            }
            let mut state = self.state(lane);
            if made == steps {
                self.look(ratio(&state.mu));
                continue;
            }
            let outcome = compiled.advance(&mut state, steps - made, rescue);
            self.put(lane, &state);
            if let Err((more, error)) = outcome {
                self.live[lane] = false;
                self.stopped[lane] = Some((first + made + more, error));
            }
            self.look(ratio(&state.mu));
        }
    }

    /// Takes note of a ratio; what is no number is larger than any.
    fn look(&mut self, ratio: f64) {
        if ratio.is_nan() || ratio > self.ratio {
            self.ratio = ratio;
        }
    }
}

/// Moves one state, whose next step was refused elsewhere, from step `made` to step `to`, with the bits that [`march`]
/// gives it: to the end of its stretch alone, then in lanes. The largest ratio, or where and why it stopped.
pub fn redo(
    manner: &Manner<'_>,
    state: &mut Numbers,
    made: u64,
    to: u64,
) -> Result<f64, (u64, StepError)> {
    let rest = (STRETCH - made % STRETCH).min(to - made);
    let outcome = manner.compiled.advance(state, rest, manner.rescue);
    if let Err((more, error)) = outcome {
        return Err((made + more, error));
    }
    let mut pack = Pack::new(std::slice::from_ref(state));
    pack.look((manner.ratio)(&state.mu));
    let mut done = made + rest;
    while done < to && pack.live[0] {
        let length = STRETCH.min(to - done);
        pack.advance(manner, done, length);
        done += length;
    }
    *state = pack.state(0);
    match pack.stopped[0].take() {
        Some(stopped) => Err(stopped),
        None => Ok(pack.ratio),
    }
}

/// Makes `steps` steps of all states, `stretch` of them before the next, each then told to `told`; why those stopped that
/// did, by their places, and the largest ratio of the last two terms of the series after a stretch.
pub fn march(
    manner: &Manner<'_>,
    states: &mut [Numbers],
    (steps, stretch): (u64, u64),
    told: &dyn Fn(u64),
) -> (BTreeMap<usize, Stopped>, f64) {
    let mut packs: Vec<Pack> = states.chunks(WIDTH).map(Pack::new).collect();
    let mut done = 0;
    while done < steps && !manner.stop.load(Ordering::Relaxed) {
        let length = stretch.min(steps - done);
        packs.par_iter_mut().for_each(|pack| pack.advance(manner, done, length));
        done += length;
        told(done);
    }
    let mut failed = BTreeMap::new();
    for (place, state) in states.iter_mut().enumerate() {
        let (pack, lane) = (&packs[place / WIDTH], place % WIDTH);
        *state = pack.state(lane);
        if let Some((step, error)) = pack.stopped[lane] {
            failed.insert(place, Stopped { index: place, step, error });
        }
    }
    let ratio =
        packs.iter().map(|pack| pack.ratio).fold(0.0, |a: f64, b| match b.is_nan() || b > a {
            true => b,
            false => a,
        });
    (failed, ratio)
}
