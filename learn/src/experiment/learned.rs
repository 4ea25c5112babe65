//! Learning as in the paper's figure: training with and without symmetry, and a learned trajectory.

use coadjoint::{Cayley, Phase, SO3, advance};
use nalgebra::{DMatrix, Vector3};

use super::report::{Bound, Curve, Report, Table};
use super::run::RunOptions;
use crate::data::{PairRows, RowPolicy, Tolerances, reduce};
use crate::error::LearnError;
use crate::function::{Generating, MomentumFunction};
use crate::group::matrix_of;
use crate::network::{DenseNetwork, TrainingOptions, fit_network_to_gradients};
use crate::truth::{MomentumBox, Quadratic, exact_flow, phase_pairs};
use crate::type_two::{TypeTwo, type_two_data};

/// The step of the data.
const STEP: f64 = 0.1;

/// Points and gradients to fit, and to watch.
struct Data {
    train: (DMatrix<f64>, DMatrix<f64>),
    test: (DMatrix<f64>, DMatrix<f64>),
}

impl Data {
    /// Losses of Adam at the paper's rate, as (step, loss, loss on the test points); the mean squared errors are these
    /// times the variances given with them.
    fn watch(&self, training: &TrainingOptions) -> Result<Vec<[f64; 3]>, LearnError> {
        let mut rows = Vec::new();
        let (points, gradients) = &self.train;
        let test = Some((&self.test.0, &self.test.1));
        fit_network_to_gradients(points, gradients, test, training, &mut |progress| {
            if let Some(validation) = progress.validation {
                rows.push([progress.step as f64, progress.loss, validation]);
            }
        })?;
        Ok(rows)
    }

    fn network(&self, training: &TrainingOptions) -> Result<DenseNetwork, LearnError> {
        let (points, gradients) = &self.train;
        Ok(fit_network_to_gradients(points, gradients, None, training, &mut |_| {})?.0)
    }
}

/// The same pairs as data with symmetry, and without.
fn data(
    group: &SO3,
    options: &RunOptions,
    momenta: MomentumBox,
    (samples, seed): (usize, u64),
) -> Result<[Data; 2], LearnError> {
    let body = Quadratic::paper();
    let pairs = |count, seed| -> PairRows<SO3> {
        phase_pairs(group, &body, STEP, momenta, count, options.seed(seed)).into()
    };
    let (train, test) = (pairs(samples, seed), pairs(100, seed + 1));
    let reduced = |pairs: &PairRows<SO3>| {
        let data =
            reduce::<SO3, Cayley>(group, pairs, Tolerances::default(), RowPolicy::Refuse)?.data;
        Ok::<_, LearnError>((data.p, data.x))
    };
    let symmetric = Data { train: reduced(&train)?, test: reduced(&test)? };
    let both = |pairs| type_two_data::<SO3, Cayley>(group, pairs);
    Ok([symmetric, Data { train: both(&train)?, test: both(&test)? }])
}

/// Errors along a trajectory: energy (signed, relative), largest of J_L, distance from the exact flow.
fn along(
    group: &SO3,
    exact: &[Phase<SO3>],
    mut step: impl FnMut(&Phase<SO3>) -> Option<Phase<SO3>>,
) -> Vec<[f64; 3]> {
    let body = Quadratic::paper();
    let energy = |mu: &Vector3<f64>| body.value(mu.as_slice());
    let (first, spatial) = (energy(&exact[0].momentum), exact[0].spatial_momentum(group));
    let mut phase = exact[0].clone();
    let mut rows = vec![[0.0; 3]];
    for expected in &exact[1..] {
        let Some(next) = step(&phase).filter(|next| next.momentum.norm() < 1e3) else { break };
        phase = next;
        let turned =
            matrix_of(group, &phase.group_element) - matrix_of(group, &expected.group_element);
        let moved = phase.momentum - expected.momentum;
        rows.push([
            energy(&phase.momentum) / first - 1.0,
            (phase.spatial_momentum(group) - spatial).amax(),
            (turned.norm_squared() + moved.norm_squared()).sqrt(),
        ]);
    }
    rows
}

pub(super) fn run(options: &RunOptions, say: &mut dyn FnMut(&str)) -> Result<Report, LearnError> {
    let mut report = options.report("learned");
    let group = SO3::new();
    let samples = options.pick(500, 200);
    training(options, &group, samples, say, &mut report)?;
    trajectory(options, &group, say, &mut report)?;
    report.notes.push(
        "training: the paper's box, Cayley's chart, Adam at a constant rate of 0.001, a network of \
         the paper's width (quick: 64-64); losses in units of the variance of the data, so that 1 \
         is the best constant"
            .into(),
    );
    report.notes.push(
        "trajectories: every motion of a free body leaves the octant [0, 6]^3 of the paper's \
         samples, so these models saw [-3, 3]^3; networks 64-64 by 50 evaluations of Adam and the \
         rest of L-BFGS. The model without symmetry saw attitudes exp(y), |y_i| <= 1, as the others; \
         its trajectory ends where its map has no solution"
            .into(),
    );
    Ok(report)
}

