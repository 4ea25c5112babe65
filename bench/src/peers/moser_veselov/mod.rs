//! The preprocessed discrete Moser–Veselov algorithm, orders 2 to 10: the specialist for the free body.
//!
//! It uses the free body's two invariants (energy and |m|²) to choose modified moments, and works for nothing else.

mod preprocess;
mod solve;

pub use preprocess::modified_inertia;

use crate::{
    arithmetic::{Compensated, Quaternion, Vector, dot, multiply},
    method::{Method, RunError, Setting, step_sweep},
    problem::{FreeBody, Problem, System},
    state::{Rotation, State},
};

/// How a step is solved and summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// As published: fixed point to 1e−15.
    FixedPoint,
    /// Cubic extrapolation from four steps, then Newton.
    Newton,
    /// The same, with compensated summation of momentum and attitude.
    Compensated,
}

/// The method of one order in one form.
#[derive(Clone, Debug)]
pub struct MoserVeselov {
    name: String,
    order: u32,
    form: Form,
}

impl MoserVeselov {
    /// Of order 2, 4, 6, 8 or 10.
    #[must_use]
    pub fn new(order: u32, form: Form) -> Self {
        let how = match form {
            Form::FixedPoint => "fixed point",
            Form::Newton => "Newton",
            Form::Compensated => "Newton, compensated",
        };
        Self { name: format!("DMV{order}, {how}"), order, form }
    }

    #[inline]
    fn solve(
        &self,
        body: &FreeBody,
        m: Vector,
        q: Quaternion,
        end: f64,
        step: f64,
    ) -> Result<State, RunError> {
        let (count, h) = Setting::steps(step, end);
        let algorithm = Algorithm::new(modified_inertia(&body.inertia, &m, h, self.order), h);
        let (m, q) = match self.form {
            Form::FixedPoint => algorithm.published(m, q, count)?,
            Form::Newton => algorithm.fast::<Plain>(m, q, count)?,
            Form::Compensated => algorithm.fast::<Careful>(m, q, count)?,
        };
        Ok(FreeBody::state(m, Rotation::Quaternion(q)))
    }
}

/// The constants of a run.
struct Algorithm {
    /// h/(2Ĩᵢ).
    half: Vector,
    /// (Ĩⱼ − Ĩₖ)/Ĩᵢ.
    f: Vector,
    /// (4/h)(Ĩⱼ − Ĩₖ).
    kick: Vector,
}

impl Algorithm {
    fn new(inertia: Vector, h: f64) -> Self {
        let difference: Vector =
            std::array::from_fn(|i| inertia[(i + 1) % 3] - inertia[(i + 2) % 3]);
        Self {
            half: inertia.map(|moment| 0.5 * h / moment),
            f: std::array::from_fn(|i| difference[i] / inertia[i]),
            kick: difference.map(|d| 4.0 / h * d),
        }
    }

    #[inline(always)]
    fn input(&self, m: &Vector) -> Vector {
        [self.half[0] * m[0], self.half[1] * m[1], self.half[2] * m[2]]
    }

    /// What c adds to the momentum.
    #[inline(always)]
    fn increment(&self, c: &Vector, squares: f64) -> Vector {
        let scale = 1.0 / (1.0 + squares);
        [
            self.kick[0] * c[1] * c[2] * scale,
            self.kick[1] * c[2] * c[0] * scale,
            self.kick[2] * c[0] * c[1] * scale,
        ]
    }

    #[inline(always)]
    fn published(
        &self,
        mut m: Vector,
        mut q: Quaternion,
        count: usize,
    ) -> Result<(Vector, Quaternion), RunError> {
        for _ in 0..count {
            let c = solve::fixed_point(&self.input(&m), &self.f)?;
            let squares = dot(&c, &c);
            let scale = 1.0 / (1.0 + squares).sqrt();
            q = multiply(&q, &[scale, scale * c[0], scale * c[1], scale * c[2]]);
            let increment = self.increment(&c, squares);
            for i in 0..3 {
                m[i] += increment[i];
            }
        }
        Ok((m, q))
    }

    #[inline(always)]
    fn fast<S: Sum>(
        &self,
        m: Vector,
        q: Quaternion,
        count: usize,
    ) -> Result<(Vector, Quaternion), RunError> {
        let (mut m, mut q) = (S::Of::<3>::start(m), S::Of::<4>::start(q));
        let mut past = [[0.0; 3]; 4];
        for number in 0..count {
            let a = self.input(&m.now());
            let guess = if number < 4 {
                a
            } else {
                std::array::from_fn(|i| {
                    4.0 * (past[0][i] + past[2][i]) - 6.0 * past[1][i] - past[3][i]
                })
            };
            let c = solve::newton(&a, &self.f, guess)?;
            past = [c, past[0], past[1], past[2]];
            let squares = dot(&c, &c);
            let root = (1.0 + squares).sqrt();
            let scale = 1.0 / root;
            // (1, c)/√(1 + |c|²) less one, without cancellation.
            let turn = [-squares / (root * (1.0 + root)), scale * c[0], scale * c[1], scale * c[2]];
            q.plus(&multiply(&q.now(), &turn));
            m.plus(&self.increment(&c, squares));
        }
        Ok((m.now(), q.now()))
    }
}

/// A choice of running sums.
trait Sum {
    type Of<const N: usize>: Running<N>;
}

/// A running sum.
trait Running<const N: usize> {
    fn start(value: [f64; N]) -> Self;
    fn now(&self) -> [f64; N];
    fn plus(&mut self, increment: &[f64; N]);
}

struct Plain;
struct Careful;

impl Sum for Plain {
    type Of<const N: usize> = [f64; N];
}

impl Sum for Careful {
    type Of<const N: usize> = Compensated<N>;
}

impl<const N: usize> Running<N> for [f64; N] {
    #[inline(always)]
    fn start(value: [f64; N]) -> Self {
        value
    }

    #[inline(always)]
    fn now(&self) -> [f64; N] {
        *self
    }

    #[inline(always)]
    fn plus(&mut self, increment: &[f64; N]) {
        for i in 0..N {
            self[i] += increment[i];
        }
    }
}

impl<const N: usize> Running<N> for Compensated<N> {
    #[inline(always)]
    fn start(value: [f64; N]) -> Self {
        Compensated::new(value)
    }

    #[inline(always)]
    fn now(&self) -> [f64; N] {
        self.value()
    }

    #[inline(always)]
    fn plus(&mut self, increment: &[f64; N]) {
        self.add(increment);
    }
}

impl Method for MoserVeselov {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        match self.form {
            Form::FixedPoint => "DMV, fixed point",
            Form::Newton | Form::Compensated => "DMV, Newton",
        }
    }

    fn order(&self) -> Option<u32> {
        Some(self.order)
    }

    fn applies(&self, problem: &Problem) -> bool {
        matches!(problem.system, System::FreeBody(_))
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep(problem)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(&self.name)?;
        let System::FreeBody(body) = &problem.system else {
            return Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: problem.name.to_owned(),
            });
        };
        let y = FreeBody::pack(&problem.initial);
        self.solve(body, problem.initial.momentum, [y[3], y[4], y[5], y[6]], problem.end, step)
    }
}
