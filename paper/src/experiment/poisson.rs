//! Poisson maps of momenta, and Hamiltonians, from data.

use coadjoint::groups::Exponential;
use coadjoint::steps::poisson_map;
use coadjoint::{LieGroup, Phase, SO3};
use coadjoint_learn::data::{RowPolicy, TOLERANCE, reduce};
use coadjoint_learn::momentum::fit_poisson;
use coadjoint_learn::polynomial::{PolynomialModel, fit_gradients};
use coadjoint_learn::truth::{MomentumBox, Separable, momentum_pairs, phase_pairs};
use coadjoint_learn::{Generating, MomentumFunction, Scaled, drifts, evaluate_momenta};
use nalgebra::Vector3;

use crate::outcome::{Config, Curve, Fallible, Report, Tabulation, row};
use crate::state::{Errors, START, State, exact_momenta, exact_momentum, momenta};

/// Step, samples, and the paper's mean squared and largest errors.
const TABLE_TWO: [(f64, usize, f64, f64); 6] = [
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

/// Table 2: Poisson maps from momenta alone, and their trajectories.
pub fn table_two(options: &Config) -> Fallible<Report> {
    let mut report = options.report("table-2");
    let (group, body) = (SO3::new(), Separable::paper());
    for (number, &(step, samples, paper, largest)) in
        options.pick(&TABLE_TWO[..], &TABLE_TWO[5..]).iter().enumerate()
    {
        eprintln!("  Δt = {step}, {samples} samples");
        let flow = |mu: &_| exact_momentum(mu, step);
        let seed = |k| options.seed(10 * number as u64 + k);
        let pairs = |count, k| momentum_pairs(&group, MomentumBox::UNIT, count, seed(k), flow);
        let (train, test) = (pairs(samples, 1), pairs(100, 2));
        let title = format!("Δt = {step}, {samples} samples, momenta in [-1, 1]³, 100 test points");
        let mut table = Tabulation::new(title, "model | mse momentum | max momentum | unsolved");
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
    options: &Config,
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

const HAMILTONIAN_STEPS: [f64; 5] = [0.4, 0.2, 0.1, 0.05, 0.025];

/// The remark on learning H through the Lie–Poisson variational integrator.
pub fn hamiltonian(options: &Config) -> Fallible<Report> {
    let mut report = options.report("hamiltonian");
    let (group, body) = (SO3::new(), Separable::paper());
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    let samples = options.pick(500, 150);
    let title = format!("H_red from {samples} pairs in [-2.5, 2.5]³");
    let columns = "dt | degree | rms of dH - dH_true | slope | energy drift of the map, 1000 steps";
    let mut table = Tabulation::new(title, columns);
    let mut curve = Curve::over("hamiltonian", "dt", HAMILTONIAN_STEPS);
    let mut furthest: f64 = 0.0;
    for degree in [2, 4] {
        let mut errors: Vec<f64> = Vec::new();
        for step in HAMILTONIAN_STEPS {
            let pairs = phase_pairs(&group, &body, step, wide, samples, options.seed(1)).into();
            let policy = RowPolicy::Refuse;
            let data = reduce::<SO3, Exponential>(&group, &pairs, TOLERANCE, policy)?.data;
            // The integrator behind it is of second order: the H found is S/Δt, the true one up to O(Δt²).
            let learned = fit_gradients(&data.p, &(&data.x / step), degree, 0.0)?;
            let (mut found, mut expected, mut squares) = ([0.0; 3], [0.0; 3], 0.0);
            for p in data.momenta.before.column_iter() {
                learned.gradient(p.as_slice(), &mut found);
                body.gradient(p.as_slice(), &mut expected);
                squares += (0..3).map(|j| (found[j] - expected[j]).powi(2)).sum::<f64>();
            }
            let rms = (squares / data.p.len() as f64).sqrt();
            let slope = errors.last().map(|before| (before / rms).log2());
            furthest = furthest.max(slope.map_or(0.0, |slope| (slope - 2.0).abs()));
            errors.push(rms);
            let map = map(Scaled { factor: step, function: &learned });
            let start = Phase::<SO3>::at_identity(START);
            let drift = drifts(&map, &group, &start, options.pick(1000, 200), Some(&body))?;
            table.rows.push(row![step, degree as f64, rms, slope, drift.energy]);
        }
        curve.add(format!("degree_{degree}"), errors);
    }
    report.judge("hamiltonian", "", &[furthest]);
    Ok(report.with(table, curve))
}

/// Forward Euler made geometric: section 5.4.
pub fn geometrize(options: &Config) -> Fallible<Report> {
    let mut report = options.report("geometrize");
    let (group, body) = (SO3::new(), Separable::paper());
    let (step, samples, steps) = (0.1, options.pick(1000, 200), options.pick(2000, 500));
    let euler = |mu: &Vector3<f64>| {
        let mut xi = [0.0; 3];
        body.gradient(mu.as_slice(), &mut xi);
        mu + group.ad_star(&Vector3::from(xi), mu) * step
    };
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    let train = momentum_pairs(&group, wide, samples, options.seed(1), euler);
    let title =
        format!("{steps} steps of {step} from (2, 0.5, 1); {samples} pairs in [-2.5, 2.5]³");
    let columns = "method | fit mse | Casimir drift | energy drift | distance to the exact flow";
    let mut table = Tabulation::new(title, columns);
    let mut curve = Curve::over("geometrize", "t", (0..=steps).map(|i| i as f64 * step));
    let exact = exact_momenta(START, step, steps);
    let mut enter = |name: &str, fit: Option<f64>, states: &[State]| {
        let along = Errors::of(states, &exact);
        let [energy, casimir, distance] = along.largest();
        table.rows.push(row![name, fit, casimir, energy, distance]);
        along.enter(&mut curve, name, "casimir");
    };
    enter("euler", None, &momenta(&exact[0], steps, |mu| Ok(euler(mu)))?);
    for degree in options.pick(vec![2, 3, 4, 5, 6], vec![4]) {
        let (model, history) = fit_poisson::<SO3, Exponential>(&group, &train, degree)?;
        let map = map(&model);
        let states = momenta(&exact[0], steps, |mu| Ok(poisson_map(&map, mu)?))?;
        enter(&format!("geometrized_{degree}"), history.last().copied(), &states);
    }
    let gain = table.number("euler", 3) / table.number("last", 3);
    report.judge("geometrize", "", &[table.number("last", 2), gain]);
    Ok(report.with(table, curve))
}
