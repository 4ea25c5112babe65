//! A run: our steps and the rival's side by side, how far each has drifted, and why a step was refused.

use coadjoint_codegen::step::{Observation, Seen, Start};
use coadjoint_program::{Attempt, Program, Stepper};

use crate::history::{History, Sample};
use crate::system::{START, System};

/// Moments of the trail behind a momentum.
const TRAIL: usize = 1200;
/// Points between two steps, so that trails and pictures are smooth.
const SMOOTH: usize = 4;

/// (g, μ) and μ̇.
#[derive(Clone, Debug, Default)]
struct Knot {
    g: Vec<f64>,
    mu: Vec<f64>,
    rate: Vec<f64>,
}

/// A run from the identity.
#[derive(Debug)]
pub struct Animation {
    h: f64,
    /// The rival's steps within one of ours.
    pub substeps: usize,
    pub steps: u64,
    before: Knot,
    now: Knot,
    rival: Vec<f64>,
    rival_rate: Vec<f64>,
    /// μ and μ̇ after each step, ours and the rival's.
    trail: [Vec<f64>; 2],
    start: Start,
    observation: Observation,
    pub history: History,
    /// The refusal of the next step.
    pub refusal: Option<Refusal>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    pub reason: Reason,
    /// A shorter step that can be made.
    pub usable: Option<f64>,
}

impl Animation {
    /// A run from the identity with this momentum.
    pub fn new(system: &System, momentum: &[f64]) -> Self {
        let size: usize = system.factors.iter().map(|factor| factor.size).sum();
        let identity: Vec<f64> =
            (0..size * size).map(|at| f64::from(u8::from(at / size == at % size))).collect();
        let g = system.step.element_of(&identity);
        let rate = system.rival.rate(START, momentum);
        let now = Knot { g, mu: momentum.to_vec(), rate: rate.clone() };
        let seen = Seen { spatial: momentum, matrix: &[], momentum };
        let start = system.invariants.start(START, seen);
        let mut run = Self {
            h: system.h,
            substeps: 1,
            steps: 0,
            before: now.clone(),
            now,
            rival: system.rival.start(momentum),
            rival_rate: rate,
            trail: [Vec::new(), Vec::new()],
            start,
            observation: Observation::new(&system.step),
            history: History::default(),
            refusal: None,
        };
        run.substeps = substeps(system, &run.now);
        run.leave_trail();
        run.record(system);
        run
    }

    /// Makes up to `count` steps; returns how many were made.
    pub fn advance(&mut self, system: &System, count: u32) -> u32 {
        let mut slots = system.slots.clone();
        for made in 0..count {
            if self.refusal.is_some() {
                return made;
            }
            let (mut next, time) = (self.now.clone(), self.time());
            system.step.set_time(&mut slots, self.h, time);
            if !system.advance(&slots, &mut next.g, &mut next.mu) {
                let reason = Reason::of(system, &slots, time, &self.now.mu);
                let usable = usable(system, time, &self.now.g, &self.now.mu);
                self.refusal = Some(Refusal { reason, usable });
                return made;
            }
            self.steps += 1;
            next.rate = system.rival.rate(self.time(), &next.mu);
            self.before = std::mem::replace(&mut self.now, next);
            let h = self.h / self.substeps as f64;
            for number in 0..self.substeps {
                self.rival = system.rival.advance(&self.rival, time + number as f64 * h, h);
            }
            self.rival_rate = system.rival.rate(self.time(), &self.rival[..system.dim()]);
            self.leave_trail();
            self.record(system);
        }
        count
    }

    /// t after the last step.
    pub fn time(&self) -> f64 {
        START + self.steps as f64 * self.h
    }

    pub fn momentum(&self) -> &[f64] {
        &self.now.mu
    }

    pub fn energy(&self, system: &System) -> f64 {
        system.energy().value(self.time(), &self.now.mu)
    }

