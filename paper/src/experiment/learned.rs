//! The first figure of section 5.2: training with and without symmetry, and a learned trajectory.

use coadjoint::groups::Cayley;
use coadjoint::steps::advance;
use coadjoint::{Phase, SO3};
use coadjoint_learn::Generating;
use coadjoint_learn::data::PairRows;
use coadjoint_learn::network::{DenseNetwork, TrainingOptions, fit_network};
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use nalgebra::DMatrix;

use super::models::Task;
use super::{Options, type_two};
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::{Errors, START, State, exact};

/// The step of the data.
const STEP: f64 = 0.1;
/// Points and gradients.
pub type Samples = (DMatrix<f64>, DMatrix<f64>);

/// Trains a network; also the losses on the way: (step, loss, loss on the test samples).
pub fn watched(
    train: &Samples,
    test: &Samples,
    training: &TrainingOptions,
) -> Fallible<(DenseNetwork, Vec<[f64; 3]>)> {
    let mut looks = Vec::new();
    let test = Some((&test.0, &test.1));
    let (network, _) = fit_network(&train.0, &train.1, test, training, &mut |now| {
        looks.extend(now.validation.map(|loss| [now.step as f64, now.loss, loss]));
    })?;
    Ok((network, looks))
}

/// Adds losses to a curve over the steps, which it begins with the first ones.
pub fn enter(curve: &mut Curve, name: &str, columns: [&str; 2], looks: &[[f64; 3]]) {
    if curve.rows.is_empty() {
        *curve = Curve::over(name, "step", looks.iter().map(|look| look[0]));
    }
    curve.add(columns[0], looks.iter().map(|look| look[1]));
    curve.add(columns[1], looks.iter().map(|look| look[2]));
}

/// The same pairs as samples to fit and to test, with symmetry and without.
fn samples(
    options: &Options,
    momenta: MomentumBox,
    count: usize,
    seed: u64,
) -> Fallible<[[Samples; 2]; 2]> {
    let group = SO3::new();
    let pairs = |count, seed| -> PairRows<SO3> {
        phase_pairs(&group, &Quadratic::paper(), STEP, momenta, count, options.seed(seed)).into()
    };
    let (train, tests) = (pairs(count, seed), pairs(100, seed + 1));
    let without = [type_two::data(&train)?, type_two::data(&tests)?];
    let Task { train, test, .. } = Task::new::<Cayley>(options, &group, &train, tests)?;
    Ok([[(train.p, train.x), (test.p, test.x)], without])
}

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("learned");
    training(options, &mut report)?;
    trajectory(options, &mut report)?;
    Ok(report)
}

fn training(options: &Options, report: &mut Report) -> Fallible<()> {
    let count = options.pick(500, 200);
    let training = TrainingOptions {
        widths: options.pick(vec![500, 500], vec![64, 64]),
        adam_steps: options.pick(1000, 500),
        final_fraction: 1.0,
        lbfgs_steps: 0,
        seed: options.seed(3),
        ..TrainingOptions::default()
    };
    let title = format!("losses of Adam, Δt = {STEP}, {count} samples in [0, 6]³, Cayley");
    let mut table = Table::new(title, "model | first test loss | last loss | last test loss");
    let mut curve = Curve::default();
    let models = [
        ("with symmetry", ["train", "test"]),
        ("without, type II", ["train_type_two", "test_type_two"]),
    ];
    for ([train, test], (name, columns)) in
        samples(options, MomentumBox::PAPER, count, 1)?.iter().zip(models)
    {
        eprintln!("  Adam {name}");
        let looks = watched(train, test, &training)?.1;
        let (first, last) = (looks.first().ok_or("no step")?, looks.last().ok_or("no step")?);
        table.rows.push(row![name, first[2], last[1], last[2]]);
        enter(&mut curve, "training", columns, &looks);
    }
    report.judge("training", "", &[table.number("without", 3) / table.number("with s", 3)]);
    report.curves.push(curve);
    report.tables.push(table);
    Ok(())
}

/// The states along a map, as far as it goes.
fn follow(count: usize, step: impl Fn(&Phase<SO3>) -> Option<Phase<SO3>>) -> Vec<State> {
    let next = |phase: &Phase<SO3>| step(phase).filter(|next| next.momentum.norm() < 1e3);
    let phases = std::iter::successors(Some(Phase::<SO3>::at_identity(START)), next);
    phases.take(count + 1).map(|phase| State::of(&SO3::new(), &phase)).collect()
}

fn trajectory(options: &Options, report: &mut Report) -> Fallible<()> {
    let steps = options.pick(5000, 1000);
    let wide = MomentumBox { low: -3.0, high: 3.0 };
    let training = TrainingOptions {
        widths: vec![64, 64],
        lbfgs_steps: options.pick(950, 350),
        seed: options.seed(13),
        ..TrainingOptions::default()
    };
    eprintln!("  networks for a trajectory");
    let [symmetric, plain] = samples(options, wide, 500, 11)?.map(|[train, _]| {
        fit_network(&train.0, &train.1, None, &training, &mut |_| {}).map(|fit| fit.0)
    });
    let (symmetric, plain) = (symmetric?, plain?);
    let exact = exact(START, STEP, steps);
    let map = Generating::<SO3, Cayley, _>::new(SO3::new(), &symmetric);
    let ours = follow(steps, |phase| {
        let mut next = phase.clone();
        advance(&map, &mut next).ok()?;
        Some(next)
    });
    let theirs = follow(steps, |phase| type_two::advance(&plain, phase));
    let title = format!(
        "largest errors over {steps} steps of {STEP} from (2, 0.5, 1); networks 64-64, 500 samples in [-3, 3]³"
    );
    let columns = "model | steps made | relative energy | momentum J | distance";
    let mut table = Table::new(title, columns);
    let mut curve = Curve::over("trajectory", "t", (0..=steps).map(|i| i as f64 * STEP));
    let whole = ours.len() == exact.len();
    for (name, key, states) in
        [("with symmetry", "symmetric", ours), ("without, type II", "type_two", theirs)]
    {
        let along = Errors::of(&states, &exact);
        let ([energy, momentum, distance], made) = (along.largest(), (states.len() - 1) as f64);
        table.rows.push(row![name, made, energy, momentum, distance]);
        along.enter(&mut curve, key, "momentum");
    }
    let momentum = if whole { table.number("with s", 3) } else { f64::NAN };
    report.judge("trajectory", "", &[momentum, table.number("with s", 2)]);
    report.tables.push(table);
    report.curves.push(curve);
    Ok(())
}
