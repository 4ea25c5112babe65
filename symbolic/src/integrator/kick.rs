//! The programs of a potential: its value and its torque.

use coadjoint_program::splitting::Splitting;

use super::Integrator;
use super::coefficients::Coefficients;
use super::lower::{collect, value_program, vector_program};
use crate::graph::Program;
use crate::potential::{Force, Potential};

/// Everything a back end needs to write or run kicks.
///
/// Programs read the entries of the group element's matrix as inputs, row by row, and folded coefficients as slots. The
/// coefficients hold no power of the step size.
#[derive(Clone, Debug)]
pub struct Kick {
    /// The potential.
    pub potential: Potential,
    /// The coefficients of the torque and of the potential.
    pub coefficients: Coefficients,
    /// g ↦ V(g), where there is a potential.
    pub energy: Option<Program>,
    /// g ↦ the body torque −g⁻¹dV(g).
    pub torque: Program,
}

impl Kick {
    /// Derives the torque and lowers it.
    pub fn build(potential: Potential) -> Self {
        let entries = potential.size() * potential.size();
        let polynomial = match &potential.force {
            Force::Polynomial(polynomial) => polynomial,
            Force::Smooth(programs) => {
                // Slot j is symbol j.
                let coefficients = Coefficients::of_symbols(potential.symbols.len());
                let (energy, torque) = (programs.value.clone(), programs.torque.clone());
                return Self { potential, coefficients, energy, torque };
            }
        };
        let mut coefficients = Coefficients::default();
        let energy = collect(&mut coefficients, entries, [(0, polynomial)]);
        let energy = value_program(&mut coefficients, entries, &energy);
        let components: Vec<_> = potential
            .torque(polynomial)
            .iter()
            .map(|component| collect(&mut coefficients, entries, [(0, component)]))
            .collect();
        let torque = vector_program(&mut coefficients, entries, &components);
        Self { potential, coefficients, energy: Some(energy), torque }
    }
}

/// The kicks between the flows of a step, over its coefficients.
#[derive(Clone, Debug)]
pub struct Kicks {
    /// Their programs.
    pub kick: Kick,
    /// The number of the programs' first slot among those of the step.
    pub first: usize,
    /// The composition of kicks and flows.
    pub splitting: Splitting,
}

impl Integrator {
    /// Adds kicks between flows; `None` if the parameters of the potential are not those of the Hamiltonian.
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
