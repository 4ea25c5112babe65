//! The groups known at run time, and states in them as numbers.

use std::path::Path;
use std::sync::Arc;

use coadjoint::groups::{CayleyMatrixGroup, DirectProduct, ElementError, MatrixGroup, TableError};
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_codegen::step::Seen;
use coadjoint_learn::catalogue;
use nalgebra::{DMatrix, DVector};

use super::compiled::{Compiled, Numbers};
use crate::error::RunError;

/// Groups known at run time.
pub(crate) trait Group:
    LieGroup<Scalar = f64, Vector = DVector<f64>, Element: Send + Sync> + Send + Sync
{
}

impl<G> Group for G where
    G: LieGroup<Scalar = f64, Vector = DVector<f64>, Element: Send + Sync> + Send + Sync
{
}

/// The group whose Lie algebra this is, factor by factor for a direct product.
pub(crate) fn product_group(
    path: &Path,
    algebra: &LieAlgebra,
) -> Result<DirectProduct<MatrixGroup>, RunError> {
    let mut known: Vec<(LieAlgebra, MatrixGroup)> = Vec::new();
    let group = |factor: LieAlgebra| {
        if let Some((_, group)) = known.iter().find(|(other, _)| *other == factor) {
            return Ok(group.clone());
        }
        let group = matrix_group(path, &factor)?;
        known.push((factor, group.clone()));
        Ok(group)
    };
    let groups: Result<Vec<_>, RunError> = algebra.factors().into_iter().map(group).collect();
    Ok(DirectProduct::new(groups?))
}

/// The group with the Cayley map.
pub(crate) fn cayley_group(
    path: &Path,
    group: &DirectProduct<MatrixGroup>,
) -> Result<DirectProduct<CayleyMatrixGroup>, RunError> {
    let factors: Result<Vec<_>, TableError> =
        group.factors().map(|factor| factor.clone().into_cayley()).collect();
    Ok(DirectProduct::new(factors.map_err(RunError::of(path))?))
}

/// The group whose Lie algebra this is, not taken apart: kicks look at the matrices of the whole.
pub(crate) fn whole_group(
    path: &Path,
    algebra: &LieAlgebra,
) -> Result<DirectProduct<MatrixGroup>, RunError> {
    Ok(DirectProduct::new(vec![matrix_group(path, algebra)?]))
}

/// The group whose Lie algebra this is.
fn matrix_group(path: &Path, algebra: &LieAlgebra) -> Result<MatrixGroup, RunError> {
    catalogue::matrix_group(algebra).map_err(RunError::of(path))
}

/// Groups whose elements can be put back as they were. Reading a matrix as a user's would straighten
/// it: other bits.
pub(crate) trait Restore: Group {
    /// The element with these entries, all rows and columns; none are checked.
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element;
}

impl<G: LieGroup<Scalar = f64, Element = DMatrix<f64>> + Send + Sync> Restore for DirectProduct<G> {
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element {
        let mut first = 0;
        let factor = |factor: &G| {
            let size = factor.matrix_size();
            first += size;
            DMatrix::from_fn(size, size, |i, j| entry(first - size + i, first - size + j))
        };
        self.factors().map(factor).collect()
    }
}

/// The matrix of an element, row by row.
pub(crate) fn entries_of<G: LieGroup<Scalar = f64>>(group: &G, element: &G::Element) -> Vec<f64> {
    let size = group.matrix_size();
    let mut entries = vec![0.0; size * size];
    group.matrix_entries(element, &mut |i, j, entry| entries[i * size + j] = entry);
    entries
}

/// The state with this matrix, row by row, and this momentum; neither is checked.
pub(crate) fn phase_of<G: Restore>(group: &G, matrix: &[f64], mu: &[f64]) -> Phase<G> {
    let size = group.matrix_size();
    let element = group.restore(&|i, j| matrix[i * size + j]);
    Phase::<G>::new(element, DVector::from_column_slice(mu))
}

/// A group whose elements are lists of numbers: their matrices, row by row, or what programs make of these.
pub(crate) trait Space {
    /// The rows of the group's matrices.
    fn size(&self) -> usize;

    /// The matrix, row by row, of the element that the given one is up to rounding.
    ///
    /// # Errors
    /// Fails if it is none.
    fn nearest(&self, matrix: &[f64]) -> Result<Vec<f64>, ElementError>;

    /// The numbers of the element with this matrix, row by row, which is not checked.
    fn numbers(&self, matrix: &[f64]) -> Vec<f64>;

