//! Steps of the series against the exact motion and RK45: errors over time, orders by step size, and work.

use coadjoint::SE3;
use coadjoint_codegen::lie::Chart;
use coadjoint_learn::truth::Separable;
use coadjoint_program::Program;
use serde_json::Value;

use crate::outcome::{Config, Curve, Fallible, Report, Tabulation, row};
use crate::state::{
    Errors, RIGID_BODY, START, State, Timestep, exact, exact_phases, largest, rk45,
};

/// The simulation figure: K = 3, 5, 7, momentum against RK45, distance over time.
pub fn simulation(options: &Config) -> Fallible<Report> {
    let mut report = options.report("simulation");
    let (h, count) = (0.2, options.pick(5000, 500));
    let exact = exact(START, h, count);
    let times: Vec<f64> = (0..=count).map(|i| i as f64 * h).collect();
    let mut errors = Curve::over("simulation", "t", times.iter().copied());
    let mut components = Curve::over("simulation-momentum", "t", times.iter().copied());
    let title =
        format!("largest errors over {count} steps of {h}, start (2, 0.5, 1) at the identity");
    let columns = "method | energy | momentum J | distance | distance at the end";
    let mut table = Tabulation::new(title, columns);
    // Enters a run, and gives its energy errors, its largest error of J and its last distance.
    let mut enter = |name: &str, states: &[State]| {
        let mut along = Errors::of(states, &exact);
        along.0[0].iter_mut().for_each(|error| *error *= exact[0].energy());
        let ([energy, momentum, distance], end) = (along.largest(), along.0[2][count]);
        table.rows.push(row![name, energy, momentum, distance, end]);
        let key = name.to_lowercase().replace(' ', "_").replace('=', "");
        for (i, axis) in ["x", "y", "z"].iter().enumerate() {
            components.add(format!("{key}_{axis}"), states.iter().map(|s| s.spatial_momentum()[i]));
        }
        let found = (along.0[0].clone(), momentum, end);
        along.enter(&mut errors, &key, "momentum");
        found
    };
    let (mut ratio, mut growth, mut ours, mut best) = (0.0_f64, 0.0, 0.0_f64, f64::INFINITY);
    for (chart, name) in [(Chart::Cayley, "Cayley"), (Chart::Exponential, "exp")] {
        let mut before = f64::INFINITY;
        for truncation in [3, 5, 7] {
            let steps = Timestep::new(RIGID_BODY, chart, truncation)?;
            let (states, _) = steps.walk(h, count, &START).ok_or("a step was refused")?;
            let (energy, momentum, end) = enter(&format!("{name} K={truncation}"), &states);
            ratio = ratio.max(largest(&energy) / before);
            before = largest(&energy);
            (ours, best) = (ours.max(momentum), best.min(end));
            if (name, truncation) == ("Cayley", 7) {
                let (first, second) = energy.split_at(energy.len() / 2);
                growth = largest(second) / largest(first);
            }
        }
    }
    // With the tolerances people get when they set none, and finer ones.
    let (_, rival, end) = enter("RK45 default", &rk45(&times, 1e-3, 1e-6)?.0);
    enter("RK45 fine", &rk45(&times, 1e-6, 1e-9)?.0);
    report.judge("energy", "", &[ratio]);
    report.judge("energy-7", "", &[growth]);
    report.judge("momentum", "", &[ours, rival / ours]);
    report.judge("difference", "", &[end / best]);
    report.tables.push(table);
    report.curves.extend([errors, components]);
    Ok(report)
}

/// A heavy top with moments (1, 1.2, 0.8) and its weight at (0.1, 0, 0.4).
const HEAVY_TOP: &str = r#"
name = "heavy-top"
group = "SE3"
coordinates = ["x", "y", "z", "u", "v", "w"]
hamiltonian = "x^2/2 + y^2/2.4 + z^2/1.6 + 0.1*u + 0.4*w"
"#;
const TOP: [f64; 6] = [0.7, -0.4, 1.1, 0.0, 0.6, 0.8];
const ORDERS_DURATION: f64 = 8.0;
const ORDERS_COUNTS: [usize; 13] = [5, 8, 10, 16, 20, 32, 40, 64, 80, 128, 160, 320, 640];
/// Step sizes of single steps.
const SINGLE: [f64; 10] = [0.025, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2];
/// Errors from which an order is read: above rounding, below where higher terms count.
const READABLE: std::ops::Range<f64> = 1e-12..5e-2;

/// The error after `count` steps; NaN where a step is refused.
fn error(steps: &Timestep, h: f64, count: usize, start: &[f64], exact: &State) -> f64 {
    let end = steps.walk(h, count, start).and_then(|(mut states, _)| states.pop());
    end.map_or(f64::NAN, |end| end.largest_difference(exact))
}

/// The slope at the smallest steps whose errors can be read.
fn order(steps: &[f64], errors: &[f64]) -> Option<f64> {
    let readable = |&i: &usize| READABLE.contains(&errors[i]) && READABLE.contains(&errors[i - 1]);
    let fine = (1..steps.len()).rev().find(readable)?;
    Some((errors[fine - 1] / errors[fine]).ln() / (steps[fine - 1] / steps[fine]).ln())
}

