//! Advancing rows of states: in lanes, on the group's closed forms where it has them.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use coadjoint::lanes::ensemble::{self, Failure};
use coadjoint::{
    Cayley, Chart, Exponential, GeneratingFunction, Phase, SE3, SO3, StepError,
    groups::CayleyMatrixGroup, groups::MatrixGroup, lanes::F64x8, lanes::LaneGroup, lanes::Lanes,
};
use coadjoint_codegen::graph::Arithmetic;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_learn::{DataGroup, matrix_of};
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::layout::{Attitude, Layout, Shape};
use super::pack::{Manner, march};
use super::rows::{Rejected, Rows};
use crate::backend::Backend;
use crate::engine::{Compiled, Interpreter, Numbers, STEEP, Steepness, advise, matrix_group};
use crate::error::CliError;

/// How far an attitude may be from the group, as for `coadjoint learn`: far above rounding in
/// files, far below noise.
const ATTITUDE_TOLERANCE: f64 = 1e-6;

/// The largest drifts over an ensemble, each row's relative to its own size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Of the spatial momentum J_L, relative to the largest coordinate of μ.
    pub spatial_momentum: f64,
    /// Of the Casimirs, each relative to itself (absolute where it is 0).
    pub casimirs: f64,
    /// The largest ratio of the last two terms of the series at the states looked at (the start, the end, and every so
    /// many steps), where it is worth a warning; else 0.
    pub ratio: f64,
}

impl Drift {
    /// The larger of each; what is no number is larger than any.
    pub fn max(self, other: Self) -> Self {
        Self {
            spatial_momentum: larger(self.spatial_momentum, other.spatial_momentum),
            casimirs: larger(self.casimirs, other.casimirs),
            ratio: larger(self.ratio, other.ratio),
        }
    }
}

/// Something that advances rows of states.
pub trait Engine: Sync {
    /// What rows may hold.
    fn shape(&self) -> Shape;

    /// How many Casimirs are watched.
    fn casimirs(&self) -> usize;

    /// Advances every row in place by `steps` steps. Rows that fail become NaN and are added to
    /// `rows.rejected`. The bits do not depend on how rows are cut into pieces or on threads. `made` is
    /// told, again and again, how many steps every row has made.
    fn advance(&self, layout: &Layout, steps: u64, rows: &mut Rows, made: &dyn Fn(u64)) -> Drift;
}

/// Steps that all rows make before the next: each is then about as far, and what is told of it is true. The runtime
/// forgets everything at the end of so many steps, so that cutting a run there changes no bit.
const STRETCH: u64 = 256;

/// The engine of a system.
pub fn engine<'a>(
    path: &Path,
    integrator: &'a Integrator,
    step: f64,
    (backend, work): (Backend, f64),
) -> Result<Box<dyn Engine + 'a>, CliError> {
    let how = (backend, work);
    let algebra = &integrator.problem.algebra;
    let group_error = |source| CliError::Group { file: path.into(), source };
    // Closed forms for what is used most; every combination costs the compiler several seconds.
    match (algebra.name(), integrator.problem.chart) {
        ("SO3", lie::Chart::Exponential) => on::<_, Exponential>(integrator, SO3::new(), step, how),
        ("SE3", lie::Chart::Exponential) => on::<_, Exponential>(integrator, SE3::new(), step, how),
        (_, lie::Chart::Exponential) => {
            on::<_, Exponential>(integrator, matrix_group(path, algebra, None)?, step, how)
        }
        (_, lie::Chart::Cayley) => {
            let group = matrix_group(path, algebra, None)?.into_cayley().map_err(group_error)?;
            on::<_, Cayley>(integrator, group, step, how)
        }
    }
}

