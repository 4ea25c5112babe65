//! An adaptive Runge–Kutta method on the same equations, as the paper's figures have it.

use coadjoint::{LieGroup, Phase, groups::DirectProduct, groups::MatrixGroup};
use coadjoint_codegen::problem::Problem;
use coadjoint_run::Derived;
use coadjoint_run::engine::{FloatPolynomial, Restore, Torque};
use coadjoint_run::simulate::{At, Moment, Recorder};
use differential_equations::prelude::{
    ControlFlag, ExplicitRungeKutta, IVP, Interpolation, Solout, Solution,
};
use nalgebra::{DMatrix, DVector};
use serde_json::json;

use super::header::Header;
use super::samples::Samples;
use super::setup::Settings;
use super::trajectory::Trajectory;
use crate::error::CliError;
use crate::progress;

/// The group that the equations are on.
type Group = DirectProduct<MatrixGroup>;

/// Dormand and Prince's method of orders 4 and 5 with this tolerance, recorded at its own steps
/// (between them it would be the interpolation that is measured).
pub fn rk45(
    system: &Derived,
    settings: &Settings,
    header: Header,
    tolerance: f64,
) -> Result<Trajectory, CliError> {
    if !(tolerance.is_finite() && tolerance > 0.0) {
        let what = "--compare-tolerance must be finite and positive; try 1e-6";
        return Err(CliError::Option(what.to_owned()));
    }
    let (integrator, setup) = (&system.integrator, &settings.setup);
    let group = &system.group()?;
    let torque = system.forces.as_ref().map(|forces| Torque::new(&forces.kick, group.clone()));
    let (n, size) = (integrator.problem.algebra.dim(), group.matrix_size());
    let Problem { hamiltonian, symbols, .. } = &integrator.problem;
    let gradient: Vec<FloatPolynomial> =
        (0..n).map(|i| FloatPolynomial::new(&hamiltonian.derivative(i), n, symbols)).collect();
    let start = Phase::<Group>::new(setup.element(&system.file, group)?, setup.momentum.clone());
    let mut state: Vec<f64> = start.momentum.iter().copied().collect();
    // The matrix of g column by column, as nalgebra keeps it.
    let matrix = |g: &_| DMatrix::from_fn(size, size, |i, j| group.matrix_entry(g, i, j));
    state.extend(matrix(&start.group_element).iter());

    // μ̇ = ad*_ξ μ + τ(g) and ġ = g·ξ with ξ = ∂H_red/∂μ.
    let flow = |_t: f64, y: &Vec<f64>, rate: &mut Vec<f64>| {
        let mu = DVector::from_column_slice(&y[..n]);
        let g = DMatrix::from_column_slice(size, size, &y[n..]);
        let xi =
            DVector::from_iterator(n, gradient.iter().map(|slope| slope.evaluate(mu.as_slice())));
        let mut force = group.ad_star(&xi, &mu);
        if let Some(torque) = &torque {
            force += torque.torque(&group.restore(&|i, j| g[(i, j)]));
        }
        rate[..n].copy_from_slice(force.as_slice());
        let moved = g * matrix_of(group, &xi);
        rate[n..].copy_from_slice(moved.as_slice());
    };
    let end = setup.schedule.end;
    let name = format!("RK45, tolerance {tolerance:e}");
    let seen = At { group, phase: &start };
    let mut recorder = Recorder::new(group, system.watched(), &start, &seen);
    let mut samples = Samples::new(n);
    let failed = |time: f64, what: String| CliError::Rival(format!("at time {time}: {what}"));
    let moment = recorder.visit(0.0, &seen).map_err(|what| failed(0.0, what))?;
    samples.offer(0.0, start.momentum.as_slice(), moment.energy.unwrap_or(0.0), moment.drift);
    let mut watch = Watch { group, recorder, samples, last: start, moment, size, failure: None };
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
    let header = header.only(&KNOWN).with("method", json!(name));
    let steps = solution.steps.accepted as u64;
    let Watch { recorder, samples, last, moment, .. } = watch;
    let outcome = recorder.finish((steps, end), &last, &moment);
    let coordinates = &integrator.problem.coordinates;
    let mut trajectory = Trajectory::of(outcome, name, header, coordinates);
    if settings.sampled {
        trajectory.records = samples.finish();
    }
    Ok(trajectory)
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
    group: &'a Group,
    recorder: Recorder<'a, Group>,
    samples: Samples,
    last: Phase<Group>,
    moment: Moment,
    /// Rows of the group's matrices.
    size: usize,
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
        let n = self.last.momentum.len();
        let momentum = DVector::from_column_slice(&y[..n]);
        // An element that has left the group is measured as it is, not projected back.
        let element = DMatrix::from_column_slice(self.size, self.size, &y[n..]);
        self.last = Phase::new(self.group.restore(&|i, j| element[(i, j)]), momentum);
        match self.recorder.visit(time, &At { group: self.group, phase: &self.last }) {
            Ok(moment) => {
                let energy = moment.energy.unwrap_or(0.0);
                self.samples.offer(time, self.last.momentum.as_slice(), energy, moment.drift);
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
