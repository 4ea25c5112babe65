//! Table 2: Poisson maps from momenta alone, and their trajectories.

use coadjoint::SO3;
use coadjoint::groups::Exponential;
use coadjoint::steps::poisson_map;
use coadjoint_learn::momentum::fit_poisson;
use coadjoint_learn::polynomial::PolynomialModel;
use coadjoint_learn::truth::{MomentumBox, Quadratic, exact_momentum_flow, momentum_pairs};
use coadjoint_learn::{Generating, MomentumFunction, Scaled, evaluate_momenta};

use super::Options;
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::{Errors, State, exact_momenta, momenta};

/// Step, samples, and the paper's mean squared and largest errors.
const CELLS: [(f64, usize, f64, f64); 6] = [
    (0.25, 25, 0.01297, 1.69),
    (0.25, 200, 0.0003, 0.36),
    (0.5, 25, 0.0546, 1.93),
    (0.5, 200, 0.0006, 0.3399),
    (1.0, 25, 0.0427, 1.2597),
    (1.0, 200, 0.0008, 0.3399),
];

/// A Poisson map of momenta, by S in the exponential chart.
pub fn map<M: MomentumFunction>(function: M) -> Generating<SO3, Exponential, M> {
    Generating::new(SO3::new(), function)
}

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("table-2");
    let (group, body) = (SO3::new(), Quadratic::paper());
    for (number, &(step, samples, paper, largest)) in
        options.pick(&CELLS[..], &CELLS[5..]).iter().enumerate()
    {
        eprintln!("  Δt = {step}, {samples} samples");
        let flow = |mu: &_| exact_momentum_flow(&group, &body, mu, step);
        let seed = |k| options.seed(10 * number as u64 + k);
        let pairs = |count, k| momentum_pairs(&group, MomentumBox::UNIT, count, seed(k), flow);
        let (train, test) = (pairs(samples, 1), pairs(100, 2));
        let title = format!("Δt = {step}, {samples} samples, momenta in [-1, 1]³, 100 test points");
        let mut table = Table::new(title, "model | mse momentum | max momentum | unsolved");
        table.rows.push(row!["paper", paper, largest, ()]);
        let mut enter = |name: String, function: &dyn MomentumFunction| {
            let found = evaluate_momenta(&map(function), &test);
            let unsolved = found.unsolved.len() as f64;
            table.rows.push(row![name, found.mse.momentum, found.max_error.momentum, unsolved]);
        };
        enter("identity, μ″ = μ′".into(), &Scaled { factor: 0.0, function: &body });
        enter("S = Δt·H".into(), &Scaled { factor: step, function: &body });
        let mut models = Vec::new();
        for degree in [2, 4, 6] {
            let (model, _) = fit_poisson::<SO3, Exponential>(&group, &train, degree)?;
            enter(format!("p eliminated, degree {degree}"), &model);
            models.push((format!("degree_{degree}"), model));
        }
        let error = table.number("p eliminated, degree 4", 1);
        report.judge("table-2", &format!("Δt = {step}, {samples} samples: "), &[error / paper]);
        report.tables.push(table);
        if (step, samples) == (1.0, 200) {
            trajectories(options, step, &models[..2], &mut report)?;
        }
    }
    Ok(report)
}

/// Long trajectories of learned Poisson maps.
fn trajectories(
    options: &Options,
    step: f64,
    models: &[(String, PolynomialModel)],
    report: &mut Report,
) -> Fallible<()> {
    let steps = options.pick(5000, 1000);
    let exact = exact_momenta([0.7, 0.2, 0.5], step, steps);
    let mut curve = Curve::over("poisson", "t", (0..=steps).map(|i| i as f64 * step));
    let mut enter = |key: &str, states: &[State]| {
        for (i, axis) in ["x", "y", "z"].iter().enumerate() {
            curve.add(format!("{key}_{axis}"), states.iter().map(|state| state.momentum[i]));
        }
        let along = Errors::of(states, &exact);
        let largest = along.largest();
        along.enter(&mut curve, key, "casimir");
        largest
    };
    enter("exact", &exact);
    let (mut casimir, mut energy): (f64, f64) = (0.0, 0.0);
    for (key, model) in models {
        let map = map(model);
        let states = momenta(&exact[0], steps, |mu| Ok(poisson_map(&map, mu)?))?;
        let largest = enter(key, &states);
        (energy, casimir) = (largest[0], casimir.max(largest[1]));
    }
    report.judge("poisson", "", &[casimir, energy]);
    report.curves.push(curve);
    Ok(())
}