fn on<'a, G, C>(
    integrator: &'a Integrator,
    group: G,
    step: f64,
    (backend, work): (Backend, f64),
) -> Result<Box<dyn Engine + 'a>, CliError>
where
    G: EnsembleGroup + 'a,
    C: Chart<G> + 'a,
    Interpreter<'a, G, C>: Lanes<Group = G> + Send + Sync,
    <Interpreter<'a, G, C> as Lanes>::Over<F64x8>: Sync,
    Phase<G>: Send + Sync,
    G::Scalar: Arithmetic,
{
    let stepper = Interpreter::<G, C>::new(integrator, group, step)
        .map_err(|source| CliError::Step { time: 0.0, source })?;
    let compiled = Compiled::new(&stepper, backend, work)?;
    Ok(Box::new(Steps { integrator, stepper, compiled, step, shorter: Mutex::default() }))
}

/// Steps of a system on a group.
struct Steps<'a, G, C> {
    integrator: &'a Integrator,
    stepper: Interpreter<'a, G, C>,
    /// The same as programs, where it can be.
    compiled: Option<Compiled>,
    step: f64,
    /// Those of half the size, of a quarter, …, as far as they were needed to advise.
    shorter: Mutex<Vec<Interpreter<'a, G, C>>>,
}

impl<'a, G: EnsembleGroup<Scalar: Arithmetic>, C: Chart<G>> Steps<'a, G, C>
where
    Interpreter<'a, G, C>: Lanes<Group = G>,
{
    /// The error of the next step of a state, with a step size that works there.
    fn advise(&self, error: StepError, state: &Phase<G>) -> StepError {
        // A thread that panicked has left whole steppers, if any.
        let mut shorter = self.shorter.lock().unwrap_or_else(PoisonError::into_inner);
        let mut place = 0;
        advise(error, self.step, |h| {
            if shorter.len() == place {
                let group = self.stepper.group().clone();
                let Ok(stepper) = Interpreter::new(self.integrator, group, h) else { return false };
                shorter.push(stepper);
            }
            place += 1;
            coadjoint::advance(&shorter[place - 1], &mut state.clone()).is_ok()
        })
    }

    /// The drifts of one row.
    fn drift(&self, before: &Phase<G>, after: &Phase<G>) -> Drift {
        use coadjoint::Coordinates;

        let group = self.stepper.group();
        let relative = |difference: f64, size: f64| {
            if size > 0.0 { difference.abs() / size } else { difference.abs() }
        };
        let (start, end) = (before.spatial_momentum(group), after.spatial_momentum(group));
        let difference = (0..group.dim()).map(|i| (end[i] - start[i]).abs()).fold(0.0, larger);
        let casimirs = (0..group.casimir_count()).map(|index| {
            let start = group.casimir(index, &before.momentum);
            relative(group.casimir(index, &after.momentum) - start, start.abs())
        });
        Drift {
            spatial_momentum: relative(difference, before.momentum.largest_entry()),
            casimirs: casimirs.fold(0.0, larger),
            ratio: 0.0,
        }
    }
}

