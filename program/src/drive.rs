//! The loop of a kernel, by the interpreter: the reference for all targets.

use alloc::vec;
use alloc::vec::Vec;

use crate::kernel::{BLOCK, Kernel};
use crate::number::{Lanes, Number};
use crate::packed::Packed;
use crate::program::Program;
use crate::stepper::{Outcome, Stepper, WIDTH};

/// Memory of the interpreter, reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct Scratch<T> {
    nodes: Vec<T>,
    values: Vec<T>,
}

impl Stepper for Kernel {
    fn advance(&self, slots: &[f64], g: &mut [f64], mu: &mut [f64], steps: u64) -> Outcome {
        let mut memory = Memory::<f64>::new(self, slots, g, mu);
        let mut outcome = Outcome::default();
        while outcome.steps < steps {
            let length = BLOCK.min(steps - outcome.steps);
            let [made] = crate::dispatch::block(self, &mut memory, length, [true], &mut outcome);
            outcome.steps += made;
            if made < length {
                break;
            }
        }
        memory.store(g, mu);
        outcome
    }

    fn advance_lanes(
        &self,
        slots: &[f64],
        g: &mut [f64],
        mu: &mut [f64],
        steps: u64,
        live: [bool; WIDTH],
    ) -> [u64; WIDTH] {
        let mut memory = Memory::<Lanes<WIDTH>>::new(self, slots, g, mu);
        let mut outcome = Outcome::default();
        let mut live = live;
        let mut made = [0; WIDTH];
        let mut done = 0;
        while done < steps && live.contains(&true) {
            let length = BLOCK.min(steps - done);
            let block = crate::dispatch::block(self, &mut memory, length, live, &mut outcome);
            for lane in 0..WIDTH {
                made[lane] += block[lane];
                live[lane] &= block[lane] == length;
            }
            done += length;
        }
        memory.store(g, mu);
        made
    }
}

impl Kernel {
    /// The increment x of the step from μ, by the interpreter; `None` where the step is refused.
    #[must_use]
    pub fn increment(&self, slots: &[f64], mu: &[f64]) -> Option<Vec<f64>> {
        let n = self.dim();
        let mut memory = Memory::<f64>::new(self, slots, &[], mu);
        let Memory { slots, state, solve, found, scratch, .. } = &mut memory;
        let mu = &state[self.element()..];
        solve_step(self, slots, mu, solve, found, [true], scratch, &mut Outcome::default());
        let input = |i: usize| if i < n { mu[i] } else { found[i - n] };
        let accepted = call(&self.programs().accept, input, slots, scratch)[0];
        found.truncate(n);
        (accepted == 1.0).then(|| core::mem::take(found))
    }

    /// The numbers of `watch` at a state.
    pub fn watch(
        &self,
        slots: &[f64],
        g: &[f64],
        mu: &[f64],
        scratch: &mut Scratch<f64>,
        out: &mut [f64],
    ) {
        let m = self.element();
        let read = |i: usize| {
            let found = if i < m { g.get(i) } else { mu.get(i - m) };
            found.copied().unwrap_or(0.0)
        };
        let slot = |i: usize| slots.get(i).copied().unwrap_or(0.0);
        let program = &self.programs().watch;
        program.evaluate(read, slot, &mut scratch.nodes);
        for (value, id) in out.iter_mut().zip(program.outputs()) {
            *value = scratch.nodes[id.index()];
        }
    }
}

/// A state and what its steps need.
pub(crate) struct Memory<T> {
    slots: Vec<T>,
    /// g, then μ.
    state: Vec<T>,
    start: Vec<T>,
    /// p, μ, the constants of the solve.
    solve: Vec<T>,
    /// x, what is left, the way.
    found: Vec<T>,
    scratch: Scratch<T>,
}

impl<T: Number> Memory<T> {
    fn new<const L: usize>(kernel: &Kernel, slots: &[f64], g: &[f64], mu: &[f64]) -> Self
    where
        T: Packed<L>,
    {
        let (n, m) = (kernel.dim(), kernel.element());
        let zero = T::of(0.0);
        let entry = |i: usize| if i < m { T::load(g, i) } else { T::load(mu, i - m) };
        let slot = |i: usize| T::of(slots.get(i).copied().unwrap_or(0.0));
        Self {
            slots: (0..kernel.slots()).map(slot).collect(),
            state: (0..m + n).map(entry).collect(),
            start: vec![zero; m + n],
            solve: vec![zero; n + n + kernel.constants()],
            found: vec![zero; n + 2],
            scratch: Scratch { nodes: Vec::new(), values: Vec::new() },
        }
    }

    fn store<const L: usize>(&self, g: &mut [f64], mu: &mut [f64])
    where
        T: Packed<L>,
    {
        let m = self.state.len() - self.solve_dim();
        for (i, value) in self.state.iter().enumerate() {
            match i < m {
                true => value.store(g, i),
                false => value.store(mu, i - m),
            }
        }
    }

