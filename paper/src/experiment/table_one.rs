//! Table 1: learning with symmetry against the baseline without it.

use coadjoint::SO3;
use coadjoint::groups::{Cayley, Exponential};
use coadjoint_learn::data::PairRows;
use coadjoint_learn::network::fit_network;
use coadjoint_learn::polynomial::fit_gradients;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use coadjoint_learn::{MomentumFunction, evaluate_with, fit_hybrid};

use super::models::{COLUMNS, Task, row};
use super::{Options, type_two};
use crate::outcome::{Fallible, Report, Table};

/// Step, samples, and the paper's test errors, with symmetry and without.
const CELLS: [(f64, usize, f64, f64); 4] = [
    (0.05, 100, 0.0024, 0.0202),
    (0.05, 500, 0.0012, 0.0063),
    (0.1, 500, 0.0042, 0.0429),
    (0.1, 1500, 0.0002, 0.0482),
];

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("table-1");
    let (group, body) = (SO3::new(), Quadratic::paper());
    for (number, &(step, samples, paper, paper_without)) in CELLS.iter().enumerate() {
        if options.quick && number != 2 {
            continue;
        }
        let count = options.pick(samples, samples.min(200));
        let seed = |k: u64| options.seed(10 * number as u64 + k);
        eprintln!("  Δt = {step}, {count} samples");
        let pairs = |count, k| -> PairRows<SO3> {
            phase_pairs(&group, &body, step, MomentumBox::PAPER, count, seed(k)).into()
        };
        let (train, tests) = (pairs(count, 1), pairs(100, 2));
        let title =
            format!("Δt = {step}, {count} samples, momenta in [0, 6]³, 100 test points, Cayley");
        let mut table = Table::new(title, COLUMNS);
        let exponential = Task::new::<Exponential>(options, &group, &train, tests.clone())?;
        let cayley = Task::new::<Cayley>(options, &group, &train, tests)?;
        let label = format!("table-1.{number}");
        let cayley = Task { seed: seed(3), label, wide: true, ..cayley };
        cayley.begin::<Cayley>(&body, step, Some(paper), &mut table)?;
        baseline(&cayley, &train, paper_without, &mut table)?;
        cayley.polynomials::<Cayley>(&[2, 4, 6, 8], "", &mut table);
        exponential.polynomials::<Exponential>(&[4, 6, 8], ", exp chart", &mut table);
        cayley.gaussian_process::<Cayley>(options.pick(400, 150), &mut table)?;
        let ours = table.number("network, symmetric", 2);
        let theirs = table.number("type II, not symmetric: network", 2);
        let of = format!("Δt = {step}, {count} samples: ");
        report.judge("table-1", &of, &[ours / paper, theirs / ours]);
        report.tables.push(table);
    }
    Ok(report)
}

/// The models without symmetry: every kind that the side with it has.
fn baseline(
    task: &Task<'_, SO3>,
    train: &PairRows<SO3>,
    paper: f64,
    table: &mut Table,
) -> Fallible<()> {
    eprintln!("  without symmetry");
    let (points, gradients) = type_two::data(train)?;
    let mut enter = |name: &str, function: &dyn MomentumFunction, paper: Option<f64>| {
        let map = |phase: &_| type_two::advance(function, phase);
        let figures = evaluate_with(&task.group, &task.tests, map);
        table.rows.push(row(format!("type II, not symmetric: {name}"), &figures, paper));
    };
    let training = task.training("baseline", true);
    let (network, _) = fit_network(&points, &gradients, None, &training, &mut |_| {})?;
    enter("network", &network, Some(paper));
    let training = task.training("baseline-hybrid", false);
    let (hybrid, _) = fit_hybrid(&points, &gradients, 2, &training, &mut |_| {})?;
    enter("hybrid", &hybrid, None);
    for degree in [2, 4, 6] {
        // Six coordinates: degree 6 has 923 coefficients.
        if let Ok(model) = fit_gradients(&points, &gradients, degree, 0.0) {
            enter(&format!("polynomial degree {degree}"), &model, None);
        }
    }
    Ok(())
}
