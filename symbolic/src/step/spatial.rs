//! The spatial momentum of states as the programs have them.

use nalgebra::DMatrix;

use super::Step;
use crate::graph::Program;

/// g, μ ↦ Ad\*_g μ, by a program of its own.
#[derive(Debug)]
pub struct Spatial {
    program: Program,
    /// First index and number of rows of each matrix whose inverse the program reads.
    inverted: Vec<(usize, usize)>,
}

impl Spatial {
    /// For the states of this step.
    pub fn new(step: &Step) -> Self {
        Self { program: step.spatial(), inverted: step.inverted() }
    }

    /// The spatial momentum of the state with these numbers of the group element and this μ; NaN where a matrix has no
    /// inverse.
    pub fn momentum(&self, g: &[f64], mu: &[f64]) -> Vec<f64> {
        // The program reads of the inverse what has been inverted here, and nothing else.
        let mut inputs = [g, g, mu].concat();
        for &(start, rows) in &self.inverted {
            let block = DMatrix::from_row_slice(rows, rows, &g[start..start + rows * rows]);
            let inverse = block.try_inverse();
            let inverse = inverse.unwrap_or_else(|| DMatrix::from_element(rows, rows, f64::NAN));
            let own = &mut inputs[g.len() + start..][..rows * rows];
            own.copy_from_slice(inverse.transpose().as_slice());
        }
        self.program.run(&inputs, &[])
    }
}
