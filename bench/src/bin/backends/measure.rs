//! Ways of making the same steps, timed in turn.

use std::time::{Duration, Instant};

/// Rounds over all ways.
const ROUNDS: usize = 31;
/// How long a way runs in a round, about.
const SAMPLE: Duration = Duration::from_millis(4);

/// Something that makes so many steps, and says how long they took.
pub struct Way<'a> {
    /// What the table calls it.
    pub name: &'static str,
    run: Box<dyn FnMut(u64) -> Duration + 'a>,
}

impl<'a> Way<'a> {
    /// All that this does for so many steps counts.
    pub fn new(name: &'static str, mut run: impl FnMut(u64) + 'a) -> Self {
        let timed = move |steps| {
            let begun = Instant::now();
            run(steps);
            begun.elapsed()
        };
        Self { name, run: Box::new(timed) }
    }

    /// This knows itself which part counts.
    pub fn timed(name: &'static str, run: impl FnMut(u64) -> Duration + 'a) -> Self {
        Self { name, run: Box::new(run) }
    }
}

/// The median nanoseconds of a step of each way: every way runs once per round.
pub fn measure(ways: &mut [Way<'_>]) -> Vec<f64> {
    let counts: Vec<u64> = ways
        .iter_mut()
        .map(|way| {
            let mut count = 64;
            loop {
                let took = (way.run)(count);
                if took >= SAMPLE / 4 {
                    let each = took.as_secs_f64() / count as f64;
                    return (SAMPLE.as_secs_f64() / each) as u64 + 1;
                }
                count *= 2;
            }
        })
        .collect();
    medians(ways, &counts, ROUNDS)
}

/// The same with so many steps of each, over so many rounds.
pub fn medians(ways: &mut [Way<'_>], counts: &[u64], rounds: usize) -> Vec<f64> {
    let mut samples = vec![Vec::with_capacity(rounds); ways.len()];
    for _ in 0..rounds {
        for ((way, &count), samples) in ways.iter_mut().zip(counts).zip(&mut samples) {
            samples.push((way.run)(count).as_secs_f64() * 1e9 / count as f64);
        }
    }
    let median = |mut list: Vec<f64>| {
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    };
    samples.into_iter().map(median).collect()
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
