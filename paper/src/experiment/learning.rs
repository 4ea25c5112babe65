//! Learning with symmetry and without, on exact data and on noisy ones, and on harder truths.

use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::steps::advance;
use coadjoint::{Phase, SE3, SO3};
use coadjoint_learn::data::{PairRows, ReducedData, RowPolicy, TOLERANCE, reduce};
use coadjoint_learn::network::{DenseNetwork, TrainingOptions, fit_network};
use coadjoint_learn::polynomial::{
    Basis, Scaling, fit_gradients, fit_polynomial, select_polynomial,
};
use coadjoint_learn::truth::{Bump, MomentumBox, Relativistic, Separable, add_noise, phase_pairs};
use coadjoint_learn::{
    DataGroup, Figures, Generating, MomentumFunction, Scaled, evaluate, evaluate_with,
    fit_gaussian_process, fit_hybrid,
};
use nalgebra::DMatrix;
use serde_json::Value;

use super::poisson::map;
use super::type_two;
use crate::outcome::{CHECKPOINT, Config, Curve, Fallible, Report, Tabulation, row};
use crate::state::{Errors, START, State, exact};

const COLUMNS: &str = "model | mse x | mse momentum | mse group | max x | max momentum | max group | unsolved | paper's mse";

/// The row of a model; the last cell is the paper's error, where there is one.
fn model_row(name: impl Into<Value>, figures: &Figures, paper: Option<f64>) -> Vec<Value> {
    let unsolved = figures.unsolved.len() as f64;
    let errors = [&figures.mse, &figures.max_error];
    let errors = errors.into_iter().flat_map(|e| [e.x, e.momentum, e.group]).map(Value::from);
    std::iter::once(name.into()).chain(errors).chain(row![unsolved, paper]).collect()
}

/// Pairs to fit and to test, with their reductions in a chart, and how networks are trained on them.
struct Task<'a, G: DataGroup> {
    options: &'a Config,
    group: G,
    train: ReducedData,
    tests: PairRows<G>,
    test: ReducedData,
    seed: u64,
    /// The name their checkpoints begin with, which begins with the experiment's.
    label: String,
    /// True for networks as wide as the paper's in the full version.
    wide: bool,
}

impl<'a, G: DataGroup> Task<'a, G> {
    /// The task of these pairs; networks have the seed 0 and no name.
    fn new<C: Chart<G>>(
        options: &'a Config,
        group: &G,
        train: &PairRows<G>,
        tests: PairRows<G>,
    ) -> Fallible<Self> {
        let reduced = |pairs: &PairRows<G>| {
            reduce::<G, C>(group, pairs, TOLERANCE, RowPolicy::Refuse).map(|r| r.data)
        };
        let (train, test, group) = (reduced(train)?, reduced(&tests)?, group.clone());
        Ok(Self { options, group, train, tests, test, seed: 0, label: String::new(), wide: false })
    }

    /// The paper's network and budget, or a small one, which loses little and takes a fortieth of the time.
    fn training(&self, name: &str, wide: bool) -> TrainingOptions {
        let file = format!("{}.{name}.{CHECKPOINT}", self.label);
        let checkpoint = self.options.out.as_ref().map(|folder| folder.join(file));
        let full = TrainingOptions { seed: self.seed, checkpoint, ..Default::default() };
        if wide && self.wide && !self.options.quick {
            return full;
        }
        let lbfgs_steps = self.options.pick(950, 350);
        TrainingOptions { widths: vec![64, 64], adam_steps: 50, lbfgs_steps, ..full }
    }

    fn figures<C: Chart<G>>(&self, function: &dyn MomentumFunction) -> Figures {
        let map = Generating::<G, C, _>::new(self.group.clone(), function);
        evaluate(&map, &self.group, &self.tests, &self.test)
    }

    /// The answers that need no data, a network, and a hybrid of degree 2.
    fn begin<C: Chart<G>>(
        &self,
        truth: &impl MomentumFunction,
        step: f64,
        paper: Option<f64>,
        table: &mut Tabulation,
    ) -> Fallible<()> {
        let mut enter = |name: &str, function: &dyn MomentumFunction, paper: Option<f64>| {
            table.rows.push(model_row(name, &self.figures::<C>(function), paper));
        };
        enter("x = 0, μ″ = μ′", &Scaled { factor: 0.0, function: truth }, None);
        enter("S = Δt·H", &Scaled { factor: step, function: truth }, None);
        eprintln!("  network");
        let (p, x) = (&self.train.p, &self.train.x);
        let network = fit_network(p, x, None, &self.training("network", true), &mut |_| {})?.0;
        enter("network, symmetric", &network, paper);
        eprintln!("  hybrid");
        let hybrid = fit_hybrid(p, x, 2, &self.training("hybrid", false), &mut |_| {})?.0;
        enter("hybrid, symmetric", &hybrid, None);
        Ok(())
    }