fn training(
    options: &RunOptions,
    group: &SO3,
    samples: usize,
    say: &mut dyn FnMut(&str),
    report: &mut Report,
) -> Result<(), LearnError> {
    let title = format!("losses of Adam, dt = {STEP}, {samples} samples in [0, 6]^3, Cayley");
    if report.has(&title) {
        return Ok(());
    }
    let both = data(group, options, MomentumBox::PAPER, (samples, 1))?;
    let training = TrainingOptions {
        widths: options.pick(vec![500, 500], vec![64, 64]),
        adam_steps: options.pick(1000, 500),
        final_fraction: 1.0,
        lbfgs_steps: 0,
        seed: options.seed(3),
        ..TrainingOptions::default()
    };
    let mut histories = Vec::new();
    let mut table = Table::new(title, &["model", "first test loss", "last loss", "last test loss"]);
    for (name, data) in ["with symmetry", "without, type II"].into_iter().zip(&both) {
        say(&format!("learned: Adam {name}"));
        let history = data.watch(&training)?;
        let last = history.last().copied().unwrap_or_default();
        let first = history.first().copied().unwrap_or_default();
        table.push(vec![name.into(), first[2].into(), last[1].into(), last[2].into()]);
        histories.push(history);
    }
    let last = |k: usize| histories[k].last().map_or(f64::NAN, |row| row[2]);
    report.judge(
        "training",
        "test loss after the last step: without symmetry over with it",
        last(1) / last(0),
        Bound::AtLeast(2.0),
    );
    let names = ["step", "train", "test", "train_type_two", "test_type_two"];
    let rows = histories[0].iter().zip(&histories[1]);
    report.curves.push(Curve {
        name: "training".into(),
        columns: names.map(Into::into).to_vec(),
        rows: rows.map(|(a, b)| vec![a[0], a[1], a[2], b[1], b[2]]).collect(),
    });
    report.tables.push(table);
    options.keep(report)
}

fn trajectory(
    options: &RunOptions,
    group: &SO3,
    say: &mut dyn FnMut(&str),
    report: &mut Report,
) -> Result<(), LearnError> {
    let steps = options.pick(5000, 1000);
    let wide = MomentumBox { low: -3.0, high: 3.0 };
    let [symmetric, plain] = data(group, options, wide, (500, 11))?;
    let training = TrainingOptions {
        widths: vec![64, 64],
        lbfgs_steps: options.pick(950, 350),
        seed: options.seed(13),
        ..TrainingOptions::default()
    };
    say("learned: networks for a trajectory");
    let network = symmetric.network(&training)?;
    let without = TypeTwo { function: plain.network(&training)? };
    let body = Quadratic::paper();
    let mut exact = vec![Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0))];
    for i in 0..steps {
        let next = exact_flow(group, &body, &exact[i], STEP);
        exact.push(next);
    }
    let map = Generating::<SO3, Cayley, &dyn MomentumFunction>::new(*group, &network);
    let ours = along(group, &exact, |phase| {
        let mut next = phase.clone();
        advance(&map, &mut next).ok()?;
        Some(next)
    });
    let theirs = along(group, &exact, |phase| without.advance::<SO3, Cayley>(group, phase));
    let title = format!(
        "largest errors over {steps} steps of {STEP} from (2, 0.5, 1); networks 64-64, 500 samples in [-3, 3]^3"
    );
    let columns = ["model", "steps made", "relative energy", "momentum J_L", "distance"];
    let mut table = Table::new(title, &columns);
    let mut names = vec!["t".to_owned()];
    let mut rows: Vec<Vec<f64>> = (0..=steps).map(|i| vec![i as f64 * STEP]).collect();
    for (name, key, errors) in
        [("with symmetry", "symmetric", &ours), ("without, type II", "type_two", &theirs)]
    {
        let largest = |k: usize| errors.iter().map(|e| e[k].abs()).fold(0.0, f64::max);
        let made = (errors.len() - 1) as f64;
        let figures = [made, largest(0), largest(1), largest(2)].map(Into::into);
        table.push(std::iter::once(name.into()).chain(figures).collect());
        names.extend(["energy", "momentum", "distance"].map(|q| format!("{key}_{q}")));
        for (i, row) in rows.iter_mut().enumerate() {
            row.extend(errors.get(i).copied().unwrap_or([f64::NAN; 3]));
        }
    }
    let largest = |k: usize| ours.iter().map(|e| e[k].abs()).fold(0.0, f64::max);
    let whole = if ours.len() == exact.len() { largest(1) } else { f64::NAN };
    report.judge(
        "trajectory",
        "largest error of J_L, learned with symmetry",
        whole,
        Bound::AtMost(1e-12),
    );
    report.judge(
        "trajectory",
        "largest relative energy error, learned with symmetry",
        largest(0),
        Bound::AtMost(1e-2),
    );
    report.tables.push(table);
    report.curves.push(Curve { name: "trajectory".into(), columns: names, rows });
    Ok(())
}
