//! The order of each truncation, and the two charts beside each other, by K and step size.

use coadjoint::SE3;
use coadjoint_codegen::lie::Chart;
use coadjoint_learn::truth::Quadratic;
use serde_json::Value;

use super::Options;
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::{RIGID_BODY, START, State, Steps, exact, exact_phases};

/// A heavy top with moments (1, 1.2, 0.8) and its weight at (0.1, 0, 0.4).
const HEAVY_TOP: &str = r#"
name = "heavy-top"
group = "SE3"
coordinates = ["x", "y", "z", "u", "v", "w"]
hamiltonian = "x^2/2 + y^2/2.4 + z^2/1.6 + 0.1*u + 0.4*w"
"#;
/// Its start.
const TOP: [f64; 6] = [0.7, -0.4, 1.1, 0.0, 0.6, 0.8];
/// The duration of a run.
const DURATION: f64 = 8.0;
/// Steps of a run.
const COUNTS: [usize; 13] = [5, 8, 10, 16, 20, 32, 40, 64, 80, 128, 160, 320, 640];
/// Step sizes of single steps.
const SINGLE: [f64; 10] = [0.025, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2];
/// Errors from which an order is read: above rounding, below where higher terms count.
const READABLE: std::ops::Range<f64> = 1e-12..5e-2;

/// The error after `count` steps; NaN where a step is refused.
fn error(steps: &Steps, h: f64, count: usize, start: &[f64], exact: &State) -> f64 {
    let end = steps.walk(h, count, start).and_then(|(mut states, _)| states.pop());
    end.map_or(f64::NAN, |end| end.largest_difference(exact))
}

/// The slope at the smallest steps whose errors can be read.
fn order(steps: &[f64], errors: &[f64]) -> Option<f64> {
    let readable = |&i: &usize| READABLE.contains(&errors[i]) && READABLE.contains(&errors[i - 1]);
    let fine = (1..steps.len()).rev().find(readable)?;
    Some((errors[fine - 1] / errors[fine]).ln() / (steps[fine - 1] / steps[fine]).ln())
}

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("orders");
    let counts = options.pick(&COUNTS[..], &COUNTS[..11]);
    let sizes: Vec<f64> = counts.iter().map(|&n| DURATION / n as f64).collect();
    let mut long = Curve::over("orders", "h", sizes.iter().copied());
    let mut single = Curve::over("charts", "h", SINGLE);
    let title = format!("order of accuracy measured over T = {DURATION}; K + 1 is expected");
    let columns = "K | K + 1 | free body, Cayley | free body, exp | heavy top, exp";
    let mut orders = Table::new(title, columns);
    let columns = "step | Cayley | exp | Cayley over exp";
    let mut charts = Table::new("error of one step of the free body", columns);
    let (mut furthest, mut gain): (f64, f64) = (0.0, f64::NAN);
    let end = exact(START, DURATION, 1).remove(1);
    let after: Vec<State> = SINGLE.iter().map(|&h| exact(START, h, 1).remove(1)).collect();
    let (se3, top) = (SE3::new(), Quadratic::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]));
    let start = nalgebra::SVector::from(TOP);
    let end_of_top = State::of(&se3, &exact_phases(&se3, &top, start, DURATION, 1)[1]);
    for truncation in [1, 3, 5, 7, 9] {
        let mut cells = row![truncation as f64, truncation as f64 + 1.0];
        let mut measure = |name: &str, steps: &Steps, start: &[f64], exact: &State| {
            let runs = counts.iter().zip(&sizes);
            let errors: Vec<f64> = runs.map(|(&n, &h)| error(steps, h, n, start, exact)).collect();
            let found = order(&sizes, &errors);
            let off = |order: f64| (order - truncation as f64 - 1.0).abs();
            furthest = furthest.max(found.map_or(f64::INFINITY, off));
            cells.push(found.into());
            long.add(format!("{name}_{truncation}"), errors);
        };
        let mut ones = Vec::new();
        for (name, chart) in [("cayley", Chart::Cayley), ("exp", Chart::Exponential)] {
            let steps = Steps::new(RIGID_BODY, chart, truncation)?;
            measure(name, &steps, &START, &end);
            let errors = SINGLE.iter().zip(&after);
            let errors: Vec<f64> = errors.map(|(&h, to)| error(&steps, h, 1, &START, to)).collect();
            single.add(format!("{name}_{truncation}"), errors.iter().copied());
            ones.push(errors);
        }
        if truncation <= 7 {
            let steps = Steps::new(HEAVY_TOP, Chart::Exponential, truncation)?;
            measure("top", &steps, &TOP, &end_of_top);
        } else {
            cells.push(Value::Null);
        }
        orders.rows.push(cells);
        let made = |error: f64| if error.is_nan() { "refused".into() } else { Value::from(error) };
        for (i, h) in SINGLE.iter().enumerate().filter(|(_, h)| [0.1, 0.2, 0.4, 0.8].contains(*h)) {
            let ratio = ones[0][i] / ones[1][i];
            if (truncation, *h) == (7, 0.2) {
                gain = ratio;
            }
            let step = format!("K = {truncation}, h = {h}");
            charts.rows.push(vec![step.into(), made(ones[0][i]), made(ones[1][i]), made(ratio)]);
        }
    }
    report.judge("charts", "", &[gain]);
    report.judge("orders", "", &[furthest]);
    report.tables.extend([charts, orders]);
    report.curves.extend([single, long]);
    Ok(report)
}
