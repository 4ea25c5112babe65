//! An adaptive Runge–Kutta method on the same equations, as the paper's figures have it.

use coadjoint::{LieGroup, MatrixGroup, Phase};
use coadjoint_codegen::problem::Problem;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::{DMatrix, DVector};

use super::Task;
use super::trajectory::{Recorder, Trajectory};
use crate::engine::{FloatPolynomial, Torque};
use crate::error::CliError;

/// Dormand and Prince's method of orders 4 and 5 with this tolerance, recorded at its own steps
/// (between them it would be the interpolation that is measured).
pub fn rk45(group: &MatrixGroup, task: &Task<'_>, tolerance: f64) -> Result<Trajectory, CliError> {
    if !(tolerance.is_finite() && tolerance > 0.0) {
        let what = "--compare-tolerance must be finite and positive; try 1e-6";
        return Err(CliError::Option(what.to_owned()));
    }
    let Task { integrator, setup, .. } = *task;
    let torque = task.forces.map(|forces| Torque::new(&forces.kick, group.clone()));
    let (n, size) = (integrator.problem.algebra.dim(), group.matrix_size());
    let Problem { hamiltonian, symbols, .. } = &integrator.problem;
    let gradient: Vec<FloatPolynomial> =
        (0..n).map(|i| FloatPolynomial::new(&hamiltonian.derivative(i), n, symbols)).collect();
    let start = Phase::<MatrixGroup>::new(setup.element(group)?, setup.momentum.clone());
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
            force += torque.torque(&g);
        }
        rate[..n].copy_from_slice(force.as_slice());
        let moved = g * group.matrix_of(&xi);
        rate[n..].copy_from_slice(moved.as_slice());
    };
    let end = setup.steps as f64 * setup.step;
    let solution = IVP::ode_from_fn(flow, 0.0, end, state)
        .method(ExplicitRungeKutta::dopri5().max_steps(usize::MAX))
        .rtol(tolerance)
        .atol(tolerance)
        .solve()
        .map_err(|error| CliError::Rival(format!("{error:?}")))?;

    let label = format!("RK45, tolerance {tolerance:e}");
    let mut recorder = Recorder::new(group, task.watched(), &start, integrator, label);
    let mut last = start.clone();
    for (&time, y) in solution.t.iter().zip(&solution.y) {
        let momentum = DVector::from_column_slice(&y[..n]);
        // What has left the group is measured as it is, not put back on it.
        last = Phase::new(DMatrix::from_column_slice(size, size, &y[n..]), momentum);
        if time != 0.0 {
            recorder.visit(time, &last, true);
        }
    }
    let mut trajectory = recorder.finish(solution.steps.accepted as u64, &last);
    trajectory.truncation = None;
    Ok(trajectory)
}
