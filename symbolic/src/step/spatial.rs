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

    /// The spatial momentum of one state, as [`Spatial::momenta`].
    pub fn momentum(&self, g: &[f64], mu: &[f64]) -> Vec<f64> {
        self.momenta(std::iter::once([g, mu])).pop().unwrap_or_default()
    }

    /// The spatial momenta of the states with these numbers of the group element and these μ; NaN where a matrix has no
    /// inverse.
    pub fn momenta<'a>(&self, states: impl Iterator<Item = [&'a [f64]; 2]>) -> Vec<Vec<f64>> {
        let inputs = states.map(|[g, mu]| {
            // The program reads of the inverse what has been inverted here, and nothing else.
            let mut inputs = [g, g, mu].concat();
            for &(start, rows) in &self.inverted {
                let block = DMatrix::from_row_slice(rows, rows, &g[start..start + rows * rows]);
                let inverse = block.try_inverse();
                let none = || DMatrix::from_element(rows, rows, f64::NAN);
                let own = &mut inputs[g.len() + start..][..rows * rows];
                own.copy_from_slice(inverse.unwrap_or_else(none).transpose().as_slice());
            }
            inputs
        });
        self.program.run_rows(&inputs.collect::<Vec<_>>(), &[])
    }
}
