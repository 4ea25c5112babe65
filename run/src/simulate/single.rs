//! Steps one at a time, ready to be made.

use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::groups::{CayleyMatrixGroup, DirectProduct, ElementError, MatrixGroup};
use coadjoint::{LieGroup, StepError};
use coadjoint_codegen::lie;
use coadjoint_program::Trajectories;

use super::setup::not_an_element;
use crate::backend::Backend;
use crate::engine::{Compiled, Numbers, Restore, advise, cayley_group, entries_of, map, phase_of};
use crate::error::RunError;
use crate::load::Derived;

/// Entries this near, relatively, to those of an element are those of one: so far rounding goes in many steps.
const SAME: f64 = 1e-12;

/// The groups that systems are on.
#[derive(Debug)]
enum Group {
    Exponential(DirectProduct<MatrixGroup>),
    Cayley(DirectProduct<CayleyMatrixGroup>),
}

/// The step of one size, ready to be made from any state.
#[derive(Debug)]
pub struct Single<S> {
    system: S,
    group: Group,
    step: f64,
    compiled: Option<Compiled>,
}

impl<S: AsRef<Derived>> Single<S> {
    /// Prepares steps of this size, about `steps` of which are going to be made.
    ///
    /// # Errors
    /// Where the step makes no sense, or the backend asked for cannot be had.
    pub fn new(system: S, step: f64, backend: Backend, steps: f64) -> Result<Self, RunError> {
        let derived = system.as_ref();
        let plain = derived.group()?;
        let group = match derived.integrator.problem.chart {
            lie::Chart::Exponential => Group::Exponential(plain),
            lie::Chart::Cayley => Group::Cayley(cayley_group(&derived.file, &plain)?),
        };
        let (integrator, kept) = (&derived.integrator, &derived.kept);
        let compiled = Compiled::new(integrator, step, backend, steps, Trajectories::One, kept)?;
        Ok(Self { system, group, step, compiled })
    }

    /// The backend that makes the steps.
    pub fn backend(&self) -> String {
        let maker = |compiled: &Compiled| compiled.code().maker().to_owned();
        self.compiled.as_ref().map_or_else(|| "interpreter".to_owned(), maker)
    }

    /// Rows of the group's matrices.
    pub fn matrix_size(&self) -> usize {
        match &self.group {
            Group::Exponential(group) => group.matrix_size(),
            Group::Cayley(group) => group.matrix_size(),
        }
    }

    /// The matrix, row by row, of the element of the group that this one is, up to rounding; one that is an element to
    /// the last digits stays as it is.
    ///
    /// # Errors
    /// Where it is none.
    pub fn element(&self, matrix: &[f64]) -> Result<Vec<f64>, RunError> {
        let file = &self.system.as_ref().file;
        let found = match &self.group {
            Group::Exponential(group) => nearest(group, matrix),
            Group::Cayley(group) => nearest(group, matrix),
        };
        let found = found.map_err(|error| not_an_element(file, &error))?;
        let far = found.iter().zip(matrix).any(|(a, b)| (a - b).abs() > SAME * (1.0 + a.abs()));
        Ok(if far { found } else { matrix.to_vec() })
    }

    /// Makes `steps` steps of the state with this matrix, row by row, and this momentum, in place. The matrix is not
    /// checked.
    ///
    /// # Errors
    /// Which step was not made, from 1, and why; the state is then that before it.
    pub fn advance(
        &self,
        matrix: &mut [f64],
        mu: &mut [f64],
        steps: u64,
    ) -> Result<(), (u64, StepError)> {
        match &self.group {
            Group::Exponential(group) => self.on::<_, Exponential>(group, matrix, mu, steps),
            Group::Cayley(group) => self.on::<_, Cayley>(group, matrix, mu, steps),
        }
    }

    fn on<G: Restore, C: Chart<G>>(
        &self,
        group: &G,
        matrix: &mut [f64],
        mu: &mut [f64],
        steps: u64,
    ) -> Result<(), (u64, StepError)> {
        let derived = self.system.as_ref();
        let make = |h| map::<G, C>(&derived.integrator, derived.forces.as_ref(), group, h);
        let advised = |error, matrix: &[f64], mu: &[f64]| {
            advise(error, self.step, |h| {
                make(h).is_ok_and(|step| step(&mut phase_of(group, matrix, mu)).is_ok())
            })
        };
        let made = match &self.compiled {
            Some(compiled) => {
                let mut numbers = Numbers { g: compiled.element_of(matrix), mu: mu.to_vec() };
                let made = compiled.advance(&mut numbers, steps, |numbers| {
                    compiled.rescue(group, numbers, |phase| make(self.step)?(phase))
                });
                matrix.copy_from_slice(&compiled.matrix_of(&numbers.g));
                mu.copy_from_slice(&numbers.mu);
                made.map(drop)
            }
            None => {
                let step = make(self.step).map_err(|error| (1, error))?;
                let mut phase = phase_of(group, matrix, mu);
                let made = (0..steps)
                    .try_for_each(|done| step(&mut phase).map(drop).map_err(|error| (done, error)));
                matrix.copy_from_slice(&entries_of(group, &phase.group_element));
                mu.copy_from_slice(phase.momentum.as_slice());
                made
            }
        };
        made.map_err(|(done, error)| (done + 1, advised(error, matrix, mu)))
    }
}

fn nearest<G: Restore>(group: &G, matrix: &[f64]) -> Result<Vec<f64>, ElementError> {
    let size = group.matrix_size();
    let element = group.element_from_matrix(|i, j| matrix[i * size + j])?;
    Ok(entries_of(group, &element))
}
