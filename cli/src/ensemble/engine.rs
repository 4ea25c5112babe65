//! Advancing rows of states: in lanes, on the group's closed forms where it has them.

use std::path::Path;

use coadjoint::{
    Cayley, Chart, Exponential, GeneratingFunction, Phase, SE3, SO3, groups::CayleyMatrixGroup,
    groups::MatrixGroup, lanes::F64x8, lanes::LaneGroup, lanes::Lanes, lanes::ensemble,
};
use coadjoint_codegen::graph::Arithmetic;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_learn::{DataGroup, matrix_of};
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::layout::{Attitude, Layout, Shape};
use super::rows::{Rejected, Rows};
use crate::engine::{Interpreter, matrix_group};
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
}

impl Drift {
    /// The larger of each.
    pub fn max(self, other: Self) -> Self {
        Self {
            spatial_momentum: self.spatial_momentum.max(other.spatial_momentum),
            casimirs: self.casimirs.max(other.casimirs),
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
    /// `rows.rejected`. The bits do not depend on how rows are cut into pieces or on threads.
    fn advance(&self, layout: &Layout, steps: u64, rows: &mut Rows) -> Drift;
}

/// The engine of a system.
pub fn engine<'a>(
    path: &Path,
    integrator: &'a Integrator,
    step: f64,
) -> Result<Box<dyn Engine + 'a>, CliError> {
    let algebra = &integrator.problem.algebra;
    let group_error = |source| CliError::Group { file: path.into(), source };
    // Closed forms for what is used most; every combination costs the compiler several seconds.
    match (algebra.name(), integrator.problem.chart) {
        ("SO3", lie::Chart::Exponential) => on::<_, Exponential>(integrator, SO3::new(), step),
        ("SE3", lie::Chart::Exponential) => on::<_, Exponential>(integrator, SE3::new(), step),
        (_, lie::Chart::Exponential) => {
            on::<_, Exponential>(integrator, matrix_group(path, algebra, None)?, step)
        }
        (_, lie::Chart::Cayley) => {
            let group = matrix_group(path, algebra, None)?.into_cayley().map_err(group_error)?;
            on::<_, Cayley>(integrator, group, step)
        }
    }
}

fn on<'a, G, C>(
    integrator: &'a Integrator,
    group: G,
    step: f64,
) -> Result<Box<dyn Engine + 'a>, CliError>
where
    G: EnsembleGroup + 'a,
    C: Chart<G> + 'a,
    Interpreter<'a, G, C>: Lanes<Group = G> + Sync,
    <Interpreter<'a, G, C> as Lanes>::Over<F64x8>: Sync,
    Phase<G>: Send + Sync,
    G::Scalar: Arithmetic,
{
    let step = Interpreter::<G, C>::new(integrator, group, step)
        .map_err(|source| CliError::Step { time: 0.0, source })?;
    Ok(Box::new(step))
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

impl<'a, G, C> Engine for Interpreter<'a, G, C>
where
    G: EnsembleGroup<Scalar: Arithmetic>,
    C: Chart<G>,
    Self: Lanes<Group = G> + Sync,
    <Self as Lanes>::Over<F64x8>: Sync,
    Phase<G>: Send + Sync,
{
    fn shape(&self) -> Shape {
        let quaternions = G::quaternion_of(&self.group().identity()).is_some();
        Shape { dim: self.group().dim(), matrix_size: self.group().matrix_size(), quaternions }
    }

    fn casimirs(&self) -> usize {
        self.group().casimir_count()
    }

    fn advance(&self, layout: &Layout, steps: u64, rows: &mut Rows) -> Drift {
        let width = layout.width();
        let read: Vec<_> =
            rows.values.par_chunks(width).map(|row| phase(self.group(), layout, row)).collect();
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
        let failures = ensemble::advance_all(self, &mut states, steps);
        let mut failed = vec![false; states.len()];
        for failure in failures {
            failed[failure.index] = true;
            rows.rejected.push(Rejected {
                row: rows.first + places[failure.index] as u64,
                step: failure.step + 1,
                reason: failure.error.to_string(),
            });
        }
        rows.values.fill(f64::NAN);
        let drifts: Vec<Option<Drift>> = before
            .par_iter()
            .zip(&states)
            .zip(&failed)
            .map(|((before, after), failed)| (!failed).then(|| drift(self.group(), before, after)))
            .collect();
        let mut largest = Drift::default();
        for ((&place, state), drift) in places.iter().zip(&states).zip(drifts) {
            let Some(drift) = drift else { continue };
            let row = &mut rows.values[place * width..(place + 1) * width];
            write(self.group(), layout, state, row);
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

/// The drifts of one row.
fn drift<G: EnsembleGroup>(group: &G, before: &Phase<G>, after: &Phase<G>) -> Drift {
    use coadjoint::Coordinates;

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
        let fine = Drift { spatial_momentum: 1e-16, casimirs: 0.0 };
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
            Drift { casimirs: f64::INFINITY, ..fine },
        ] {
            assert!(check(&layout, &row, wrong).unwrap_err().contains("not finite"));
        }
        assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan());
        assert_eq!((larger(1.0, 2.0), larger(2.0, 1.0)), (2.0, 2.0));
    }
}