impl<'a, G, C> Steps<'a, G, C>
where
    G: EnsembleGroup<Scalar: Arithmetic>,
    C: Chart<G>,
    Interpreter<'a, G, C>: Lanes<Group = G> + Send + Sync,
    <Interpreter<'a, G, C> as Lanes>::Over<F64x8>: Sync,
    Phase<G>: Send + Sync,
{
    /// Makes the steps of all states; why those stopped that did, by their places, and the largest ratio of the last two
    /// terms of the series that is worth a warning.
    fn march(
        &self,
        states: &mut [Phase<G>],
        steps: u64,
        made: &dyn Fn(u64),
    ) -> (BTreeMap<usize, Failure>, f64) {
        if let Some(compiled) = &self.compiled {
            return self.march_programs(compiled, states, steps, made);
        }
        let mut failed: BTreeMap<usize, Failure> = BTreeMap::new();
        let mut going: Vec<usize> = (0..states.len()).collect();
        let mut moving = states.to_vec();
        let mut done = 0;
        let mut ratio = self.ratio(&moving);
        while done < steps && !going.is_empty() {
            let stretch = STRETCH.min(steps - done);
            let stopped = ensemble::advance_all(&self.stepper, &mut moving, stretch);
            let mut goes_on = vec![true; moving.len()];
            for failure in &stopped {
                goes_on[failure.index] = false;
                let error = self.advise(failure.error, &moving[failure.index]);
                let place = going[failure.index];
                failed.insert(place, Failure { index: place, step: done + failure.step, error });
            }
            if !stopped.is_empty() {
                let mut kept = goes_on.iter();
                going.retain(|_| kept.next() == Some(&true));
                let mut kept = goes_on.iter();
                moving.retain(|_| kept.next() == Some(&true));
            }
            done += stretch;
            ratio = larger(ratio, self.ratio(&moving));
            made(done);
        }
        for (place, state) in going.into_iter().zip(moving) {
            states[place] = state;
        }
        (failed, ratio)
    }

    /// The largest ratio of the last two terms of the series at these states, where it is worth a warning; else 0.
    fn ratio(&self, states: &[Phase<G>]) -> f64 {
        let steepness = Steepness::new(&self.stepper);
        let ratios = states.iter().map(|state| steepness.ratio(&state.momentum));
        ratios.filter(|&ratio| ratio > STEEP).fold(0.0, larger)
    }

    /// The same by programs.
    fn march_programs(
        &self,
        compiled: &Compiled,
        states: &mut [Phase<G>],
        steps: u64,
        made: &dyn Fn(u64),
    ) -> (BTreeMap<usize, Failure>, f64) {
        use coadjoint::Coordinates;

        let group = self.stepper.group();
        let read = |state: &Phase<G>| numbers(compiled, group, state);
        let mut moving: Vec<Numbers> = states.par_iter().map(read).collect();
        let rescue = |own: &mut Numbers| {
            let mut phase = state(compiled, group, own)?;
            let report = coadjoint::advance(&self.stepper, &mut phase)?;
            *own = numbers(compiled, group, &phase);
            Ok(report)
        };
        let steepness = Steepness::new(&self.stepper);
        let before = self.ratio(states);
        let ratio = |mu: &[f64]| steepness.ratio(&G::Vector::from_entries(mu.len(), |i| mu[i]));
        let manner = Manner { compiled, rescue: &rescue, ratio: &ratio };
        let (mut failed, along) = march(&manner, &mut moving, (steps, STRETCH), made);
        for (place, own) in moving.iter().enumerate() {
            match state(compiled, group, own) {
                Ok(state) => states[place] = state,
                Err(error) => {
                    failed.entry(place).or_insert(Failure { index: place, step: steps, error });
                }
            }
        }
        for failure in failed.values_mut() {
            failure.error = self.advise(failure.error, &states[failure.index]);
        }
        let along = if along > STEEP { along } else { 0.0 };
        (failed, larger(before, along))
    }
}

/// A state as programs have it.
fn numbers<G: EnsembleGroup>(compiled: &Compiled, group: &G, state: &Phase<G>) -> Numbers {
    let g = match G::quaternion_of(&state.group_element) {
        Some(q) => q.to_vec(),
        None => {
            let size = group.matrix_size();
            let entry = |at: usize| group.matrix_entry(&state.group_element, at / size, at % size);
            compiled.element_of(&(0..size * size).map(entry).collect::<Vec<_>>())
        }
    };
    Numbers { g, mu: (0..group.dim()).map(|i| state.momentum[i]).collect() }
}

/// A state as the group has it.
fn state<G: EnsembleGroup>(
    compiled: &Compiled,
    group: &G,
    numbers: &Numbers,
) -> Result<Phase<G>, StepError> {
    use coadjoint::Coordinates;

    let matrix = compiled.matrix_of(&numbers.g);
    let size = group.matrix_size();
    let element = group.element_from_matrix(|i, j| matrix[i * size + j]);
    // Programs check their elements: what is none is not finite.
    let group_element = element.map_err(|_| StepError::NonFiniteState)?;
    let momentum = G::Vector::from_entries(group.dim(), |i| numbers.mu[i]);
    Ok(Phase { group_element, momentum })
}

