//! Interleaved timing: every way runs once per round, so that a change of the machine's speed meets all alike.

use std::time::{Duration, Instant};

pub type Failure = Box<dyn std::error::Error>;

type Run<'a> = dyn FnMut(u64) -> Result<Duration, Failure> + 'a;

pub struct Contender<'a> {
    pub name: String,
    /// The number of trajectories that make each step.
    bodies: u64,
    /// The number of steps tried first.
    first: u64,
    /// About how long it runs in a round.
    sample: Duration,
    run: Box<Run<'a>>,
}

impl<'a> Contender<'a> {
    /// A way that makes this many steps of each of `bodies` trajectories in this process.
    pub fn new(
        name: &str,
        bodies: usize,
        mut steps: impl FnMut(u64) -> Result<(), Failure> + 'a,
    ) -> Self {
        let run = move |count| {
            let begun = Instant::now();
            steps(count)?;
            Ok(begun.elapsed())
        };
        let (bodies, sample) = (bodies as u64, Duration::from_millis(4));
        Self { name: name.to_owned(), bodies, first: 1, sample, run: Box::new(run) }
    }

    /// A way that runs another process and says itself how long this many steps took.
    pub fn process(
        name: String,
        bodies: usize,
        run: impl FnMut(u64) -> Result<Duration, Failure> + 'a,
    ) -> Self {
        // Fewer steps are lost in how much the time to start varies.
        let (bodies, first) = (bodies as u64, (1 << 14) / (bodies as u64).min(1 << 10));
        Self { name, bodies, first, sample: Duration::from_millis(300), run: Box::new(run) }
    }

    /// A number of steps that takes about as long as a sample.
    fn steps(&mut self) -> Result<u64, Failure> {
        let mut count = self.first;
        loop {
            let took = (self.run)(count)?;
            if took >= self.sample / 4 {
                let each = took.as_secs_f64() / count as f64;
                return Ok((self.sample.as_secs_f64() / each) as u64 + 1);
            }
            count *= 2;
        }
    }
}

/// The median nanoseconds of a step of one trajectory, for each way over the rounds.
pub fn medians(ways: &mut [Contender<'_>], rounds: usize) -> Result<Vec<f64>, Failure> {
    let counts = ways.iter_mut().map(Contender::steps).collect::<Result<Vec<u64>, Failure>>()?;
    let mut samples = vec![Vec::with_capacity(rounds); ways.len()];
    for _ in 0..rounds {
        for ((way, &count), samples) in ways.iter_mut().zip(&counts).zip(&mut samples) {
            let made = (count * way.bodies) as f64;
            samples.push((way.run)(count)?.as_secs_f64() * 1e9 / made);
        }
    }
    Ok(samples.into_iter().map(median).collect())
}

/// A line of a table: the nanoseconds of each way, and in brackets the ratio to the first.
pub fn line(name: &str, ways: &[Contender<'_>], medians: &[f64]) -> String {
    let first = medians.first().copied().unwrap_or(f64::NAN);
    let cell = |(way, median): (&Contender<'_>, &f64)| {
        format!(" {} {} ({:.2}) |", way.name, figure(*median), median / first)
    };
    let cells: String = ways.iter().zip(medians).map(cell).collect();
    format!("| {name} |{cells}")
}

/// Nanoseconds with the digits that mean something.
pub fn figure(nanoseconds: f64) -> String {
    if nanoseconds < 10.0 { format!("{nanoseconds:.2}") } else { format!("{nanoseconds:.0}") }
}

/// The middle value, of an even number the lower of the two middle ones.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(f64::NAN)
}

/// The machine, the vector features that this program was built for, whether it is optimised, and the load.
pub fn machine() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    let processor = line.and_then(|line| line.split_once(": ")).map_or("unknown", |pair| pair.1);
    let features = [
        ("avx2", cfg!(target_feature = "avx2")),
        ("fma", cfg!(target_feature = "fma")),
        ("avx512f", cfg!(target_feature = "avx512f")),
        ("neon", cfg!(target_feature = "neon")),
        ("UNOPTIMISED", cfg!(debug_assertions)),
    ];
    let present = features.iter().filter(|feature| feature.1).map(|feature| feature.0);
    let built = std::iter::once(std::env::consts::ARCH).chain(present).collect::<Vec<_>>();
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split_whitespace().take(3).collect::<Vec<_>>().join(" ");
    format!("{processor}; built for {}; load {load}", built.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_ignores_an_outlier() {
        assert_eq!(median(vec![3.0, 1.0, 1e9, 2.0, 2.5]), 2.5);
        assert_eq!(median(vec![1.0, 2.0]), 1.0);
        assert!(median(Vec::new()).is_nan());
    }
}
