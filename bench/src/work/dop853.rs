//! The Runge–Kutta method of order 8 of Dormand and Prince, of the crate `ode_solvers`.

use coadjoint::{LieGroup, SE3};
use nalgebra::Vector6;
use ode_solvers::{Dop853, SVector, System, dop_shared::OutputType};

use super::method::Competitor;
use super::problem::{Dynamics, Problem, Quaternion, State, Vector, cross, matrix};
use super::smooth::{root, six, spin};
use crate::timing::Failure;

/// Steps no honest run needs; above the crate's own limit, which is below what T = 1000 takes.
const MAX_STEPS: u32 = 100_000_000;

/// The method, by its tolerance.
pub fn method() -> Option<Competitor> {
    Some(Competitor {
        name: "DOP853 (ode_solvers)".to_owned(),
        order: None,
        settings: (24..=128).map(|k| 10f64.powf(-f64::from(k) / 8.0)).collect(),
        run,
    })
}

fn run(problem: &Problem, tolerance: f64) -> Result<State, Failure> {
    let (a, m, f) = (problem.inverse_inertia, problem.momentum, problem.force);
    let start = [m[0], m[1], m[2], 1.0, 0.0, 0.0, 0.0];
    let rotating =
        |y: [f64; 7]| Ok(State::rotating([y[0], y[1], y[2]], matrix(&[y[3], y[4], y[5], y[6]])));
    let mut whole = [0.0; 13];
    whole[..7].copy_from_slice(&start);
    whole[7..10].copy_from_slice(&f);
    let y = match problem.kind {
        Dynamics::Free => {
            let field = Turning(|m: &Vector| [m[0] * a[0], m[1] * a[1], m[2] * a[2]]);
            return rotating(integrate(field, start, problem.end, tolerance)?);
        }
        Dynamics::Root => {
            let field = Turning(|m: &Vector| root(&(*m).into()).into());
            return rotating(integrate(field, start, problem.end, tolerance)?);
        }
        Dynamics::Spin => {
            let field = Turning(|m: &Vector| spin(&(*m).into()).into());
            return rotating(integrate(field, start, problem.end, tolerance)?);
        }
        Dynamics::Six => {
            let y = integrate(Six, [m[0], m[1], m[2], f[0], f[1], f[2]], problem.end, tolerance)?;
            let whole = State::rotating([y[0], y[1], y[2]], [[0.0; 3]; 3]);
            return Ok(State { force: [y[3], y[4], y[5]], ..whole });
        }
        Dynamics::TopOnFirst(w) => {
            integrate(Translating(a, Gravity::<0>(w)), whole, problem.end, tolerance)?
        }
        Dynamics::TopOnSecond(w) => {
            integrate(Translating(a, Gravity::<1>(w)), whole, problem.end, tolerance)?
        }
        Dynamics::Fluid(b) => integrate(Translating(a, Mass(b)), whole, problem.end, tolerance)?,
    };
    Ok(State {
        force: [y[7], y[8], y[9]],
        position: [y[10], y[11], y[12]],
        ..State::rotating([y[0], y[1], y[2]], matrix(&[y[3], y[4], y[5], y[6]]))
    })
}

/// The end of a motion at a tolerance.
fn integrate<const N: usize, F: System<f64, SVector<f64, N>>>(
    field: F,
    start: [f64; N],
    end: f64,
    tolerance: f64,
) -> Result<[f64; N], Failure> {
    let y = SVector::from(start);
    let (sparse, most) = (OutputType::Sparse, MAX_STEPS);
    let (safety, beta, shrink, grow) = (0.9, 0.0, 0.333, 6.0);
    let mut stepper = Dop853::from_param(
        field, 0.0, end, end, y, tolerance, tolerance, safety, beta, shrink, grow, end, 0.0, most,
        most, sparse,
    );
    stepper.integrate().map_err(|error| format!("ode_solvers: {error}"))?;
    let last = stepper.y_out().last().map(|y| y.data.0[0]);
    last.ok_or_else(|| "no step was made".into())
}

/// Π̇ = Π × Ω, q̇ = ½ q (0, Ω), Ω = ∂H/∂Π; the components are (Π, q).
struct Turning<F>(F);

