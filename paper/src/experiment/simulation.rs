//! The simulation figure: K = 3, 5, 7, momentum against RK45, distance over time.

use coadjoint_codegen::lie::Chart;

use super::Options;
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::{Errors, RIGID_BODY, START, State, Steps, exact, largest, rk45};

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("simulation");
    let (h, count) = (0.2, options.pick(5000, 500));
    let exact = exact(START, h, count);
    let times: Vec<f64> = (0..=count).map(|i| i as f64 * h).collect();
    let mut errors = Curve::over("simulation", "t", times.iter().copied());
    let mut components = Curve::over("simulation-momentum", "t", times.iter().copied());
    let title =
        format!("largest errors over {count} steps of {h}, start (2, 0.5, 1) at the identity");
    let columns = "method | energy | momentum J | distance | distance at the end";
    let mut table = Table::new(title, columns);
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
            let steps = Steps::new(RIGID_BODY, chart, truncation)?;
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
