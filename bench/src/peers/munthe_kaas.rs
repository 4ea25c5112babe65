//! RKMK4: Munthe-Kaas's Runge–Kutta method of order 4 on the group, momentum carried by the coadjoint action.
//!
//! Iserles, Munthe-Kaas, Nørsett, Zanna, *Lie-group methods*, Acta Numerica 9 (2000) 215, section 4, for the classical
//! tableau, with the inverse of dexp to the second commutator.

use crate::{
    arithmetic::{Quaternion, Vector, cross, dot, multiply, rotate},
    method::{Method, RunError, Setting, step_sweep},
    problem::{FreeBody, MovingBody, Problem, System, Translation},
    state::{Rotation, State},
};

/// A left-invariant system on T\*G with an algebra of M dimensions.
trait LeftInvariant<const M: usize> {
    /// An element of the group.
    type Element: Copy;
    /// ξ = ∂H/∂μ.
    fn velocity(&self, momentum: &[f64; M]) -> [f64; M];
    /// [u, v].
    fn bracket(u: &[f64; M], v: &[f64; M]) -> [f64; M];
    /// exp.
    fn exp(u: &[f64; M]) -> Self::Element;
    /// Ad\*_{g⁻¹} μ.
    fn pull_back(g: &Self::Element, momentum: &[f64; M]) -> [f64; M];
    /// g k.
    fn multiply(g: &Self::Element, k: &Self::Element) -> Self::Element;
}

/// sin θ/θ, (1 − cos θ)/θ² and (θ − sin θ)/θ³ of t = θ².
#[inline(always)]
fn kernels(t: f64) -> (f64, f64, f64) {
    if t > 0.25 {
        let angle = t.sqrt();
        let (sine, cosine) = angle.sin_cos();
        return (sine / angle, (1.0 - cosine) / t, (angle - sine) / (t * angle));
    }
    // Terms to t⁷ leave less than 2⁻⁵³ at t = 1/4.
    let series = |first: f64| {
        let (mut sum, mut term) = (0.0, 1.0);
        for k in 0..8 {
            sum += term;
            let n = first + 2.0 * f64::from(k);
            term *= -t / (n * (n + 1.0));
        }
        sum
    };
    (series(2.0), 0.5 * series(3.0), series(4.0) / 6.0)
}

#[inline(always)]
fn quaternion(u: &Vector) -> Quaternion {
    let t = 0.25 * dot(u, u);
    let (sinc, versine, _) = kernels(t);
    let s = 0.5 * sinc;
    [1.0 - t * versine, s * u[0], s * u[1], s * u[2]]
}

#[inline(always)]
fn inverse(q: &Quaternion) -> Quaternion {
    [q[0], -q[1], -q[2], -q[3]]
}

impl LeftInvariant<3> for FreeBody {
    type Element = Quaternion;

    #[inline(always)]
    fn velocity(&self, m: &Vector) -> Vector {
        let a = &self.inverse_inertia;
        [a[0] * m[0], a[1] * m[1], a[2] * m[2]]
    }

    #[inline(always)]
    fn bracket(u: &Vector, v: &Vector) -> Vector {
        cross(u, v)
    }

    #[inline(always)]
    fn exp(u: &Vector) -> Quaternion {
        quaternion(u)
    }

    #[inline(always)]
    fn pull_back(q: &Quaternion, m: &Vector) -> Vector {
        rotate(&inverse(q), m)
    }

    #[inline(always)]
    fn multiply(g: &Quaternion, k: &Quaternion) -> Quaternion {
        multiply(g, k)
    }
}

#[inline(always)]
fn halves(u: &[f64; 6]) -> (Vector, Vector) {
    ([u[0], u[1], u[2]], [u[3], u[4], u[5]])
}

#[inline(always)]
fn join(u: Vector, v: Vector) -> [f64; 6] {
    [u[0], u[1], u[2], v[0], v[1], v[2]]
}

impl<T: Translation> LeftInvariant<6> for MovingBody<T> {
    type Element = (Quaternion, Vector);

    #[inline(always)]
    fn velocity(&self, m: &[f64; 6]) -> [f64; 6] {
        let a = &self.inverse_inertia;
        join(
            [a[0] * m[0], a[1] * m[1], a[2] * m[2]],
            self.translation.velocity(&[m[3], m[4], m[5]]),
        )
    }

    #[inline(always)]
    fn bracket(u: &[f64; 6], v: &[f64; 6]) -> [f64; 6] {
        let ((w, a), (z, b)) = (halves(u), halves(v));
        let (left, right) = (cross(&w, &b), cross(&a, &z));
        join(cross(&w, &z), std::array::from_fn(|i| left[i] + right[i]))
    }

