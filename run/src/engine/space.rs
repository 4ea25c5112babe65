//! The groups known at run time, and states in them as numbers.

use std::path::Path;
use std::sync::Arc;

use coadjoint::groups::{DirectProduct, ElementError, MatrixGroup};
use coadjoint::{LieGroup, Phase, StepError};
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_codegen::step::{DriftPrograms, Invariants, Seen, nudge};
use coadjoint_learn::catalogue;
use coadjoint_program::WIDTH;
use coadjoint_program::states::{into_lane, of_lane};
use nalgebra::{DMatrix, DVector};

use super::compiled::{Compiled, Numbers};
use crate::error::RunError;

/// The groups known at run time, by tables.
pub(crate) type Tables = DirectProduct<MatrixGroup>;

/// The groups whose elements are those of [`Tables`], in any chart.
pub(crate) trait Group:
    LieGroup<Scalar = f64, Vector = DVector<f64>, Element = Vec<DMatrix<f64>>> + Send + Sync
{
}

impl<G> Group for G where
    G: LieGroup<Scalar = f64, Vector = DVector<f64>, Element = Vec<DMatrix<f64>>> + Send + Sync
{
}

/// Moves a state as one of another group with the same elements.
pub(super) fn moved_in<G: Group, T>(
    phase: &mut Phase<Tables>,
    by: impl FnOnce(&mut Phase<G>) -> Result<T, StepError>,
) -> Result<T, StepError> {
    let mut own = Phase::<G>::new(phase.group_element.clone(), phase.momentum.clone());
    let made = by(&mut own)?;
    *phase = Phase::<Tables>::new(own.group_element, own.momentum);
    Ok(made)
}

/// The group whose Lie algebra this is: `whole` for kicks, which look at its matrices, else factor by factor for a direct product.
pub(crate) fn group_of(path: &Path, algebra: &LieAlgebra, whole: bool) -> Result<Tables, RunError> {
    let factors = if whole { vec![algebra.clone()] } else { algebra.factors() };
    let mut known: Vec<(LieAlgebra, MatrixGroup)> = Vec::new();
    let group = |factor: LieAlgebra| {
        if let Some((_, group)) = known.iter().find(|(other, _)| *other == factor) {
            return Ok(group.clone());
        }
        let group = catalogue::matrix_group(&factor).map_err(RunError::of(path))?;
        known.push((factor, group.clone()));
        Ok(group)
    };
    Ok(DirectProduct::new(factors.into_iter().map(group).collect::<Result<_, RunError>>()?))
}

/// The matrix of an element, row by row.
pub(crate) fn entries_of(group: &Tables, element: &<Tables as LieGroup>::Element) -> Vec<f64> {
    let size = group.matrix_size();
    let mut entries = vec![0.0; size * size];
    group.matrix_entries(element, &mut |i, j, entry| entries[i * size + j] = entry);
    entries
}

