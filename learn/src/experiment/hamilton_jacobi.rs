//! The Hamilton–Jacobi equation by least squares against the exact series.

use coadjoint::{Exponential, SO3, poisson_map};
use coadjoint_codegen::lie::Chart as AlgebraChart;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::report::{Bound, Curve, Report, Table};
use super::run::RunOptions;
use super::simulation::paper_series;
use crate::error::LearnError;
use crate::function::{Generating, MomentumFunction};
use crate::hamilton_jacobi::{CollocationOptions, solve_hamilton_jacobi};
use crate::least_squares::GaussNewton;
use crate::truth::{MomentumBox, Quadratic, exact_momentum_flow};

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("hamilton-jacobi");
    let group = SO3::new();
    let body = Quadratic::paper();
    let time = 0.5;
    let mut rng = ChaCha8Rng::seed_from_u64(options.seed(2));
    let tests: Vec<Vector3<f64>> =
        (0..100).map(|_| Vector3::from_fn(|_, _| 2.0 * rng.random::<f64>() - 1.0)).collect();
    let mut table = Table::new(
        format!("p in [-1, 1]^3, t in (0, {time}); errors at t = {time}, 100 points"),
        &[
            "degree",
            "powers of t",
            "residual mse",
            "rms of dS - series K=11",
            "rms of the map, least squares",
            "rms of the map, series",
        ],
    );
    let reference = paper_series(AlgebraChart::Exponential, 11, time)?;
    let mut rows = Vec::new();
    let mut worst: f64 = 0.0;
    for (degree, powers) in options.pick(vec![(2, 1), (4, 2), (6, 3), (8, 4)], vec![(2, 1), (4, 2)])
    {
        let collocation = CollocationOptions {
            degree,
            powers: (0..powers).map(|a| 2 * a + 1).collect(),
            time,
            momenta: MomentumBox::UNIT,
            samples: options.pick(3000, 600),
            seed: options.seed(1),
            iteration: GaussNewton { iterations: 20, relative_decrease: 1e-3, ridge: 1e-18 },
        };
        let solution = solve_hamilton_jacobi::<SO3, Exponential, _>(&group, &body, &collocation)?;
        let learned = solution.at(time);
        let truncation = 2 * powers as usize - 1;
        let series = paper_series(AlgebraChart::Exponential, truncation, time)?;
        let (mut slope, mut map, mut plain) = (0.0, 0.0, 0.0);
        let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
        let fitted = Generating::<SO3, Exponential, &dyn MomentumFunction>::new(group, &learned);
        let truncated = Generating::<SO3, Exponential, &dyn MomentumFunction>::new(group, &series);
        let failed = |e: coadjoint::StepError| LearnError::NotConverged { reason: e.to_string() };
        for mu in &tests {
            learned.gradient(mu.as_slice(), &mut a);
            reference.gradient(mu.as_slice(), &mut b);
            slope += (0..3).map(|j| (a[j] - b[j]).powi(2)).sum::<f64>();
            let exact = exact_momentum_flow(&group, &body, mu, time);
            map += (poisson_map(&fitted, mu).map_err(failed)? - exact).norm_squared();
            plain += (poisson_map(&truncated, mu).map_err(failed)? - exact).norm_squared();
        }
        let rms = |sum: f64| (sum / (3 * tests.len()) as f64).sqrt();
        worst = worst.max((map / plain).sqrt());
        let residual = solution.history.last().copied();
        table.push(vec![
            (degree as f64).into(),
            (1..=truncation).step_by(2).map(|k| k.to_string()).collect::<Vec<_>>().join(" ").into(),
            residual.into(),
            rms(slope).into(),
            rms(map).into(),
            rms(plain).into(),
        ]);
        for (iteration, value) in solution.history.iter().enumerate() {
            rows.push(vec![degree as f64, iteration as f64, *value]);
        }
    }
    report.tables.push(table);
    report.judge(
        "hamilton-jacobi",
        "largest ratio of the error of the map by least squares to that of the series of the same powers of t",
        worst,
        Bound::AtMost(2.0),
    );
    let columns = ["degree", "iteration", "residual_mse"].map(Into::into).to_vec();
    report.curves.push(Curve { name: "hamilton-jacobi".into(), columns, rows });
    report.notes.push(
        "the paper proposes this without figures; both columns of the map use the same powers of t, \
         so they compare a fit over the whole box and time with an expansion at t = 0"
            .into(),
    );
    Ok(report)
}