    #[inline(always)]
    fn exp(u: &[f64; 6]) -> Self::Element {
        let (w, v) = halves(u);
        let (_, b, c) = kernels(dot(&w, &w));
        let once = cross(&w, &v);
        let twice = cross(&w, &once);
        (quaternion(&w), std::array::from_fn(|i| v[i] + b * once[i] + c * twice[i]))
    }

    #[inline(always)]
    fn pull_back(g: &Self::Element, m: &[f64; 6]) -> [f64; 6] {
        let (momentum, force) = halves(m);
        let back = inverse(&g.0);
        let arm = cross(&g.1, &force);
        join(rotate(&back, &std::array::from_fn(|i| momentum[i] - arm[i])), rotate(&back, &force))
    }

    #[inline(always)]
    fn multiply(g: &Self::Element, k: &Self::Element) -> Self::Element {
        let moved = rotate(&g.0, &k.1);
        (multiply(&g.0, &k.0), std::array::from_fn(|i| g.1[i] + moved[i]))
    }
}

/// The method.
#[derive(Clone, Copy, Debug, Default)]
pub struct MuntheKaas;

const NAME: &str = "RKMK4";

impl MuntheKaas {
    #[inline]
    fn solve<const M: usize, S: LeftInvariant<M>>(
        system: &S,
        mut g: S::Element,
        mut momentum: [f64; M],
        end: f64,
        step: f64,
    ) -> (S::Element, [f64; M]) {
        let (count, h) = Setting::steps(step, end);
        for _ in 0..count {
            let k1 = system.velocity(&momentum);
            let k2 = slope(system, &scale(&k1, 0.5 * h), &momentum);
            let k3 = slope(system, &scale(&k2, 0.5 * h), &momentum);
            let k4 = slope(system, &scale(&k3, h), &momentum);
            let u = std::array::from_fn(|i| h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
            let turn = S::exp(&u);
            momentum = S::pull_back(&turn, &momentum);
            g = S::multiply(&g, &turn);
        }
        (g, momentum)
    }

    fn moving<T: Translation>(body: &MovingBody<T>, initial: &State, end: f64, step: f64) -> State {
        let y = MovingBody::<T>::pack(initial);
        let start = ([y[6], y[7], y[8], y[9]], initial.position);
        let (g, m) = Self::solve(body, start, join(initial.momentum, initial.force), end, step);
        let (momentum, force) = halves(&m);
        State { momentum, force, rotation: Rotation::Quaternion(g.0), position: g.1 }
    }
}

#[inline(always)]
fn scale<const M: usize>(u: &[f64; M], factor: f64) -> [f64; M] {
    std::array::from_fn(|i| factor * u[i])
}

/// dexp⁻¹_{−u} ξ(exp(u)) = ξ + ½[u, ξ] + 1/12 [u, [u, ξ]].
#[inline(always)]
fn slope<const M: usize, S: LeftInvariant<M>>(
    system: &S,
    u: &[f64; M],
    momentum: &[f64; M],
) -> [f64; M] {
    let velocity = system.velocity(&S::pull_back(&S::exp(u), momentum));
    let once = S::bracket(u, &velocity);
    let twice = S::bracket(u, &once);
    std::array::from_fn(|i| velocity[i] + 0.5 * once[i] + twice[i] / 12.0)
}

impl Method for MuntheKaas {
    fn name(&self) -> &str {
        NAME
    }

    fn family(&self) -> &str {
        NAME
    }

    fn order(&self) -> Option<u32> {
        Some(4)
    }

    fn applies(&self, _: &Problem) -> bool {
        true
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep(problem)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(NAME)?;
        let (initial, end) = (&problem.initial, problem.end);
        Ok(match &problem.system {
            System::FreeBody(body) => {
                let y = FreeBody::pack(initial);
                let (q, m) =
                    Self::solve(body, [y[3], y[4], y[5], y[6]], initial.momentum, end, step);
                FreeBody::state(m, Rotation::Quaternion(q))
            }
            System::HeavyTop(body) => Self::moving(body, initial, end, step),
            System::Kirchhoff(body) => Self::moving(body, initial, end, step),
            System::Kovalevskaya(body) => Self::moving(body, initial, end, step),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_meet_at_the_switch() {
        let (below, above) = (kernels(0.25), kernels(0.25 + 1e-12));
        assert!((below.0 - above.0).abs() < 1e-12);
        assert!((below.1 - above.1).abs() < 1e-12);
        assert!((below.2 - above.2).abs() < 1e-12);
    }
}
