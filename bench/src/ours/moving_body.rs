//! Tops and bodies in a fluid by the attribute, as a user writes them, at several truncations.

use coadjoint::{Phase, SE3, lie_poisson};
use nalgebra::Vector6;

use super::rows;
use crate::{
    method::{Method, RunError, Setting},
    problem::{Gravity, Mass, MovingBody, Problem, System},
    state::{Rotation, State},
};

/// Runs a generated integrator from the problem's initial state to its end.
macro_rules! run {
    ($body:ident($h:expr, $($argument:expr),*), $problem:expr, $count:expr) => {{
        let (m, f) = ($problem.initial.momentum, $problem.initial.force);
        let momentum = Vector6::new(m[0], m[1], m[2], f[0], f[1], f[2]);
        let step = $body::new($h, $($argument),*).map_err(|_| RunError::NotConverged)?;
        let mut phase = Phase::<SE3>::at_identity(momentum);
        let made = step.advance_by(&mut phase, $count as u64);
        made.map_err(|_| RunError::NotConverged)?;
        Ok(state(&phase))
    }};
}

/// Writes a top with its centre of mass on one principal axis, at one truncation.
macro_rules! top {
    ($module:ident, $truncation:literal, $axis:literal) => {
        mod $module {
            use super::*;

            /// Heavy top: inverse moments of inertia in 1/(kg m²), weight times lever arm in J.
            #[lie_poisson(group = SE3, truncation = $truncation)]
            pub fn heavy_top(mu: [f64; 6], inverse: [f64; 3], weight: f64) -> f64 {
                0.5 * (inverse[0] * mu[0] * mu[0]
                    + inverse[1] * mu[1] * mu[1]
                    + inverse[2] * mu[2] * mu[2])
                    + weight * mu[3 + $axis]
            }

            pub fn run(
                body: &MovingBody<Gravity<$axis>>,
                problem: &Problem,
                step: f64,
            ) -> Result<State, RunError> {
                let (count, h) = Setting::steps(step, problem.end);
                let weight = body.translation.weight;
                run!(HeavyTop(h, body.inverse_inertia, weight), problem, count)
            }
        }
    };
}

/// Writes a symmetric top with its centre of mass on its axis, the second one, at one truncation.
macro_rules! symmetric_top {
    ($module:ident, $truncation:literal) => {
        mod $module {
            use super::*;

            /// Lagrange's top: inverse moments of inertia in 1/(kg m²), weight times lever arm in J.
            #[lie_poisson(group = SE3, truncation = $truncation, frame = comoving)]
            pub fn lagrange_top(mu: [f64; 6], transverse: f64, axial: f64, weight: f64) -> f64 {
                0.5 * (transverse * (mu[0] * mu[0] + mu[2] * mu[2]) + axial * mu[1] * mu[1])
                    + weight * mu[4]
            }

            pub fn run(
                body: &MovingBody<Gravity<1>>,
                problem: &Problem,
                step: f64,
            ) -> Result<State, RunError> {
                let (count, h) = Setting::steps(step, problem.end);
                let [transverse, axial, _] = body.inverse_inertia;
                let weight = body.translation.weight;
                run!(LagrangeTop(h, transverse, axial, weight), problem, count)
            }
        }
    };
}

/// Writes Kirchhoff's body at one truncation in one frame.
macro_rules! kirchhoff {
    ($module:ident, $truncation:literal, $frame:ident) => {
        mod $module {
            use super::*;

            /// Body in a fluid: inverse moments of inertia and masses, added ones included.
            #[lie_poisson(group = SE3, truncation = $truncation, frame = $frame)]
            pub fn kirchhoff(mu: [f64; 6], inertia: [f64; 3], mass: [f64; 3]) -> f64 {
                0.5 * (inertia[0] * mu[0] * mu[0]
                    + inertia[1] * mu[1] * mu[1]
                    + inertia[2] * mu[2] * mu[2]
                    + mass[0] * mu[3] * mu[3]
                    + mass[1] * mu[4] * mu[4]
                    + mass[2] * mu[5] * mu[5])
            }

            pub fn run(
                body: &MovingBody<Mass>,
                problem: &Problem,
                step: f64,
            ) -> Result<State, RunError> {
                let (count, h) = Setting::steps(step, problem.end);
                let (inertia, mass) = (body.inverse_inertia, body.translation.inverse);
                run!(Kirchhoff(h, inertia, mass), problem, count)
            }
        }
    };
}

top!(first_axis_five, 5, 0);
top!(first_axis_seven, 7, 0);
top!(first_axis_nine, 9, 0);
top!(first_axis_eleven, 11, 0);
top!(second_axis_five, 5, 1);
top!(second_axis_seven, 7, 1);
top!(second_axis_nine, 9, 1);
symmetric_top!(symmetric_five, 5);
symmetric_top!(symmetric_seven, 7);
symmetric_top!(symmetric_nine, 9);
kirchhoff!(kirchhoff_five, 5, fixed);
kirchhoff!(kirchhoff_seven, 7, fixed);
kirchhoff!(comoving_kirchhoff_five, 5, comoving);
kirchhoff!(comoving_kirchhoff_seven, 7, comoving);
kirchhoff!(comoving_kirchhoff_nine, 9, comoving);

