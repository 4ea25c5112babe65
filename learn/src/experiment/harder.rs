//! Truths on which the linear model has something to lose.

use coadjoint::{Exponential, SE3, SO3};

use super::networks::Training;
use super::report::{Bound, Cell, Report, Table};
use super::run::RunOptions;
use super::task::{COLUMNS, Task, row};
use crate::data::PairRows;
use crate::error::LearnError;
use crate::function::MomentumFunction;
use crate::group::DataGroup;
use crate::polynomial::{SelectionOptions, select_polynomial};
use crate::truth::{Bump, MomentumBox, Quadratic, Quartic, Relativistic, phase_pairs};

pub(super) fn run(options: &RunOptions, say: &mut dyn FnMut(&str)) -> Result<Report, LearnError> {
    let mut report = options.report("harder-truths");
    let (group, body) = (SO3::new(), vec![1.0 / 1.5, 0.5, 0.4]);
    let quartic = Quartic { weights: body.clone(), quartic: vec![0.3, 0.1, 0.2] };
    learn(options, &group, &quartic, ("quartic H on so(3)*", 0.1, 40), say, &mut report)?;
    let root = Relativistic { weights: body.clone(), ripple: 0.3 };
    learn(options, &group, &root, ("square-root H on so(3)*", 0.1, 50), say, &mut report)?;
    let bump = Bump {
        weights: body,
        height: 1.5,
        sharpness: vec![1.2, 0.7, 0.9],
        centre: vec![0.5, -0.3, 0.8],
    };
    learn(options, &group, &bump, ("Gaussian bump H on so(3)*", 0.1, 70), say, &mut report)?;
    learn(options, &group, &bump, ("Gaussian bump H on so(3)*", 0.4, 80), say, &mut report)?;
    let top = Quadratic::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]);
    learn(options, &SE3::new(), &top, ("heavy top on se(3)*", 0.1, 60), say, &mut report)?;
    let error = |table: &Table, name: &str| {
        let begins = |cell: &Cell| matches!(cell, Cell::Text(text) if text.starts_with(name));
        match table.rows.iter().find(|row| begins(&row[0])).map(|row| &row[1]) {
            Some(Cell::Number(value)) => *value,
            _ => f64::NAN,
        }
    };
    let gains = report.tables.iter().map(|t| error(t, "x = 0") / error(t, "Gaussian process"));
    let least = gains.fold(f64::INFINITY, f64::min);
    let long =
        report.tables.iter().find(|table| table.title.contains("bump H on so(3)*, dt = 0.4"));
    let linear = long.map(|t| error(t, "cross-validated") / error(t, "Gaussian process"));
    report.judge(
        "harder-truths",
        "least ratio of the error of x without a model to that of the Gaussian process, all truths",
        least,
        Bound::AtLeast(1000.0),
    );
    report.judge(
        "harder-truths",
        "Gaussian bump, dt = 0.4: error of x of the best polynomial over that of the Gaussian process",
        linear,
        Bound::AtLeast(2.0),
    );
    report.notes.push(
        "quartic: H = (1/2) sum w mu^2 + (1/4) sum v mu^4; square root: H = sqrt(1 + sum w mu^2) + \
         0.3 sin mu_1; bump: H = (1/2) sum w mu^2 + 1.5 exp(-(1/2) sum s (mu - c)^2); w = (1/1.5, \
         1/2, 1/2.5)"
            .into(),
    );
    report.notes.push(
        "S = dt H is knowledge of the truth, not learning; it errs by O(dt^3). At dt = 0.1 no fit \
         to samples comes near it for the square root, whose angular velocity is bounded, nor for \
         the bump; at dt = 0.4 the comparison says something"
            .into(),
    );
    Ok(report)
}

fn learn<G, H>(
    options: &RunOptions,
    group: &G,
    truth: &H,
    (name, step, first_seed): (&str, f64, u64),
    say: &mut dyn FnMut(&str),
    report: &mut Report,
) -> Result<(), LearnError>
where
    G: DataGroup,
    H: MomentumFunction,
{
    let count = options.pick(500, 150);
    let title = format!("{name}, dt = {step}, {count} samples, momenta in [-2, 2]^n, exponential");
    if report.has(&title) {
        return Ok(());
    }
    say(&format!("harder-truths: {name}, {count} samples"));
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let seed = |k| options.seed(first_seed + k);
    let pairs =
        |count, k| -> PairRows<G> { phase_pairs(group, truth, step, wide, count, seed(k)).into() };
    let (train, test) = (pairs(count, 1), pairs(100, 2));
    let task = Task::new::<Exponential>(group, &train, test)?;
    let mut table = Table::new(title, &COLUMNS);
    task.trivial::<Exponential>(truth, step, &mut table);
    let label = format!("harder-truths.{first_seed}");
    let training = Training { options, seed: seed(3), label, wide: false };
    training.symmetric::<G, Exponential>(&task, None, say, &mut table)?;
    task.polynomials::<Exponential>(&[2, 4, 6, 8], "", say, &mut table);
    let selection = SelectionOptions { seed: seed(4), ..Default::default() };
    let selection = select_polynomial(&task.train, &selection)?;
    let figures = task.figures::<Exponential>(&selection.model);
    table.push(row(format!("cross-validated: {}", selection.best.name), &figures, None));
    say("  Gaussian process");
    task.gaussian_process::<Exponential>(options.pick(400, 150), &mut table)?;
    report.tables.push(table);
    options.keep(report)
}