/// The order of each truncation, and the two charts beside each other, by K and step size.
pub fn orders(options: &Config) -> Fallible<Report> {
    let mut report = options.report("orders");
    let counts = options.pick(&ORDERS_COUNTS[..], &ORDERS_COUNTS[..11]);
    let sizes: Vec<f64> = counts.iter().map(|&n| ORDERS_DURATION / n as f64).collect();
    let mut long = Curve::over("orders", "h", sizes.iter().copied());
    let mut single = Curve::over("charts", "h", SINGLE);
    let title = format!("order of accuracy measured over T = {ORDERS_DURATION}; K + 1 is expected");
    let columns = "K | K + 1 | free body, Cayley | free body, exp | heavy top, exp";
    let mut orders = Tabulation::new(title, columns);
    let columns = "step | Cayley | exp | Cayley over exp";
    let mut charts = Tabulation::new("error of one step of the free body", columns);
    let (mut furthest, mut gain): (f64, f64) = (0.0, f64::NAN);
    let end = exact(START, ORDERS_DURATION, 1).remove(1);
    let after: Vec<State> = SINGLE.iter().map(|&h| exact(START, h, 1).remove(1)).collect();
    let (se3, top) = (SE3::new(), Separable::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]));
    let start = nalgebra::SVector::from(TOP);
    let end_of_top = State::of(&se3, &exact_phases(&se3, &top, start, ORDERS_DURATION, 1)[1]);
    for truncation in [1, 3, 5, 7, 9] {
        let mut cells = row![truncation as f64, truncation as f64 + 1.0];
        let mut measure = |name: &str, steps: &Timestep, start: &[f64], exact: &State| {
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
            let steps = Timestep::new(RIGID_BODY, chart, truncation)?;
            measure(name, &steps, &START, &end);
            let errors = SINGLE.iter().zip(&after);
            let errors: Vec<f64> = errors.map(|(&h, to)| error(&steps, h, 1, &START, to)).collect();
            single.add(format!("{name}_{truncation}"), errors.iter().copied());
            ones.push(errors);
        }
        if truncation <= 7 {
            let steps = Timestep::new(HEAVY_TOP, Chart::Exponential, truncation)?;
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

const WORK_DURATION: f64 = 20.0;
const WORK_COUNTS: [usize; 10] = [20, 25, 32, 40, 50, 64, 100, 160, 250, 500];
/// Operations of an evaluation of the field by RK45: ξ = I⁻¹Π 3, Π × ξ 9, R ξ^ 9 entries of 3 each.
const FIELD: usize = 3 + 9 + 27;
/// Operations of a step of RK45 besides: a product and a sum for each of twelve numbers and each of
/// 1 + 2 + … + 6 weights of stages and 7 of the error, and its norm.
const COMBINE: usize = 12 * 2 * (21 + 7) + 12 * 5;

/// Work against precision, the work counted and not timed: the same on every machine.
pub fn work(options: &Config) -> Fallible<Report> {
    let mut report = options.report("work");
    let end = exact(START, WORK_DURATION, 1).remove(1);
    let mut curve = Curve { name: "work".into(), ..Curve::default() };
    curve.columns = ["method", "setting", "error", "operations"].map(Into::into).to_vec();
    let mut names = Vec::new();
    for (chart, name) in [(Chart::Exponential, "exp"), (Chart::Cayley, "Cayley")] {
        for truncation in [3, 5, 7, 9] {
            let steps = Timestep::new(RIGID_BODY, chart, truncation)?;
            let programs = &steps.kernel().programs;
            let cost = |program: &Program| program.cost().total() as f64;
            let step = cost(&programs.guess) + cost(&programs.accept) + cost(&programs.transport);
            for &count in options.pick(&WORK_COUNTS[..], &WORK_COUNTS[..9]) {
                let walk = steps.walk(WORK_DURATION / count as f64, count, &START);
                let Some((states, corrections)) = walk else { continue };
                let work = count as f64 * step + corrections as f64 * cost(&programs.correct);
                let error = states[count].largest_difference(&end);
                curve.rows.push(vec![
                    names.len() as f64,
                    count as f64,
                    error,
                    work / WORK_DURATION,
                ]);
            }
            names.push(format!("{name} K={truncation}"));
        }
    }
    for tolerance in (3..=13).map(|k| 10f64.powi(-k)) {
        let (states, steps, evaluations) = rk45(&[WORK_DURATION], tolerance, tolerance)?;
        let work = (evaluations * FIELD + steps * COMBINE) as f64 / WORK_DURATION;
        let error = states[0].largest_difference(&end);
        curve.rows.push(vec![names.len() as f64, tolerance, error, work]);
    }
    names.push("RK45".into());
    let title = format!(
        "arithmetic operations per unit of time for an error of (R, Π) at T = {WORK_DURATION}"
    );
    let mut table = Tabulation::new(title, "method | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12");
    for (at, name) in names.iter().enumerate() {
        let cheapest = |bound: f64| {
            let good = curve.rows.iter().filter(|row| row[0] == at as f64 && row[2] <= bound);
            Value::from(good.map(|row| row[3]).min_by(f64::total_cmp))
        };
        let mut cells = row![name.as_str()];
        cells.extend((2..=6).map(|k| cheapest(10f64.powi(-2 * k))));
        table.rows.push(cells);
    }
    report.judge("work", "", &[table.number("RK45", 3) / table.number("exp K=7", 3)]);
    Ok(report.with(table, curve))
}
