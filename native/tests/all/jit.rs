//! Machine code by Cranelift has the interpreter's bits.
#![allow(clippy::unwrap_used, clippy::type_complexity)]

use crate::samples::chance::Chance;
use crate::samples::wild::{self, Shape};
use crate::samples::{Sample, Seen, compare, rigid};
use coadjoint_native::jit::{self, JitError};
use coadjoint_program::Trajectories;

const STEPS: [u64; 9] = [0, 1, 2, 7, 255, 256, 257, 512, 700];

fn try_all(sample: &Sample, chance: &mut Chance) -> Seen {
    let entry = jit::compile(&sample.kernel, Trajectories::Both).unwrap();
    let mut seen = Seen::default();
    for steps in STEPS {
        compare(sample, &entry, steps, chance, &mut seen);
    }
    seen
}

#[test]
fn a_rigid_body_moves_as_the_interpreter_moves_it() {
    let mut chance = Chance(1);
    for comoving in [false, true] {
        let seen = try_all(&rigid::body(10.0, 10.0, comoving), &mut chance);
        assert_eq!(seen, Seen { whole: 8 * STEPS.len(), ..Seen::default() });
    }
}

#[test]
fn refused_steps_and_unsound_states_leave_what_was_before() {
    let mut chance = Chance(2);
    let mut seen = try_all(&rigid::body(0.5, 10.0, true), &mut chance);
    assert!(seen.whole > 0 && seen.stopped > 0 && seen.back > 0, "{seen:?}");
    seen = try_all(&rigid::body(10.0, 0.4, true), &mut chance);
    assert!(seen.whole > 0 && seen.stopped == 0 && seen.back > 0, "{seen:?}");
    seen = try_all(&rigid::body(0.5, 0.4, false), &mut chance);
    assert!(seen.whole > 0 && seen.stopped > 0 && seen.back > 0, "{seen:?}");
}

#[test]
fn random_programs_have_the_same_bits() {
    let mut chance = Chance(3);
    let mut seen = Seen::default();
    for round in 0..40 {
        let shape = Shape {
            dim: 1 + chance.below(6),
            element: chance.below(10),
            constants: chance.below(5),
            slots: chance.below(12),
            nodes: 1 + chance.below(120),
            corrections: round % 7,
            comoving: chance.below(2) == 0,
            flows: [0, 0, 1, 3][chance.below(4)],
        };
        let sample = wild::kernel(shape, &mut chance);
        let entry = jit::compile(&sample.kernel, Trajectories::Both).unwrap();
        for steps in [1, 3, 256, 300] {
            compare(&sample, &entry, steps, &mut chance, &mut seen);
        }
    }
    assert!(seen.whole > 100 && seen.stopped > 100 && seen.back > 100, "{seen:?}");
}

#[test]
fn programs_with_more_values_than_registers_have_the_same_bits() {
    let mut chance = Chance(4);
    let mut seen = Seen::default();
    for nodes in [600, 1500] {
        let (dim, element, constants, slots, corrections) = (24, 30, 20, 60, 3);
        let shape = Shape { dim, element, constants, slots, nodes, corrections, comoving: true };
        let sample = wild::kernel(shape, &mut chance);
        let entry = jit::compile(&sample.kernel, Trajectories::Both).unwrap();
        for steps in [1, 5, 260] {
            compare(&sample, &entry, steps, &mut chance, &mut seen);
        }
    }
    assert!(seen.whole > 0, "{seen:?}");
}

#[test]
fn code_outlives_all_but_its_last_entry() {
    let sample = rigid::body(10.0, 10.0, false);
    let entry = jit::compile(&sample.kernel, Trajectories::Both).unwrap();
    let other = entry.clone();
    drop(entry);
    let threads: Vec<_> = (0..4)
        .map(|seed| {
            let entry = other.clone();
            std::thread::spawn(move || {
                let sample = rigid::body(10.0, 10.0, false);
                let mut seen = Seen::default();
                compare(&sample, &entry, 300, &mut Chance(seed), &mut seen);
                seen.whole
            })
        })
        .collect();
    drop(other);
    for thread in threads {
        assert_eq!(thread.join().unwrap(), 8);
    }
}

#[test]
fn what_is_not_compiled_is_interpreted() {
    let mut chance = Chance(5);
    let mut seen = Seen::default();
    for trajectories in [Trajectories::One, Trajectories::Lanes] {
        let sample = rigid::body(0.5, 10.0, true);
        let entry = jit::compile(&sample.kernel, trajectories).unwrap();
        compare(&sample, &entry, 300, &mut chance, &mut seen);
    }
    assert!(seen.whole > 0, "{seen:?}");
}

#[test]
fn a_state_that_does_not_fit_the_stack_is_refused() {
    let element = 9000;
    let shape = Shape {
        dim: 2,
        element,
        constants: 1,
        slots: 1,
        nodes: 4,
        corrections: 1,
        comoving: false,
    };
    let sample = wild::kernel(shape, &mut Chance(6));
    let refused = jit::compile(&sample.kernel, Trajectories::Lanes).unwrap_err();
    // The state now and at the start of the block, in pairs of numbers.
    let told =
        matches!(refused, JitError::Large { bytes, most } if bytes > most && bytes > 32 * element);
    assert!(told, "{refused:?}");
}
