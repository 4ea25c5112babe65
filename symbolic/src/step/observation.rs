//! States as the programs have them, in the numbers that laws are about.

use coadjoint_program::{Graph, Id, Program};
use nalgebra::DMatrix;

use super::Step;

/// g, μ ↦ Ad\*_g μ and the matrix of g, by a program of its own.
#[derive(Debug)]
pub struct Observation {
    /// g, g⁻¹, μ ↦ Ad\*_g μ, then the matrix of g, row by row. Of g⁻¹ the matrices in `inverted` are read, and nothing else.
    program: Program,
    /// First index and number of rows of each matrix whose inverse the program reads.
    inverted: Vec<(usize, usize)>,
    dim: usize,
    element: usize,
}

impl Observation {
    /// For the states of this step.
    pub fn new(step: &Step) -> Self {
        let (dim, element) = (step.kernel().dim, step.kernel().element);
        let (graph, spatial) = (Graph::new(), step.spatial());
        let ids: Vec<Id> = (0..spatial.inputs()).map(|i| graph.input(i)).collect();
        let mut outputs = graph.call(&spatial, &ids);
        outputs.extend(graph.call(&step.kernel().programs.matrix, &ids[..element]));
        let program = graph.finish(ids.len(), &outputs);
        Self { program, inverted: step.inverted(), dim, element }
    }

    /// The spatial momentum and the matrix of each state (g, μ), one state after the other; NaN where a matrix has no inverse.
    pub fn of(&self, states: &[[&[f64]; 2]]) -> Vec<f64> {
        let m = self.element;
        let mut inverses = vec![0.0; if self.inverted.is_empty() { 0 } else { m * states.len() }];
        for (row, [g, _]) in states.iter().enumerate() {
            for &(start, rows) in &self.inverted {
                let block = DMatrix::from_row_slice(rows, rows, &g[start..start + rows * rows]);
                let inverse = block.try_inverse();
                let none = || DMatrix::from_element(rows, rows, f64::NAN);
                let own = &mut inverses[row * m + start..][..rows * rows];
                own.copy_from_slice(inverse.unwrap_or_else(none).transpose().as_slice());
            }
        }
        let input = |row: usize, i: usize| {
            let [g, mu] = states[row];
            let number = match i {
                _ if i < m => g.get(i),
                _ if i < 2 * m => inverses.get(row * m + i - m),
                _ => mu.get(i - 2 * m),
            };
            number.copied().unwrap_or(f64::NAN)
        };
        self.program.run_each(states.len(), input, &[])
    }

    /// The spatial momentum of a state.
    pub fn spatial_momentum(&self, g: &[f64], mu: &[f64]) -> Vec<f64> {
        let mut seen = self.of(&[[g, mu]]);
        seen.truncate(self.dim);
        seen
    }
}