type BodyRun<T> = fn(&MovingBody<T>, &Problem, f64) -> Result<State, RunError>;

/// One truncation over the three kinds of systems on se(3)\*.
#[derive(Clone, Copy)]
struct Runs {
    first_axis: BodyRun<Gravity<0>>,
    // These are left out where their code would take minutes to compile.
    second_axis: Option<BodyRun<Gravity<1>>>,
    kirchhoff: Option<BodyRun<Mass>>,
}

impl super::Run for Runs {
    fn applies(&self, system: &System) -> bool {
        match system {
            System::FreeBody(_) => false,
            System::Kirchhoff(_) => self.kirchhoff.is_some(),
            System::HeavyTop(_) => self.second_axis.is_some(),
            System::Kovalevskaya(_) => true,
        }
    }

    fn run(&self, problem: &Problem, step: f64) -> Option<Result<State, RunError>> {
        match &problem.system {
            System::FreeBody(_) => None,
            System::HeavyTop(body) => self.second_axis.map(|run| run(body, problem, step)),
            System::Kovalevskaya(body) => Some((self.first_axis)(body, problem, step)),
            System::Kirchhoff(body) => self.kirchhoff.map(|run| run(body, problem, step)),
        }
    }
}

/// One truncation in the comoving frame, where it is another than the fixed one.
#[derive(Clone, Copy)]
struct Comoving {
    symmetric_top: BodyRun<Gravity<1>>,
    kirchhoff: BodyRun<Mass>,
}

impl super::Run for Comoving {
    fn applies(&self, system: &System) -> bool {
        match system {
            System::HeavyTop(body) => body.inverse_inertia[0] == body.inverse_inertia[2],
            System::Kirchhoff(_) => true,
            System::FreeBody(_) | System::Kovalevskaya(_) => false,
        }
    }

    /// A top's steps follow the nutation, which is slower than the spin.
    fn pace(&self, system: &System) -> f64 {
        if matches!(system, System::HeavyTop(_)) { 16.0 } else { 1.0 }
    }

    fn run(&self, problem: &Problem, step: f64) -> Option<Result<State, RunError>> {
        match &problem.system {
            _ if !self.applies(&problem.system) => None,
            System::HeavyTop(body) => Some((self.symmetric_top)(body, problem, step)),
            System::Kirchhoff(body) => Some((self.kirchhoff)(body, problem, step)),
            System::FreeBody(_) | System::Kovalevskaya(_) => None,
        }
    }
}

/// Every truncation.
#[must_use]
pub fn all() -> Vec<Box<dyn Method>> {
    let runs = [
        (
            5,
            Runs {
                first_axis: first_axis_five::run,
                second_axis: Some(second_axis_five::run),
                kirchhoff: Some(kirchhoff_five::run),
            },
        ),
        (
            7,
            Runs {
                first_axis: first_axis_seven::run,
                second_axis: Some(second_axis_seven::run),
                kirchhoff: Some(kirchhoff_seven::run),
            },
        ),
        (
            9,
            Runs {
                first_axis: first_axis_nine::run,
                second_axis: Some(second_axis_nine::run),
                kirchhoff: None,
            },
        ),
        (11, Runs { first_axis: first_axis_eleven::run, second_axis: None, kirchhoff: None }),
    ];
    let comoving = [
        (
            5,
            Comoving {
                symmetric_top: symmetric_five::run,
                kirchhoff: comoving_kirchhoff_five::run,
            },
        ),
        (
            7,
            Comoving {
                symmetric_top: symmetric_seven::run,
                kirchhoff: comoving_kirchhoff_seven::run,
            },
        ),
        (
            9,
            Comoving {
                symmetric_top: symmetric_nine::run,
                kirchhoff: comoving_kirchhoff_nine::run,
            },
        ),
    ];
    let fixed = runs.into_iter().flat_map(|(truncation, runs)| rows(truncation, "SE(3)", runs));
    let comoving = comoving
        .into_iter()
        .flat_map(|(truncation, runs)| rows(truncation, "SE(3), comoving", runs));
    fixed.chain(comoving).collect()
}

fn state(phase: &Phase<SE3>) -> State {
    let (m, q) = (&phase.momentum, &phase.group_element.rotation);
    let x = &phase.group_element.translation;
    State {
        momentum: [m[0], m[1], m[2]],
        force: [m[3], m[4], m[5]],
        rotation: Rotation::Quaternion([q.w, q.i, q.j, q.k]),
        position: [x.x, x.y, x.z],
    }
}