    /// μ a part of the way from the last state but one to the last. Only for pictures.
    pub fn between(&self, part: f64) -> Vec<f64> {
        let (a, b) = (&self.before, &self.now);
        let end = |of: &Knot, i: usize| (of.mu[i], of.rate[i] * self.h);
        (0..a.mu.len()).map(|i| hermite(end(a, i), end(b, i), part)).collect()
    }

    /// The matrices of the last state but one and of the last, row by row, one after the other.
    pub fn matrices(&self, system: &System) -> Vec<f64> {
        let program = &system.step.kernel().programs.matrix;
        [&self.before, &self.now].into_iter().flat_map(|state| program.run(&state.g, &[])).collect()
    }

    /// The recent trail of three coordinates of μ, as points (x, y, z), smoothed between steps.
    pub fn trail(&self, of_rival: bool, axes: [usize; 3], part: f64) -> Vec<f32> {
        let n = self.now.mu.len();
        let trail = &self.trail[usize::from(of_rival)];
        let moments: Vec<&[f64]> = trail.chunks_exact(2 * n).collect();
        let end = |of: &[f64], axis: usize| match axis < n {
            true => (of[axis], of[n + axis] * self.h),
            false => (0.0, 0.0),
        };
        let mut points = Vec::with_capacity(3 * SMOOTH * moments.len());
        for (number, pair) in moments.windows(2).enumerate() {
            let until = if number + 2 == moments.len() { part } else { 1.0 };
            for s in 0..SMOOTH {
                let s = s as f64 / SMOOTH as f64 * until;
                for axis in axes {
                    points.push(hermite(end(pair[0], axis), end(pair[1], axis), s) as f32);
                }
            }
        }
        if let [.., a, b] = &moments[..] {
            for axis in axes {
                points.push(hermite(end(a, axis), end(b, axis), part) as f32);
            }
        }
        points
    }

    fn leave_trail(&mut self) {
        let n = self.now.mu.len();
        let ours = self.now.mu.iter().chain(&self.now.rate);
        self.trail[0].extend(ours);
        self.trail[1].extend(self.rival[..n].iter().chain(&self.rival_rate));
        for trail in &mut self.trail {
            // Cut now and then, half of it.
            if trail.len() > 4 * n * TRAIL {
                trail.drain(..2 * n * TRAIL);
            }
        }
    }

    fn record(&mut self, system: &System) {
        let n = self.now.mu.len();
        let ours = self.drift(system, &self.now.mu, &self.our_spatial());
        let rival = self.drift(system, &self.rival[..n], &system.rival.spatial(&self.rival));
        self.history.push(Sample { time: self.time(), drifts: [ours, rival] });
    }

    /// The drifts of energy, spatial momentum and Casimirs; NaN if there is none.
    fn drift(&self, system: &System, mu: &[f64], spatial: &[f64]) -> [f64; 3] {
        let seen = Seen { spatial, matrix: &[], momentum: mu };
        let conserved = system.invariants.conserved(self.time(), &[seen]);
        let [momentum, casimirs, energy] = self.start.drift(&conserved).numbers();
        [energy, momentum, casimirs]
    }

    fn our_spatial(&self) -> Vec<f64> {
        let Knot { g, mu, .. } = &self.now;
        self.observation.spatial_momentum(g, mu)
    }
}

/// The number of the rival's steps that cost as much as one of ours, rounded up.
fn substeps(system: &System, start: &Knot) -> usize {
    let kernel = system.step.kernel();
    let programs = &kernel.programs;
    let (Knot { mut g, mut mu, .. }, mut slots) = (start.clone(), system.slots.clone());
    let (mut steps, mut corrections) = (0_u64, 0_u64);
    while steps < 16 {
        system.step.set_time(&mut slots, system.h, START + steps as f64 * system.h);
        let outcome = kernel.advance(&slots, &mut g, &mut mu, 1);
        if outcome.steps == 0 {
            break;
        }
        (steps, corrections) = (steps + 1, corrections + u64::from(outcome.corrections));
    }
    let corrections = if steps == 0 { 1.0 } else { corrections as f64 / steps as f64 };
    let cost = |program: &Program| program.cost().total() as f64;
    let rest =
        [&programs.guess, &programs.accept, &programs.transport].map(cost).iter().sum::<f64>();
    let ours = rest + corrections * cost(&programs.correct);
    (ours / system.rival.cost().max(1) as f64).ceil().max(1.0) as usize
}

