//! The stress program: random steps over groups, charts, truncations, solvers and frames, each accepted one
//! judged in doubled precision by `coadjoint_codegen::judge`.

mod families;
mod family;
mod generated;
mod instance;
mod random;
mod runtime;
mod verdict;

pub use verdict::{Tally, Wrong, report};

use std::sync::atomic::{AtomicU64, Ordering};

use random::Random;

/// What to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Steps to make, about.
    pub steps: u64,
    /// The seed of everything.
    pub seed: u64,
    /// Families whose names contain this.
    pub only: String,
    /// Threads; the result does not depend on them.
    pub threads: usize,
    /// The seed of one instance to repeat, as an example names it.
    pub instance: Option<u64>,
}

/// Runs the stress and counts, family by family.
#[must_use]
pub fn run(options: &Options) -> Vec<(String, Tally)> {
    let families = families::families(&options.only);
    if families.is_empty() {
        return Vec::new();
    }
    let per = families.len() as u64;
    let rounds = match options.instance {
        Some(_) => 1,
        None => options.steps.div_ceil(per * instance::DRAWS as u64),
    };
    let next = AtomicU64::new(0);
    let work = || {
        let mut found: Vec<(u64, Tally)> = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= rounds * per {
                return found;
            }
            let seed = options.instance.unwrap_or_else(|| {
                Random::new(options.seed ^ index.wrapping_mul(0xd134_2543_de82_ef95)).bits()
            });
            let mut tally = Tally::default();
            instance::run(&families[(index % per) as usize], seed, &mut tally);
            found.push((index, tally));
        }
    };
    let mut found: Vec<(u64, Tally)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..options.threads.max(1)).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("a thread")).collect()
    });
    found.sort_by_key(|found| found.0);
    let mut tallies: Vec<_> =
        families.iter().map(|family| (family.name.clone(), Tally::default())).collect();
    for (index, tally) in found {
        tallies[(index % per) as usize].1.add(tally);
    }
    tallies
}
