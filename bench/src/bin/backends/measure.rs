//! Ways of making the same steps, timed in turn.

use std::time::{Duration, Instant};

use coadjoint_bench::measure::median;

use crate::Failure;

/// Rounds over all ways.
const ROUNDS: usize = 31;
/// How long a way runs in a round, about.
const SAMPLE: Duration = Duration::from_millis(4);

/// Something that makes so many steps, and says how long they took.
pub struct Way<'a> {
    /// What the table calls it.
    pub name: &'static str,
    run: Box<dyn FnMut(u64) -> Result<Duration, Failure> + 'a>,
}

impl<'a> Way<'a> {
    /// All that this does for so many steps counts.
    pub fn new(name: &'static str, mut run: impl FnMut(u64) + 'a) -> Self {
        let timed = move |steps| {
            let begun = Instant::now();
            run(steps);
            Ok(begun.elapsed())
        };
        Self { name, run: Box::new(timed) }
    }

    /// This knows itself which part counts.
    pub fn timed(
        name: &'static str,
        run: impl FnMut(u64) -> Result<Duration, Failure> + 'a,
    ) -> Self {
        Self { name, run: Box::new(run) }
    }
}

/// The median nanoseconds of a step of each way: every way runs once per round.
///
/// # Errors
/// What a way could not do.
pub fn measure(ways: &mut [Way<'_>]) -> Result<Vec<f64>, Failure> {
    let counts: Result<Vec<u64>, Failure> = ways.iter_mut().map(steps_of_sample).collect();
    medians(ways, &counts?, ROUNDS)
}

/// How many steps take about as long as a sample.
fn steps_of_sample(way: &mut Way<'_>) -> Result<u64, Failure> {
    let mut count = 64;
    loop {
        let took = (way.run)(count)?;
        if took >= SAMPLE / 4 {
            let each = took.as_secs_f64() / count as f64;
            return Ok((SAMPLE.as_secs_f64() / each) as u64 + 1);
        }
        count *= 2;
    }
}

/// The same with so many steps of each, over so many rounds.
///
/// # Errors
/// What a way could not do.
pub fn medians(ways: &mut [Way<'_>], counts: &[u64], rounds: usize) -> Result<Vec<f64>, Failure> {
    let mut samples = vec![Vec::with_capacity(rounds); ways.len()];
    for _ in 0..rounds {
        for ((way, &count), samples) in ways.iter_mut().zip(counts).zip(&mut samples) {
            samples.push((way.run)(count)?.as_secs_f64() * 1e9 / count as f64);
        }
    }
    Ok(samples.into_iter().map(median).collect())
}

/// A line of a table: each way with its ratio to the first.
pub fn line(name: &str, ways: &[Way<'_>], medians: &[f64]) -> String {
    let first = medians[0].max(f64::MIN_POSITIVE);
    let cell = |(way, median): (&Way<'_>, &f64)| {
        format!(" {} {median:.0} ({:.2}) |", way.name, median / first)
    };
    let cells: String = ways.iter().zip(medians).map(cell).collect();
    format!("| {name} |{cells}")
}
