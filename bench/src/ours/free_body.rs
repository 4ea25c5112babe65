//! The free body by the attribute, as a user writes it, at several truncations.

use coadjoint::{Phase, SO3, lie_poisson};

use crate::{
    method::{Method, RunError, Setting, step_sweep},
    problem::{FreeBody, Problem, System},
    state::{Rotation, State},
};

/// Writes the Hamiltonian at one truncation and its run over an interval.
macro_rules! truncated {
    ($module:ident, $truncation:literal) => {
        mod $module {
            use super::*;

            /// Free rigid body, moments of inertia in kg m².
            #[lie_poisson(group = SO3, truncation = $truncation)]
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
                let failed = |_| RunError::NotConverged;
                let step = RigidBody::new(h, body.inertia).map_err(failed)?;
                let mut phase = Phase::<SO3>::at_identity(momentum);
                for _ in 0..count {
                    step.advance(&mut phase).map_err(failed)?;
                }
                let q = &phase.group_element;
                let m = phase.momentum;
                Ok(FreeBody::state([m[0], m[1], m[2]], Rotation::Quaternion([q.w, q.i, q.j, q.k])))
            }
        }
    };
}

truncated!(seven, 7);
truncated!(eleven, 11);
truncated!(thirteen, 13);

type Run = fn(&FreeBody, [f64; 3], f64, f64) -> Result<State, RunError>;

/// Our step for the free body.
pub struct RigidBody {
    name: String,
    truncation: u32,
    run: Run,
}

impl RigidBody {
    fn new(truncation: u32, run: Run) -> Self {
        Self { name: format!("coadjoint, K = {truncation}"), truncation, run }
    }

    /// Every truncation.
    #[must_use]
    pub fn all() -> Vec<Self> {
        vec![Self::new(7, seven::run), Self::new(11, eleven::run), Self::new(13, thirteen::run)]
    }
}

impl Method for RigidBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        "coadjoint"
    }

    fn order(&self) -> Option<u32> {
        Some(self.truncation + 1)
    }

    fn applies(&self, problem: &Problem) -> bool {
        matches!(problem.system, System::FreeBody(_))
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep(problem)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let Setting::Step(step) = setting else {
            return Err(RunError::Setting {
                method: self.name.clone(),
                wanted: "a step",
                given: setting,
            });
        };
        let System::FreeBody(body) = &problem.system else {
            return Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: problem.name.to_owned(),
            });
        };
        (self.run)(body, problem.initial.momentum, problem.end, step)
    }
}
