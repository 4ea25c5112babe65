//! Interleaved timing: every candidate runs once per round, so that a change of the machine's speed meets all alike.

use std::time::{Duration, Instant};

use crate::{
    method::{Method, RunError, Setting},
    problem::Problem,
};

/// A setting of a method with the error it reaches and its cost.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Measurement {
    /// The method's name.
    pub method: String,
    /// The name under which its kin are drawn.
    pub family: String,
    /// The setting, as text.
    pub setting: String,
    /// The error of the end state in (Π, R).
    pub error: f64,
    /// Nanoseconds of one core per unit of the problem's time: the median over the rounds.
    pub nanoseconds: f64,
}

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Rounds over all candidates.
    pub rounds: usize,
    /// Runs are repeated within a sample until it lasts about this long.
    pub sample: Duration,
    /// A setting slower than this per run is not tried.
    pub longest: Duration,
}

impl Effort {
    /// For figures to be kept.
    #[must_use]
    pub fn full() -> Self {
        Self { rounds: 31, sample: Duration::from_millis(2), longest: Duration::from_millis(120) }
    }

    /// For a look.
    #[must_use]
    pub fn quick() -> Self {
        Self { rounds: 5, sample: Duration::from_micros(500), longest: Duration::from_millis(40) }
    }
}

/// Runs more for the rough time of a setting.
const ROUGH: usize = 6;
/// Settings timed for each target: on a restless machine rough times do not tell which is the cheapest.
const CHEAPEST: usize = 4;

/// A setting worth timing.
struct Candidate<'a> {
    method: &'a dyn Method,
    setting: Setting,
    error: f64,
    rough: Duration,
}

/// Errors below which a candidate is sought, two to a decade.
fn targets() -> impl Iterator<Item = f64> {
    (6..=27).map(|k| 10f64.powf(-f64::from(k) / 2.0))
}

/// For each method, its settings that are cheapest at some error, timed together.
///
/// # Errors
/// When a method refuses a setting it proposed itself for another reason than convergence.
pub fn work_precision(
    problem: &Problem,
    methods: &[Box<dyn Method>],
    effort: &Effort,
) -> Result<Vec<Measurement>, RunError> {
    let mut candidates = Vec::new();
    for method in methods.iter().filter(|method| method.applies(problem)) {
        let tried = try_settings(problem, method.as_ref(), effort)?;
        candidates.extend(worth_timing(tried));
    }
    Ok(time(problem, &candidates, effort))
}

/// Runs each setting as often as a rough time needs, from coarse to fine until finer brings nothing.
fn try_settings<'a>(
    problem: &Problem,
    method: &'a dyn Method,
    effort: &Effort,
) -> Result<Vec<Candidate<'a>>, RunError> {
    let mut tried: Vec<Candidate<'a>> = Vec::new();
    let (mut best, mut since, mut count) = (f64::INFINITY, 0, 0);
    for setting in method.settings(problem) {
        if let Setting::Step(step) = setting {
            let (steps, _) = Setting::steps(step, problem.end);
            // Rounded to whole steps, this is the setting before.
            if steps == std::mem::replace(&mut count, steps) {
                continue;
            }
        }
        let start = Instant::now();
        let end = match method.run(problem, setting) {
            Ok(end) => end,
            Err(RunError::NotConverged | RunError::Foreign(_)) => continue,
            Err(error) => return Err(error),
        };
        let mut rough = start.elapsed();
        let error = end.error(&problem.reference, &problem.scale);
        // The least of some: two settings close to each other are not to be told apart by a busy moment.
        for _ in 0..ROUGH {
            let start = Instant::now();
            std::hint::black_box(method.run(problem, setting).ok());
            rough = rough.min(start.elapsed());
        }
        tried.push(Candidate { method, setting, error, rough });
        if error < 0.8 * best {
            (best, since) = (error, 0);
        } else if error < 1e-6 {
            since += 1;
        }
        if rough > effort.longest || since > 16 {
            break;
        }
    }
    Ok(tried)
}

/// The cheapest settings at or below each target, without repetition.
fn worth_timing(mut tried: Vec<Candidate<'_>>) -> Vec<Candidate<'_>> {
    tried.sort_by_key(|candidate| candidate.rough);
    let mut wanted = vec![false; tried.len()];
    for target in targets() {
        for index in (0..tried.len()).filter(|&i| tried[i].error <= target).take(CHEAPEST) {
            wanted[index] = true;
        }
    }
    let mut keep = wanted.into_iter();
    tried.retain(|_| keep.next().unwrap_or(false));
    tried
}

fn time(problem: &Problem, candidates: &[Candidate<'_>], effort: &Effort) -> Vec<Measurement> {
    let mut samples = vec![Vec::with_capacity(effort.rounds); candidates.len()];
    for _ in 0..effort.rounds {
        for (candidate, times) in candidates.iter().zip(&mut samples) {
            let repeats = (effort.sample.as_secs_f64() / candidate.rough.as_secs_f64().max(1e-9))
                .ceil()
                .max(1.0);
            let start = Instant::now();
            for _ in 0..repeats as u64 {
                std::hint::black_box(
                    candidate.method.run(std::hint::black_box(problem), candidate.setting).ok(),
                );
            }
            times.push(start.elapsed().as_secs_f64() / repeats);
        }
    }
    let measured = candidates.iter().zip(samples).map(|(candidate, times)| Measurement {
        method: candidate.method.name().to_owned(),
        family: candidate.method.family().to_owned(),
        setting: candidate.setting.to_string(),
        error: candidate.error,
        nanoseconds: median(times) * 1e9 / problem.end,
    });
    measured.collect()
}

/// The middle value, of an even number the lower of the two middle ones.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{peers::splitting::Splitting, problem};

    #[test]
    fn the_median_ignores_an_outlier() {
        assert_eq!(median(vec![3.0, 1.0, 1e9, 2.0, 2.5]), 2.5);
        assert_eq!(median(vec![1.0, 2.0]), 1.0);
        assert!(median(Vec::new()).is_nan());
    }

    #[test]
    fn only_settings_that_are_cheapest_somewhere_are_timed() {
        let splitting = Splitting::order2();
        let candidate = |error: f64, micros: u64| Candidate {
            method: &splitting,
            setting: Setting::Step(1.0),
            error,
            rough: Duration::from_micros(micros),
        };
        let tried = vec![
            candidate(1e-4, 10),
            candidate(9e-5, 11),
            candidate(9e-5, 50),
            candidate(1e-9, 60),
            candidate(1e-9, 90),
            candidate(1e-9, 99),
            candidate(1e-9, 120),
            candidate(1e-9, 130),
        ];
        let kept: Vec<u128> = worth_timing(tried).iter().map(|c| c.rough.as_micros()).collect();
        assert_eq!(kept, [10, 11, 50, 60, 90, 99, 120]);
    }

    #[test]
    fn a_measurement_carries_the_error_of_its_run() {
        let mut problem = problem::named("free-body-a").unwrap();
        problem.end = 1.0;
        let methods: Vec<Box<dyn Method>> = vec![Box::new(Splitting::order8())];
        let exact = crate::peers::jacobi::Exact.run(&problem, Setting::Step(1.0)).unwrap();
        problem.reference = exact;
        let effort =
            Effort { rounds: 2, sample: Duration::ZERO, longest: Duration::from_millis(5) };
        let rows = work_precision(&problem, &methods, &effort).unwrap();
        assert!(rows.iter().any(|row| row.error < 1e-10 && row.nanoseconds > 0.0));
    }
}
