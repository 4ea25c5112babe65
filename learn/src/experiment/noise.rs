//! Robustness against noise: 1000 samples, step 0.15, Gaussian noise.

use coadjoint::{Exponential, SO3};

use super::report::{Bound, Cell, Curve, Report, Table};
use super::run::RunOptions;
use super::task::{COLUMNS, row};
use crate::data::{PairRows, ReducedData, RowPolicy, Tolerances, reduce};
use crate::error::LearnError;
use crate::evaluate::evaluate;
use crate::function::{Generating, MomentumFunction, Scaled, Zero};
use crate::gaussian_process::{GaussianProcessOptions, fit_gaussian_process};
use crate::model::Model;
use crate::polynomial::{Scaling, SelectionOptions, select_polynomial};
use crate::truth::{MomentumBox, Quadratic, add_noise, phase_pairs};

pub(super) fn run(options: &RunOptions, say: &mut dyn FnMut(&str)) -> Result<Report, LearnError> {
    let mut report = options.report("noise");
    let group = SO3::new();
    let body = Quadratic::paper();
    let (step, samples) = (0.15, options.pick(1000, 200));
    // "Mean 0 and variance 0.05".
    let deviation = 0.05_f64.sqrt();
    let clean = phase_pairs(&group, &body, step, MomentumBox::PAPER, samples, options.seed(1));
    let noisy: PairRows<SO3> = add_noise(&group, &clean, deviation, options.seed(2)).into();
    let clean: PairRows<SO3> = clean.into();
    let test: PairRows<SO3> =
        phase_pairs(&group, &body, step, MomentumBox::PAPER, 100, options.seed(3)).into();
    let reduced = |pairs: &PairRows<SO3>| {
        reduce::<SO3, Exponential>(&group, pairs, Tolerances::unlimited(), RowPolicy::Drop)
    };
    let test_data = reduced(&test)?.data;
    for (label, pairs) in [("without noise", &clean), ("with noise", &noisy)] {
        say(&format!("noise: {label}"));
        let reduction = reduced(pairs)?;
        let title = format!(
            "trained {label} on {} samples ({} rows dropped), dt = {step}; 100 noise-free tests",
            reduction.data.len(),
            reduction.dropped.len()
        );
        let mut table = Table::new(title, &COLUMNS);
        let data = &reduction.data;
        let mut enter = |name: &str, function: &dyn MomentumFunction| {
            let map = Generating::<SO3, Exponential, _>::new(group, function);
            let figures = evaluate(&map, &group, &test, &test_data);
            table.push(row(name, &figures, None));
        };
        enter("x = 0", &Zero { dim: 3 });
        enter("S = dt H", &Scaled { factor: step, function: &body });
        for (name, model, curve) in networks(options, data, &test_data, label)? {
            enter(&name, &model);
            report.curves.push(curve);
        }
        let selection = SelectionOptions {
            seed: options.seed(5),
            degrees: (2..=6).collect(),
            ..Default::default()
        };
        let selection = select_polynomial(data, &selection)?;
        enter(&format!("cross-validated: {}", selection.best.name), &selection.model);
        let process = GaussianProcessOptions {
            largest: options.pick(300, 100),
            ..GaussianProcessOptions::default()
        };
        let process = fit_gaussian_process(data, &process)?;
        enter("Gaussian process", &process);
        report.tables.push(table);
    }
    let error = |table: usize, row: usize| match report.tables[table].rows[row][2] {
        Cell::Number(value) => value,
        Cell::Text(_) => f64::NAN,
    };
    let (still, noisy, selected) = (error(1, 0), error(1, 2), error(1, 3));
    report.judge(
        "noise",
        "noisy data: test error of the momentum by the network over that of the best polynomial",
        noisy / selected,
        Bound::AtMost(20.0),
    );
    report.judge(
        "noise",
        "noisy data: test error of the momentum without a model over that of the network",
        still / noisy,
        Bound::AtLeast(2.0),
    );
    report.notes.push(format!(
        "noise of variance 0.05 (deviation {deviation:.3}) on every coordinate of the momenta and, \
         as g exp(eta), of the attitudes; the paper shows that the noisy model still predicts, \
         without figures"
    ));
    Ok(report)
}

/// The network as in the paper, 250 steps of Adam, with its test error while it trains.
fn networks(
    options: &RunOptions,
    data: &ReducedData,
    test: &ReducedData,
    label: &str,
) -> Result<Vec<(String, Model, Curve)>, LearnError> {
    use crate::network::{TrainingOptions, fit_network_to_gradients};
    let training = TrainingOptions {
        widths: options.pick(vec![500, 500], vec![64, 64]),
        adam_steps: options.pick(250, 100),
        lbfgs_steps: 0,
        seed: options.seed(4),
        ..Default::default()
    };
    // Losses come in units of the variance of the targets, each weighted by the width of its coordinate.
    let scaling = Scaling::of(&data.p);
    let (mut squares, mut widths) = (0.0, 0.0);
    for (row, width) in data.x.row_iter().zip(&scaling.half_width) {
        squares += width * width * row.variance();
        widths += width * width;
    }
    let unit = squares / widths;
    let mut rows = Vec::new();
    let (network, _) = fit_network_to_gradients(
        &data.p,
        &data.x,
        Some((&test.p, &test.x)),
        &training,
        &mut |p| {
            if let Some(validation) = p.validation {
                rows.push(vec![p.step as f64, unit * p.loss, unit * validation]);
            }
        },
    )?;
    let name = format!("noise_{}", label.replace(' ', "_"));
    let columns = ["step", "train_mse", "test_mse"].map(Into::into).to_vec();
    let label = format!("network, {} steps of Adam", training.adam_steps);
    Ok(vec![(label, Model::Network(network), Curve { name, columns, rows })])
}