/// The state with this matrix, row by row, and this momentum; neither is checked. Reading the matrix as a user's would straighten
/// it: other bits.
pub(crate) fn phase_of(group: &Tables, matrix: &[f64], mu: &[f64]) -> Phase<Tables> {
    let (size, mut first) = (group.matrix_size(), 0);
    let factor = |factor: &MatrixGroup| {
        let own = factor.matrix_size();
        first += own;
        DMatrix::from_fn(own, own, |i, j| matrix[(first - own + i) * size + first - own + j])
    };
    let element = group.factors().map(factor).collect();
    Phase::<Tables>::new(element, DVector::from_column_slice(mu))
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

/// What is conserved of some states, and of the states beside them, whose numbers are [nudged](nudge).
pub(crate) struct Conserved {
    numbers: Vec<f64>,
    /// Numbers of one state.
    count: usize,
    states: usize,
}

impl Conserved {
    /// Of each state, and of the one beside it.
    pub(crate) fn each(&self) -> impl Iterator<Item = [&[f64]; 2]> {
        let of = |at: usize| &self.numbers[at * self.count..][..self.count];
        (0..self.states).map(move |at| [of(at), of(self.states + at)])
    }
}

/// The unit matrix with this number of rows, row by row.
pub(crate) fn identity(size: usize) -> Vec<f64> {
    (0..size * size).map(|at| if at / size == at % size { 1.0 } else { 0.0 }).collect()
}

/// A group whose elements are lists of numbers: those that programs have where there are any, else their matrices, row by row.
pub(crate) struct Space {
    /// The group.
    pub group: Arc<Tables>,
    /// The programs, where there are any.
    pub compiled: Option<Arc<Compiled>>,
}

impl Space {
    /// A state as the group has it.
    pub(crate) fn phase(&self, state: &Numbers) -> Phase<Tables> {
        phase_of(&self.group, &self.matrix(&state.g), &state.mu)
    }

    /// A state as numbers.
    pub(crate) fn state(&self, phase: &Phase<Tables>) -> Numbers {
        let g = self.numbers(&entries_of(&self.group, &phase.group_element));
        Numbers { g, mu: phase.momentum.as_slice().to_vec() }
    }

    /// The rows of the group's matrices.
    pub(crate) fn size(&self) -> usize {
        self.group.matrix_size()
    }

    /// The matrix, row by row, of the element that the given one is up to rounding.
    ///
    /// # Errors
    /// Fails if it is none.
    pub(crate) fn nearest(&self, matrix: &[f64]) -> Result<Vec<f64>, ElementError> {
        let size = self.size();
        let element = self.group.element_from_matrix(|i, j| matrix[i * size + j])?;
        Ok(entries_of(&self.group, &element))
    }

    /// The numbers of the element with this matrix, row by row, which is not checked.
    pub(crate) fn numbers(&self, matrix: &[f64]) -> Vec<f64> {
        self.compiled
            .as_ref()
            .map_or_else(|| matrix.to_vec(), |programs| programs.element_of(matrix))
    }

    /// The matrix of the element with these numbers, row by row.
    pub(crate) fn matrix(&self, g: &[f64]) -> Vec<f64> {
        self.compiled.as_ref().map_or_else(|| g.to_vec(), |programs| programs.matrix_of(g))
    }

    /// These states (g, μ), of one group, as laws are stated for them.
    pub(crate) fn observe(&self, states: &[[&[f64]; 2]]) -> Observed {
        let of = |[g, mu]: &[&[f64]; 2]| {
            let phase = phase_of(&self.group, &self.matrix(g), mu);
            [phase.spatial_momentum(&*self.group).as_slice(), g].concat()
        };
        let numbers = match &self.compiled {
            Some(compiled) => compiled.observe(states),
            None => states.iter().flat_map(of).collect(),
        };
        let dim = self.group.dim();
        Observed { numbers, lengths: [dim, dim + self.size().pow(2)] }
    }

    /// These states (g, μ), of this time, as [`observe`](Space::observe) has them; and what is conserved there.
    pub(crate) fn conserved(
        &self,
        invariants: &Invariants,
        time: f64,
        states: &[[&[f64]; 2]],
    ) -> (Observed, Conserved) {
        let mut beside: Vec<f64> = Vec::new();
        for state in states {
            for part in state {
                let first = beside.len();
                beside.extend_from_slice(part);
                nudge(&mut beside[first..]);
            }
        }
        let mut rest = &beside[..];
        let mut next = |part: &[f64]| {
            let (own, after) = rest.split_at(part.len());
            rest = after;
            own
        };
        let beside = states.iter().map(|state| state.map(&mut next));
        let all: Vec<[&[f64]; 2]> = states.iter().copied().chain(beside).collect();
        let observed = self.observe(&all);
        let seen = all.iter().enumerate().map(|(at, [_, mu])| observed.seen(at, mu));
        let numbers = invariants.conserved(time, &seen.collect::<Vec<_>>());
        (observed, Conserved { numbers, count: invariants.count(), states: states.len() })
    }

    /// The programs of the drifts of these quantities, between states side by side.
    pub(crate) fn drifts(&self, invariants: &Invariants) -> DriftPrograms {
        match &self.compiled {
            Some(compiled) => compiled.drifts(invariants),
            None => DriftPrograms::new(invariants, None, self.size().pow(2)),
        }
    }

    /// Puts Ad\*_g μ of the states of a block into another.
    pub(crate) fn spatial_momenta(&self, block: &[f64], spatial: &mut [f64]) {
        for lane in 0..WIDTH {
            let numbers: Vec<f64> = of_lane(block, lane).collect();
            let state = numbers.split_at(numbers.len() - self.group.dim());
            into_lane(spatial, lane, [self.observe(&[state.into()]).spatial(0), &[]]);
        }
    }

    /// Ad\*_g μ.
    pub(crate) fn spatial_momentum(&self, state: &Numbers) -> Vec<f64> {
        self.observe(&[state.parts()]).spatial(0).to_vec()
    }
}
