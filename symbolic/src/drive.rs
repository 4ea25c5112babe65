//! Velocities and torques beside a Hamiltonian: ġ = g ξ, μ̇ = ad\*_ξ μ + τ with ξ = ∂H/∂μ + η.
//!
//! A velocity η keeps the state on its coadjoint orbit and the spatial momentum, whatever it is: damping by the double bracket, spin
//! torque, feedback along an orbit. A torque τ changes the spatial momentum by its integral in space: friction, thrust, control. Both
//! are functions of t, g, μ and ω = ∂H/∂μ.

use std::ops::Range;

use coadjoint_program::{Graph, Id, Node, Program};

use crate::lie::LieAlgebra;
use crate::potential::{Force, Potential, Programs};
use crate::problem::Symbol;
use crate::signal::{self, Signal};

/// The velocity and the torque that act on a motion beside its Hamiltonian, as straight-line programs.
///
/// The inputs of the programs are the entries of the group element's matrix, row by row, the n coordinates of μ, those of ω = ∂H/∂μ,
/// the time, and the values of the signals then; their slots are the symbols.
#[derive(Clone, Debug)]
pub struct Drive {
    /// η, then τ, 2n outputs.
    pub program: Program,
    /// As [`Programs::watched`].
    pub watched: Program,
    /// The texts of the expressions watched.
    pub expressions: Vec<String>,
    /// The texts of expressions that have a kink, across which steps are less accurate.
    pub kinks: Vec<String>,
    /// The expressions in parameters, which the slots are.
    pub symbols: Vec<Symbol>,
    /// The number of the first slot among the symbols of the system.
    pub first: usize,
    /// The keys with their values, as the user wrote them.
    pub source: String,
    /// The number of entries among the inputs: 0 where none can be read.
    pub entries: usize,
    /// True if time or signals are read.
    pub moves: bool,
    /// True if there is a velocity.
    pub velocity: bool,
    /// True if the velocity is damping alone, along which the energy falls.
    pub damps: bool,
    /// A potential whose torque is a part of the motion, and the number of its first slot among those of the programs.
    pub potential: Option<(Potential, usize)>,
    /// The torque, where one acts: the potential, or what has none.
    pub torque: Option<Potential>,
}

/// The parts that a drive is made of.
#[derive(Clone, Debug, Default)]
pub struct Ingredients {
    /// η and τ as the user gives them, with the inputs of a [`Drive`], one after the other as far as they are
    /// [`given`](Ingredients::given); what is watched in them, the texts of that, and their symbols.
    pub own: Option<(Program, Program, Vec<String>, Vec<Symbol>)>,
    /// True if η, and τ, are among them.
    pub given: [bool; 2],
    /// True if they read the time or signals.
    pub moves: bool,
    /// The texts of expressions in them that have a kink.
    pub kinks: Vec<String>,
    /// The diagonal of Γ, where η has damping by the double bracket: Γ (ad\*_ω μ + τ′) with the torque τ′ of the potential.
    pub damping: Option<Vec<f64>>,
    /// A potential, whose torque is a part of τ.
    pub potential: Option<Potential>,
    /// The keys with their values, as the user wrote them.
    pub source: String,
}

/// The places of the inputs of a program, one list after the other.
#[derive(Clone, Copy, Debug)]
struct Layout {
    entries: usize,
    dim: usize,
    signals: usize,
}

impl Layout {
    fn count(self) -> usize {
        self.entries + 2 * self.dim + 1 + self.signals
    }

    fn mu(self) -> Range<usize> {
        self.entries..self.entries + self.dim
    }

    fn omega(self) -> Range<usize> {
        self.entries + self.dim..self.entries + 2 * self.dim
    }
}

