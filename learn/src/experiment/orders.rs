//! The order of each truncation, and the two charts beside each other, by K and step size.

use coadjoint::{Phase, SE3, SO3};
use coadjoint_codegen::lie::Chart;

use super::report::{Bound, Cell, Curve, Report, Table};
use super::run::RunOptions;
use super::steps::{End, HEAVY_TOP, RIGID_BODY, Steps};
use crate::error::LearnError;
use crate::function::{MomentumFunction, entries, vector};
use crate::group::{DataGroup, matrix_of};
use crate::truth::{Quadratic, exact_flow};

/// The duration of a run.
const DURATION: f64 = 8.0;
/// Steps of a run.
const COUNTS: [u64; 13] = [5, 8, 10, 16, 20, 32, 40, 64, 80, 128, 160, 320, 640];
/// Step sizes of single steps.
const SINGLE: [f64; 10] = [0.025, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2];
/// Errors from which an order is read: above rounding, below where higher terms count.
const READABLE: std::ops::Range<f64> = 1e-12..5e-2;

/// The state of the exact flow.
fn truth<G: DataGroup>(
    group: &G,
    body: &impl MomentumFunction,
    start: &[f64],
    time: f64,
) -> (Vec<f64>, Vec<f64>) {
    let phase = exact_flow(group, body, &Phase::new(group.identity(), vector::<G>(start)), time);
    let matrix = matrix_of(group, &phase.group_element);
    (entries(&phase.momentum), matrix.transpose().iter().copied().collect())
}

/// The largest difference of a coordinate or an entry; none where there is no state.
fn error(found: Option<End>, (momentum, matrix): &(Vec<f64>, Vec<f64>)) -> f64 {
    let Some(found) = found else { return f64::NAN };
    let pairs = found.momentum.iter().zip(momentum).chain(found.matrix.iter().zip(matrix));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The error of a step, or that it was refused.
fn made(error: f64) -> Cell {
    if error.is_nan() { "refused".into() } else { error.into() }
}

/// The slope at the smallest steps whose errors can be read.
fn order(steps: &[f64], errors: &[f64]) -> Option<f64> {
    let points = || (1..steps.len()).rev();
    let fine =
        points().find(|&i| READABLE.contains(&errors[i]) && READABLE.contains(&errors[i - 1]))?;
    Some((errors[fine - 1] / errors[fine]).ln() / (steps[fine - 1] / steps[fine]).ln())
}

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("orders");
    let counts = options.pick(&COUNTS[..], &COUNTS[..11]);
    let steps: Vec<f64> = counts.iter().map(|&n| DURATION / n as f64).collect();
    let (body, start) = (Quadratic::paper(), [2.0, 0.5, 1.0]);
    let top = Quadratic::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]);
    let top_start = [0.7, -0.4, 1.1, 0.0, 0.6, 0.8];
    let so3 = |time| truth(&SO3::new(), &body, &start, time);
    let se3 = |time| truth(&SE3::new(), &top, &top_start, time);

    let mut long = Curve { name: "orders".into(), columns: vec!["h".into()], rows: Vec::new() };
    long.rows = steps.iter().map(|&h| vec![h]).collect();
    let mut single = Curve { name: "charts".into(), columns: vec!["h".into()], rows: Vec::new() };
    single.rows = SINGLE.iter().map(|&h| vec![h]).collect();
    let mut orders = Table::new(
        format!("order of accuracy measured over T = {DURATION}; K + 1 is expected"),
        &["K", "K + 1", "free body, Cayley", "free body, exp", "heavy top, exp"],
    );
    let columns = ["K", "h", "Cayley", "exp", "Cayley over exp"];
    let mut charts = Table::new("error of one step of the free body", &columns);
    let mut furthest: f64 = 0.0;
    let exact = so3(DURATION);
    let exact_top = se3(DURATION);
    let exact_single: Vec<_> = SINGLE.iter().map(|&h| so3(h)).collect();
    for truncation in [1, 3, 5, 7, 9] {
        let mut cells = vec![(truncation as f64).into(), (truncation as f64 + 1.0).into()];
        let mut ones = Vec::new();
        for (name, chart, top) in [
            ("cayley", Chart::Cayley, false),
            ("exp", Chart::Exponential, false),
            ("top", Chart::Exponential, true),
        ] {
            if top && truncation > 7 {
                cells.push("-".into());
                continue;
            }
            let (system, start): (_, &[f64]) =
                if top { (HEAVY_TOP, &top_start) } else { (RIGID_BODY, &start) };
            let ours = Steps::new(system, chart, truncation)?;
            let exact = if top { &exact_top } else { &exact };
            let errors: Vec<f64> = counts
                .iter()
                .zip(&steps)
                .map(|(&n, &h)| error(ours.run(h, n, start), exact))
                .collect();
            let found = order(&steps, &errors);
            let far = found.map_or(f64::INFINITY, |o| (o - truncation as f64 - 1.0).abs());
            furthest = furthest.max(far);
            cells.push(found.into());
            long.columns.push(format!("{name}_{truncation}"));
            long.rows.iter_mut().zip(&errors).for_each(|(row, &e)| row.push(e));
            if !top {
                let errors: Vec<f64> = SINGLE
                    .iter()
                    .zip(&exact_single)
                    .map(|(&h, exact)| error(ours.run(h, 1, start), exact))
                    .collect();
                single.columns.push(format!("{name}_{truncation}"));
                single.rows.iter_mut().zip(&errors).for_each(|(row, &e)| row.push(e));
                ones.push(errors);
            }
        }
        orders.push(cells);
        for (i, h) in SINGLE.iter().enumerate().filter(|(_, h)| [0.1, 0.2, 0.4, 0.8].contains(*h)) {
            let (cayley, exponential) = (ones[0][i], ones[1][i]);
            if truncation == 7 && *h == 0.2 {
                report.judge(
                    "charts",
                    "error of one step with K = 7, h = 0.2: Cayley over exponential",
                    cayley / exponential,
                    Bound::AtLeast(1e4),
                );
            }
            charts.push(vec![
                (truncation as f64).into(),
                (*h).into(),
                made(cayley),
                made(exponential),
                made(cayley / exponential),
            ]);
        }
    }
    report.judge(
        "orders",
        "largest difference of a measured order from K + 1, both charts and both systems",
        furthest,
        Bound::AtMost(0.4),
    );
    report.tables.extend([charts, orders]);
    report.curves.extend([single, long]);
    report.notes.push(
        "errors are the largest difference of a coordinate of the momentum or an entry of the \
         attitude from the exact flow; an order is the slope at the smallest steps whose errors lie \
         between 1e-12 and 5e-2"
            .into(),
    );
    Ok(report)
}
