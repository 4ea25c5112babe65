//! Every system reaches the end state of its reference at the order theory says, K + 1 (shared
//! mathematics, parity of the series), and keeps momentum and Casimirs to rounding.
#![allow(clippy::unwrap_used)]

use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::judge::{Enclosure, Judge};
use coadjoint_codegen::lie::Chart;
use coadjoint_tests::reference::{end_state, numbers};
use coadjoint_tests::run::run;
use nalgebra::{DMatrix, DVector};

/// Runs with n and 2n steps at each truncation; the finer run must end within `bound`.
fn reaches(system: &str, runs: &[(usize, usize, f64)]) {
    let entry = end_state(system);
    for &(truncation, n, bound) in runs {
        let series = entry.series(truncation);
        let (_, coarse) = run(&entry, &series, (n, n), None, &[]);
        let (_, fine) = run(&entry, &series, (2 * n, 2 * n), None, &[]);
        let note = format!("{system}, K = {truncation}, n = {n}: {coarse:?} {fine:?}");
        assert!(fine.momentum < bound && fine.group_element < 10.0 * bound, "{note}");
        for (a, b) in [(coarse.momentum, fine.momentum), (coarse.group_element, fine.group_element)]
        {
            let order = (a / b).log2();
            assert!((order - (truncation + 1) as f64).abs() < 0.3, "order {order}: {note}");
        }
        for outcome in [coarse, fine] {
            assert!(outcome.spatial_momentum <= 1e-13 && outcome.casimirs <= 1e-13, "{note}");
        }
    }
}

macro_rules! reaches {
    ($($test:ident: $system:literal, $runs:expr;)*) => {
        $(#[test]
        fn $test() {
            reaches($system, &$runs);
        })*
    };
}

// Step counts put both runs into the asymptotic regime and above rounding; bounds are the
// measured end errors, rounded up.
reaches! {
    rigid_body_of_the_paper: "rigid-body (paper)", [(3, 500, 1e-4), (5, 500, 2e-8), (7, 300, 1e-9)];
    rigid_body_of_the_dmv_driver: "rigid-body (DMV driver)",
        [(3, 100, 1e-5), (5, 100, 1e-7), (7, 60, 1e-8)];
    rigid_body_of_geometric_problems: "rigid-body (GeometricProblems)",
        [(3, 300, 1e-4), (5, 300, 1e-7), (7, 200, 1e-8)];
    free_body_with_full_inertia: "free-body-full-inertia",
        [(3, 200, 5e-6), (5, 200, 4e-9), (7, 200, 4e-12)];
    lagrange_top: "lagrange-top", [(3, 200, 6e-7), (5, 100, 6e-8), (7, 100, 3e-10)];
    kovalevskaya_top: "Kovalevskaya top", [(3, 100, 8e-6), (5, 100, 2e-8), (7, 100, 6e-11)];
    goryachev_chaplygin_top: "goryachev-chaplygin-top",
        [(3, 100, 7e-7), (5, 100, 3e-10), (7, 50, 4e-11)];
    heavy_top_of_bruels: "heavy top (Bruels)", [(3, 500, 2e-5), (5, 400, 1e-7), (7, 400, 1e-9)];
    kirchhoff_body: "Kirchhoff", [(3, 100, 4e-8), (5, 50, 1e-9), (7, 50, 1e-12)];
    clebsch_case: "clebsch-case", [(3, 100, 7e-7), (5, 100, 3e-10), (7, 50, 5e-11)];
    gyrostat: "gyrostat", [(3, 200, 6e-5), (5, 200, 2e-7), (7, 100, 5e-8)];
    manakov_body: "Manakov so(4)", [(3, 50, 1e-8), (5, 50, 2e-12), (7, 12, 3e-11)];
    su3_quadratic: "su3-quadratic", [(3, 50, 7e-7), (5, 50, 6e-10), (7, 25, 2e-10)];
    extended_pose: "extended-pose", [(3, 50, 6e-8), (5, 25, 1e-9), (7, 12, 4e-10)];
    moments_of_a_beam: "beam-moments", [(3, 100, 5e-8), (5, 50, 1e-9), (7, 25, 3e-10)];
    three_wave_interaction: "three-wave", [(3, 100, 5e-5), (5, 50, 2e-5)];
    heisenberg_spin_ring: "heisenberg-spin-ring", [(3, 50, 5e-4)];
    zeitlin_3: "zeitlin-3", [(3, 50, 8e-6), (5, 25, 4e-7)];
    zeitlin_5: "zeitlin-5", [(1, 60, 1e-2), (3, 16, 1e-2)];
    toda_lattice: "toda-lattice", [(3, 50, 3e-7), (5, 50, 5e-10), (7, 25, 3e-10)];
}

/// The judge's own motion reaches the references' end states, to the truncation of the series: the signs, both charts, and the group
/// element.
#[test]
fn motions_of_the_judge_reach_the_references() {
    for (name, chart, truncation, steps, tolerance) in [
        ("rigid-body (DMV driver)", Chart::Exponential, 9, 200, 1e-9),
        ("rigid-body (DMV driver)", Chart::Cayley, 9, 400, 1e-7),
        ("Kirchhoff", Chart::Exponential, 5, 400, 1e-7),
        ("Manakov so(4)", Chart::Exponential, 3, 400, 1e-3),
    ] {
        let entry = end_state(name);
        let (algebra, limit) = (entry.algebra(), TermLimit::default());
        let series = derive(&algebra, chart, &entry.polynomial(), truncation, limit).unwrap();
        let judge = Judge::new(&algebra, &series).unwrap();
        let mut setting =
            judge.at(entry.time.parse::<f64>().unwrap() / f64::from(steps), &[]).unwrap();
        let mut motion = Enclosure::new(&numbers(&entry.momentum0));
        let size = entry.group_element.len();
        let unit = DMatrix::<f64>::identity(size, size);
        let mut element = unit.clone();
        for _ in 0..steps {
            let mut one = Enclosure::new(&motion.momentum());
            one.step(&mut setting, None, f64::EPSILON / 2.0).unwrap();
            motion.step(&mut setting, None, f64::EPSILON / 2.0).unwrap();
            // The product of rounded elements, for the comparison only.
            element *= DMatrix::from_row_slice(size, size, &one.element_from(unit.as_slice()));
        }
        let expected = DVector::from_vec(numbers(&entry.momentum));
        let found = DVector::from_vec(motion.momentum());
        assert!((found - &expected).amax() < tolerance * expected.amax(), "{name}");
        let expected: Vec<f64> = entry.group_element.iter().flat_map(|row| numbers(row)).collect();
        let off = (&element - DMatrix::from_row_slice(size, size, &expected)).amax();
        assert!(off < 100.0 * tolerance, "{name}: {off:e}");
        let rows = element.transpose();
        assert!(motion.element_deviation(unit.as_slice(), rows.as_slice()) < 1.0, "{name}");
    }
}
