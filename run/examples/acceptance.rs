//! `cargo run --release -p coadjoint-run --example acceptance -- 100000 [seed]`
//!
//! Random single steps on twelve groups at K = 1, 3, 5, 7 with h|Ω| up to 3, made as the command makes them, and compared
//! with the exact flow: how far accepted steps are off, and whether a warning says so. Ends with 1 where a bar of
//! `docs/measurements/acceptance.md` is missed.

use std::process::ExitCode;
use std::sync::Arc;

use coadjoint_codegen::lie::catalogue;
use coadjoint_codegen::step::Energy;
use coadjoint_codegen::system::Options;
use coadjoint_run::simulate::Single;
use coadjoint_run::{Backend, Derived, STEEP, read_varying};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// The groups, how many Hamiltonians there are for each K, and whether |μ| of each factor is conserved.
const GROUPS: [(&str, usize, bool); 12] = [
    ("SO3", 40, true),
    ("SU2", 20, true),
    ("U2", 20, true),
    ("SO4", 12, true),
    ("SU3", 3, true),
    ("SO3^4", 12, true),
    ("SL2", 40, false),
    ("SL2*SO3", 12, false),
    ("SE2", 20, false),
    ("SE3", 6, false),
    ("Heisenberg", 20, false),
    ("Aff1", 20, false),
];
const TRUNCATIONS: [usize; 4] = [1, 3, 5, 7];
/// The longest step, h|Ω|.
const LONGEST: f64 = 3.0;
/// An accepted step is at most this far off, and at most [`WARNED`] without a warning.
const OFF: f64 = 0.2;
const WARNED: f64 = 0.05;
/// Steps on SO(3) with K ≥ 5 and h|μ|/I below this, I the least moment of inertia, are never refused.
const PROMISED: f64 = 1.5;
/// Steps of the exact flow, by Runge and Kutta's method of order 4.
const FINE: usize = 400;

/// Results for one group and truncation.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    rows: usize,
    accepted: usize,
    warned: usize,
    /// The largest error of an accepted step, and of one without a warning.
    worst: f64,
    worst_unwarned: f64,
    /// Accepted steps that are further off than a bar allows.
    off: usize,
    unwarned: usize,
    /// Steps that must be accepted, and those refused.
    promised: usize,
    refused: usize,
}

impl Tally {
    fn add(self, other: Self) -> Self {
        Self {
            rows: self.rows + other.rows,
            accepted: self.accepted + other.accepted,
            warned: self.warned + other.warned,
            worst: self.worst.max(other.worst),
            worst_unwarned: self.worst_unwarned.max(other.worst_unwarned),
            off: self.off + other.off,
            unwarned: self.unwarned + other.unwarned,
            promised: self.promised + other.promised,
            refused: self.refused + other.refused,
        }
    }
}

/// A Hamiltonian as text, and the least moment of inertia of a body.
fn hamiltonian(group: &str, dim: usize, random: &mut ChaCha8Rng) -> (String, Option<f64>) {
    let mut terms = Vec::new();
    let mut least = None;
    match group {
        "SO3" | "SO3^4" | "SU2" => {
            // Bodies that obey the triangle inequality, with ratios of inertia to 10.
            for body in 0..dim / 3 {
                let inertia = loop {
                    let [a, b, c] = [(); 3].map(|()| random.random_range(0.01..1.0));
                    let all = [b + c, a + c, a + b];
                    let (low, high) = all
                        .iter()
                        .fold((f64::MAX, 0.0_f64), |(low, high), &i| (low.min(i), high.max(i)));
                    if high <= 10.0 * low {
                        least = Some(low);
                        break all;
                    }
                };
                terms
                    .extend((0..3).map(|i| format!("mu[{}]^2/{}", 3 * body + i, 2.0 * inertia[i])));
            }
        }
        // A heavy top as often as a body in a fluid.
        "SE3" if random.random_bool(0.5) => {
            terms.extend((0..3).map(|i| format!("mu[{i}]^2*{}", random.random_range(0.1..1.0))));
            terms.push(format!("mu[5]*{}", random.random_range(0.1..1.0)));
        }
        _ => {
            terms.extend((0..dim).map(|i| format!("mu[{i}]^2*{}", random.random_range(0.1..1.0))));
            let (i, j) = (random.random_range(0..dim), random.random_range(0..dim));
            terms.push(format!("mu[{i}]*mu[{j}]*{}", random.random_range(-0.1..0.1)));
        }
    }
    (terms.join(" + "), least)
}

