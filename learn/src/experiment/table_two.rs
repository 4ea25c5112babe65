//! Table 2: Poisson maps from momenta alone.

use coadjoint::{Exponential, SO3};

use super::report::{Cell, Report, Table};
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
        networks(options, &train, &test, seed(3), say, &mut table)?;
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

#[cfg(not(feature = "neural"))]
#[allow(clippy::unnecessary_wraps)]
fn networks(
    _options: &RunOptions,
    _train: &MomentumPairs,
    _test: &MomentumPairs,
    _seed: u64,
    _say: &mut dyn FnMut(&str),
    table: &mut Table,
) -> Result<(), LearnError> {
    table.push(vec!["latent momenta: built without the feature neural".into()]);
    Ok(())
}

#[cfg(feature = "neural")]
fn networks(
    options: &RunOptions,
    train: &MomentumPairs,
    test: &MomentumPairs,
    seed: u64,
    say: &mut dyn FnMut(&str),
    table: &mut Table,
) -> Result<(), LearnError> {
    use crate::network::{LatentOptions, MomentumModel, TrainingOptions, fit_latent};
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
    }
    Ok(())
}