impl Drive {
    /// From its parts; `None` where a potential is none of programs.
    pub fn new(algebra: &LieAlgebra, signals: &[Signal], parts: Ingredients) -> Option<Self> {
        let Ingredients { own, given, moves, kinks, damping, potential, source } = parts;
        let dim = algebra.dim();
        let reads = own.is_some() || potential.is_some();
        let entries = if reads { algebra.matrix_size().pow(2) } else { 0 };
        let places = Layout { entries, dim, signals: signals.len() };
        let graph = Graph::new();
        let all: Vec<Id> = (0..places.count()).map(|at| graph.input(at)).collect();
        let (mut eta, mut tau) = (vec![graph.zero(); dim], vec![graph.zero(); dim]);
        let (mut watched, mut expressions, mut symbols) = (Vec::new(), Vec::new(), Vec::new());
        let add = |sum: &mut Vec<Id>, terms: &[Id]| {
            sum.iter_mut().zip(terms).for_each(|(sum, &term)| *sum = graph.add(*sum, term));
        };
        if let Some((program, of_own, texts, own_symbols)) = own {
            let outputs = graph.call(&program, &all);
            let mut lists = outputs.chunks(dim);
            for (sum, _) in [&mut eta, &mut tau].into_iter().zip(given).filter(|(_, given)| *given)
            {
                add(sum, lists.next().unwrap_or_default());
            }
            watched.extend(graph.call(&of_own, &all));
            expressions.extend(texts);
            symbols.extend(own_symbols);
        }
        let mut force = vec![graph.zero(); dim];
        let of_potential = symbols.len();
        if let Some(potential) = &potential {
            let Force::Smooth(programs) = &potential.force else { return None };
            let entries = &all[..places.entries];
            force = graph.call_from(&programs.torque, entries, of_potential);
            watched.extend(graph.call_from(&programs.watched, entries, of_potential));
            expressions.extend(programs.expressions.iter().cloned());
            symbols.extend(potential.symbols.iter().cloned());
            add(&mut tau, &force);
        }
        if let Some(rates) = &damping {
            for (i, j, k, c) in algebra.constants() {
                let product = graph.mul(graph.constant(c), all[places.omega()][i]);
                force[j] = graph.times_plus(product, all[places.mu()][k], force[j]);
            }
            for ((eta, rate), force) in eta.iter_mut().zip(rates).zip(force) {
                *eta = graph.times_plus(graph.constant(*rate), force, *eta);
            }
        }
        let finish = |outputs: &[Id]| graph.finish(places.count(), outputs);
        let alone = || Potential {
            name: "torque".to_owned(),
            algebra: algebra.clone(),
            force: Force::Smooth(Box::new(Programs {
                value: None,
                torque: finish(&tau),
                watched: finish(&[]),
                expressions: Vec::new(),
            })),
            symbols: symbols.clone(),
            parameters: Vec::new(),
            source: String::new(),
        };
        let torque = if given[1] { Some(alone()) } else { potential.clone() };
        Some(Self {
            program: finish(&[eta.clone(), tau.clone()].concat()),
            watched: finish(&watched),
            expressions,
            kinks,
            symbols,
            first: 0,
            source,
            entries,
            moves,
            velocity: damping.is_some() || given[0],
            damps: damping.is_some() && !given[0],
            potential: potential.map(|potential| (potential, of_potential)),
            torque,
        })
    }

    /// True if the energy falls: a velocity damps, and no torque acts but that of a potential.
    pub fn is_dissipative(&self) -> bool {
        self.damps && self.torque.as_ref().is_none_or(|torque| torque.alone().is_none())
    }

    /// This drive without its velocity.
    pub fn without_velocity(&self) -> Self {
        let graph = Graph::new();
        let inputs: Vec<Id> = (0..self.program.inputs()).map(|at| graph.input(at)).collect();
        let mut outputs = graph.call(&self.program, &inputs);
        let dim = outputs.len() / 2;
        outputs[..dim].fill(graph.zero());
        let program = graph.finish(inputs.len(), &outputs);
        Self { program, velocity: false, damps: false, ..self.clone() }
    }

    /// A program of it with slots for all symbols of the system.
    pub fn of_system(&self, program: &Program) -> Program {
        let graph = Graph::new();
        let inputs: Vec<Id> = (0..program.inputs()).map(|at| graph.input(at)).collect();
        let outputs = graph.call_from(program, &inputs, self.first);
        graph.finish(inputs.len(), &outputs)
    }

    /// The inputs of its programs in a state. `entries` may be empty where they do not [read](Drive::reads_element) the element.
    pub fn inputs(
        &self,
        entries: &[f64],
        [mu, omega]: [&[f64]; 2],
        time: f64,
        signals: &[Signal],
    ) -> Vec<f64> {
        let mut inputs = entries.to_vec();
        inputs.resize(self.entries, f64::NAN);
        inputs.extend_from_slice(mu);
        signal::inputs(inputs, omega, time, signals)
    }

    /// True if its programs read entries of the group element's matrix.
    pub fn reads_element(&self) -> bool {
        let entries = self.entries;
        self.program
            .nodes()
            .iter()
            .any(|node| matches!(node, Node::Input(at) if (*at as usize) < entries))
    }
}