/// A group whose elements can be read from rows and written to them.
pub trait EnsembleGroup: DataGroup + LaneGroup + Sync {
    /// The quaternion w, x, y, z of an element, where the group has them.
    fn quaternion_of(_element: &Self::Element) -> Option<[f64; 4]> {
        None
    }
}

impl EnsembleGroup for SO3<f64> {
    fn quaternion_of(element: &Self::Element) -> Option<[f64; 4]> {
        Some([element.w, element.i, element.j, element.k])
    }
}

impl EnsembleGroup for SE3<f64> {}
impl EnsembleGroup for MatrixGroup {}
impl EnsembleGroup for CayleyMatrixGroup {}

impl<'a, G, C> Engine for Steps<'a, G, C>
where
    G: EnsembleGroup<Scalar: Arithmetic>,
    C: Chart<G>,
    Interpreter<'a, G, C>: Lanes<Group = G> + Send + Sync,
    <Interpreter<'a, G, C> as Lanes>::Over<F64x8>: Sync,
    Phase<G>: Send + Sync,
    Self: Sync,
{
    fn shape(&self) -> Shape {
        let group = self.stepper.group();
        let quaternions = G::quaternion_of(&group.identity()).is_some();
        Shape { dim: group.dim(), matrix_size: group.matrix_size(), quaternions }
    }

    fn casimirs(&self) -> usize {
        self.stepper.group().casimir_count()
    }

    fn advance(&self, layout: &Layout, steps: u64, rows: &mut Rows, made: &dyn Fn(u64)) -> Drift {
        let group = self.stepper.group();
        let width = layout.width();
        let read: Vec<_> =
            rows.values.par_chunks(width).map(|row| phase(group, layout, row)).collect();
        let known: Vec<u64> = rows.rejected.iter().map(|r| r.row).collect();
        let mut places = Vec::with_capacity(read.len());
        let mut states = Vec::with_capacity(read.len());
        for (place, phase) in read.into_iter().enumerate() {
            let row = rows.first + place as u64;
            match phase {
                _ if known.binary_search(&row).is_ok() => {}
                Ok(phase) => {
                    places.push(place);
                    states.push(phase);
                }
                Err(reason) => rows.rejected.push(Rejected { row, step: 0, reason }),
            }
        }
        let before = states.clone();
        let (failed, ratio) = self.march(&mut states, steps, made);
        for (place, failure) in &failed {
            rows.rejected.push(Rejected {
                row: rows.first + places[*place] as u64,
                step: failure.step + 1,
                reason: failure.error.to_string(),
            });
        }
        rows.values.fill(f64::NAN);
        let drifts: Vec<Option<Drift>> = before
            .par_iter()
            .zip(&states)
            .enumerate()
            .map(|(place, (before, after))| {
                (!failed.contains_key(&place)).then(|| self.drift(before, after))
            })
            .collect();
        let mut largest = Drift { ratio, ..Drift::default() };
        for ((&place, state), drift) in places.iter().zip(&states).zip(drifts) {
            let Some(drift) = drift else { continue };
            let row = &mut rows.values[place * width..(place + 1) * width];
            write(group, layout, state, row);
            if let Err(reason) = check(layout, row, drift) {
                row.fill(f64::NAN);
                let row = rows.first + place as u64;
                rows.rejected.push(Rejected { row, step: steps, reason });
                continue;
            }
            largest = largest.max(drift);
        }
        rows.rejected.sort_by_key(|r| r.row);
        largest
    }
}

