//! The free body by the attribute, as a user writes it, at several truncations.

use coadjoint::{Phase, SO3, lie_poisson};

use super::rows;
use crate::{
    method::{Method, RunError, Setting},
    problem::{FreeBody, Problem, System},
    state::{Rotation, State},
};

/// Writes the Hamiltonian at one truncation in one frame and its run over an interval.
macro_rules! truncated {
    ($module:ident, $truncation:literal, $frame:ident) => {
        pub(crate) mod $module {
            use super::*;

            /// Free rigid body, moments of inertia in kg m².
            #[lie_poisson(group = SO3, truncation = $truncation, frame = $frame)]
            pub fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
                0.5 * (mu[0] * mu[0] / inertia[0]
                    + mu[1] * mu[1] / inertia[1]
                    + mu[2] * mu[2] / inertia[2])
            }

            pub fn run(
                body: &FreeBody,
                momentum: [f64; 3],
                end: f64,
                step: f64,
            ) -> Result<State, RunError> {
                let (count, h) = Setting::steps(step, end);
                let step = RigidBody::new(h, body.inertia).map_err(|_| RunError::NotConverged)?;
                let mut phase = Phase::<SO3>::at_identity(momentum);
                let made = step.advance_by(&mut phase, count as u64);
                made.map_err(|_| RunError::NotConverged)?;
                Ok(state(&phase))
            }
        }
    };
}

truncated!(five, 5, fixed);
truncated!(seven, 7, fixed);
truncated!(nine, 9, fixed);
truncated!(eleven, 11, fixed);
truncated!(thirteen, 13, fixed);
truncated!(fifteen, 15, fixed);
truncated!(seventeen, 17, fixed);
truncated!(comoving_five, 5, comoving);
truncated!(comoving_seven, 7, comoving);
truncated!(comoving_nine, 9, comoving);
truncated!(comoving_eleven, 11, comoving);
truncated!(comoving_thirteen, 13, comoving);
truncated!(comoving_fifteen, 15, comoving);

/// A phase point as the comparison has it.
pub(crate) fn state(phase: &Phase<SO3>) -> State {
    let (m, q) = (phase.momentum, &phase.group_element);
    FreeBody::state([m[0], m[1], m[2]], Rotation::Quaternion([q.w, q.i, q.j, q.k]))
}

type FreeBodyRun = fn(&FreeBody, [f64; 3], f64, f64) -> Result<State, RunError>;

/// One truncation in one frame.
#[derive(Clone, Copy)]
struct Runs {
    run: FreeBodyRun,
    /// By what factor steps are longer in this frame.
    pace: f64,
}

impl super::Run for Runs {
    fn applies(&self, system: &System) -> bool {
        matches!(system, System::FreeBody(_))
    }

    fn pace(&self, _: &System) -> f64 {
        self.pace
    }

    fn run(&self, problem: &Problem, step: f64) -> Option<Result<State, RunError>> {
        let System::FreeBody(body) = &problem.system else {
            return None;
        };
        Some((self.run)(body, problem.initial.momentum, problem.end, step))
    }
}

/// Every truncation.
#[must_use]
pub fn all() -> Vec<Box<dyn Method>> {
    let runs: [(u32, FreeBodyRun); 7] = [
        (5, five::run),
        (7, seven::run),
        (9, nine::run),
        (11, eleven::run),
        (13, thirteen::run),
        (15, fifteen::run),
        (17, seventeen::run),
    ];
    let comoving: [(u32, FreeBodyRun); 6] = [
        (5, comoving_five::run),
        (7, comoving_seven::run),
        (9, comoving_nine::run),
        (11, comoving_eleven::run),
        (13, comoving_thirteen::run),
        (15, comoving_fifteen::run),
    ];
    let fixed = runs
        .into_iter()
        .flat_map(|(truncation, run)| rows(truncation, "SO(3)", Runs { run, pace: 1.0 }));
    // Steps follow the wobble.
    let comoving = comoving
        .into_iter()
        .flat_map(|(truncation, run)| rows(truncation, "SO(3), comoving", Runs { run, pace: 2.0 }));
    fixed.chain(comoving).collect()
}
