//! A run of a reference system, and what it kept.

use coadjoint::groups::{Exponential, MatrixGroup};
use coadjoint::steps::advance;
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::hamilton_jacobi::GeneratingSeries;
use nalgebra::DVector;

use crate::bridge::{matrix_group, series_function};
use crate::moments::casimirs;
use crate::reference::{EndState, numbers};

/// Errors and drifts of a run, all relative.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// max |μ − μ_reference| / max |μ_reference| at the end.
    pub momentum: f64,
    /// max |g − g_reference| / max |g_reference| at the end, over the entries.
    pub group_element: f64,
    /// The largest drift of J_L over the run, against its largest coordinate.
    pub spatial_momentum: f64,
    /// The largest drift of any Casimir over the run.
    pub casimirs: f64,
    /// The largest drift of each watched function over the first and the second half of the run.
    pub watched: Vec<(f64, f64)>,
}

pub type Watched<'a> = &'a dyn Fn(&[f64]) -> f64;

/// Runs from the reference's initial state, μ(0) replaced by `start` if given, `steps` steps of
/// T/`steps_to_end`.
pub fn run(
    entry: &EndState,
    series: &GeneratingSeries,
    (steps, steps_to_end): (usize, usize),
    start: Option<&[f64]>,
    watched: &[Watched<'_>],
) -> (Phase<MatrixGroup>, Deviation) {
    let time: f64 = entry.time.parse().expect("a time");
    let group = matrix_group(&entry.algebra()).expect("a matrix group");
    let h = time / steps_to_end as f64;
    let map = series_function(group.clone(), Exponential, series, h).expect("no symbols");
    let given = numbers(&entry.momentum0);
    let start = DVector::from_column_slice(start.unwrap_or(&given));
    let mut phase = Phase::<MatrixGroup>::new(group.identity(), start.clone());

    let known = |mu: &DVector<f64>| casimirs(&entry.group, &entry.system, mu.as_slice());
    let first = known(&start);
    let values: Vec<f64> = watched.iter().map(|f| f(start.as_slice())).collect();
    let mut outcome = Deviation {
        momentum: f64::NAN,
        group_element: f64::NAN,
        spatial_momentum: 0.0,
        casimirs: 0.0,
        watched: vec![(0.0, 0.0); watched.len()],
    };
    for step in 0..steps {
        advance(&map, &mut phase).expect("a step");
        let spatial = phase.spatial_momentum(&group);
        let drift = (spatial - &start).amax() / start.amax();
        outcome.spatial_momentum = outcome.spatial_momentum.max(drift);
        for ((value, scale), (old, _)) in known(&phase.momentum).into_iter().zip(&first) {
            // The scale of a vanishing Casimir is that of its terms, if these do not vanish too.
            if scale > 0.0 {
                outcome.casimirs = outcome.casimirs.max((value - old).abs() / scale);
            }
        }
        for ((f, old), drift) in watched.iter().zip(&values).zip(&mut outcome.watched) {
            let change = (f(phase.momentum.as_slice()) - old).abs();
            let half = if step < steps / 2 { &mut drift.0 } else { &mut drift.1 };
            *half = half.max(change);
        }
    }
    let end = DVector::from_vec(numbers(&entry.momentum));
    outcome.momentum = (&phase.momentum - &end).amax() / end.amax();
    let size = group.matrix_size();
    let (mut error, mut largest) = (0.0_f64, 0.0_f64);
    for row in 0..size {
        let wanted = numbers(&entry.group_element[row]);
        for (column, wanted) in wanted.into_iter().enumerate() {
            let found = group.matrix_entry(&phase.group_element, row, column);
            error = error.max((found - wanted).abs());
            largest = largest.max(wanted.abs());
        }
    }
    outcome.group_element = error / largest;
    (phase, outcome)
}
