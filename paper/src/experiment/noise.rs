//! Robustness against noise: 1000 samples, step 0.15, Gaussian noise of variance 0.05.

use coadjoint::SO3;
use coadjoint::groups::Exponential;
use coadjoint_learn::data::{PairRows, ReducedData, RowPolicy, Tolerances, reduce};
use coadjoint_learn::network::TrainingOptions;
use coadjoint_learn::polynomial::{Scaling, select_polynomial};
use coadjoint_learn::truth::{MomentumBox, Quadratic, add_noise, phase_pairs};
use coadjoint_learn::{MomentumFunction, Scaled, evaluate, fit_gaussian_process};

use super::Options;
use super::learned::{enter, watched};
use super::models::{COLUMNS, row};
use super::table_two::map;
use crate::outcome::{Curve, Fallible, Report, Table};

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("noise");
    let (group, body) = (SO3::new(), Quadratic::paper());
    let (step, samples) = (0.15, options.pick(1000, 200));
    let pairs = |count, seed| phase_pairs(&group, &body, step, MomentumBox::PAPER, count, seed);
    let clean = pairs(samples, options.seed(1));
    let noisy = add_noise(&group, &clean, 0.05_f64.sqrt(), options.seed(2));
    let tests: PairRows<SO3> = pairs(100, options.seed(3)).into();
    let reduced = |pairs: &PairRows<SO3>| {
        reduce::<SO3, Exponential>(&group, pairs, Tolerances::unlimited(), RowPolicy::Drop)
    };
    let test = reduced(&tests)?.data;
    let mut curve = Curve::default();
    for (label, pairs, columns) in [
        ("without noise", clean, ["without_train", "without_test"]),
        ("with noise", noisy, ["with_train", "with_test"]),
    ] {
        eprintln!("  {label}");
        let reduction = reduced(&pairs.into())?;
        let (data, dropped) = (&reduction.data, reduction.dropped.len());
        let count = data.len();
        let title = format!(
            "trained {label} on {count} samples ({dropped} rows dropped), Δt = {step}; 100 noise-free tests"
        );
        let mut table = Table::new(title, COLUMNS);
        let mut enter_row = |name: &str, function: &dyn MomentumFunction| {
            table.rows.push(row(name, &evaluate(&map(function), &group, &tests, &test), None));
        };
        enter_row("x = 0", &Scaled { factor: 0.0, function: &body });
        enter_row("S = Δt·H", &Scaled { factor: step, function: &body });
        let training = TrainingOptions {
            widths: options.pick(vec![500, 500], vec![64, 64]),
            adam_steps: options.pick(250, 100),
            lbfgs_steps: 0,
            seed: options.seed(4),
            ..Default::default()
        };
        // Losses come in units of the variance of the targets, each weighted by the width of its coordinate.
        let weights = Scaling::of(&data.p).half_width.into_iter().map(|width| width * width);
        let weights: Vec<f64> = weights.collect();
        let squares: f64 = data.x.row_iter().zip(&weights).map(|(x, w)| w * x.variance()).sum();
        let unit = squares / weights.iter().sum::<f64>();
        let data_of = |data: &ReducedData| (data.p.clone(), data.x.clone());
        let (network, mut looks) = watched(&data_of(data), &data_of(&test), &training)?;
        looks.iter_mut().for_each(|look| *look = [look[0], unit * look[1], unit * look[2]]);
        enter_row(&format!("network, {} steps of Adam", training.adam_steps), &network);
        enter(&mut curve, "noise", columns, &looks);
        let selection = select_polynomial(data, 2..=6, options.seed(5))?;
        enter_row(&format!("cross-validated: {}", selection.best.name), &selection.model);
        let process = fit_gaussian_process(data, options.pick(300, 100))?;
        enter_row("Gaussian process", &process);
        report.tables.push(table);
    }
    report.curves.push(curve);
    let error = |row: &str| report.tables[1].number(row, 2);
    let network = error("network");
    let judged = [network / error("cross-validated"), error("x = 0") / network];
    report.judge("noise", "", &judged);
    Ok(report)
}