/// The exact flow, and what is compared with it.
struct Truth<'a> {
    /// ∂H/∂μ.
    velocity: &'a dyn Fn(&[f64]) -> Vec<f64>,
    structure: Vec<(usize, usize, usize, f64)>,
    /// The factor of each coordinate.
    factors: Vec<u32>,
    compact: bool,
}

impl Truth<'_> {
    fn speed(&self, mu: &[f64]) -> f64 {
        (self.velocity)(mu).into_iter().fold(0.0, f64::hypot)
    }

    /// ad\*_{∂H/∂μ} μ
    fn field(&self, mu: &[f64]) -> Vec<f64> {
        let omega = (self.velocity)(mu);
        let mut field = vec![0.0; mu.len()];
        for &(i, j, k, c) in &self.structure {
            field[j] += omega[i] * c * mu[k];
        }
        field
    }

    /// μ after a unit of time.
    fn flow(&self, start: &[f64]) -> Vec<f64> {
        let h = 1.0 / FINE as f64;
        let mut mu = start.to_vec();
        for _ in 0..FINE {
            let moved = |by: f64, k: &[f64]| -> Vec<f64> {
                mu.iter().zip(k).map(|(mu, k)| mu + by * h * k).collect()
            };
            let a = self.field(&mu);
            let b = self.field(&moved(0.5, &a));
            let c = self.field(&moved(0.5, &b));
            let d = self.field(&moved(1.0, &c));
            for i in 0..mu.len() {
                mu[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
            }
        }
        mu
    }

    /// The largest error of a factor: relative to |μ| of the factor, which on a group that is not compact is the larger of
    /// those before and after the step.
    fn error(&self, start: &[f64], found: &[f64]) -> f64 {
        let exact = self.flow(start);
        let count = self.factors.last().map_or(0, |last| last + 1);
        let length = |factor: u32, of: &dyn Fn(usize) -> f64| {
            let own = (0..start.len()).filter(|&i| self.factors[i] == factor);
            own.map(of).fold(0.0, f64::hypot)
        };
        let relative = |factor| {
            let off = length(factor, &|i| found[i] - exact[i]);
            let before = length(factor, &|i| start[i]);
            let after = if self.compact { 0.0 } else { length(factor, &|i| exact[i]) };
            off / before.max(after)
        };
        (0..count).map(relative).fold(0.0, f64::max)
    }
}

/// A momentum whose step of unit time has h|Ω| up to [`LONGEST`] in the fastest factor; now and then along an axis.
fn momentum(truth: &Truth<'_>, random: &mut ChaCha8Rng) -> Vec<f64> {
    let dim = truth.factors.len();
    let mut mu: Vec<f64> = (0..dim).map(|_| random.random_range(-1.0..1.0)).collect();
    if random.random_bool(0.2) {
        let axis = random.random_range(0..dim);
        let small = 10_f64.powf(random.random_range(-4.0..-0.5));
        (0..dim).filter(|&i| i != axis).for_each(|i| mu[i] *= small);
    }
    // All factors but one are slow, half of the time.
    if random.random_bool(0.5) {
        let fast = truth.factors[random.random_range(0..dim)];
        (0..dim).filter(|&i| truth.factors[i] != fast).for_each(|i| mu[i] *= 0.1);
    }
    let turn = random.random_range(0.0..LONGEST);
    // |Ω| grows with |μ|.
    let (mut low, mut high) = (0.0, 1e3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let scaled: Vec<f64> = mu.iter().map(|mu| middle * mu).collect();
        if truth.speed(&scaled) < turn { low = middle } else { high = middle }
    }
    mu.iter_mut().for_each(|mu| *mu *= low);
    mu
}

type Made = Result<Tally, String>;

