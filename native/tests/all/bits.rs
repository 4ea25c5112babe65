//! A compiled step has the bits of the interpreter, in scalars and in lanes, whatever is refused.
#![allow(clippy::unwrap_used)]

use crate::samples::{Chance, Sample, Seen, Shape, compare};
use coadjoint_native::Entry;
#[cfg(unix)]
use coadjoint_native::{COptions, Native};
use coadjoint_program::{Graph, Kernel, Stepper, Trajectories, WIDTH};

#[cfg(unix)]
fn by_c(kernel: &Kernel, trajectories: Trajectories) -> Entry {
    let options = COptions { trajectories, ..COptions::default() };
    Native::by_c(kernel, &options).unwrap().entry
}

#[cfg(feature = "jit")]
fn by_cranelift(kernel: &Kernel, trajectories: Trajectories) -> Entry {
    coadjoint_native::jit::compile(kernel, trajectories).unwrap()
}

const COMPILERS: &[fn(&Kernel, Trajectories) -> Entry] = &[
    #[cfg(unix)]
    by_c,
    #[cfg(feature = "jit")]
    by_cranelift,
];

#[test]
fn random_programs_have_the_same_bits() {
    for compile in COMPILERS {
        let (mut chance, mut seen, mut rows) = (Chance(3), Seen::default(), 0);
        for round in 0..32 {
            let shape = Shape {
                dim: 1 + chance.below(6),
                element: chance.below(10),
                constants: chance.below(5),
                beyond: [[0, 0], [0, 0], [3, 0], [5, 9]][chance.below(4)],
                slots: chance.below(12),
                nodes: 1 + chance.below(120),
                corrections: round % 7,
                comoving: chance.below(2) == 0,
                flows: [0, 0, 1, 3][chance.below(4)],
            };
            let sample = Sample::new(shape, &mut chance);
            let programs = &sample.kernel.programs;
            rows += [&programs.guess, &programs.correct, &programs.transport]
                .map(|program| program.rows().len())
                .iter()
                .sum::<usize>();
            let entry = compile(&sample.kernel, Trajectories::Both);
            for steps in [0, 1, 3, 7, 255, 256, 257, 300, 512, 700] {
                compare(&sample, &entry, steps, &mut chance, &mut seen);
            }
        }
        assert!(seen.whole > 100 && seen.stopped > 100 && seen.back > 100, "{seen:?}");
        assert!(rows > 20, "{rows}");
    }
}

/// Programs with more values than registers, and so long that they are printed in pieces.
#[test]
fn long_programs_have_the_same_bits() {
    for compile in COMPILERS {
        let (mut chance, mut seen) = (Chance(4), Seen::default());
        for (dim, element, nodes) in [(24, 30, 600), (24, 30, 1500), (4, 4, 4000)] {
            let (constants, slots, corrections, comoving, flows) = (20, 60, 3, true, 0);
            let beyond = [0, 0];
            let sample = Sample::new(
                Shape {
                    dim,
                    element,
                    constants,
                    beyond,
                    slots,
                    nodes,
                    corrections,
                    comoving,
                    flows,
                },
                &mut chance,
            );
            let entry = compile(&sample.kernel, Trajectories::Both);
            for steps in [1, 5, 260, 3000] {
                compare(&sample, &entry, steps, &mut chance, &mut seen);
            }
        }
        assert!(seen.whole > 0, "{seen:?}");
    }
}

#[test]
fn what_is_not_compiled_is_interpreted() {
    for compile in COMPILERS {
        for trajectories in [Trajectories::One, Trajectories::Lanes] {
            let (sample, mut seen) = (Sample::small(7), Seen::default());
            let entry = compile(&sample.kernel, trajectories);
            compare(&sample, &entry, 300, &mut Chance(5), &mut seen);
        }
    }
}

#[test]
fn slices_that_are_too_short_make_no_step() {
    let Sample { kernel, slots } = Sample::small(3);
    let compiled = COMPILERS.iter().map(|compile| compile(&kernel, Trajectories::Both));
    let compiled: Vec<Entry> = compiled.collect();
    let steppers = compiled.iter().map(|entry| entry as &dyn Stepper).chain([&kernel as _]);
    for stepper in steppers {
        let (mut g, mut mu) = (vec![0.5; 4 * WIDTH], vec![0.5; 3 * WIDTH]);
        assert_eq!(stepper.advance(&slots, &mut g[..3], &mut mu, 5).steps, 0);
        assert_eq!(stepper.advance(&slots[1..], &mut g, &mut mu, 5).steps, 0);
        let made = stepper.advance_lanes(&slots, &mut g, &mut mu[..20], 5, [true; WIDTH]);
        assert_eq!(made, [0; WIDTH]);
    }
    let graph = Graph::new();
    assert!(graph.finish(0, &[graph.slot(0)]).run(&[], &[])[0].is_nan());
}

#[test]
fn code_outlives_all_but_its_last_entry_and_goes_between_threads() {
    for compile in COMPILERS {
        let sample = Sample::small(5);
        let entry = compile(&sample.kernel, Trajectories::Both);
        let clones: Vec<Entry> = (0..4).map(|_| entry.clone()).collect();
        drop(entry);
        std::thread::scope(|scope| {
            for (seed, entry) in (0..).zip(clones) {
                let sample = &sample;
                scope.spawn(move || {
                    compare(sample, &entry, 500, &mut Chance(seed), &mut Seen::default());
                });
            }
        });
    }
}

#[cfg(feature = "jit")]
#[test]
fn a_state_that_does_not_fit_the_stack_is_refused() {
    use coadjoint_native::jit::{JitError, compile};
    let (dim, element, constants, slots, nodes) = (2, 9000, 1, 1, 4);
    let (beyond, corrections, comoving, flows) = ([0, 0], 1, false, 0);
    let sample = Sample::new(
        Shape { dim, element, constants, beyond, slots, nodes, corrections, comoving, flows },
        &mut Chance(6),
    );
    let refused = compile(&sample.kernel, Trajectories::Lanes).unwrap_err();
    // The state now and at the start of the block, in pairs of numbers.
    let told =
        matches!(refused, JitError::Large { bytes, most } if bytes > most && bytes > 32 * element);
    assert!(told, "{refused:?}");
}
