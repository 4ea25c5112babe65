//! Kernels put together by hand, and the comparison of machine code with the interpreter, bit for bit.
#![allow(dead_code)]

pub mod chance;
pub mod rigid;
pub mod wild;

use coadjoint_native::Entry;
use coadjoint_program::{Kernel, Stepper, WIDTH};

use chance::Chance;

/// A kernel with folded coefficients, and how to draw a state of it.
pub struct Sample {
    pub kernel: Kernel,
    pub slots: Vec<f64>,
    pub draw: fn(&Kernel, &mut Chance) -> (Vec<f64>, Vec<f64>),
}

/// How many trajectories were compared, and what became of them.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// All steps made.
    pub whole: usize,
    /// Stopped in the middle of a block.
    pub stopped: usize,
    /// No step at all, or back to the start of a block.
    pub back: usize,
}

fn bits(values: &[f64]) -> Vec<u64> {
    // Which of the many NaNs comes out is left open by IEEE 754.
    let bits = |value: &f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
    values.iter().map(bits).collect()
}

/// Compares both functions of an entry with the interpreter on eight drawn states, lanes being live at random.
pub fn compare(sample: &Sample, entry: &Entry, steps: u64, chance: &mut Chance, seen: &mut Seen) {
    let Sample { kernel, slots, draw } = sample;
    let (n, m) = (kernel.dim(), kernel.element());
    let states: Vec<_> = (0..WIDTH).map(|_| draw(kernel, chance)).collect();
    let live: [bool; WIDTH] = std::array::from_fn(|_| chance.below(5) > 0);
    let mut g = vec![0.0; m * WIDTH];
    let mut mu = vec![0.0; n * WIDTH];
    for (lane, state) in states.iter().enumerate() {
        for i in 0..m {
            g[i * WIDTH + lane] = state.0[i];
        }
        for i in 0..n {
            mu[i * WIDTH + lane] = state.1[i];
        }
    }
    let (mut g_lanes, mut mu_lanes) = (g.clone(), mu.clone());
    let made = kernel.advance_lanes(slots, &mut g, &mut mu, steps, live);
    let made_lanes = entry.advance_lanes(slots, &mut g_lanes, &mut mu_lanes, steps, live);
    assert_eq!(made_lanes, made, "steps made by lanes out of {steps}");
    assert_eq!(bits(&g_lanes), bits(&g), "g of lanes after {made:?} of {steps} steps");
    assert_eq!(bits(&mu_lanes), bits(&mu), "μ of lanes after {made:?} of {steps} steps");

    for (lane, state) in states.iter().enumerate() {
        let (mut one, mut other) = (state.clone(), state.clone());
        let expected = kernel.advance(slots, &mut one.0, &mut one.1, steps);
        let found = entry.advance(slots, &mut other.0, &mut other.1, steps);
        assert_eq!(found.steps, expected.steps, "steps made out of {steps}");
        assert_eq!(found.corrections, expected.corrections, "corrections");
        assert_eq!(bits(&[found.residual]), bits(&[expected.residual]), "residual");
        assert_eq!(bits(&other.0), bits(&one.0), "g after {} steps", found.steps);
        assert_eq!(bits(&other.1), bits(&one.1), "μ after {} steps", found.steps);
        if live[lane] {
            assert_eq!(made[lane], expected.steps, "steps made by a lane and alone");
        }
        match expected.steps {
            made if made == steps => seen.whole += 1,
            made if made % coadjoint_program::BLOCK == 0 => seen.back += 1,
            _ => seen.stopped += 1,
        }
    }
}
