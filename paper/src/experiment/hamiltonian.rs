//! The remark on learning H through the Lie–Poisson variational integrator.

use coadjoint::groups::Exponential;
use coadjoint::{Phase, SO3};
use coadjoint_learn::data::{RowPolicy, Tolerances, reduce};
use coadjoint_learn::polynomial::fit_gradients;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use coadjoint_learn::{MomentumFunction, Scaled, drifts};

use super::Options;
use super::table_two::map;
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::START;

const STEPS: [f64; 5] = [0.4, 0.2, 0.1, 0.05, 0.025];

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("hamiltonian");
    let (group, body) = (SO3::new(), Quadratic::paper());
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    let samples = options.pick(500, 150);
    let title = format!("H_red from {samples} pairs in [-2.5, 2.5]³");
    let columns = "dt | degree | rms of dH - dH_true | slope | energy drift of the map, 1000 steps";
    let mut table = Table::new(title, columns);
    let mut curve = Curve::over("hamiltonian", "dt", STEPS);
    let mut furthest: f64 = 0.0;
    for degree in [2, 4] {
        let mut errors: Vec<f64> = Vec::new();
        for step in STEPS {
            let pairs = phase_pairs(&group, &body, step, wide, samples, options.seed(1)).into();
            let (tolerances, policy) = (Tolerances::default(), RowPolicy::Refuse);
            let data = reduce::<SO3, Exponential>(&group, &pairs, tolerances, policy)?.data;
            // The integrator behind it is of second order: the H found is S/Δt, the true one up to O(Δt²).
            let learned = fit_gradients(&data.p, &(&data.x / step), degree, 0.0)?;
            let (mut found, mut expected, mut squares) = ([0.0; 3], [0.0; 3], 0.0);
            for p in data.momenta.before.column_iter() {
                learned.gradient(p.as_slice(), &mut found);
                body.gradient(p.as_slice(), &mut expected);
                squares += (0..3).map(|j| (found[j] - expected[j]).powi(2)).sum::<f64>();
            }
            let rms = (squares / data.p.len() as f64).sqrt();
            let slope = errors.last().map(|before| (before / rms).log2());
            furthest = furthest.max(slope.map_or(0.0, |slope| (slope - 2.0).abs()));
            errors.push(rms);
            let map = map(Scaled { factor: step, function: &learned });
            let start = Phase::<SO3>::at_identity(START);
            let drift = drifts(&map, &group, &start, options.pick(1000, 200), Some(&body))?;
            table.rows.push(row![step, degree as f64, rms, slope, drift.energy]);
        }
        curve.add(format!("degree_{degree}"), errors);
    }
    report.judge("hamiltonian", "", &[furthest]);
    Ok(report.with(table, curve))
}