/// The cubic with these values and slopes at 0 and 1.
fn hermite((a, slope_a): (f64, f64), (b, slope_b): (f64, f64), s: f64) -> f64 {
    let (t, u) = (1.0 - s, s);
    a * t * t * (1.0 + 2.0 * u) + b * u * u * (1.0 + 2.0 * t) + slope_a * u * t * t
        - slope_b * u * u * t
}

/// Places ahead at which a refused step asks for H.
const AHEAD: u32 = 16;
/// Halves of a refused step that are tried.
const MOST_HALVINGS: u32 = 20;

/// Reasons for which the kernel refuses the next step from (g, μ), as `emit --language c` tells them apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    NotFinite,
    /// |μ| is beyond the radius up to which the truncated series means something.
    BeyondSeries,
    /// The equation of the step was not solved to rounding near the first guess.
    NotSolved,
    BeyondChart,
    /// Ahead the Hamiltonian is not defined, as this text says.
    Undefined(String),
    /// The nodes of collocation do not resolve the step.
    NotResolved,
    OffGroup,
}

impl Reason {
    fn of(system: &System, slots: &[f64], time: f64, mu: &[f64]) -> Self {
        if !mu.iter().all(|entry| entry.is_finite()) {
            return Self::NotFinite;
        }
        let square: f64 = mu.iter().map(|entry| entry * entry).sum();
        let (kernel, series) = (system.step.kernel(), system.series().is_some());
        let limit = slots.get(system.step.radius_at());
        if series && !limit.is_some_and(|&limit| square <= limit) {
            return Self::BeyondSeries;
        }
        let Attempt { residual_bound, distance, accepted, .. } = kernel.attempt(slots, mu);
        if !(residual_bound <= kernel.tolerance && distance <= kernel.near) {
            // On the way that the momentum would take at its rate.
            let rate = system.rival.rate(time, mu);
            let ahead = (0..=AHEAD).find_map(|part| {
                let later = system.h * f64::from(part) / f64::from(AHEAD);
                let mu: Vec<f64> =
                    mu.iter().zip(&rate).map(|(mu, rate)| mu + later * rate).collect();
                system.undefined(time + later, &mu)
            });
            return ahead.map_or(Self::NotSolved, Self::Undefined);
        }
        match (accepted, series) {
            (true, _) => Self::OffGroup,
            (false, true) => Self::BeyondChart,
            (false, false) => Self::NotResolved,
        }
    }

    pub fn text(&self) -> &str {
        match self {
            Self::Undefined(text) => text,
            Self::NotResolved => {
                "not resolved: velocity or force change too much within the step for its nodes, or the body would turn too far"
            }
            Self::NotFinite => "the momentum is no longer a finite number",
            Self::BeyondSeries => {
                "beyond the series: the momentum is so large for this step size that the last terms of S no longer shrink"
            }
            Self::NotSolved => {
                "not solved: the equation of the step has no solution to rounding near the first guess"
            }
            Self::BeyondChart => {
                "beyond the chart: the body would turn farther in one step than the programs accept"
            }
            Self::OffGroup => "off the group: rounding has carried the group element away",
        }
    }
}

/// The longest of h/2, h/4, … with which the step can be made.
fn usable(system: &System, time: f64, g: &[f64], mu: &[f64]) -> Option<f64> {
    let mut shorter = system.h;
    (0..MOST_HALVINGS).find_map(|_| {
        shorter *= 0.5;
        let (mut slots, mut g) = (system.step.fold(shorter, &[]).unwrap_or_default(), g.to_vec());
        system.step.set_time(&mut slots, shorter, time);
        system.step.forget(&mut g);
        system.advance(&slots, &mut g, &mut mu.to_vec()).then_some(shorter)
    })
}
