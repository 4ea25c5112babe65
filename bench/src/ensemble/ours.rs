//! Our ensembles by the attribute and [`advance_all`], as a user writes them.

use coadjoint::{Phase, SO3, ensemble::advance_all, lie_poisson};

use super::EnsembleMethod;
use crate::{
    arithmetic::Vector,
    method::{RunError, Setting},
    problem::{FreeBody, Problem, System},
    state::{Rotation, State},
};

/// Bodies from whose motion the tail of the series is summed.
const SAMPLE: usize = 16;

/// The ends of bodies that start at the identity: body, momenta, end time, step.
type Run = fn(&FreeBody, &[Vector], f64, f64) -> Result<Vec<State>, RunError>;

/// Writes the Hamiltonian at one truncation, and the run of an ensemble.
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
                momenta: &[Vector],
                end: f64,
                step: f64,
            ) -> Result<Vec<State>, RunError> {
                let (count, h) = Setting::steps(step, end);
                let sample = momenta.iter().copied().take(SAMPLE);
                let step = RigidBody::tuned(h, body.inertia, sample);
                let step = step.map_err(|_| RunError::NotConverged)?;
                let start = |&momentum: &Vector| Phase::<SO3>::at_identity(momentum);
                let mut states: Vec<Phase<SO3>> = momenta.iter().map(start).collect();
                if !advance_all(&step, &mut states, count as u64).is_empty() {
                    return Err(RunError::NotConverged);
                }
                Ok(states.iter().map(state).collect())
            }
        }
    };
}

truncated!(nine, 9);
truncated!(eleven, 11);
truncated!(thirteen, 13);
truncated!(seventeen, 17);

fn state(phase: &Phase<SO3>) -> State {
    let (m, q) = (phase.momentum, &phase.group_element);
    FreeBody::state([m[0], m[1], m[2]], Rotation::Quaternion([q.w, q.i, q.j, q.k]))
}

/// A truncation as a row.
struct Ours {
    name: String,
    run: Run,
}

impl EnsembleMethod for Ours {
    fn name(&self) -> &str {
        &self.name
    }

    fn settings(&self) -> Vec<Setting> {
        (2..=14).map(|k| Setting::Step(2f64.powf(-f64::from(k) / 4.0))).collect()
    }

    fn run(
        &self,
        template: &Problem,
        momenta: &[Vector],
        setting: Setting,
    ) -> Result<Vec<State>, RunError> {
        let step = setting.fixed_step(&self.name)?;
        let System::FreeBody(body) = &template.system else {
            return Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: template.name.to_owned(),
            });
        };
        (self.run)(body, momenta, template.end, step)
    }
}

/// Every truncation, tuned to some of the bodies.
#[must_use]
pub fn ours() -> Vec<Box<dyn EnsembleMethod>> {
    let runs: [(u32, Run); 4] =
        [(9, nine::run), (11, eleven::run), (13, thirteen::run), (17, seventeen::run)];
    let row = |(truncation, run)| {
        let name = format!("coadjoint, K = {truncation}, tuned, 8 lanes");
        Box::new(Ours { name, run }) as Box<dyn EnsembleMethod>
    };
    runs.into_iter().map(row).collect()
}
