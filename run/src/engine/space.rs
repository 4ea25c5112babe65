//! States as numbers, and the group that they belong to.

use std::sync::Arc;

use coadjoint::Phase;
use coadjoint::groups::ElementError;

use super::compiled::{Compiled, Numbers};
use super::restore::{Restore, entries_of, phase_of};

/// A group whose elements are lists of numbers: their matrices, row by row, or what programs make of these.
pub trait Space {
    /// The rows of the group's matrices.
    fn size(&self) -> usize;

    /// The matrix, row by row, of the element that the given one is up to rounding.
    ///
    /// # Errors
    /// Where it is none.
    fn nearest(&self, matrix: &[f64]) -> Result<Vec<f64>, ElementError>;

    /// The numbers of the element with this matrix, row by row, which is not checked.
    fn numbers(&self, matrix: &[f64]) -> Vec<f64>;

    /// The matrix of the element with these numbers, row by row.
    fn matrix(&self, g: &[f64]) -> Vec<f64>;

    /// The element with these numbers, rounded in single precision, put onto the group as the group's own products do.
    fn settled(&self, g: &[f64]) -> Vec<f64>;

    /// Ad\*_g μ.
    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64>;
}

/// The unit matrix with this number of rows, row by row.
pub fn identity(size: usize) -> Vec<f64> {
    (0..size * size).map(|at| if at / size == at % size { 1.0 } else { 0.0 }).collect()
}

/// Elements as programs have them where there are any, else as matrices.
pub struct Elements<G> {
    /// The group.
    pub group: Arc<G>,
    /// The programs, where there are any.
    pub compiled: Option<Arc<Compiled>>,
}

impl<G: Restore> Elements<G> {
    /// A state as the group has it.
    pub fn phase(&self, state: &Numbers) -> Phase<G> {
        phase_of(&*self.group, &self.matrix(&state.g), &state.mu)
    }

    /// A state as numbers.
    pub fn state(&self, phase: &Phase<G>) -> Numbers {
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

    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64> {
        match &self.compiled {
            Some(compiled) => compiled.spatial_momentum(state),
            None => self.phase(state).spatial_momentum(&*self.group).as_slice().to_vec(),
        }
    }
}
