//! An adaptive Runge–Kutta method on the same equations, as the paper's figures have it.

use coadjoint::{Chart, LieGroup, MatrixGroup, Phase};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::poly::Polynomial;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::{DMatrix, DVector};
use num_traits::ToPrimitive;

use super::setup::Setup;
use super::trajectory::{Recorder, Trajectory};
use crate::engine::Interpreter;
use crate::error::CliError;

/// Dormand and Prince's method of orders 4 and 5 with this tolerance, recorded at its own steps
/// (between them it would be the interpolation that is measured).
pub fn rk45<C: Chart<MatrixGroup>>(
    step: &Interpreter<'_, MatrixGroup, C>,
    integrator: &Integrator,
    setup: &Setup,
    tolerance: f64,
) -> Result<Trajectory, CliError> {
    use coadjoint::GeneratingFunction;
    if !(tolerance.is_finite() && tolerance > 0.0) {
        let what = "--compare-tolerance must be finite and positive; try 1e-6";
        return Err(CliError::Option(what.to_owned()));
    }
    let group = step.group();
    let (n, size) = (integrator.problem.algebra.dim(), group.matrix_size());
    let gradient: Vec<Terms> =
        (0..n).map(|i| terms(integrator, &integrator.problem.hamiltonian.derivative(i))).collect();
    let start = Phase::<MatrixGroup>::new(setup.element(group)?, setup.momentum.clone());
    let mut state: Vec<f64> = start.momentum.iter().copied().collect();
    // The matrix of g column by column, as nalgebra keeps it.
    let matrix = |g: &_| DMatrix::from_fn(size, size, |i, j| group.matrix_entry(g, i, j));
    state.extend(matrix(&start.group_element).iter());

    // μ̇ = ad*_ξ μ and ġ = g·ξ with ξ = ∂H_red/∂μ.
    let flow = |_t: f64, y: &Vec<f64>, rate: &mut Vec<f64>| {
        let mu = DVector::from_column_slice(&y[..n]);
        let g = DMatrix::from_column_slice(size, size, &y[n..]);
        let xi = DVector::from_iterator(n, gradient.iter().map(|terms| evaluate(terms, &mu)));
        rate[..n].copy_from_slice(group.ad_star(&xi, &mu).as_slice());
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

    let energy = |mu: &_| step.energy(mu);
    let label = format!("RK45, tolerance {tolerance:e}");
    let mut recorder = Recorder::new(group, &energy, &start, integrator, label);
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

/// (coefficient, [(coordinate, power)]).
type Terms = Vec<(f64, Vec<(usize, i32)>)>;

fn terms(integrator: &Integrator, polynomial: &Polynomial) -> Terms {
    let n = integrator.problem.algebra.dim();
    let symbols: Vec<f64> =
        integrator.problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect();
    polynomial
        .terms()
        .map(|(exponents, value)| {
            let (momenta, powers) = exponents.split_at(n);
            let scale: f64 = symbols.iter().zip(powers).map(|(s, &p)| s.powi(p as i32)).product();
            let factors = momenta.iter().enumerate().filter(|(_, power)| **power > 0);
            let factors = factors.map(|(i, &power)| (i, power as i32)).collect();
            (scale * value.to_f64().unwrap_or(f64::NAN), factors)
        })
        .collect()
}

fn evaluate(terms: &Terms, mu: &DVector<f64>) -> f64 {
    let monomial = |factors: &[(usize, i32)]| {
        factors.iter().map(|&(i, power)| mu[i].powi(power)).product::<f64>()
    };
    terms.iter().map(|(value, factors)| value * monomial(factors)).sum()
}
