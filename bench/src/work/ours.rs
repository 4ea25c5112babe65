//! Ours, by the attribute as a user writes it.

use coadjoint::{Phase, SE3, SO3, lie_poisson};

use super::method::{Competitor, Run, equal_steps};
use super::problem::{Dynamics, Problem, State, Vector, matrix};
use crate::timing::Failure;

macro_rules! free {
    ($module:ident, $truncation:literal, $frame:ident) => {
        mod $module {
            use super::*;

            #[lie_poisson(group = SO3, truncation = $truncation, frame = $frame)]
            fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
                0.5 * (mu[0] * mu[0] / inertia[0]
                    + mu[1] * mu[1] / inertia[1]
                    + mu[2] * mu[2] / inertia[2])
            }

            pub fn run(problem: &Problem, step: f64) -> Result<State, Failure> {
                let (count, h) = equal_steps(step, problem.end);
                let step = Body::<f64>::new(h, problem.inverse_inertia.map(f64::recip))?;
                let mut phase = Phase::<SO3>::at_identity(problem.momentum);
                step.advance_by(&mut phase, count)?;
                let (m, q) = (phase.momentum, &phase.group_element);
                Ok(State::rotating([m[0], m[1], m[2]], matrix(&[q.w, q.i, q.j, q.k])))
            }
        }
    };
}

/// Runs a step on SE(3).
macro_rules! run {
    ($problem:ident, $step:ident, $make:expr) => {{
        let (count, h) = equal_steps($step, $problem.end);
        let step = $make(h)?;
        let (m, f) = ($problem.momentum, $problem.force);
        let mut phase = Phase::<SE3>::at_identity([m[0], m[1], m[2], f[0], f[1], f[2]]);
        step.advance_by(&mut phase, count)?;
        Ok(state(&phase))
    }};
}

/// A top with its centre of mass on an axis.
macro_rules! top {
    ($module:ident, $truncation:literal, $axis:literal, $kind:ident) => {
        mod $module {
            use super::*;

            #[lie_poisson(group = SE3, truncation = $truncation)]
            fn top(mu: [f64; 6], inverse: [f64; 3], weight: f64) -> f64 {
                0.5 * (inverse[0] * mu[0] * mu[0]
                    + inverse[1] * mu[1] * mu[1]
                    + inverse[2] * mu[2] * mu[2])
                    + weight * mu[3 + $axis]
            }

            pub fn run(problem: &Problem, step: f64) -> Result<State, Failure> {
                let Dynamics::$kind(weight) = problem.kind else {
                    return Err("another top".into());
                };
                run!(problem, step, |h| Top::<f64>::new(h, problem.inverse_inertia, weight))
            }
        }
    };
}

/// A symmetric top with its centre of mass on its axis, the second one.
macro_rules! symmetric_top {
    ($module:ident, $truncation:literal) => {
        mod $module {
            use super::*;

            #[lie_poisson(group = SE3, truncation = $truncation, frame = comoving)]
            fn top(mu: [f64; 6], transverse: f64, axial: f64, weight: f64) -> f64 {
                0.5 * (transverse * (mu[0] * mu[0] + mu[2] * mu[2]) + axial * mu[1] * mu[1])
                    + weight * mu[4]
            }

            pub fn run(problem: &Problem, step: f64) -> Result<State, Failure> {
                let (Dynamics::TopOnSecond(weight), [transverse, axial, other]) =
                    (problem.kind, problem.inverse_inertia)
                else {
                    return Err("no such top".into());
                };
                if transverse != other {
                    return Err("the top is not symmetric".into());
                }
                run!(problem, step, |h| Top::<f64>::new(h, transverse, axial, weight))
            }
        }
    };
}

macro_rules! fluid {
    ($module:ident, $truncation:literal, $frame:ident) => {
        mod $module {
            use super::*;

            #[lie_poisson(group = SE3, truncation = $truncation, frame = $frame)]
            fn kirchhoff(mu: [f64; 6], inertia: [f64; 3], mass: [f64; 3]) -> f64 {
                0.5 * (inertia[0] * mu[0] * mu[0]
                    + inertia[1] * mu[1] * mu[1]
                    + inertia[2] * mu[2] * mu[2]
                    + mass[0] * mu[3] * mu[3]
                    + mass[1] * mu[4] * mu[4]
                    + mass[2] * mu[5] * mu[5])
            }

            pub fn run(problem: &Problem, step: f64) -> Result<State, Failure> {
                let Dynamics::Fluid(mass) = problem.kind else { return Err("no fluid".into()) };
                run!(problem, step, |h| Kirchhoff::<f64>::new(h, problem.inverse_inertia, mass))
            }
        }
    };
}

free!(free_7, 7, fixed);
free!(free_9, 9, fixed);
free!(free_13, 13, fixed);
free!(comoving_7, 7, comoving);
free!(comoving_9, 9, comoving);
free!(comoving_11, 11, comoving);
free!(comoving_13, 13, comoving);
top!(first_5, 5, 0, TopOnFirst);
top!(first_7, 7, 0, TopOnFirst);
top!(first_9, 9, 0, TopOnFirst);
top!(second_7, 7, 1, TopOnSecond);
symmetric_top!(symmetric_7, 7);
symmetric_top!(symmetric_9, 9);
fluid!(fluid_7, 7, fixed);
fluid!(comoving_fluid_7, 7, comoving);
fluid!(comoving_fluid_9, 9, comoving);

/// Our methods for a problem: each truncation in the fixed and, where that is another, in the comoving frame. There a
/// free body's steps follow the wobble and a top's the nutation, so the sweep begins with longer ones.
pub fn methods(problem: &Problem) -> Vec<Competitor> {
    let list: &[(u32, bool, f64, Run)] = match problem.kind {
        Dynamics::Free => &[
            (7, false, 1.0, free_7::run),
            (9, false, 1.0, free_9::run),
            (13, false, 1.0, free_13::run),
            (7, true, 2.0, comoving_7::run),
            (9, true, 2.0, comoving_9::run),
            (11, true, 2.0, comoving_11::run),
            (13, true, 2.0, comoving_13::run),
        ],
        Dynamics::TopOnFirst(_) => &[
            (5, false, 1.0, first_5::run),
            (7, false, 1.0, first_7::run),
            (9, false, 1.0, first_9::run),
        ],
        Dynamics::TopOnSecond(_) => &[
            (7, false, 1.0, second_7::run),
            (7, true, 16.0, symmetric_7::run),
            (9, true, 16.0, symmetric_9::run),
        ],
        Dynamics::Fluid(_) => &[
            (7, false, 1.0, fluid_7::run),
            (7, true, 1.0, comoving_fluid_7::run),
            (9, true, 1.0, comoving_fluid_9::run),
        ],
        _ => &[],
    };
    let method = |&(truncation, comoving, pace, run): &(u32, bool, f64, Run)| {
        let frame = if comoving { "comoving, " } else { "" };
        let name = format!("coadjoint, {frame}K = {truncation}");
        Competitor::stepping(name, truncation + 1, pace * problem.time_scale, run)
    };
    list.iter().map(method).collect()
}

fn state(phase: &Phase<SE3>) -> State {
    let (m, g) = (&phase.momentum, &phase.group_element);
    let (q, x) = (&g.rotation, &g.translation);
    let force: Vector = [m[3], m[4], m[5]];
    let rotation = matrix(&[q.w, q.i, q.j, q.k]);
    State { momentum: [m[0], m[1], m[2]], force, rotation, position: [x.x, x.y, x.z] }
}
