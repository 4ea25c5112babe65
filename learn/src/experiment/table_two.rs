//! Table 2: Poisson maps from momenta alone.

use coadjoint::{Exponential, SO3, poisson_map};
use nalgebra::Vector3;

use super::report::{Bound, Cell, Curve, Report, Table};
use super::run::RunOptions;
use crate::data::MomentumPairs;
use crate::error::LearnError;
use crate::evaluate::evaluate_momenta;
use crate::function::{Generating, MomentumFunction, Scaled, Zero};
use crate::momentum::{PoissonOptions, fit_poisson};
use crate::truth::{MomentumBox, Quadratic, exact_momentum_flow, momentum_pairs};

/// Step, samples, and the paper's mean squared and largest errors.
const CELLS: [(f64, usize, f64, f64); 6] = [
    (0.25, 25, 0.01297, 1.69),
    (0.25, 200, 0.0003, 0.36),
    (0.5, 25, 0.0546, 1.93),
    (0.5, 200, 0.0006, 0.3399),
    (1.0, 25, 0.0427, 1.2597),
    (1.0, 200, 0.0008, 0.3399),
];

fn row(name: String, map: impl MomentumFunction, test: &MomentumPairs) -> Vec<Cell> {
    let map = Generating::<SO3, Exponential, &dyn MomentumFunction>::new(SO3::new(), &map);
    let figures = evaluate_momenta(&map, test);
    vec![
        name.into(),
        figures.mse.momentum.into(),
        figures.max_error.momentum.into(),
        (figures.unsolved.len() as f64).into(),
    ]
}

pub(super) fn run(options: &RunOptions, say: &mut dyn FnMut(&str)) -> Result<Report, LearnError> {
    let mut report = options.report("table-2");
    let group = SO3::new();
    let body = Quadratic::paper();
    let cells = options.pick(&CELLS[..], &CELLS[5..]);
    for (number, &(step, samples, paper, paper_largest)) in cells.iter().enumerate() {
        let title =
            format!("dt = {step}, {samples} samples, momenta in [-1, 1]^3, 100 test points");
        if report.has(&title) {
            continue;
        }
        say(&format!("table-2: dt = {step}, {samples} samples"));
        let seed = |k: u64| options.seed(10 * number as u64 + k);
        let flow = |count, seed| {
            momentum_pairs(&group, MomentumBox::UNIT, count, seed, |mu| {
                exact_momentum_flow(&group, &body, mu, step)
            })
        };
        let (train, test) = (flow(samples, seed(1)), flow(100, seed(2)));
        let columns = ["model", "mse momentum", "max momentum", "unsolved"];
        let mut table = Table::new(title, &columns);
        table.push(vec!["paper".into(), paper.into(), paper_largest.into(), "-".into()]);
        table.push(row("identity, mu'' = mu'".into(), Zero { dim: 3 }, &test));
        table.push(row("S = dt H".into(), Scaled { factor: step, function: &body }, &test));
        for degree in [2, 4, 6] {
            let fit =
                fit_poisson::<SO3, Exponential>(&group, &train, &PoissonOptions::degree(degree))?;
            table.push(row(format!("p eliminated, degree {degree}"), &fit.model, &test));
        }
        let latent = networks(options, &train, &test, seed(3), say, &mut table)?;
        let fourth = table.rows.iter().find(|row| row[0] == Cell::from("p eliminated, degree 4"));
        let error = match fourth.map(|row| &row[1]) {
            Some(Cell::Number(value)) => *value,
            _ => f64::NAN,
        };
        report.judge(
            "table-2",
            format!("dt = {step}, {samples} samples: error of degree 4 over the paper's"),
            error / paper,
            Bound::AtMost(1.0),
        );
        if (step, samples) == (1.0, 200) {
            let mut models: Vec<(&str, Box<dyn MomentumFunction>)> = Vec::new();
            for (name, degree) in [("degree_2", 2), ("degree_4", 4)] {
                let options = PoissonOptions::degree(degree);
                let fit = fit_poisson::<SO3, Exponential>(&group, &train, &options)?;
                models.push((name, Box::new(fit.model)));
            }
            models.extend(latent.map(|model| ("latent", model)));
            trajectories(options, &group, step, &models, &mut report)?;
        }
        report.tables.push(table);
        options.keep(&report)?;
    }
    report.notes.push(
        "the paper does not state its box; ours is [-1, 1]^3. p eliminated: a polynomial S, p solved \
         for by Newton's method for each sample; latent: p unknowns of the fit, as in the paper, \
         with its network 50-10; p network: p from a second network"
            .into(),
    );
    report.notes.push(
        "25 samples do not determine degree 6 (83 coefficients); the ridge of 1e-16 picks the \
         smallest"
            .into(),
    );
    Ok(report)
}