/// Refuses an end state that is no state: a number in it, or its drift, is not finite.
fn check(layout: &Layout, row: &[f64], drift: Drift) -> Result<(), String> {
    if let Some(place) = row.iter().position(|value| !value.is_finite()) {
        let name = layout.names().swap_remove(place);
        return Err(format!("{name} is {} at the end", row[place]));
    }
    if drift.spatial_momentum.is_finite() && drift.casimirs.is_finite() {
        return Ok(());
    }
    Err("the drift of the momentum or of a Casimir is not finite: the numbers are too large".into())
}

/// The phase point of a row, or what is wrong with it.
fn phase<G: EnsembleGroup>(group: &G, layout: &Layout, row: &[f64]) -> Result<Phase<G>, String> {
    use coadjoint::Coordinates;

    if let Some(place) = row.iter().position(|value| !value.is_finite()) {
        let name = layout.names().swap_remove(place);
        return Err(format!("{name} is {}", row[place]));
    }
    let (mu, attitude) = row.split_at(group.dim());
    let momentum = G::Vector::from_entries(mu.len(), |i| mu[i]);
    let (element, distance) = match layout.attitude {
        Attitude::None => return Ok(Phase { group_element: group.identity(), momentum }),
        Attitude::Matrix => {
            let size = group.matrix_size();
            let given = DMatrix::from_row_slice(size, size, attitude);
            let found = group.element_near(&given);
            let nearest = found.as_ref().map(|g| matrix_of(group, g));
            (found, nearest.map_or(f64::INFINITY, |m| (m - given).amax()))
        }
        Attitude::Quaternion => {
            let wxyz = std::array::from_fn(|i| attitude[i]);
            let norm = attitude.iter().map(|q| q * q).sum::<f64>().sqrt();
            (group.element_of_quaternion(wxyz), (norm - 1.0).abs())
        }
    };
    match element {
        Some(group_element) if distance <= ATTITUDE_TOLERANCE => {
            Ok(Phase { group_element, momentum })
        }
        Some(_) => Err(format!("the attitude is off the group by {distance:.1e}")),
        None => Err("the attitude is no element of the group".into()),
    }
}

/// Writes a phase point into a row.
fn write<G: EnsembleGroup>(group: &G, layout: &Layout, phase: &Phase<G>, row: &mut [f64]) {
    let (mu, attitude) = row.split_at_mut(group.dim());
    for (i, value) in mu.iter_mut().enumerate() {
        *value = phase.momentum[i];
    }
    match layout.attitude {
        Attitude::None => {}
        Attitude::Matrix => {
            let size = group.matrix_size();
            for (place, value) in attitude.iter_mut().enumerate() {
                *value = group.matrix_entry(&phase.group_element, place / size, place % size);
            }
        }
        Attitude::Quaternion => {
            for (value, q) in attitude
                .iter_mut()
                .zip(G::quaternion_of(&phase.group_element).into_iter().flatten())
            {
                *value = q;
            }
        }
    }
}

/// The larger of two numbers; what is no number is larger than any.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_never_an_end_state() {
        let shape = Shape { dim: 3, matrix_size: 3, quaternions: true };
        let layout = Layout { shape, attitude: Attitude::Quaternion };
        let fine = Drift { spatial_momentum: 1e-16, casimirs: 0.0, ratio: 0.0 };
        let row = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0];
        assert_eq!(check(&layout, &row, fine), Ok(()));
        for (place, value, expected) in
            [(1, f64::NAN, "mu_2 is NaN"), (5, f64::INFINITY, "q_y is inf")]
        {
            let mut wrong = row;
            wrong[place] = value;
            assert!(check(&layout, &wrong, fine).unwrap_err().starts_with(expected));
        }
        for wrong in [
            Drift { spatial_momentum: f64::NAN, ..fine },
            Drift { casimirs: f64::INFINITY, ..fine }.max(fine),
        ] {
            assert!(check(&layout, &row, wrong).unwrap_err().contains("not finite"));
        }
        assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan());
        assert_eq!((larger(1.0, 2.0), larger(2.0, 1.0)), (2.0, 2.0));
    }
}
