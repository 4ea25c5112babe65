//! Learning H_red through the Lie–Poisson variational integrator.

use coadjoint::{Exponential, Phase, SO3};
use nalgebra::Vector3;

use super::report::{Bound, Curve, Report, Table};
use super::run::RunOptions;
use crate::data::{RowPolicy, Tolerances, reduce};
use crate::error::LearnError;
use crate::evaluate::drifts;
use crate::function::{Generating, MomentumFunction, Scaled};
use crate::hamiltonian::fit_hamiltonian;
use crate::truth::{MomentumBox, Quadratic, phase_pairs};

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("hamiltonian");
    let group = SO3::new();
    let body = Quadratic::paper();
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    let samples = options.pick(500, 150);
    let mut table = Table::new(
        format!("H_red from {samples} pairs in [-2.5, 2.5]^3"),
        &["dt", "degree", "rms of dH - dH_true", "slope", "energy drift of the map, 1000 steps"],
    );
    let mut rows = Vec::new();
    let mut furthest: f64 = 0.0;
    for degree in [2, 4] {
        let mut previous: Option<f64> = None;
        for step in [0.4, 0.2, 0.1, 0.05, 0.025] {
            let pairs = phase_pairs(&group, &body, step, wide, samples, options.seed(1)).into();
            let data = reduce::<SO3, Exponential>(
                &group,
                &pairs,
                Tolerances::default(),
                RowPolicy::Refuse,
            )?
            .data;
            let learned = fit_hamiltonian(&data, step, degree, 0.0)?;
            let (mut found, mut expected) = ([0.0; 3], [0.0; 3]);
            let mut squares = 0.0;
            for p in data.momenta.before.column_iter() {
                learned.gradient(p.as_slice(), &mut found);
                body.gradient(p.as_slice(), &mut expected);
                squares += (0..3).map(|j| (found[j] - expected[j]).powi(2)).sum::<f64>();
            }
            let rms = (squares / data.p.len() as f64).sqrt();
            let slope = previous.map(|p| (p / rms).log2());
            furthest = furthest.max(slope.map_or(0.0, |slope| (slope - 2.0).abs()));
            previous = Some(rms);
            let scaled = Scaled { factor: step, function: &learned };
            let map = Generating::<SO3, Exponential, &dyn MomentumFunction>::new(group, &scaled);
            let start = Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0));
            let drift = drifts(&map, &group, &start, options.pick(1000, 200), Some(&body))?;
            table.push(vec![
                step.into(),
                (degree as f64).into(),
                rms.into(),
                slope.into(),
                drift.energy.into(),
            ]);
            rows.push(vec![degree as f64, step, rms]);
        }
    }
    report.tables.push(table);
    report.judge(
        "hamiltonian",
        "largest difference of a slope from 2, the order of the integrator",
        furthest,
        Bound::AtMost(0.2),
    );
    let columns = ["degree", "dt", "rms"].map(Into::into).to_vec();
    report.curves.push(Curve { name: "hamiltonian".into(), columns, rows });
    report.notes.push(
        "the integrator behind the remark is of second order, so the H found is the true one up to \
         O(dt^2), the slope 2; the paper reports no figures"
            .into(),
    );
    Ok(report)
}