/// Long trajectories of learned Poisson maps: energy, Casimir, distance from the exact flow.
fn trajectories(
    options: &RunOptions,
    group: &SO3,
    step: f64,
    models: &[(&str, Box<dyn MomentumFunction>)],
    report: &mut Report,
) -> Result<(), LearnError> {
    let body = Quadratic::paper();
    let steps = options.pick(5000, 1000);
    let start = Vector3::new(0.7, 0.2, 0.5);
    let energy = |mu: &Vector3<f64>| body.value(mu.as_slice());
    let mut exact = vec![start];
    for i in 0..steps {
        exact.push(exact_momentum_flow(group, &body, &exact[i], step));
    }
    let mut columns = vec!["t".to_owned(), "exact_x".into(), "exact_y".into(), "exact_z".into()];
    let mut rows: Vec<Vec<f64>> =
        exact.iter().enumerate().map(|(i, mu)| vec![i as f64 * step, mu.x, mu.y, mu.z]).collect();
    let mut casimir: f64 = 0.0;
    for (name, model) in models {
        let map = Generating::<SO3, Exponential, &dyn MomentumFunction>::new(*group, &**model);
        let mut mu = start;
        for (i, row) in rows.iter_mut().enumerate() {
            if i > 0 {
                mu = poisson_map(&map, &mu)
                    .map_err(|e| LearnError::NotConverged { reason: e.to_string() })?;
            }
            let norm = mu.norm_squared() / start.norm_squared() - 1.0;
            casimir = casimir.max(norm.abs());
            row.extend([mu.x, mu.y, mu.z, energy(&mu) / energy(&start) - 1.0]);
            row.extend([norm.abs(), (mu - exact[i]).norm()]);
        }
        let quantities = ["x", "y", "z", "energy", "casimir", "distance"];
        columns.extend(quantities.map(|q| format!("{name}_{q}")));
    }
    let curve = Curve { name: "poisson".into(), columns, rows };
    let energies = curve.column("degree_4_energy").into_iter().map(f64::abs);
    let largest = energies.fold(0.0, f64::max);
    report.judge(
        "poisson",
        format!("largest relative drift of the Casimir over {steps} steps, every model"),
        casimir,
        Bound::AtMost(1e-12),
    );
    report.judge(
        "poisson",
        format!("largest relative error of the energy over {steps} steps, degree 4"),
        largest,
        Bound::AtMost(1e-3),
    );
    report.curves.push(curve);
    Ok(())
}

#[cfg(not(feature = "neural"))]
#[allow(clippy::unnecessary_wraps)]
fn networks(
    _options: &RunOptions,
    _train: &MomentumPairs,
    _test: &MomentumPairs,
    _seed: u64,
    _say: &mut dyn FnMut(&str),
    table: &mut Table,
) -> Result<Option<Box<dyn MomentumFunction>>, LearnError> {
    table.push(vec!["latent momenta: built without the feature neural".into()]);
    Ok(None)
}

#[cfg(feature = "neural")]
fn networks(
    options: &RunOptions,
    train: &MomentumPairs,
    test: &MomentumPairs,
    seed: u64,
    say: &mut dyn FnMut(&str),
    table: &mut Table,
) -> Result<Option<Box<dyn MomentumFunction>>, LearnError> {
    use crate::network::{LatentOptions, MomentumModel, TrainingOptions, fit_latent};
    let mut first: Option<Box<dyn MomentumFunction>> = None;
    for (name, momenta) in [
        ("latent p, 50-10", MomentumModel::Latent),
        ("p network 50-10, S network 50-10", MomentumModel::Network(vec![50, 10])),
    ] {
        say(&format!("  {name}"));
        let latent = LatentOptions {
            training: TrainingOptions {
                widths: vec![50, 10],
                adam_steps: options.pick(500, 100),
                rate: 5e-3,
                lbfgs_steps: options.pick(1500, 200),
                seed,
                ..Default::default()
            },
            momenta,
        };
        let fit = fit_latent(&SO3::<f64>::new(), train, &latent, &mut |_| {})?;
        table.push(row(name.into(), &fit.network, test));
        first.get_or_insert_with(|| Box::new(fit.network));
    }
    Ok(first)
}
