//! An adaptive Runge–Kutta method on the same equations, as the paper's figures have it.

use std::sync::Arc;

use coadjoint::{LieGroup, groups::DirectProduct, groups::MatrixGroup};
use coadjoint_run::engine::{Elements, Numbers, Restore, Torque};
use coadjoint_run::simulate::{Moment, Recorder};
use coadjoint_run::{Derived, RunError};
use differential_equations::prelude::{
    ControlFlag, ExplicitRungeKutta, IVP, Interpolation, Solout, Solution,
};
use nalgebra::{DMatrix, DVector};
use serde_json::json;

use super::keep::Trajectory;
use super::samples::Samples;
use super::settings::{Header, Settings};
use crate::error::CliError;
use crate::progress;

/// The group that the equations are on.
type Group = DirectProduct<MatrixGroup>;

/// Dormand and Prince's method of orders 4 and 5 with this tolerance, recorded at its own steps
/// (between them it would be the interpolation that is measured).
pub(crate) fn rk45(
    system: &Derived,
    settings: &Settings<'_>,
    header: Header,
    tolerance: f64,
) -> Result<Trajectory, CliError> {
    if !(tolerance.is_finite() && tolerance > 0.0) {
        let what = "--compare-tolerance must be finite and positive; try 1e-6";
        return Err(CliError::Option(what.to_owned()));
    }
    let (facts, setup) = (system.facts(), &settings.setup);
    let group = &system.group()?;
    let forces = system.series().and_then(|series| series.forces.as_ref());
    let torque = forces.map(|forces| Torque::new(&forces.kick, group.clone()));
    let torque = torque.transpose().map_err(|source| RunError::Step { time: 0.0, source })?;
    let (n, size) = (facts.algebra.dim(), group.matrix_size());
    let Some(energy) = &system.invariants.hamiltonian else {
        let what = "--compare: the Hamiltonian depends on time, or a torque acts, and the comparison takes neither";
        return Err(CliError::Option(what.to_owned()));
    };
    let gradient = energy.gradient(n);
    let space = Elements { group: Arc::new(group.clone()), compiled: None };
    let start = setup.start(&system.file, &space)?;
    // μ, and the matrix of g row by row.
    let state: Vec<f64> = start.mu.iter().chain(&start.g).copied().collect();

    // μ̇ = ad*_ξ μ + τ(g) and ġ = g·ξ with ξ = ∂H_red/∂μ.
    let flow = |t: f64, y: &Vec<f64>, rate: &mut Vec<f64>| {
        let mu = DVector::from_column_slice(&y[..n]);
        let g = DMatrix::from_row_slice(size, size, &y[n..]);
        let xi = DVector::from_vec(gradient(&y[..n]));
        let mut force = group.ad_star(&xi, &mu);
        if let Some(torque) = &torque {
            let torque = torque.torque(&group.restore(&|i, j| g[(i, j)]), &mu, t);
            force += torque.unwrap_or_else(|_| DVector::repeat(n, f64::NAN));
        }
        rate[..n].copy_from_slice(force.as_slice());
        let moved = g * matrix_of(group, &xi);
        rate[n..].copy_from_slice(moved.transpose().as_slice());
    };
    let end = setup.schedule.end;
    let name = format!("RK45, tolerance {tolerance:e}");
    let mut recorder = Recorder::new(system.watched(), &space, &start);
    let failed = |time: f64, what: String| CliError::Rival(format!("at time {time}: {what}"));
    let moment = recorder.visit(0.0, &space, &start).map_err(|what| failed(0.0, what))?;
    let mut samples = Samples::new(n);
    samples.offer(0.0, &start.mu, moment.drift);
    let mut watch = Watch { space, recorder, samples, last: start, moment, failure: None };
    let _phase = progress::phase("integrating with RK45");
    let solution = IVP::ode_from_fn(flow, 0.0, end, state)
        .method(ExplicitRungeKutta::dopri5().max_steps(usize::MAX))
        .rtol(tolerance)
        .atol(tolerance)
        .solout(&mut watch)
        .solve();
    if let Some((time, what)) = watch.failure {
        return Err(failed(time, what));
    }
    let solution = solution.map_err(|error| CliError::Rival(format!("{error:?}")))?;
    let Watch { space, recorder, samples, last, moment, .. } = watch;
    let outcome = recorder.finish((solution.steps.accepted as u64, end), &space, &last, &moment);
    Ok(Trajectory {
        header: header.only(&KNOWN).with("method", json!(name)),
        label: name,
        coordinates: facts.coordinates.to_vec(),
        samples: if settings.sampled { samples.finish() } else { Vec::new() },
        announcement: None,
        outcome,
        out: None,
    })
}

/// The matrix of an element of the algebra.
fn matrix_of(group: &Group, x: &DVector<f64>) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(group.matrix_size(), group.matrix_size());
    let (mut row, mut coordinate) = (0, 0);
    for factor in group.factors() {
        let (size, dim) = (factor.matrix_size(), factor.dim());
        let block = factor.matrix_of(&x.rows(coordinate, dim).into_owned());
        matrix.view_mut((row, row), (size, size)).copy_from(&block);
        (row, coordinate) = (row + size, coordinate + dim);
    }
    matrix
}

/// The entries of the head of a run by another method.
const KNOWN: [&str; 7] = [
    "program",
    "system",
    "system_sha256",
    "name",
    "group",
    "initial_momentum",
    "initial_group_element",
];

/// Looks at the method's own steps as they are made; none are kept.
struct Watch<'a> {
    space: Elements<Group>,
    recorder: Recorder<'a>,
    samples: Samples,
    last: Numbers,
    moment: Moment,
    failure: Option<(f64, String)>,
}

impl Solout<f64, Vec<f64>> for &mut Watch<'_> {
    fn solout<I>(
        &mut self,
        time: f64,
        _: f64,
        y: &Vec<f64>,
        _: &Vec<f64>,
        _: &mut I,
        _: &mut Solution<f64, Vec<f64>>,
    ) -> ControlFlag<f64, Vec<f64>>
    where
        I: Interpolation<f64, Vec<f64>> + ?Sized,
    {
        if time == 0.0 {
            return ControlFlag::Continue;
        }
        // An element that has left the group is measured as it is, not projected back.
        let (mu, g) = y.split_at(self.last.mu.len());
        self.last = Numbers { g: g.to_vec(), mu: mu.to_vec() };
        match self.recorder.visit(time, &self.space, &self.last) {
            Ok(moment) => {
                self.samples.offer(time, mu, moment.drift);
                self.moment = moment;
                ControlFlag::Continue
            }
            Err(what) => {
                self.failure = Some((time, what));
                ControlFlag::Terminate
            }
        }
    }
}
