//! Geometrizing forward Euler: section 5.4.

use coadjoint::{Exponential, LieGroup, SO3, poisson_map};
use nalgebra::Vector3;

use super::report::{Bound, Cell, Curve, Report, Table};
use super::run::RunOptions;
use crate::error::LearnError;
use crate::function::{Generating, MomentumFunction};
use crate::momentum::{PoissonOptions, fit_poisson};
use crate::truth::{MomentumBox, Quadratic, exact_momentum_flow, momentum_pairs};

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("geometrize");
    let group = SO3::new();
    let body = Quadratic::paper();
    let (step, samples, steps) = (0.1, options.pick(1000, 200), options.pick(2000, 500));
    let euler = |mu: &Vector3<f64>| {
        let mut xi = [0.0; 3];
        body.gradient(mu.as_slice(), &mut xi);
        mu + group.ad_star(&Vector3::from(xi), mu) * step
    };
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    let train = momentum_pairs(&group, wide, samples, options.seed(1), euler);
    let start = Vector3::new(2.0, 0.5, 1.0);
    let energy = |mu: &Vector3<f64>| body.value(mu.as_slice());
    let mut table = Table::new(
        format!("{steps} steps of {step} from (2, 0.5, 1); {samples} pairs in [-2.5, 2.5]^3"),
        &["method", "fit mse", "Casimir drift", "energy drift", "distance to the exact flow"],
    );
    let mut exact = vec![start];
    let mut plain = vec![start];
    for i in 0..steps {
        let next = exact_momentum_flow(&group, &body, &exact[i], step);
        exact.push(next);
        plain.push(euler(&plain[i]));
    }
    let mut curves = vec![("euler".to_owned(), plain)];
    let mut fits = vec![None];
    for degree in options.pick(vec![2, 3, 4, 5, 6], vec![4]) {
        let fit = fit_poisson::<SO3, Exponential>(&group, &train, &PoissonOptions::degree(degree))?;
        let map = Generating::<SO3, Exponential, &dyn MomentumFunction>::new(group, &fit.model);
        let mut states = vec![start];
        for i in 0..steps {
            let next = poisson_map(&map, &states[i])
                .map_err(|e| LearnError::NotConverged { reason: e.to_string() })?;
            states.push(next);
        }
        curves.push((format!("geometrized_{degree}"), states));
        fits.push(fit.history.last().copied());
    }
    let relative = |value: f64, first: f64| (value / first - 1.0).abs();
    let mut columns = vec!["t".to_owned()];
    let mut rows: Vec<Vec<f64>> = (0..=steps).map(|i| vec![i as f64 * step]).collect();
    for ((name, states), fit) in curves.iter().zip(fits) {
        let errors: Vec<[f64; 3]> = states
            .iter()
            .zip(&exact)
            .map(|(mu, expected)| {
                [
                    relative(mu.norm_squared(), start.norm_squared()),
                    relative(energy(mu), energy(&start)),
                    (mu - expected).norm(),
                ]
            })
            .collect();
        let largest = |k: usize| errors.iter().map(|e| e[k]).fold(0.0, f64::max);
        table.push(vec![
            name.clone().into(),
            fit.into(),
            largest(0).into(),
            largest(1).into(),
            largest(2).into(),
        ]);
        columns.extend(["casimir", "energy", "distance"].map(|q| format!("{name}_{q}")));
        rows.iter_mut().zip(&errors).for_each(|(row, e)| row.extend(e));
    }
    let last = |k: usize| match table.rows.last().map(|row| &row[k]) {
        Some(Cell::Number(value)) => *value,
        _ => f64::NAN,
    };
    let euler = |k: usize| match &table.rows[0][k] {
        Cell::Number(value) => *value,
        Cell::Text(_) => f64::NAN,
    };
    report.judge(
        "geometrize",
        "largest relative drift of the Casimir, geometrized (highest degree)",
        last(2),
        Bound::AtMost(1e-12),
    );
    report.judge(
        "geometrize",
        "largest relative drift of the energy: forward Euler over geometrized",
        euler(3) / last(3),
        Bound::AtLeast(100.0),
    );
    report.tables.push(table);
    report.curves.push(Curve { name: "geometrize".into(), columns, rows });
    report.notes.push(
        "geometrized_d is a polynomial S of degree d, the momenta p eliminated; the fit cannot \
         reach zero, because Euler's map is not a Poisson map. The paper gives curves only: Casimir \
         to rounding, energy much better kept than Euler's"
            .into(),
    );
    Ok(report)
}