    /// n: x has as many coordinates.
    fn solve_dim(&self) -> usize {
        self.found.len() - 2
    }
}

/// Evaluates a program on inputs given by number; its results are in `values` of the scratch.
#[inline(always)]
fn call<'s, T: Number>(
    program: &Program,
    input: impl Fn(usize) -> T,
    slots: &[T],
    scratch: &'s mut Scratch<T>,
) -> &'s [T] {
    program.evaluate(input, |i| slots[i], &mut scratch.nodes);
    let Scratch { nodes, values } = scratch;
    values.clear();
    values.extend(program.outputs().iter().map(|id| nodes[id.index()]));
    values
}

/// Up to `length` steps of the lanes that are live, then the frame and the check; the steps each lane made.
#[inline(always)]
pub(crate) fn block<T: Packed<L>, const L: usize>(
    kernel: &Kernel,
    memory: &mut Memory<T>,
    length: u64,
    live: [bool; L],
    outcome: &mut Outcome,
) -> [u64; L] {
    let (n, m) = (kernel.dim(), kernel.element());
    let programs = kernel.programs();
    let Memory { slots, state, start, solve, found, scratch } = memory;
    start.copy_from_slice(state);
    let begun = live;
    let mut live = live;
    let mut made = [0; L];
    for _ in 0..length {
        solve_step(kernel, slots, &state[m..], solve, found, live, scratch, outcome);
        let accepted = call(
            &programs.accept,
            |i| if i < n { state[m + i] } else { found[i - n] },
            slots,
            scratch,
        )[0];
        for lane in 0..L {
            live[lane] &= accepted.lane(lane) == 1.0;
            made[lane] += u64::from(live[lane]);
        }
        if !live.contains(&true) {
            break;
        }
        let input = |i: usize| if i < m + n { state[i] } else { found[i - m - n] };
        let moved = call(&programs.transport, input, slots, scratch);
        for (old, &new) in state.iter_mut().zip(moved) {
            *old = old.update(live, new);
        }
    }
    let stirred: [bool; L] = core::array::from_fn(|lane| made[lane] > 0);
    if let Some(frame) = &programs.frame {
        let mut times = T::of(0.0);
        for lane in 0..L {
            let only = core::array::from_fn(|other| other == lane);
            times = times.update(only, T::of(made[lane] as f64));
        }
        let input = |i: usize| if i < m + n { state[i] } else { times };
        let moved = call(frame, input, slots, scratch);
        for (old, &new) in state.iter_mut().zip(moved) {
            *old = old.update(stirred, new);
        }
    }
    let sound = call(&programs.sound, |i| state[i], slots, scratch)[0];
    let broken: [bool; L] =
        core::array::from_fn(|lane| begun[lane] && stirred[lane] && sound.lane(lane) != 1.0);
    if broken.contains(&true) {
        for (now, &before) in state.iter_mut().zip(start.iter()) {
            *now = now.update(broken, before);
        }
        for lane in 0..L {
            if broken[lane] {
                made[lane] = 0;
            }
        }
    }
    made
}

/// Solves the equation of a step in the lanes that are live: x, what is left, and the way go to `found`.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn solve_step<T: Packed<L>, const L: usize>(
    kernel: &Kernel,
    slots: &[T],
    mu: &[T],
    solve: &mut [T],
    found: &mut [T],
    live: [bool; L],
    scratch: &mut Scratch<T>,
    outcome: &mut Outcome,
) {
    let n = kernel.dim();
    let programs = kernel.programs();
    let guess = call(&programs.guess, |i| mu[i], slots, scratch);
    solve[..n].copy_from_slice(&guess[..n]);
    solve[n..2 * n].copy_from_slice(&mu[..n]);
    solve[2 * n..].copy_from_slice(&guess[n..]);
    found[n] = T::of(1.0);
    found[n + 1] = T::of(0.0);
    let mut open = live;
    for iteration in 1..=kernel.corrections() {
        let corrected = call(&programs.correct, |i| solve[i], slots, scratch);
        for i in 0..n {
            solve[i] = solve[i].update(open, corrected[i]);
            found[i] = found[i].update(open, corrected[n + i]);
        }
        found[n] = found[n].update(open, corrected[2 * n]);
        found[n + 1] = found[n + 1].update(open, found[n + 1].add(corrected[2 * n + 1]));
        outcome.corrections = outcome.corrections.max(iteration);
        for lane in 0..L {
            let left = found[n].lane(lane);
            let solved = left <= kernel.tolerance();
            let near = found[n + 1].lane(lane) <= kernel.near();
            if open[lane] && solved && outcome.residual < left {
                outcome.residual = left;
            }
            open[lane] &= !solved && near;
        }
        if !open.contains(&true) {
            break;
        }
    }
}
