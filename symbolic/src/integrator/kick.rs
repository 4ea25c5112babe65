//! The programs of a potential: its value and its torque.

use coadjoint_program::splitting::Splitting;

use super::Integrator;
use super::coefficients::Coefficients;
use super::lower::{collect, value_program, vector_program};
use crate::graph::Program;
use crate::potential::Potential;

/// Everything a back end needs to write or run kicks.
///
/// Programs read the entries of the group element's matrix as inputs, row by row, and folded
/// coefficients as slots. The coefficients hold no power of the step size.
#[derive(Clone, Debug)]
pub struct Kick {
    /// The potential.
    pub potential: Potential,
    /// The coefficients of the torque and of the potential.
    pub coefficients: Coefficients,
    /// g ↦ V(g).
    pub energy: Program,
    /// g ↦ the body torque −g⁻¹dV(g).
    pub torque: Program,
}

impl Kick {
    /// Derives the torque and lowers it.
    #[must_use]
    pub fn build(potential: Potential) -> Self {
        let entries = potential.size() * potential.size();
        let mut coefficients = Coefficients::default();
        let energy = collect(&mut coefficients, entries, [(0, &potential.energy)]);
        let energy = value_program(&mut coefficients, entries, &energy);
        let components: Vec<_> = potential
            .torque()
            .iter()
            .map(|component| collect(&mut coefficients, entries, [(0, component)]))
            .collect();
        let torque = vector_program(&mut coefficients, entries, &components);
        Self { potential, coefficients, energy, torque }
    }
}

/// The kicks between the flows of an integrator, over its coefficients.
#[derive(Clone, Debug)]
pub struct Kicks {
    /// Their programs.
    pub kick: Kick,
    /// The number of the programs' first slot among those of the integrator.
    pub first: usize,
    /// How kicks and flows are composed.
    pub splitting: Splitting,
}

impl Integrator {
    /// The same with kicks between flows; `None` where the potential has other parameters than the Hamiltonian.
    #[must_use]
    pub fn with_kicks(mut self, kick: Kick, splitting: Splitting) -> Option<Self> {
        let problem = &mut self.problem;
        if kick.potential.parameters != problem.parameters {
            return None;
        }
        let first = self.coefficients.append(&kick.coefficients, problem.symbols.len());
        problem.symbols.extend(kick.potential.symbols.iter().cloned());
        self.kicks = Some(Kicks { kick, first, splitting });
        Some(self)
    }
}
