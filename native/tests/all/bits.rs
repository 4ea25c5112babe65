//! A compiled step has the bits of the interpreter, in scalars and in lanes, whatever is refused.
#![allow(clippy::unwrap_used)]

use crate::common::{bits, kernel, kicked, lane, state};
use coadjoint_native::{COptions, CacheFolder, Entry, Native};
use coadjoint_program::{Kernel, Stepper, Trajectories, WIDTH};

fn compiled(kernel: &Kernel) -> Entry {
    let options = COptions { cache: CacheFolder::None, ..COptions::default() };
    Native::by_c(kernel, &options).unwrap().entry
}

/// The cases a comparison has met, to check that they occurred.
#[derive(Debug, Default)]
struct Met {
    whole: usize,
    refused: usize,
    longest: u64,
}

/// Compares runs of `steps` steps from several states, each going on where the last one stopped.
fn compare(kernel: &Kernel, entry: &Entry, seed: u64, steps: u64, met: &mut Met) {
    for round in 0..6 {
        let (slots, mut g, mut mu) = state(kernel, seed * 100 + round);
        if round == 5 {
            mu[0] = f64::NAN;
            mu[3] = f64::INFINITY;
            mu[4] = -0.0;
        }
        let (g_begin, mu_begin) = (g.clone(), mu.clone());
        let mut live = [true; WIDTH];
        live[round as usize] = false;
        let (mut g_expected, mut mu_expected) = (g.clone(), mu.clone());
        let expected = kernel.advance_lanes(&slots, &mut g_expected, &mut mu_expected, steps, live);
        let made = entry.advance_lanes(&slots, &mut g, &mut mu, steps, live);
        assert_eq!(made, expected, "steps of lanes, seed {seed}");
        assert_eq!(bits(&g), bits(&g_expected), "g of lanes, seed {seed}");
        assert_eq!(bits(&mu), bits(&mu_expected), "μ of lanes, seed {seed}");
        for r in 0..WIDTH {
            let (mut g, mut mu) = (lane(&g_begin, r), lane(&mu_begin, r));
            let (mut g_expected, mut mu_expected) = (g.clone(), mu.clone());
            let expected = kernel.advance(&slots, &mut g_expected, &mut mu_expected, steps);
            let outcome = entry.advance(&slots, &mut g, &mut mu, steps);
            assert_eq!(outcome, expected, "seed {seed}, lane {r}");
            assert_eq!(bits(&g), bits(&g_expected), "g, seed {seed}, lane {r}");
            assert_eq!(bits(&mu), bits(&mu_expected), "μ, seed {seed}, lane {r}");
            if live[r] {
                assert_eq!(made[r], outcome.steps, "a lane is a trajectory, seed {seed}, lane {r}");
            }
            match outcome.steps == steps {
                true => met.whole += 1,
                false => met.refused += 1,
            }
            met.longest = met.longest.max(outcome.steps);
        }
    }
}

#[test]
fn random_kernels_have_the_bits_of_the_interpreter() {
    let mut met = Met::default();
    let shapes = [[3, 4, 1], [1, 1, 0], [6, 7, 3], [2, 0, 2], [5, 9, 0], [3, 3, 6]];
    for (seed, shape) in (1..).zip(shapes) {
        for (frame, flows) in [(false, 0), (true, 0), (false, seed as u32 % 4 + 1)] {
            let refusal = if seed % 2 == 0 { 0.05 } else { 0.4 };
            let mut kernel = kernel(seed, shape, 40, frame, refusal);
            if flows > 0 {
                kernel = kicked(kernel, seed, flows);
            }
            let entry = compiled(&kernel);
            for steps in [0, 1, 7, 256, 700] {
                compare(&kernel, &entry, seed, steps, &mut met);
            }
        }
    }
    assert!(met.whole > 100 && met.refused > 100 && met.longest == 700, "{met:?}");
}

#[test]
fn thousands_of_steps_have_the_bits_of_the_interpreter() {
    thousands(&[(20, 600), (21, 600)]);
}

/// Programs long enough to be printed in pieces.
#[test]
fn thousands_of_operations_have_the_bits_of_the_interpreter() {
    thousands(&[(22, 4000)]);
}

/// Kernels of these seeds and lengths.
fn thousands(kernels: &[(u64, usize)]) {
    let mut met = Met::default();
    for &(seed, length) in kernels {
        let kernel = kernel(seed, [4, 4, 2], length, true, 0.0);
        compare(&kernel, &compiled(&kernel), seed, 3000, &mut met);
    }
    assert!(met.longest == 3000, "{met:?}");
}

#[test]
fn what_is_not_compiled_is_interpreted() {
    let kernel = kernel(7, [3, 4, 1], 40, true, 0.1);
    for trajectories in [Trajectories::One, Trajectories::Lanes] {
        let options = COptions { cache: CacheFolder::None, trajectories, ..COptions::default() };
        let native = Native::by_c(&kernel, &options).unwrap();
        let mut met = Met::default();
        compare(&kernel, &native.entry, 7, 300, &mut met);
    }
}

#[test]
fn slices_that_are_too_short_make_no_step() {
    let kernel = kernel(3, [3, 4, 1], 20, false, 0.0);
    let entry = compiled(&kernel);
    let (slots, mut g, mut mu) = state(&kernel, 1);
    assert_eq!(entry.advance(&slots, &mut g[..3], &mut mu, 5).steps, 0);
    assert_eq!(entry.advance(&slots[1..], &mut g, &mut mu, 5).steps, 0);
    assert_eq!(entry.advance_lanes(&slots, &mut g, &mut mu[..20], 5, [true; WIDTH]), [0; WIDTH]);
}

#[test]
fn an_entry_outlives_what_it_came_from_and_goes_between_threads() {
    let kernel = kernel(5, [3, 4, 1], 30, true, 0.0);
    let entry = compiled(&kernel);
    let clones: Vec<Entry> = (0..4).map(|_| entry.clone()).collect();
    drop(entry);
    let (slots, g, mu) = state(&kernel, 2);
    let run = |entry: &Entry| {
        let (mut g, mut mu) = (lane(&g, 0), lane(&mu, 0));
        let outcome = entry.advance(&slots, &mut g, &mut mu, 500);
        (outcome.steps, bits(&g), bits(&mu))
    };
    let run = &run;
    let expected = run(&clones[0]);
    std::thread::scope(|scope| {
        let threads: Vec<_> =
            clones.into_iter().map(|entry| scope.spawn(move || run(&entry))).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), expected);
        }
    });
}