    /// The matrix of the element with these numbers, row by row.
    fn matrix(&self, g: &[f64]) -> Vec<f64>;

    /// The element with these numbers, rounded in single precision, put onto the group as the group's own products do.
    fn settled(&self, g: &[f64]) -> Vec<f64>;

    /// These states, of one group, as laws are stated for them.
    fn observe(&self, states: &[&Numbers]) -> Observed;

    /// Ad\*_g μ.
    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64> {
        self.observe(&[state]).spatial(0).to_vec()
    }
}

/// The spatial momentum and the matrix of each of some states.
#[derive(Clone, Debug)]
pub(crate) struct Observed {
    numbers: Vec<f64>,
    /// The numbers of the spatial momentum, and of both.
    lengths: [usize; 2],
}

impl Observed {
    /// Ad\*_g μ of the state in this place.
    pub(crate) fn spatial(&self, at: usize) -> &[f64] {
        &self.numbers[at * self.lengths[1]..][..self.lengths[0]]
    }

    /// The matrix of g, row by row, of the state in this place.
    pub(crate) fn matrix(&self, at: usize) -> &[f64] {
        &self.numbers[at * self.lengths[1]..(at + 1) * self.lengths[1]][self.lengths[0]..]
    }

    /// The state in this place alone.
    pub(crate) fn only(&self, at: usize) -> Self {
        let [_, length] = self.lengths;
        Self { numbers: self.numbers[at * length..][..length].to_vec(), lengths: self.lengths }
    }

    /// The state in this place, with its momentum.
    pub(crate) fn seen<'a>(&'a self, at: usize, momentum: &'a [f64]) -> Seen<'a> {
        Seen { spatial: self.spatial(at), matrix: self.matrix(at), momentum }
    }
}

/// The unit matrix with this number of rows, row by row.
pub(crate) fn identity(size: usize) -> Vec<f64> {
    (0..size * size).map(|at| if at / size == at % size { 1.0 } else { 0.0 }).collect()
}

/// Elements as programs have them where there are any, else as matrices.
pub(crate) struct Elements<G> {
    /// The group.
    pub group: Arc<G>,
    /// The programs, where there are any.
    pub compiled: Option<Arc<Compiled>>,
}

impl<G: Restore> Elements<G> {
    /// A state as the group has it.
    pub(crate) fn phase(&self, state: &Numbers) -> Phase<G> {
        phase_of(&*self.group, &self.matrix(&state.g), &state.mu)
    }

    /// A state as numbers.
    pub(crate) fn state(&self, phase: &Phase<G>) -> Numbers {
        let g = self.numbers(&entries_of(&*self.group, &phase.group_element));
        Numbers { g, mu: phase.momentum.as_slice().to_vec() }
    }
}

impl<G: Restore> Space for Elements<G> {
    fn size(&self) -> usize {
        self.group.matrix_size()
    }

    fn nearest(&self, matrix: &[f64]) -> Result<Vec<f64>, ElementError> {
        let size = self.size();
        let element = self.group.element_from_matrix(|i, j| matrix[i * size + j])?;
        Ok(entries_of(&*self.group, &element))
    }

    fn numbers(&self, matrix: &[f64]) -> Vec<f64> {
        self.compiled
            .as_ref()
            .map_or_else(|| matrix.to_vec(), |programs| programs.element_of(matrix))
    }

    fn matrix(&self, g: &[f64]) -> Vec<f64> {
        self.compiled.as_ref().map_or_else(|| g.to_vec(), |programs| programs.matrix_of(g))
    }

    fn settled(&self, g: &[f64]) -> Vec<f64> {
        let group = &*self.group;
        let mut phase = self.phase(&Numbers { g: g.to_vec(), mu: vec![0.0; group.dim()] });
        for _ in 0..2 {
            phase.group_element = group.compose(&phase.group_element, &group.identity());
        }
        self.state(&phase).g
    }

    fn observe(&self, states: &[&Numbers]) -> Observed {
        let of = |state: &&Numbers| {
            let spatial = self.phase(state).spatial_momentum(&*self.group);
            [spatial.as_slice(), &state.g].concat()
        };
        let numbers = match &self.compiled {
            Some(compiled) => compiled.observe(states),
            None => states.iter().flat_map(of).collect(),
        };
        let dim = self.group.dim();
        Observed { numbers, lengths: [dim, dim + self.size().pow(2)] }
    }
}
