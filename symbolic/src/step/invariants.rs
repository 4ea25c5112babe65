//! The quantities that a motion conserves, as a program of its states: their one definition.

use crate::graph::{Graph, Id, Program};
use crate::lie::{LieAlgebra, watched_casimirs};
use crate::poly::{Numeric, Polynomial};
use crate::potential::{Force, Potential};
use crate::problem::Problem;
use crate::smooth::{Given, Hamiltonian, Smooth};

use super::Origin;
use super::drift::{Scales, Start};
use super::solving::inputs;

/// A state in the numbers that its laws are about.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// Ad\*_g μ, n numbers; empty where g is not known.
    pub spatial: &'a [f64],
    /// The matrix of g, row by row; it is read where a potential acts, and may be empty elsewhere.
    pub matrix: &'a [f64],
    /// μ, n numbers.
    pub momentum: &'a [f64],
}

/// The quantities that a motion conserves.
#[derive(Clone, Debug)]
pub struct Invariants {
    /// The ξ with ⟨J_L, ξ⟩ conserved, their largest coordinate being 1; `None` where all of J_L is conserved.
    pub directions: Option<Vec<Vec<f64>>>,
    /// The number of Casimirs of low degree that are conserved.
    pub casimirs: usize,
    /// True if an energy is known and conserved.
    pub energy: bool,
    /// The reason for which a known energy is not conserved.
    pub no_energy: Option<&'static str>,
    /// True if V(g) is a part of the energy.
    pub potential: bool,
    /// The Hamiltonian, where it is a function of the user's.
    given: Option<Given>,
    pub(super) dim: usize,
    /// J_L (n), μ (n), the matrix of g ↦ the conserved ⟨J_L, ξ⟩, the Casimirs, the energy.
    pub(super) values: Program,
    /// The same inputs ↦ the sums of the absolute values of the terms of each Casimir and of the energy; of functions that are no
    /// polynomials the absolute value.
    pub(super) sizes: Program,
    symbols: Vec<f64>,
}

impl Invariants {
    /// Of every motion on the coadjoint orbits of this algebra that keeps the spatial momentum.
    pub fn of(algebra: &LieAlgebra) -> Self {
        Self::new(algebra, None)
    }

    /// Of the motion with this Hamiltonian and its drive, where they are known, for the values that the input gives the parameters.
    pub fn new(algebra: &LieAlgebra, hamiltonian: Option<&Hamiltonian>) -> Self {
        let parameters = hamiltonian.map_or_else(Vec::new, |own| own.facts().defaults());
        let law = hamiltonian.map(|own| match own {
            Hamiltonian::Polynomial(problem, _) => Law::Polynomial(problem),
            Hamiltonian::Smooth(smooth) => Law::Smooth(smooth),
        });
        Self::of_motion(algebra, law, None, &parameters)
    }

    /// Of the motion of a system, with the kicks of its potential if there is one, for these values of the parameters that are kept.
    pub fn of_system(origin: &Origin, parameters: &[f64]) -> Self {
        let law = match origin {
            Origin::Series(integrator) => Law::Polynomial(&integrator.problem),
            Origin::Collocation(smooth) => Law::Smooth(smooth),
        };
        let potential = origin.kicks().map(|kicks| &kicks.kick.potential);
        Self::of_motion(origin.facts().algebra, Some(law), potential, parameters)
    }

    fn of_motion(
        algebra: &LieAlgebra,
        law: Option<Law<'_>>,
        potential: Option<&Potential>,
        parameters: &[f64],
    ) -> Self {
        let smooth = law.and_then(Law::smooth);
        let moves = smooth.is_some_and(|smooth| smooth.moves);
        let drive = smooth.and_then(|smooth| smooth.drive.as_ref());
        let of_drive = drive.and_then(|drive| drive.potential.as_ref());
        let energetic = of_drive.map(|(potential, _)| potential).or(potential);
        let force = drive.and_then(|drive| drive.torque.as_ref()).or(potential);
        let of_torque = drive.and_then(|drive| drive.no_energy);
        let of_time = moves.then_some("not conserved: the Hamiltonian depends on time");
        let no_energy = of_torque.or(of_time);
        let law = law.filter(|_| no_energy.is_none());
        let smooth = law.and_then(Law::smooth);
        let potential_of_energy = energetic.filter(|_| of_torque.is_none());
        let mut casimirs = watched_casimirs(algebra);
        casimirs.retain(|casimir| force.is_none_or(|force| force.keeps(casimir)));
        let mut symbols = smooth.map_or_else(Vec::new, |smooth| smooth.symbols_at(parameters));
        let first = symbols.len();
        let of_potential = potential_of_energy.iter().flat_map(|own| &own.symbols);
        symbols.extend(of_potential.map(|symbol| symbol.expr.evaluate(parameters)));
        let directions = force.map(Potential::directions);
        let parts = Parts {
            algebra,
            directions: directions.as_deref(),
            casimirs: &casimirs,
            energy: law,
            potential: potential_of_energy.filter(|_| law.is_some()),
            parameters,
            symbols: &symbols,
            first,
        };
        Self {
            casimirs: casimirs.len(),
            energy: law.is_some(),
            no_energy,
            potential: potential_of_energy.is_some(),
            given: smooth.and_then(|smooth| smooth.given.clone()),
            dim: algebra.dim(),
            values: parts.program(false),
            sizes: parts.program(true),
            symbols,
            directions,
        }
    }

    /// The number of components of the spatial momentum that are conserved.
    pub fn momenta(&self) -> usize {
        self.directions.as_ref().map_or(self.dim, Vec::len)
    }

    /// The number of conserved quantities.
    pub fn count(&self) -> usize {
        self.values.outputs().len()
    }

