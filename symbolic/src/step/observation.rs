//! States as the programs have them, in the numbers that laws are about.

use coadjoint_program::states::abreast;
use coadjoint_program::{Evaluation, Graph, Id, Program, WIDTH};
use nalgebra::DMatrix;

use super::drift::{self, Drift, Scales, Start};
use super::{Invariants, Step};
use crate::step::solving::inputs;

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
            invert(&self.inverted, |i| g[i], |i, entry| inverses[row * m + i] = entry);
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

/// Puts the entries of the inverses of the matrices in `inverted`, by first index and number of rows, of an element with these
/// numbers; NaN where a matrix has no inverse.
fn invert(inverted: &[(usize, usize)], g: impl Fn(usize) -> f64, mut put: impl FnMut(usize, f64)) {
    for &(start, rows) in inverted {
        let inverse = DMatrix::from_fn(rows, rows, |i, j| g(start + i * rows + j)).try_inverse();
        let inverse = inverse.unwrap_or_else(|| DMatrix::from_element(rows, rows, f64::NAN));
        let entries = inverse.transpose();
        entries.iter().enumerate().for_each(|(i, entry)| put(start + i, *entry));
    }
}

/// The drifts of what is conserved, energies left out, of states in [blocks](coadjoint_program::states::States), which are
/// measured [`WIDTH`] side by side.
#[derive(Debug)]
pub struct DriftPrograms {
    /// g, what is known beside it, μ ↦ what is conserved.
    values: Program,
    /// These inputs ↦ what is conserved, Ad\*_g μ, the sizes of the terms of the Casimirs.
    start: Program,
    beside: Beside,
    momenta: usize,
    dim: usize,
    element: usize,
}

/// The numbers that the programs read beside those of a state.
#[derive(Debug)]
enum Beside {
    /// The inverses of the matrices with these first indices and numbers of rows, in the places of the matrices.
    Inverses(Vec<(usize, usize)>),
    /// Ad\*_g μ, which is found by other means.
    Spatial,
}

impl DriftPrograms {
    /// Of the states of a step, or of states with `element` numbers of g whose spatial momentum is found otherwise.
    pub fn new(invariants: &Invariants, step: Option<&Step>, element: usize) -> Self {
        let n = invariants.dim;
        let m = step.map_or(element, |step| step.kernel().element);
        let known = step.map_or(n, |_| m);
        let program = |start: bool| {
            let graph = Graph::new();
            let ids = inputs(&graph, 0, m + known + n);
            let (spatial, matrix) = match step {
                Some(step) => {
                    let matrix = &step.kernel().programs.matrix;
                    (graph.call(&step.spatial(), &ids), graph.call(matrix, &ids[..m]))
                }
                None => (ids[m..m + n].to_vec(), Vec::new()),
            };
            let mut seen = [&spatial, &ids[m + known..], &matrix].concat();
            seen.resize(invariants.values.inputs(), graph.zero());
            let of = |program: &Program| {
                let mut outputs = graph.call(program, &seen);
                outputs.truncate(outputs.len() - usize::from(invariants.energy));
                outputs
            };
            let mut outputs = of(&invariants.values);
            if start {
                outputs.extend(spatial);
                outputs.extend(of(&invariants.sizes));
            }
            graph.finish(ids.len(), &outputs)
        };
        let beside = match step {
            Some(step) => Beside::Inverses(step.inverted()),
            None => Beside::Spatial,
        };
        let (values, start) = (program(false), program(true));
        Self { values, start, beside, momenta: invariants.momenta(), dim: n, element: m }
    }

    /// Ready to measure blocks, one after the other.
    pub fn gauge(&self) -> DriftGauge<'_> {
        let numbers = match self.beside {
            Beside::Inverses(ref list) if list.is_empty() => 0,
            Beside::Inverses(_) => self.element,
            Beside::Spatial => self.dim,
        };
        DriftGauge {
            drifts: self,
            values: Evaluation::new(&self.values, &[]),
            start: Evaluation::new(&self.start, &[]),
            nudged: vec![0.0; (self.element + self.dim) * WIDTH],
            beside: vec![0.0; numbers * WIDTH],
            found: Default::default(),
            lane: Default::default(),
            from: Start { momenta: self.momenta, ..Start::default() },
        }
    }
}

/// Measures the drifts of blocks of states.
#[derive(Debug)]
pub struct DriftGauge<'a> {
    drifts: &'a DriftPrograms,
    values: Evaluation<'a, WIDTH>,
    start: Evaluation<'a, WIDTH>,
    /// The state after, nudged.
    nudged: Vec<f64>,
    /// The numbers beside those of a state.
    beside: Vec<f64>,
    /// The results of programs: at the start, after, and nudged.
    found: [Vec<[f64; WIDTH]>; 3],
    /// The conserved quantities after and nudged, in one lane, and the start there.
    lane: [Vec<f64>; 2],
    from: Start,
}

impl DriftGauge<'_> {
    /// The drifts between two blocks, in each lane. `spatial` puts Ad\*_g μ of the states of a block into another, where it is
    /// not found by the programs.
    pub fn drifts(
        &mut self,
        [before, after]: [&[f64]; 2],
        spatial: impl Fn(&[f64], &mut [f64]),
    ) -> impl Iterator<Item = Drift> {
        let Self { drifts, values, start, nudged, beside, found, lane, from } = self;
        let (m, n) = (drifts.element, drifts.dim);
        let numbers = nudged.chunks_exact_mut(WIDTH).zip(after.chunks_exact(WIDTH));
        for (i, (to, from)) in numbers.enumerate() {
            let factor = drift::nudged(if i < m { i } else { i - m });
            to.iter_mut().zip(from).for_each(|(to, from)| *to = from * factor);
        }
        let mut evaluate = |programs: &mut Evaluation<'_, WIDTH>, block: &[f64], at: usize| {
            let known = match &drifts.beside {
                Beside::Inverses(list) => {
                    for lane in 0..WIDTH {
                        let place = |i: usize| i * WIDTH + lane;
                        invert(list, |i| block[place(i)], |i, entry| beside[place(i)] = entry);
                    }
                    m
                }
                Beside::Spatial => {
                    spatial(block, beside);
                    n
                }
            };
            programs.run(|i| match i {
                _ if i < m => abreast(block, i),
                _ if i < m + known => abreast(beside, i - m),
                _ => abreast(block, i - known),
            });
            found[at].clear();
            found[at].extend(programs.results());
        };
        evaluate(start, before, 0);
        evaluate(values, after, 1);
        evaluate(values, nudged, 2);
        let [start, after, nudged] = found;
        let [now, moved] = lane;
        let count = after.len();
        (0..WIDTH).map(move |lane| {
            let take = |list: &mut Vec<f64>, of: &[[f64; WIDTH]]| {
                list.clear();
                list.extend(of.iter().map(|own| own[lane]));
            };
            take(now, after);
            take(moved, nudged);
            take(&mut from.conserved, &start[..count]);
            let mut sizes = std::mem::take(&mut from.scales.casimirs);
            take(&mut sizes, &start[count + n..]);
            let spatial = start[count..count + n].iter().map(|own| own[lane]);
            from.scales = Scales::new(spatial, sizes, [0.0; 2]);
            from.measured(now, moved)
        })
    }
}