/// The rows of one Hamiltonian.
fn rows(name: &str, compact: bool, truncation: usize, rows: usize, seed: u64) -> Made {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let said = |error: &dyn std::fmt::Display| format!("{name}, K = {truncation}: {error}");
    let algebra = catalogue::lookup(name).map_err(|error| said(&error))?;
    let dim = algebra.dim();
    let (energy, least) = hamiltonian(name, dim, &mut random);
    let text = format!(
        "group = \"{name}\"\nhamiltonian = \"{energy}\"\n[integrator]\ntruncation = {truncation}\n"
    );
    let system = read_varying(name, &text, Options::default(), &[]);
    let system = system.map_err(|error| said(&error))?;
    let problem = system.problem.clone();
    let energy_of = Energy::new(&problem);
    let derived = Arc::new(Derived::of(system).map_err(|error| said(&error))?);
    let (structure, factors) = (algebra.constants(), algebra.factor_of_coordinates());
    let truth = Truth { velocity: &|mu| energy_of.gradient(0.0, mu), structure, factors, compact };
    let step = Single::new(derived, 1.0, Backend::Interpreter, 1.0);
    let step = step.map_err(|error| said(&error))?;
    let size = step.matrix_size();
    let identity = (0..size * size).map(|at| f64::from(u8::from(at / size == at % size)));
    let identity: Vec<f64> = identity.collect();
    let mut tally = Tally::default();
    for _ in 0..rows {
        let mu = momentum(&truth, &mut random);
        let length = mu.iter().copied().fold(0.0, f64::hypot);
        let promised =
            name == "SO3" && truncation >= 5 && least.is_some_and(|i| length / i < PROMISED);
        let mut end = mu.clone();
        let made = step.advance(&mut identity.clone(), &mut end, 0.0, [0, 1], None).is_ok();
        tally.rows += 1;
        tally.promised += usize::from(promised);
        tally.refused += usize::from(promised && !made);
        if !made {
            continue;
        }
        let error = truth.error(&mu, &end);
        let warned = step.ratio(&mu) > STEEP;
        tally.accepted += 1;
        tally.warned += usize::from(warned);
        tally.worst = tally.worst.max(error);
        tally.off += usize::from(error.is_nan() || error > OFF);
        if !warned {
            tally.worst_unwarned = tally.worst_unwarned.max(error);
            tally.unwarned += usize::from(error.is_nan() || error > WARNED);
        }
        if error.is_nan() || error > if warned { OFF } else { WARNED } {
            eprintln!(
                "{name}, K = {truncation}: {error:.3} off, warned: {warned}, H = {energy}, μ = {mu:?}"
            );
        }
    }
    Ok(tally)
}

fn table(count: usize, seed: u64) -> Result<bool, String> {
    let mut tasks = Vec::new();
    for (name, models, compact) in GROUPS {
        for truncation in TRUNCATIONS {
            for model in 0..models {
                let own = count / (GROUPS.len() * TRUNCATIONS.len() * models);
                let seed = seed.wrapping_mul(1_000_003).wrapping_add(tasks.len() as u64);
                tasks.push((name, compact, truncation, own + usize::from(model == 0), seed));
            }
        }
    }
    let found: Result<Vec<_>, String> = tasks
        .par_iter()
        .map(|&(name, compact, truncation, count, seed)| {
            Ok((name, truncation, rows(name, compact, truncation, count, seed)?))
        })
        .collect();
    let found = found?;
    println!("| group | K | rows | accepted | warned of | largest error | without a warning |");
    println!("|---|---|---|---|---|---|---|");
    let mut whole = Tally::default();
    for (name, _, _) in GROUPS {
        for truncation in TRUNCATIONS {
            let own = found.iter().filter(|row| (row.0, row.1) == (name, truncation));
            let own = own.fold(Tally::default(), |sum, row| sum.add(row.2));
            whole = whole.add(own);
            let percent = |part: usize| 100.0 * part as f64 / own.rows.max(1) as f64;
            println!(
                "| {name} | {truncation} | {} | {:.1} % | {:.1} % | {:.1} % | {:.1} % |",
                own.rows,
                percent(own.accepted),
                percent(own.warned),
                100.0 * own.worst,
                100.0 * own.worst_unwarned
            );
        }
    }
    println!(
        "\n{} rows: {} accepted steps more than 20 % off, {} more than 5 % without a warning; {} of {} promised steps \
         refused",
        whole.rows, whole.off, whole.unwarned, whole.refused, whole.promised
    );
    Ok(whole.off + whole.unwarned + whole.refused == 0)
}

fn main() -> ExitCode {
    let number = |at: usize, default: u64| {
        std::env::args().nth(at).and_then(|text| text.parse().ok()).unwrap_or(default)
    };
    match table(number(1, 10_000) as usize, number(2, 1)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