impl<F: Fn(&Vector) -> Vector> System<f64, SVector<f64, 7>> for Turning<F> {
    fn system(&self, _: f64, y: &SVector<f64, 7>, dy: &mut SVector<f64, 7>) {
        let m = [y[0], y[1], y[2]];
        let w = (self.0)(&m);
        let torque = cross(&m, &w);
        let rate = rate(&[y[3], y[4], y[5], y[6]], &w);
        *dy = SVector::from([torque[0], torque[1], torque[2], rate[0], rate[1], rate[2], rate[3]]);
    }
}

/// μ̇ = ad\*_ω μ of six variables.
struct Six;

impl System<f64, SVector<f64, 6>> for Six {
    fn system(&self, _: f64, y: &SVector<f64, 6>, dy: &mut SVector<f64, 6>) {
        let m = Vector6::from(y.data.0[0]);
        *dy = SVector::from(SE3::new().ad_star(&six(&m), &m).data.0[0]);
    }
}

/// ½ q (0, ω).
#[inline(always)]
fn rate(q: &Quaternion, w: &Vector) -> Quaternion {
    let w = w.map(|component| 0.5 * component);
    [
        -q[1] * w[0] - q[2] * w[1] - q[3] * w[2],
        q[0] * w[0] + q[2] * w[2] - q[3] * w[1],
        q[0] * w[1] + q[3] * w[0] - q[1] * w[2],
        q[0] * w[2] + q[1] * w[1] - q[2] * w[0],
    ]
}

/// The part of H that depends on Γ, written without its vanishing terms: V = ∂H/∂Γ as Γ × V and as R V.
trait Translation {
    fn torque(&self, force: &Vector) -> Vector;
    fn moved(&self, q: &Quaternion, force: &Vector) -> Vector;
}

/// w Γ_AXIS.
struct Gravity<const AXIS: usize>(f64);

impl<const AXIS: usize> Translation for Gravity<AXIS> {
    #[inline(always)]
    fn torque(&self, force: &Vector) -> Vector {
        let mut torque = [0.0; 3];
        torque[(AXIS + 1) % 3] = force[(AXIS + 2) % 3] * self.0;
        torque[(AXIS + 2) % 3] = -force[(AXIS + 1) % 3] * self.0;
        torque
    }

    #[inline(always)]
    fn moved(&self, q: &Quaternion, _: &Vector) -> Vector {
        matrix(q).map(|row| row[AXIS] * self.0)
    }
}

/// ½ Σ Γᵢ²/Mᵢ, with its 1/Mᵢ.
struct Mass(Vector);

impl Mass {
    #[inline(always)]
    fn velocity(&self, force: &Vector) -> Vector {
        [force[0] * self.0[0], force[1] * self.0[1], force[2] * self.0[2]]
    }
}

impl Translation for Mass {
    #[inline(always)]
    fn torque(&self, force: &Vector) -> Vector {
        cross(force, &self.velocity(force))
    }

    #[inline(always)]
    fn moved(&self, q: &Quaternion, force: &Vector) -> Vector {
        let (axis, v) = ([q[1], q[2], q[3]], self.velocity(force));
        let t = cross(&axis, &v).map(|component| 2.0 * component);
        let s = cross(&axis, &t);
        [v[0] + q[0] * t[0] + s[0], v[1] + q[0] * t[1] + s[1], v[2] + q[0] * t[2] + s[2]]
    }
}

/// Adds Γ × V to the torque, Γ̇ = Γ × Ω and ẋ = R V; the components are (Π, q, Γ, x).
struct Translating<T>(Vector, T);

impl<T: Translation> System<f64, SVector<f64, 13>> for Translating<T> {
    fn system(&self, _: f64, y: &SVector<f64, 13>, dy: &mut SVector<f64, 13>) {
        let w = [y[0] * self.0[0], y[1] * self.0[1], y[2] * self.0[2]];
        let (q, force) = ([y[3], y[4], y[5], y[6]], [y[7], y[8], y[9]]);
        let (turning, pull) = (cross(&[y[0], y[1], y[2]], &w), self.1.torque(&force));
        let (q_rate, f_rate) = (rate(&q, &w), cross(&force, &w));
        let moved = self.1.moved(&q, &force);
        for i in 0..3 {
            (dy[i], dy[7 + i], dy[10 + i]) = (turning[i] + pull[i], f_rate[i], moved[i]);
        }
        (0..4).for_each(|i| dy[3 + i] = q_rate[i]);
    }
}
