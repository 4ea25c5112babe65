//! The simulation figure: K = 3, 5, 7, momentum against RK45, distance over time.

use coadjoint::{Cayley, Chart, Coordinates, Exponential, Phase, SO3, advance};
use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::lie::{Chart as AlgebraChart, catalogue};
use coadjoint_codegen::poly::Polynomial;
use nalgebra::{Matrix3, Vector3};
use num_rational::BigRational;

use super::report::{Curve, Report, Table};
use super::run::RunOptions;
use super::runge_kutta::dormand_prince;
use crate::error::LearnError;
use crate::function::{Generating, MomentumFunction};
use crate::group::matrix_of;
use crate::series::Monomials;
use crate::truth::{Quadratic, exact_flow};

/// The exact series of the paper's rigid body to the order K, at a step.
pub(super) fn paper_series(
    chart: AlgebraChart,
    truncation: usize,
    step: f64,
) -> Result<Monomials, LearnError> {
    let failed = |reason: String| LearnError::NotConverged { reason };
    let algebra = catalogue::lookup("SO3").map_err(|e| failed(e.to_string()))?;
    // H = ½ (x²/1.5 + y²/2 + z²/2.5) = x²/3 + y²/4 + z²/5.
    let hamiltonian = Polynomial::from_terms(
        3,
        [([2, 0, 0], 3), ([0, 2, 0], 4), ([0, 0, 2], 5)]
            .map(|(exponents, d)| (exponents.to_vec(), BigRational::new(1.into(), d.into()))),
    );
    let series = derive(&algebra, chart, &hamiltonian, truncation, TermLimit::new(100_000))
        .map_err(|e| failed(e.to_string()))?;
    Ok(Monomials::of_series(&series, step))
}

/// Energy error, momentum error and distance from the exact state after every step.
fn follow<C: Chart<SO3>>(
    series: Monomials,
    exact: &[Phase<SO3>],
) -> Result<Vec<[f64; 3]>, LearnError> {
    let map = Generating::<SO3, C, &dyn MomentumFunction>::new(SO3::new(), &series);
    let mut phase = exact[0].clone();
    let mut rows = vec![[0.0; 3]];
    for expected in &exact[1..] {
        advance(&map, &mut phase)
            .map_err(|e| LearnError::NotConverged { reason: e.to_string() })?;
        let rotation = matrix_of(&SO3::<f64>::new(), &phase.group_element);
        let g = Matrix3::from_fn(|i, j| rotation[(i, j)]);
        rows.push(compare(&g, &phase.momentum, expected, &exact[0]));
    }
    Ok(rows)
}

fn compare(
    g: &Matrix3<f64>,
    mu: &Vector3<f64>,
    expected: &Phase<SO3>,
    start: &Phase<SO3>,
) -> [f64; 3] {
    let body = Quadratic::paper();
    let group = SO3::new();
    let energy = |mu: &Vector3<f64>| body.value(mu.as_slice());
    let spatial = start.spatial_momentum(&group);
    let rotation = matrix_of(&group, &expected.group_element);
    let distance = (g - Matrix3::from_fn(|i, j| rotation[(i, j)])).norm_squared()
        + (mu - expected.momentum).norm_squared();
    [
        (energy(mu) - energy(&start.momentum)).abs(),
        (g * mu - spatial).largest_entry(),
        distance.sqrt(),
    ]
}

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("simulation");
    let (step, count) = (0.2, options.pick(5000, 250));
    let group = SO3::new();
    let body = Quadratic::paper();
    let mut exact = vec![Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0))];
    for i in 0..count {
        let next = exact_flow(&group, &body, &exact[i], step);
        exact.push(next);
    }
    let title =
        format!("largest errors over {count} steps of {step}, start (2, 0.5, 1) at the identity");
    let mut table =
        Table::new(title, &["method", "energy", "momentum J_L", "distance", "distance at the end"]);
    let mut names = vec!["t".to_owned()];
    let mut rows: Vec<Vec<f64>> = (0..=count).map(|i| vec![i as f64 * step]).collect();
    let mut enter = |name: String, errors: Vec<[f64; 3]>| {
        let largest = |k: usize| errors.iter().map(|e| e[k]).fold(0.0, f64::max);
        let end = errors.last().map_or(0.0, |e| e[2]);
        let key = name.to_lowercase().replace([' ', ','], "_").replace(['=', '⁻'], "");
        table.push(vec![
            name.into(),
            largest(0).into(),
            largest(1).into(),
            largest(2).into(),
            end.into(),
        ]);
        names.extend(["energy", "momentum", "distance"].map(|q| format!("{key}_{q}")));
        for (row, error) in rows.iter_mut().zip(&errors) {
            row.extend(error);
        }
    };
    for truncation in [3, 5, 7] {
        let cayley = paper_series(AlgebraChart::Cayley, truncation, step)?;
        enter(format!("Cayley K={truncation}"), follow::<Cayley>(cayley, &exact)?);
        let exponential = paper_series(AlgebraChart::Exponential, truncation, step)?;
        enter(format!("exp K={truncation}"), follow::<Exponential>(exponential, &exact)?);
    }
    // RK45 with the tolerances people get when they set none (rtol 1e-3, atol 1e-6), and finer.
    let times: Vec<f64> = (1..=count).map(|i| i as f64 * step).collect();
    let mut start: Vec<f64> = Matrix3::<f64>::identity().as_slice().to_vec();
    start.extend(exact[0].momentum.iter());
    let slope = |y: &[f64], f: &mut [f64]| {
        let g = Matrix3::from_column_slice(&y[..9]);
        let mu = Vector3::new(y[9], y[10], y[11]);
        let xi = Vector3::new(mu.x / 1.5, mu.y / 2.0, mu.z / 2.5);
        f[..9].copy_from_slice((g * xi.cross_matrix()).as_slice());
        f[9..].copy_from_slice(mu.cross(&xi).as_slice());
    };
    for (name, relative, absolute) in [("RK45 default", 1e-3, 1e-6), ("RK45 fine", 1e-6, 1e-9)] {
        let states = dormand_prince(&start, &times, relative, absolute, slope)
            .map_err(|e| LearnError::NotConverged { reason: e.to_string() })?;
        let mut errors = vec![[0.0; 3]];
        for (state, expected) in states.iter().zip(&exact[1..]) {
            let g = Matrix3::from_column_slice(&state[..9]);
            let mu = Vector3::new(state[9], state[10], state[11]);
            errors.push(compare(&g, &mu, expected, &exact[0]));
        }
        enter(name.into(), errors);
    }
    report.tables.push(table);
    report.curves.push(Curve { name: "simulation".into(), columns: names, rows });
    report.notes.push(
        "the paper's figure has no numbers: it shows the energy of K = 3, 5, 7 bounded and better \
         with K, the momentum exact, and RK45 drifting in both; the distance is that of (R, Π) \
         from the exact flow"
            .into(),
    );
    Ok(report)
}
