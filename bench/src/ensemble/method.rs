//! What a row of the ensemble comparison is.

use crate::{
    arithmetic::Vector,
    method::{Method, RunError, Setting},
    peers::taylor::batch,
    problem::{FreeBody, Problem, System},
    state::State,
};

/// A way to integrate many free bodies from the identity attitude. Ours and the peers implement it alike.
pub trait EnsembleMethod {
    /// Its name.
    fn name(&self) -> &str;

    /// The settings to measure.
    fn settings(&self) -> Vec<Setting>;

    /// The end states, in the order of the momenta; `template` gives the body and the end time.
    ///
    /// # Errors
    /// As [`Method::run`], for the first body that fails.
    fn run(
        &self,
        template: &Problem,
        momenta: &[Vector],
        setting: Setting,
    ) -> Result<Vec<State>, RunError>;
}

/// Any method, one body after another.
pub struct OneByOne<M> {
    method: M,
    settings: Vec<Setting>,
}

impl<M: Method> OneByOne<M> {
    /// The method at these settings.
    pub fn new(method: M, settings: Vec<Setting>) -> Self {
        Self { method, settings }
    }
}

impl<M: Method> EnsembleMethod for OneByOne<M> {
    fn name(&self) -> &str {
        self.method.name()
    }

    fn settings(&self) -> Vec<Setting> {
        self.settings.clone()
    }

    fn run(
        &self,
        template: &Problem,
        momenta: &[Vector],
        setting: Setting,
    ) -> Result<Vec<State>, RunError> {
        let mut problem = template.clone();
        let mut end = |momentum: &Vector| {
            problem.initial.momentum = *momentum;
            self.method.run(&problem, setting)
        };
        momenta.iter().map(&mut end).collect()
    }
}

/// Taylor's method with N coefficients in L lanes.
pub struct TaylorBatch<const N: usize, const L: usize> {
    name: String,
}

impl<const N: usize, const L: usize> Default for TaylorBatch<N, L> {
    fn default() -> Self {
        Self { name: format!("Taylor, order {}, {L} lanes", N - 1) }
    }
}

impl<const N: usize, const L: usize> EnsembleMethod for TaylorBatch<N, L> {
    fn name(&self) -> &str {
        &self.name
    }

    fn settings(&self) -> Vec<Setting> {
        (4..=16).map(|k| Setting::Tolerance(10f64.powi(-k))).collect()
    }

    fn run(
        &self,
        template: &Problem,
        momenta: &[Vector],
        setting: Setting,
    ) -> Result<Vec<State>, RunError> {
        let Setting::Tolerance(tolerance) = setting else {
            return Err(RunError::Setting {
                method: self.name.clone(),
                wanted: "a tolerance",
                given: setting,
            });
        };
        let System::FreeBody(body) = &template.system else {
            return Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: template.name.to_owned(),
            });
        };
        let mut ends = Vec::with_capacity(momenta.len());
        for group in momenta.chunks(L) {
            ends.extend(self.group(body, group, template.end, tolerance)?);
        }
        Ok(ends)
    }
}

impl<const N: usize, const L: usize> TaylorBatch<N, L> {
    /// A group of at most L bodies; a short one is filled with its last body.
    fn group(
        &self,
        body: &FreeBody,
        group: &[Vector],
        end: f64,
        tolerance: f64,
    ) -> Result<impl Iterator<Item = State> + use<N, L>, RunError> {
        let lanes = std::array::from_fn(|lane| group[lane.min(group.len() - 1)]);
        let ends: [State; L] = batch::integrate::<N, L>(body, &lanes, end, tolerance)?;
        Ok(ends.into_iter().take(group.len()))
    }
}