    /// Polynomials of the degrees that the samples determine.
    fn polynomials<C: Chart<G>>(&self, degrees: &[usize], remark: &str, table: &mut Tabulation) {
        for &degree in degrees.iter().filter(|d| Basis::size(self.group.dim(), **d) <= 1000) {
            if let Ok(model) = fit_polynomial(&self.train, degree, 0.0) {
                let name = format!("polynomial degree {degree}{remark}");
                table.rows.push(model_row(name, &self.figures::<C>(&model), None));
            }
        }
    }

    /// A Gaussian process of at most this number of samples.
    fn gaussian_process<C: Chart<G>>(
        &self,
        largest: usize,
        table: &mut Tabulation,
    ) -> Fallible<()> {
        eprintln!("  Gaussian process");
        let process = fit_gaussian_process(&self.train, largest)?;
        table.rows.push(model_row("Gaussian process", &self.figures::<C>(&process), None));
        Ok(())
    }
}

const LEARNED_STEP: f64 = 0.1;
type Samples = (DMatrix<f64>, DMatrix<f64>);

/// Trains a network; also the losses on the way: (step, loss, loss on the test samples).
fn watched(
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
fn enter(curve: &mut Curve, name: &str, columns: [&str; 2], looks: &[[f64; 3]]) {
    if curve.rows.is_empty() {
        *curve = Curve::over(name, "step", looks.iter().map(|look| look[0]));
    }
    curve.add(columns[0], looks.iter().map(|look| look[1]));
    curve.add(columns[1], looks.iter().map(|look| look[2]));
}

/// Samples to fit and to test from one set of pairs: with symmetry, and without.
fn samples(
    options: &Config,
    momenta: MomentumBox,
    count: usize,
    seed: u64,
) -> Fallible<[[Samples; 2]; 2]> {
    let group = SO3::new();
    let pairs = |count, seed| -> PairRows<SO3> {
        phase_pairs(&group, &Separable::paper(), LEARNED_STEP, momenta, count, options.seed(seed))
            .into()
    };
    let (train, tests) = (pairs(count, seed), pairs(100, seed + 1));
    let without = [type_two::data(&train)?, type_two::data(&tests)?];
    let Task { train, test, .. } = Task::new::<Cayley>(options, &group, &train, tests)?;
    Ok([[(train.p, train.x), (test.p, test.x)], without])
}

/// The first figure of section 5.2: training with and without symmetry, and a learned trajectory.
pub fn learned(options: &Config) -> Fallible<Report> {
    let mut report = options.report("learned");
    training(options, &mut report)?;
    trajectory(options, &mut report)?;
    Ok(report)
}

fn training(options: &Config, report: &mut Report) -> Fallible<()> {
    let count = options.pick(500, 200);
    let training = TrainingOptions {
        widths: options.pick(vec![500, 500], vec![64, 64]),
        adam_steps: options.pick(1000, 500),
        final_fraction: 1.0,
        lbfgs_steps: 0,
        seed: options.seed(3),
        ..TrainingOptions::default()
    };
    let title = format!("losses of Adam, Δt = {LEARNED_STEP}, {count} samples in [0, 6]³, Cayley");
    let mut table = Tabulation::new(title, "model | first test loss | last loss | last test loss");
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

fn trajectory(options: &Config, report: &mut Report) -> Fallible<()> {
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
    let exact = exact(START, LEARNED_STEP, steps);
    let map = Generating::<SO3, Cayley, _>::new(SO3::new(), &symmetric);
    let ours = follow(steps, |phase| {
        let mut next = phase.clone();
        advance(&map, &mut next).ok()?;
        Some(next)
    });
    let theirs = follow(steps, |phase| type_two::advance(&plain, phase));
    let title = format!(
        "largest errors over {steps} steps of {LEARNED_STEP} from (2, 0.5, 1); networks 64-64, 500 samples in [-3, 3]³"
    );
    let columns = "model | steps made | relative energy | momentum J | distance";
    let mut table = Tabulation::new(title, columns);
    let mut curve = Curve::over("trajectory", "t", (0..=steps).map(|i| i as f64 * LEARNED_STEP));
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

/// Robustness against noise: 1000 samples, step 0.15, Gaussian noise of variance 0.05.
pub fn noise(options: &Config) -> Fallible<Report> {
    let mut report = options.report("noise");
    let (group, body) = (SO3::new(), Separable::paper());
    let (step, samples) = (0.15, options.pick(1000, 200));
    let pairs = |count, seed| phase_pairs(&group, &body, step, MomentumBox::PAPER, count, seed);
    let clean = pairs(samples, options.seed(1));
    let noisy = add_noise(&group, &clean, 0.05_f64.sqrt(), options.seed(2));
    let tests: PairRows<SO3> = pairs(100, options.seed(3)).into();
    let reduced = |pairs: &PairRows<SO3>| {
        reduce::<SO3, Exponential>(&group, pairs, f64::INFINITY, RowPolicy::Drop)
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
        let count = data.count();
        let title = format!(
            "trained {label} on {count} samples ({dropped} rows dropped), Δt = {step}; 100 noise-free tests"
        );
        let mut table = Tabulation::new(title, COLUMNS);
        let mut enter_row = |name: &str, function: &dyn MomentumFunction| {
            table.rows.push(model_row(
                name,
                &evaluate(&map(function), &group, &tests, &test),
                None,
            ));
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

/// Step, samples, and the paper's test errors, with symmetry and without.
const TABLE_ONE: [(f64, usize, f64, f64); 4] = [
    (0.05, 100, 0.0024, 0.0202),
    (0.05, 500, 0.0012, 0.0063),
    (0.1, 500, 0.0042, 0.0429),
    (0.1, 1500, 0.0002, 0.0482),
];

/// Table 1: learning with symmetry against the baseline without it.
pub fn table_one(options: &Config) -> Fallible<Report> {
    let mut report = options.report("table-1");
    let (group, body) = (SO3::new(), Separable::paper());
    for (number, &(step, samples, paper, paper_without)) in TABLE_ONE.iter().enumerate() {
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
        let mut table = Tabulation::new(title, COLUMNS);
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
    table: &mut Tabulation,
) -> Fallible<()> {
    eprintln!("  without symmetry");
    let (points, gradients) = type_two::data(train)?;
    let mut enter = |name: &str, function: &dyn MomentumFunction, paper: Option<f64>| {
        let map = |phase: &_| type_two::advance(function, phase);
        let figures = evaluate_with(&task.group, &task.tests, map);
        table.rows.push(model_row(format!("type II, not symmetric: {name}"), &figures, paper));
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

/// Truths on which the linear model has something to lose.
pub fn harder(options: &Config) -> Fallible<Report> {
    let mut report = options.report("harder-truths");
    let (group, body) = (SO3::new(), vec![1.0 / 1.5, 0.5, 0.4]);
    let quartic = Separable { quartic: vec![0.3, 0.1, 0.2], ..Separable::quadratic(body.clone()) };
    let root = Relativistic { weights: body.clone(), ripple: 0.3 };
    let (sharpness, centre) = (vec![1.2, 0.7, 0.9], vec![0.5, -0.3, 0.8]);
    let bump = Bump { weights: body, height: 1.5, sharpness, centre };
    let top = Separable::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]);
    report.tables = vec![
        learn_harder(options, &group, &quartic, ("quartic H on so(3)*", 0.1, 40))?,
        learn_harder(options, &group, &root, ("square-root H on so(3)*", 0.1, 50))?,
        learn_harder(options, &group, &bump, ("Gaussian bump H on so(3)*", 0.1, 70))?,
        learn_harder(options, &group, &bump, ("Gaussian bump H on so(3)*", 0.4, 80))?,
        learn_harder(options, &SE3::new(), &top, ("heavy top on se(3)*", 0.1, 60))?,
    ];
    let over = |table: &Tabulation, name: &str| {
        table.number(name, 1) / table.number("Gaussian process", 1)
    };
    let least = report.tables.iter().map(|t| over(t, "x = 0")).fold(f64::INFINITY, f64::min);
    let linear = over(&report.tables[3], "cross-validated");
    report.judge("harder-truths", "", &[least, linear]);
    Ok(report)
}

fn learn_harder<G: DataGroup>(
    options: &Config,
    group: &G,
    truth: &impl MomentumFunction,
    (name, step, first_seed): (&str, f64, u64),
) -> Fallible<Tabulation> {
    let count = options.pick(500, 150);
    eprintln!("  {name}, Δt = {step}, {count} samples");
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let seed = |k| options.seed(first_seed + k);
    let pairs =
        |count, k| -> PairRows<G> { phase_pairs(group, truth, step, wide, count, seed(k)).into() };
    let task = Task::new::<Exponential>(options, group, &pairs(count, 1), pairs(100, 2))?;
    let task = Task { seed: seed(3), label: format!("harder-truths.{first_seed}"), ..task };
    let title = format!("{name}, Δt = {step}, {count} samples, momenta in [-2, 2]^n, exponential");
    let mut table = Tabulation::new(title, COLUMNS);
    task.begin::<Exponential>(truth, step, None, &mut table)?;
    task.polynomials::<Exponential>(&[2, 4, 6, 8], "", &mut table);
    let selection = select_polynomial(&task.train, 2..=10, seed(4))?;
    let figures = task.figures::<Exponential>(&selection.model);
    table.rows.push(model_row(format!("cross-validated: {}", selection.best.name), &figures, None));
    task.gaussian_process::<Exponential>(options.pick(400, 150), &mut table)?;
    Ok(table)
}
