//! The stress program: random steps over groups, charts, truncations, solvers and frames, each accepted one
//! judged in doubled precision by `coadjoint_codegen::judge`; and steps by collocation, compared with another method.

mod collocation;
mod families;
mod family;
mod flow;
mod generated;
mod instance;
mod kernels;
mod random;
mod runtime;
mod verdict;

pub use random::Random;
pub use verdict::{Tally, Wrong, report, times};

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use family::Family;

#[derive(Clone, Debug)]
pub struct Campaign {
    /// Steps to make, about.
    pub steps: u64,
    pub seed: u64,
    pub only: String,
    /// Threads; the result does not depend on them.
    pub threads: usize,
    /// The seed of one instance to repeat, as an example names it.
    pub instance: Option<u64>,
    /// As many instances of one family as of another; else fewer of those whose steps take long.
    pub even: bool,
}

/// Runs the stress and counts, family by family.
pub fn run(options: &Campaign) -> Vec<(String, Tally)> {
    let families = families::families(&options.only);
    if families.is_empty() {
        return Vec::new();
    }
    let schedule = schedule(&families, options);
    let per = schedule.len() as u64;
    // An example is repeated by each family once; so is every family where all are to have a turn.
    let instances = match options.instance {
        Some(_) => per,
        None => options.steps.div_ceil(instance::DRAWS as u64),
    };
    let instances = if options.even { instances.next_multiple_of(per) } else { instances };
    let next = AtomicU64::new(0);
    let work = || {
        let mut found: Vec<(u64, Tally)> = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= instances {
                return found;
            }
            let seed = options.instance.unwrap_or_else(|| {
                Random::new(options.seed ^ index.wrapping_mul(0xd134_2543_de82_ef95)).bits()
            });
            let mut tally = Tally::default();
            let start = Instant::now();
            (families[schedule[(index % per) as usize]].judge)(&mut Random::new(seed), &mut tally);
            tally.seconds = start.elapsed().as_secs_f64();
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
        tallies[schedule[(index % per) as usize]].1.add(tally);
    }
    tallies
}

/// Families in the order of their instances, each as often as its weight says, spread evenly.
fn schedule(families: &[Family], options: &Campaign) -> Vec<usize> {
    if options.even || options.instance.is_some() {
        // The longest family goes first, or all wait for it at the end.
        let mut order: Vec<_> = (0..families.len()).collect();
        order.sort_by_key(|&family| families[family].weight);
        return order;
    }
    let mut places: Vec<(f64, usize)> = Vec::new();
    for (family, of) in families.iter().enumerate() {
        let weight = of.weight.max(1);
        places.extend((0..weight).map(|k| ((k as f64 + 0.5) / weight as f64, family)));
    }
    places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    places.into_iter().map(|place| place.1).collect()
}
