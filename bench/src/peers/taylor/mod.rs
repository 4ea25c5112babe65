//! Taylor's method: the series of the solution by the recurrences of automatic differentiation, at fixed order.
//!
//! Jorba and Zou, *A software package for the numerical integration of ODEs by means of high-order Taylor methods*,
//! Experimental Mathematics 14 (2005) 99, for the adaptive step.

pub mod batch;
mod free_body;
mod lanes;
mod moving_body;

use lanes::{Lanes, scaled};
use moving_body::Translating;

use crate::{
    method::{Method, RunError, Setting, step_sweep, tolerance_sweep},
    problem::{FreeBody, MovingBody, Problem, System},
    state::{Rotation, State},
};

/// The series of the solution through y: N coefficients of M times four lanes.
trait Recurrence<const M: usize> {
    fn expand<const N: usize>(&self, y: &[Lanes; M]) -> [[Lanes; M]; N];
}

/// Runs a block for each order `K` below `N − 1`, with `K` a constant, so that every sum is unrolled.
macro_rules! for_each_order {
    ($k:ident, $n:ident, $block:block) => {
        $crate::peers::taylor::for_each_order!(@ $k $n $block
            0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23)
    };
    (@ $k:ident $n:ident $block:block $($order:literal)*) => {
        $(if $order + 1 < $n {
            const $k: usize = $order;
            $block
        })*
    };
}
use for_each_order;

/// Taylor's method with N coefficients, that is of order N − 1.
#[derive(Clone, Debug)]
pub struct Taylor<const N: usize> {
    name: String,
    adaptive: bool,
}

impl<const N: usize> Taylor<N> {
    /// With a fixed step.
    #[must_use]
    pub fn fixed() -> Self {
        Self { name: format!("Taylor, order {}", N - 1), adaptive: false }
    }

    /// With a step chosen from the last two coefficients.
    #[must_use]
    pub fn adaptive() -> Self {
        Self { name: format!("Taylor, order {}, adaptive", N - 1), adaptive: true }
    }

    #[inline]
    fn solve<const M: usize, S: Recurrence<M>>(
        &self,
        system: &S,
        initial: [Lanes; M],
        end: f64,
        setting: Setting,
    ) -> Result<[Lanes; M], RunError> {
        let mut y = initial;
        match setting {
            Setting::Step(step) if !self.adaptive => {
                let (count, h) = Setting::steps(step, end);
                for _ in 0..count {
                    y = horner(&system.expand::<N>(&y), h);
                }
                Ok(y)
            }
            Setting::Tolerance(tolerance) if self.adaptive => {
                let mut t = 0.0;
                while t < end {
                    let series = system.expand::<N>(&y);
                    let h = step_size(&series, tolerance);
                    if !h.is_finite() || h < 1e-12 * end {
                        return Err(RunError::NotConverged);
                    }
                    let left = end - t;
                    y = horner(&series, h.min(left));
                    t = if h >= left { end } else { t + h };
                }
                Ok(y)
            }
            given => {
                let wanted = if self.adaptive { "a tolerance" } else { "a step" };
                Err(RunError::Setting { method: self.name.clone(), wanted, given })
            }
        }
    }

    fn moving<T: Translating>(
        &self,
        body: &MovingBody<T>,
        problem: &Problem,
        setting: Setting,
    ) -> Result<State, RunError> {
        let initial = &problem.initial;
        let rotation = initial.rotation.matrix();
        let column = |i: usize| [rotation[0][i], rotation[1][i], rotation[2][i], initial.force[i]];
        let [m, x] = [initial.momentum, initial.position].map(|v| [v[0], v[1], v[2], 0.0]);
        let y = self.solve(body, [m, column(0), column(1), column(2), x], problem.end, setting)?;
        Ok(State {
            momentum: [y[0][0], y[0][1], y[0][2]],
            force: [y[1][3], y[2][3], y[3][3]],
            rotation: Rotation::Matrix(std::array::from_fn(|row| {
                std::array::from_fn(|column| y[1 + column][row])
            })),
            position: [y[4][0], y[4][1], y[4][2]],
        })
    }
}

/// Σ yₖ hᵏ.
#[inline(always)]
fn horner<const M: usize, const N: usize>(series: &[[Lanes; M]; N], h: f64) -> [Lanes; M] {
    std::array::from_fn(|i| {
        series.iter().rev().skip(1).fold(series[N - 1][i], |sum, c| scaled(h, &sum, c[i]))
    })
}

/// The largest h for which each of the last two terms is below `tolerance` times the state.
#[inline(always)]
fn step_size<const M: usize, const N: usize>(series: &[[Lanes; M]; N], tolerance: f64) -> f64 {
    let size = |k: usize| series[k].iter().flatten().fold(0.0f64, |max, v| max.max(v.abs()));
    let limit = tolerance * size(0);
    // Seven digits of a step size are plenty, and single precision takes a fraction of the time.
    let root = |k: usize| f64::from(((limit / size(k)) as f32).powf(1.0 / k as f32));
    root(N - 1).min(root(N - 2))
}

impl<const N: usize> Method for Taylor<N> {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        "Taylor"
    }

    fn order(&self) -> Option<u32> {
        u32::try_from(N - 1).ok()
    }

    fn applies(&self, _: &Problem) -> bool {
        true
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        if self.adaptive { tolerance_sweep() } else { step_sweep(problem) }
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        match &problem.system {
            System::FreeBody(body) => {
                let m = problem.initial.momentum;
                let q = FreeBody::pack(&problem.initial);
                let initial = [[m[0], m[1], m[2], 0.0], [q[3], q[4], q[5], q[6]]];
                let y = self.solve(body, initial, problem.end, setting)?;
                Ok(FreeBody::state([y[0][0], y[0][1], y[0][2]], Rotation::Quaternion(y[1])))
            }
            System::HeavyTop(body) => self.moving(body, problem, setting),
            System::Kirchhoff(body) => self.moving(body, problem, setting),
            System::Kovalevskaya(body) => self.moving(body, problem, setting),
        }
    }
}
