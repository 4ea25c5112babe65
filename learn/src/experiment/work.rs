//! Work against precision, the work counted and not timed: the same on every machine.

use coadjoint::{Phase, SO3};
use coadjoint_codegen::lie::Chart;
use coadjoint_program::Kernel;
use nalgebra::{Matrix3, Vector3};

use super::report::{Bound, Curve, Report, Table};
use super::run::RunOptions;
use super::runge_kutta::dormand_prince;
use super::steps::{RIGID_BODY, Steps};
use crate::error::LearnError;
use crate::group::matrix_of;
use crate::truth::{Quadratic, exact_flow};

/// The duration of a run.
const DURATION: f64 = 20.0;
/// Steps of ours in a run.
const COUNTS: [u64; 10] = [20, 25, 32, 40, 50, 64, 100, 160, 250, 500];
/// Operations of RK45 in an evaluation of the field: ξ = I⁻¹Π 3, Π × ξ 9, R ξ^ 9 entries of 3 each.
const FIELD: u64 = 3 + 9 + 27;
/// Operations of a step of RK45 besides: a product and a sum for each of twelve numbers and each of
/// 1 + 2 + … + 6 weights of stages and 7 of the error, and its norm.
const COMBINE: u64 = 12 * 2 * (21 + 7) + 12 * 5;

/// Operations of the steps of a kernel with so many corrections.
fn operations(kernel: &Kernel, steps: u64, corrections: u64) -> f64 {
    let programs = kernel.programs();
    let cost = |program: &coadjoint_program::Program| program.cost().total() as f64;
    steps as f64 * (cost(&programs.guess) + cost(&programs.accept) + cost(&programs.transport))
        + corrections as f64 * cost(&programs.correct)
}

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("work");
    let start = [2.0, 0.5, 1.0];
    let at = Phase::<SO3>::at_identity(start);
    let end = exact_flow(&SO3::new(), &Quadratic::paper(), &at, DURATION);
    let rotation = matrix_of(&SO3::<f64>::new(), &end.group_element);
    let error = |momentum: &[f64], entry: &dyn Fn(usize, usize) -> f64| {
        let turned = (0..9).map(|k| (entry(k / 3, k % 3) - rotation[(k / 3, k % 3)]).abs());
        let moved = (0..3).map(|i| (momentum[i] - end.momentum[i]).abs());
        turned.chain(moved).fold(0.0, f64::max)
    };
    let mut curve = Curve { name: "work".into(), columns: Vec::new(), rows: Vec::new() };
    curve.columns = ["method", "setting", "error", "operations"].map(Into::into).to_vec();
    let mut families: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for (chart, name) in [(Chart::Exponential, "exp"), (Chart::Cayley, "Cayley")] {
        for truncation in [3, 5, 7, 9] {
            let ours = Steps::new(RIGID_BODY, chart, truncation)?;
            let mut points = Vec::new();
            for &count in options.pick(&COUNTS[..], &COUNTS[..9]) {
                let Some(found) = ours.run(DURATION / count as f64, count, &start) else {
                    continue;
                };
                let work = operations(ours.kernel(), count, found.corrections) / DURATION;
                let error = error(&found.momentum, &|i, j| found.matrix[3 * i + j]);
                points.push((error, work));
                curve.rows.push(vec![families.len() as f64, count as f64, error, work]);
            }
            families.push((format!("{name} K={truncation}"), points));
        }
    }
    let mut first: Vec<f64> = Matrix3::<f64>::identity().as_slice().to_vec();
    first.extend(start);
    let mut points = Vec::new();
    for tolerance in (3..=13).map(|k| 10f64.powi(-k)) {
        let evaluations = std::cell::Cell::new(0_u64);
        let slope = |y: &[f64], f: &mut [f64]| {
            evaluations.set(evaluations.get() + 1);
            let g = Matrix3::from_column_slice(&y[..9]);
            let mu = Vector3::new(y[9], y[10], y[11]);
            let xi = Vector3::new(mu.x / 1.5, mu.y / 2.0, mu.z / 2.5);
            f[..9].copy_from_slice((g * xi.cross_matrix()).as_slice());
            f[9..].copy_from_slice(mu.cross(&xi).as_slice());
        };
        let Ok(states) = dormand_prince(&first, &[DURATION], tolerance, tolerance, slope) else {
            continue;
        };
        // Seven evaluations a step, of which the last is the first of the next.
        let steps = evaluations.get() / 7;
        let work = (steps * (6 * FIELD + COMBINE)) as f64 / DURATION;
        let state = &states[0];
        let error = error(&state[9..], &|i, j| state[3 * j + i]);
        points.push((error, work));
        curve.rows.push(vec![families.len() as f64, tolerance, error, work]);
    }
    families.push(("RK45".into(), points));
    let mut table = Table::new(
        format!("arithmetic operations per unit of time for an error of (R, Π) at T = {DURATION}"),
        &["method", "1e-4", "1e-6", "1e-8", "1e-10", "1e-12"],
    );
    let cheapest = |points: &[(f64, f64)], bound: f64| {
        let good = points.iter().filter(|point| point.0 <= bound).map(|point| point.1);
        good.min_by(f64::total_cmp)
    };
    for (name, points) in &families {
        let cells = (2..=6).map(|k| cheapest(points, 10f64.powi(-2 * k)).into());
        table.push(std::iter::once(name.clone().into()).chain(cells).collect());
    }
    let of = |name: &str| {
        let (_, points) = families.iter().find(|(family, _)| family == name)?;
        cheapest(points, 1e-8)
    };
    let ratio = of("RK45").zip(of("exp K=7")).map(|(rival, ours)| rival / ours);
    report.judge(
        "work",
        "operations of RK45 over those of K = 7, exponential, for an error of 1e-8",
        ratio,
        Bound::AtLeast(5.0),
    );
    report.tables.push(table);
    report.curves.push(curve);
    report.notes.push(
        "operations are products, sums, quotients and roots of the step's own programs, first guess, \
         corrections and attitude included, counted on the way; RK45's are those of its field and \
         of its stages. Times of the emitted code are the benchmark's"
            .into(),
    );
    Ok(report)
}
