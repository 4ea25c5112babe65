//! Work against precision, the work counted and not timed: the same on every machine.

use coadjoint_codegen::lie::Chart;
use coadjoint_program::Program;
use serde_json::Value;

use super::Options;
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::{RIGID_BODY, START, Steps, exact, rk45};

/// The duration of a run.
const DURATION: f64 = 20.0;
/// Steps of ours in a run.
const COUNTS: [usize; 10] = [20, 25, 32, 40, 50, 64, 100, 160, 250, 500];
/// Operations of an evaluation of the field by RK45: ξ = I⁻¹Π 3, Π × ξ 9, R ξ^ 9 entries of 3 each.
const FIELD: usize = 3 + 9 + 27;
/// Operations of a step of RK45 besides: a product and a sum for each of twelve numbers and each of
/// 1 + 2 + … + 6 weights of stages and 7 of the error, and its norm.
const COMBINE: usize = 12 * 2 * (21 + 7) + 12 * 5;

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("work");
    let end = exact(START, DURATION, 1).remove(1);
    let mut curve = Curve { name: "work".into(), ..Curve::default() };
    curve.columns = ["method", "setting", "error", "operations"].map(Into::into).to_vec();
    let mut names = Vec::new();
    for (chart, name) in [(Chart::Exponential, "exp"), (Chart::Cayley, "Cayley")] {
        for truncation in [3, 5, 7, 9] {
            let steps = Steps::new(RIGID_BODY, chart, truncation)?;
            let programs = steps.kernel().programs();
            let cost = |program: &Program| program.cost().total() as f64;
            let step = cost(&programs.guess) + cost(&programs.accept) + cost(&programs.transport);
            for &count in options.pick(&COUNTS[..], &COUNTS[..9]) {
                let walk = steps.walk(DURATION / count as f64, count, &START);
                let Some((states, corrections)) = walk else { continue };
                let work = count as f64 * step + corrections as f64 * cost(&programs.correct);
                let error = states[count].largest_difference(&end);
                curve.rows.push(vec![names.len() as f64, count as f64, error, work / DURATION]);
            }
            names.push(format!("{name} K={truncation}"));
        }
    }
    for tolerance in (3..=13).map(|k| 10f64.powi(-k)) {
        let (states, steps, evaluations) = rk45(&[DURATION], tolerance, tolerance)?;
        let work = (evaluations * FIELD + steps * COMBINE) as f64 / DURATION;
        let error = states[0].largest_difference(&end);
        curve.rows.push(vec![names.len() as f64, tolerance, error, work]);
    }
    names.push("RK45".into());
    let title =
        format!("arithmetic operations per unit of time for an error of (R, Π) at T = {DURATION}");
    let mut table = Table::new(title, "method | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12");
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
