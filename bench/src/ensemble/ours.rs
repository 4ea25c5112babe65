//! Our ensembles by [`advance_all`].

use coadjoint::{F64x8, Lanes, Phase, SO3, StepError, ensemble::advance_all};

use super::EnsembleMethod;
use crate::{
    arithmetic::Vector,
    method::{RunError, Setting},
    ours::free_body::{self, eleven, nine, seventeen, thirteen},
    problem::{FreeBody, Problem, System},
    state::State,
};

/// Bodies from whose motion the tail of the series is summed.
const SAMPLE: usize = 16;

/// The ends of bodies that start at the identity: body, momenta, end time, step.
type Run = fn(&FreeBody, &[Vector], f64, f64) -> Result<Vec<State>, RunError>;

/// The ends by the step that `tuned` makes for a step size and some of the momenta.
fn ends<S>(
    tuned: impl Fn(f64, &[Vector]) -> Result<S, StepError>,
    momenta: &[Vector],
    end: f64,
    step: f64,
) -> Result<Vec<State>, RunError>
where
    S: Lanes<Group = SO3> + Sync,
    S::Over<F64x8>: Sync,
{
    let (count, h) = Setting::steps(step, end);
    let sample = &momenta[..SAMPLE.min(momenta.len())];
    let step = tuned(h, sample).map_err(|_| RunError::NotConverged)?;
    let start = |&momentum: &Vector| Phase::<SO3>::at_identity(momentum);
    let mut states: Vec<Phase<SO3>> = momenta.iter().map(start).collect();
    if !advance_all(&step, &mut states, count as u64).is_empty() {
        return Err(RunError::NotConverged);
    }
    Ok(states.iter().map(free_body::state).collect())
}

/// The run by the integrator of one truncation.
macro_rules! run {
    ($module:ident) => {
        |body, momenta, end, step| {
            let tuned = |h, sample: &[Vector]| {
                $module::RigidBody::tuned(h, body.inertia, sample.iter().copied())
            };
            ends(tuned, momenta, end, step)
        }
    };
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
        [(9, run!(nine)), (11, run!(eleven)), (13, run!(thirteen)), (17, run!(seventeen))];
    let row = |(truncation, run)| {
        let name = format!("coadjoint, K = {truncation}, tuned, 8 lanes");
        Box::new(Ours { name, run }) as Box<dyn EnsembleMethod>
    };
    runs.into_iter().map(row).collect()
}