    /// The conserved quantities of states of this time, [`count`](Self::count) numbers of each, one state after the other.
    pub fn conserved(&self, time: f64, states: &[Seen<'_>]) -> Vec<f64> {
        self.evaluate(&self.values, time, states)
    }

    /// The energy among what is [`conserved`](Self::conserved), where there is one.
    pub fn energy_of(&self, conserved: &[f64]) -> Option<f64> {
        conserved.last().copied().filter(|_| self.energy)
    }

    /// The sizes of what the Casimirs and the energy at a state are sums of.
    pub fn sizes(&self, time: f64, state: Seen<'_>) -> (Vec<f64>, Option<f64>) {
        let mut sizes = self.evaluate(&self.sizes, time, &[state]);
        let energy = if self.energy { sizes.pop() } else { None };
        (sizes, energy.map(f64::abs))
    }

    /// The start of a run from that state.
    pub fn start(&self, time: f64, state: Seen<'_>) -> Start {
        let conserved = self.conserved(time, &[state]);
        let (casimirs, energy) = self.sizes(time, state);
        let known = self.energy_of(&conserved).unwrap_or(0.0);
        let energies = [known, energy.unwrap_or(0.0)];
        let scales = Scales::new(state.spatial.iter().copied(), casimirs, energies);
        Start { momenta: self.momenta(), conserved, scales }
    }

    /// The outputs of a program for each state, one state after the other.
    fn evaluate(&self, program: &Program, time: f64, states: &[Seen<'_>]) -> Vec<f64> {
        let n = self.dim;
        let input = |row: usize, i: usize| {
            let Seen { spatial, matrix, momentum } = states[row];
            let number = match i {
                _ if i < n => spatial.get(i),
                _ if i < 2 * n => momentum.get(i - n),
                _ => matrix.get(i - 2 * n),
            };
            number.copied().unwrap_or(f64::NAN)
        };
        let mut found = program.run_each(states.len(), input, &self.symbols);
        if let Some(Given(function)) = &self.given {
            for (row, state) in found.chunks_mut(program.outputs().len()).zip(states) {
                let Some(energy) = row.last_mut() else { continue };
                *energy += function.value(time, state.momentum);
            }
        }
        found
    }
}

/// The function that the energy of a motion is.
#[derive(Clone, Copy)]
enum Law<'a> {
    Polynomial(&'a Problem),
    Smooth(&'a Smooth),
}

impl<'a> Law<'a> {
    fn smooth(self) -> Option<&'a Smooth> {
        match self {
            Self::Polynomial(_) => None,
            Self::Smooth(smooth) => Some(smooth),
        }
    }
}

/// The parts that the programs are made of.
struct Parts<'a> {
    algebra: &'a LieAlgebra,
    directions: Option<&'a [Vec<f64>]>,
    casimirs: &'a [Polynomial],
    energy: Option<Law<'a>>,
    potential: Option<&'a Potential>,
    parameters: &'a [f64],
    /// The values of the symbols of a smooth function and of the potential.
    symbols: &'a [f64],
    /// The first slot of the potential's symbols.
    first: usize,
}

impl Parts<'_> {
    /// The quantities, or the sizes of the terms of the Casimirs and of the energy.
    fn program(&self, sizes: bool) -> Program {
        let n = self.algebra.dim();
        let entries = self.algebra.matrix_size().pow(2);
        let graph = Graph::new();
        let lists = [(0, n), (n, n), (2 * n, entries)];
        let [spatial, mu, matrix] = lists.map(|(first, count)| inputs(&graph, first, count));
        let size = |id: Id| if sizes { graph.abs(id) } else { id };
        let polynomial = |polynomial: &Numeric, at: &[Id]| match sizes {
            false => polynomial.node(&graph, at),
            true => {
                let at: Vec<Id> = at.iter().map(|&entry| graph.abs(entry)).collect();
                polynomial.absolute().node(&graph, &at)
            }
        };
        let mut outputs: Vec<Id> = match self.directions {
            _ if sizes => Vec::new(),
            None => spatial,
            Some(directions) => {
                let along = |xi: &Vec<f64>| {
                    let terms = xi.iter().zip(&spatial).filter(|(xi, _)| **xi != 0.0);
                    terms.fold(graph.zero(), |sum, (&xi, &j)| {
                        graph.add(sum, graph.mul(graph.constant(xi), j))
                    })
                };
                directions.iter().map(along).collect()
            }
        };
        let casimirs = self.casimirs.iter();
        outputs.extend(casimirs.map(|casimir| polynomial(&Numeric::new(casimir, n, &[]), &mu)));
        if let Some(law) = self.energy {
            let mut energy = match law {
                Law::Polynomial(problem) => {
                    let symbols = problem.symbols_at(self.parameters);
                    polynomial(&Numeric::new(&problem.hamiltonian, n, &symbols), &mu)
                }
                // It does not depend on the time, or it is a function of the user's, whose value is added elsewhere.
                Law::Smooth(smooth) if smooth.given.is_none() => {
                    size(graph.call(&smooth.value, &mu)[0])
                }
                Law::Smooth(_) => graph.zero(),
            };
            if let Some(potential) = self.potential {
                let value = match &potential.force {
                    Force::Polynomial(own) => {
                        let symbols = &self.symbols[self.first..];
                        polynomial(&Numeric::new(own, entries, symbols), &matrix)
                    }
                    Force::Smooth(programs) => programs.value.as_ref().map_or_else(
                        || graph.zero(),
                        |value| size(graph.call_from(value, &matrix, self.first)[0]),
                    ),
                };
                energy = graph.add(energy, value);
            }
            outputs.push(energy);
        }
        graph.finish(2 * n + entries, &outputs)
    }
}
