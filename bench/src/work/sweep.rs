//! Which settings of which methods are worth timing, and their times.

use std::hint::black_box;
use std::time::{Duration, Instant};

use super::method::{Competitor, equal_steps};
use super::problem::Problem;
use crate::timing::median;

/// A setting of a method with the error it reaches and its cost.
#[derive(Clone, Debug)]
pub struct Measurement {
    pub method: String,
    pub error: f64,
    /// Nanoseconds of one core per unit of the problem's time: the median over the rounds.
    pub nanoseconds: f64,
}

/// Runs more for the rough time of a setting.
const ROUGH: usize = 6;
/// Settings timed for each error: on a restless machine rough times do not tell which is the cheapest.
const CHEAPEST: usize = 4;

/// A setting with a rough time.
pub struct Setting {
    pub method: usize,
    pub setting: f64,
    pub error: f64,
    /// The least time of some runs.
    pub rough: Duration,
}

/// For each method its settings that are cheapest at some error, timed together.
pub fn measure(problem: &Problem, methods: &[Competitor], quick: bool) -> Vec<Measurement> {
    let longest = Duration::from_millis(if quick { 40 } else { 120 });
    let candidates: Vec<Setting> = methods
        .iter()
        .enumerate()
        .flat_map(|(at, method)| worth_timing(try_settings(problem, method, at, longest)))
        .collect();
    let (rounds, sample) = if quick { (5, 0.0005) } else { (31, 0.002) };
    let mut samples = vec![Vec::with_capacity(rounds); candidates.len()];
    for _ in 0..rounds {
        for (candidate, times) in candidates.iter().zip(&mut samples) {
            let repeats = (sample / candidate.rough.as_secs_f64().max(1e-9)).ceil().max(1.0);
            let begun = Instant::now();
            for _ in 0..repeats as u64 {
                let method = &methods[candidate.method];
                let _ = black_box(method.run(black_box(problem), candidate.setting).is_ok());
            }
            times.push(begun.elapsed().as_secs_f64() / repeats);
        }
    }
    let measured = candidates.iter().zip(samples).map(|(candidate, times)| Measurement {
        method: methods[candidate.method].name.clone(),
        error: candidate.error,
        nanoseconds: median(times) * 1e9 / problem.end,
    });
    measured.collect()
}

/// Runs each setting as often as a rough time needs, from coarse to fine until finer brings nothing.
fn try_settings(
    problem: &Problem,
    method: &Competitor,
    at: usize,
    longest: Duration,
) -> Vec<Setting> {
    let mut tried: Vec<Setting> = Vec::new();
    let (mut best, mut since, mut count) = (f64::INFINITY, 0, 0);
    for &setting in &method.settings {
        if method.order.is_some() {
            let steps = equal_steps(setting, problem.end).0;
            // Rounded to whole steps, this is the setting before.
            if steps == std::mem::replace(&mut count, steps) {
                continue;
            }
        }
        let begun = Instant::now();
        let Ok(end) = method.run(problem, setting) else { continue };
        let mut rough = begun.elapsed();
        let error = end.error(&problem.reference, problem.scale);
        // The least of some: two settings close to each other are not to be told apart by a busy moment.
        for _ in 0..ROUGH {
            let begun = Instant::now();
            let _ = black_box(method.run(problem, setting).is_ok());
            rough = rough.min(begun.elapsed());
        }
        tried.push(Setting { method: at, setting, error, rough });
        if error < 0.8 * best {
            (best, since) = (error, 0);
        } else if error < 1e-6 {
            since += 1;
        }
        if rough > longest || since > 16 {
            break;
        }
    }
    tried
}

/// The cheapest settings at or below each error, two to a decade, without repetition.
pub fn worth_timing(mut tried: Vec<Setting>) -> Vec<Setting> {
    tried.sort_by_key(|candidate| candidate.rough);
    let mut wanted = vec![false; tried.len()];
    for target in (6..=27).map(|k| 10f64.powf(-f64::from(k) / 2.0)) {
        for index in (0..tried.len()).filter(|&i| tried[i].error <= target).take(CHEAPEST) {
            wanted[index] = true;
        }
    }
    let mut keep = wanted.into_iter();
    tried.retain(|_| keep.next().unwrap_or(false));
    tried
}
