//! Truths on which the linear model has something to lose.

use coadjoint::groups::Exponential;
use coadjoint::{SE3, SO3};
use coadjoint_learn::data::PairRows;
use coadjoint_learn::polynomial::select_polynomial;
use coadjoint_learn::truth::{Bump, MomentumBox, Quadratic, Quartic, Relativistic, phase_pairs};
use coadjoint_learn::{DataGroup, MomentumFunction};

use super::Options;
use super::models::{COLUMNS, Task, row};
use crate::outcome::{Fallible, Report, Table};

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("harder-truths");
    let (group, body) = (SO3::new(), vec![1.0 / 1.5, 0.5, 0.4]);
    let quartic = Quartic { weights: body.clone(), quartic: vec![0.3, 0.1, 0.2] };
    let root = Relativistic { weights: body.clone(), ripple: 0.3 };
    let (sharpness, centre) = (vec![1.2, 0.7, 0.9], vec![0.5, -0.3, 0.8]);
    let bump = Bump { weights: body, height: 1.5, sharpness, centre };
    let top = Quadratic::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]);
    report.tables = vec![
        learn(options, &group, &quartic, ("quartic H on so(3)*", 0.1, 40))?,
        learn(options, &group, &root, ("square-root H on so(3)*", 0.1, 50))?,
        learn(options, &group, &bump, ("Gaussian bump H on so(3)*", 0.1, 70))?,
        learn(options, &group, &bump, ("Gaussian bump H on so(3)*", 0.4, 80))?,
        learn(options, &SE3::new(), &top, ("heavy top on se(3)*", 0.1, 60))?,
    ];
    let over =
        |table: &Table, name: &str| table.number(name, 1) / table.number("Gaussian process", 1);
    let least = report.tables.iter().map(|t| over(t, "x = 0")).fold(f64::INFINITY, f64::min);
    let linear = over(&report.tables[3], "cross-validated");
    report.judge("harder-truths", "", &[least, linear]);
    Ok(report)
}

fn learn<G: DataGroup>(
    options: &Options,
    group: &G,
    truth: &impl MomentumFunction,
    (name, step, first_seed): (&str, f64, u64),
) -> Fallible<Table> {
    let count = options.pick(500, 150);
    eprintln!("  {name}, Δt = {step}, {count} samples");
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let seed = |k| options.seed(first_seed + k);
    let pairs =
        |count, k| -> PairRows<G> { phase_pairs(group, truth, step, wide, count, seed(k)).into() };
    let task = Task::new::<Exponential>(options, group, &pairs(count, 1), pairs(100, 2))?;
    let task = Task { seed: seed(3), label: format!("harder-truths.{first_seed}"), ..task };
    let title = format!("{name}, Δt = {step}, {count} samples, momenta in [-2, 2]^n, exponential");
    let mut table = Table::new(title, COLUMNS);
    task.begin::<Exponential>(truth, step, None, &mut table)?;
    task.polynomials::<Exponential>(&[2, 4, 6, 8], "", &mut table);
    let selection = select_polynomial(&task.train, 2..=10, seed(4))?;
    let figures = task.figures::<Exponential>(&selection.model);
    table.rows.push(row(format!("cross-validated: {}", selection.best.name), &figures, None));
    task.gaussian_process::<Exponential>(options.pick(400, 150), &mut table)?;
    Ok(table)
}
