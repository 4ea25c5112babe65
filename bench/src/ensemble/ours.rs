//! Our ensembles by [`advance_all`].

use coadjoint::{Phase, SO3, StepError, lanes::F64x8, lanes::Lanes, lanes::ensemble::advance_all};

use super::EnsembleMethod;
use crate::{
    arithmetic::{Vector, dot},
    method::{RunError, Setting},
    ours::free_body::{
        self, comoving_eleven, comoving_fifteen, comoving_nine, comoving_thirteen, eleven, fifteen,
        nine, thirteen,
    },
    problem::{FreeBody, Problem, System},
    state::State,
};

/// Classes of bodies by the size of their momenta: slow bodies get longer steps, as a method with
/// chosen steps gives them.
const CLASSES: usize = 8;

/// The ends of bodies that start at the identity: body, momenta, end time, step of the fastest.
type Run = fn(&FreeBody, &[Vector], f64, f64) -> Result<Vec<State>, RunError>;

/// The ends by the steps that `make` makes for a step size.
fn ends<S>(
    make: impl Fn(f64) -> Result<S, StepError>,
    momenta: &[Vector],
    end: f64,
    step: f64,
) -> Result<Vec<State>, RunError>
where
    S: Lanes<Group = SO3> + Sync,
    S::Over<F64x8>: Sync,
{
    let size = |index: usize| dot(&momenta[index], &momenta[index]).sqrt();
    let mut order: Vec<usize> = (0..momenta.len()).collect();
    order.sort_by(|&a, &b| size(a).total_cmp(&size(b)));
    let fastest = order.last().map_or(0.0, |&last| size(last));
    let mut ends = vec![None; momenta.len()];
    for class in order.chunks(momenta.len().div_ceil(CLASSES).max(1)) {
        let own = class.last().map_or(fastest, |&last| size(last));
        let (count, h) = Setting::steps(step * fastest / own, end);
        let step = make(h).map_err(|_| RunError::NotConverged)?;
        let start = |&index: &usize| Phase::<SO3>::at_identity(momenta[index]);
        let mut states: Vec<Phase<SO3>> = class.iter().map(start).collect();
        if !advance_all(&step, &mut states, count as u64).is_empty() {
            return Err(RunError::NotConverged);
        }
        for (&index, state) in class.iter().zip(&states) {
            ends[index] = Some(free_body::state(state));
        }
    }
    ends.into_iter().collect::<Option<_>>().ok_or(RunError::NotConverged)
}

/// The run by the integrator of one truncation.
macro_rules! run {
    ($module:ident) => {
        |body, momenta, end, step| {
            ends(|h| $module::RigidBody::new(h, body.inertia), momenta, end, step)
        }
    };
}

/// A truncation as a row.
struct Ours {
    name: String,
    /// The longest step tried.
    longest: f64,
    run: Run,
}

impl EnsembleMethod for Ours {
    fn name(&self) -> &str {
        &self.name
    }

    fn settings(&self) -> Vec<Setting> {
        (0..=10).map(|k| Setting::Step(self.longest * 2f64.powf(-f64::from(k) / 4.0))).collect()
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

/// Every truncation.
#[must_use]
pub fn ours() -> Vec<Box<dyn EnsembleMethod>> {
    let runs: [(&str, f64, Run); 8] = [
        ("K = 9", 1.0, run!(nine)),
        ("K = 11", 1.0, run!(eleven)),
        ("K = 13", 1.0, run!(thirteen)),
        ("K = 15", 1.0, run!(fifteen)),
        ("comoving, K = 9", 2.0, run!(comoving_nine)),
        ("comoving, K = 11", 2.0, run!(comoving_eleven)),
        ("comoving, K = 13", 2.0, run!(comoving_thirteen)),
        ("comoving, K = 15", 2.0, run!(comoving_fifteen)),
    ];
    let row = |(series, longest, run)| {
        let name = format!("coadjoint, {series}, 8 lanes");
        Box::new(Ours { name, longest, run }) as Box<dyn EnsembleMethod>
    };
    runs.into_iter().map(row).collect()
}
