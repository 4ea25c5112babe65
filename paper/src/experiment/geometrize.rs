//! Forward Euler made geometric: section 5.4.

use coadjoint::groups::Exponential;
use coadjoint::steps::poisson_map;
use coadjoint::{LieGroup, SO3};
use coadjoint_learn::MomentumFunction;
use coadjoint_learn::momentum::fit_poisson;
use coadjoint_learn::truth::{MomentumBox, Quadratic, momentum_pairs};
use nalgebra::Vector3;

use super::Options;
use super::table_two::map;
use crate::outcome::{Curve, Fallible, Report, Table, row};
use crate::state::{Errors, START, State, exact_momenta, momenta};

pub fn run(options: &Options) -> Fallible<Report> {
    let mut report = options.report("geometrize");
    let (group, body) = (SO3::new(), Quadratic::paper());
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
    let mut table = Table::new(title, columns);
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
