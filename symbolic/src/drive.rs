//! Velocities and torques beside a Hamiltonian: ġ = g ξ, μ̇ = ad\*_ξ μ + τ with ξ = ∂H/∂μ + η.
//!
//! A velocity η keeps the state on its coadjoint orbit and the spatial momentum, whatever it is: damping by the double bracket, spin
//! torque, feedback along an orbit. A torque τ changes the spatial momentum by its integral in space: friction, thrust, control. Both
//! are functions of t, g, μ and ω = ∂H/∂μ.

use std::ops::Range;
use std::sync::Arc;

use coadjoint_program::{Graph, Id, Node, Program};

use crate::lie::LieAlgebra;
use crate::potential::{Force, Potential, Programs};
use crate::problem::Symbol;
use crate::signal::{self, Signal};
use crate::spatial::Spatial;

/// A velocity or a torque that is a function of the user's.
pub trait Actor: Send + Sync {
    /// η or τ at (t, g, μ), as many numbers as μ has, by the entries of g's matrix, row by row; NaN where it is not defined.
    fn acting(&self, time: f64, entries: &[f64], mu: &[f64]) -> Vec<f64>;
}

/// A function of the user's, shared.
#[derive(Clone)]
pub struct Acts(pub Arc<dyn Actor>);

impl std::fmt::Debug for Acts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Acts").finish_non_exhaustive()
    }
}

/// The velocity and the torque that act on a motion beside its Hamiltonian, as straight-line programs.
///
/// The inputs of the programs are the entries of the group element's matrix, row by row, the n coordinates of μ, those of ω = ∂H/∂μ,
/// the time, and the values of the signals then; their slots are the symbols.
#[derive(Clone, Debug)]
pub struct Drive {
    /// η, then τ, 2n outputs; where [a torque works](Drive::works) ⟨τ, ω⟩ too, without the potential's part.
    pub program: Program,
    /// As [`Programs::watched`].
    pub watched: Program,
    /// A velocity and a torque beside those of the program, functions of the user's.
    pub functions: [Option<Acts>; 2],
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
    /// The reason for which no energy is conserved, where a torque is given or a potential depends on time.
    pub no_energy: Option<&'static str>,
    /// True if there is a velocity.
    pub velocity: bool,
    /// True if the velocity is damping alone, along which the energy falls.
    pub damps: bool,
    /// The slots that are rates of damping, which must not be negative.
    pub rates: Vec<usize>,
    /// A potential whose torque is a part of the motion, and the number of its first slot among those of the programs.
    pub potential: Option<(Potential, usize)>,
    /// The torque, where one acts: the potential, or what has none.
    pub torque: Option<Potential>,
}

/// The parts that a drive is made of.
#[derive(Clone, Debug, Default)]
pub struct Ingredients {
    /// The lists that the user gives, one after the other as far as they are [`given`](Ingredients::given), with the inputs of a
    /// [`Drive`], or without the entries where there are rates of damping alone; what is watched in them, the texts of that, and their
    /// symbols.
    pub own: Option<(Program, Program, Vec<String>, Vec<Symbol>)>,
    /// True if they are among them: η and τ in the body, η and τ in space, and the diagonal of Γ of damping by the double bracket,
    /// Γ (ad\*_ω μ + τ′) with the torque τ′ of the potential.
    pub given: [bool; 5],
    /// A velocity and a torque that are functions of the user's.
    pub functions: [Option<Acts>; 2],
    /// True if they read the time or signals.
    pub moves: bool,
    /// The texts of expressions in them that have a kink.
    pub kinks: Vec<String>,
    /// A potential, whose torque is a part of τ; where it depends on the time its programs read that and the signals after the entries.
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
    /// From its parts; `None` where a potential is none of programs, or where η or τ is given in space, and the group is not [one of
    /// motions](Spatial).
    pub fn new(algebra: &LieAlgebra, signals: &[Signal], parts: Ingredients) -> Option<Self> {
        let Ingredients { own, given, functions, moves, kinks, potential, source } = parts;
        let dim = algebra.dim();
        let called = functions.each_ref().map(Option::is_some);
        let reads = given[..4].contains(&true) || potential.is_some() || called.contains(&true);
        let entries = if reads { algebra.matrix_size().pow(2) } else { 0 };
        let places = Layout { entries, dim, signals: signals.len() };
        let in_space = given[2] || given[3];
        let spatial = if in_space { Spatial::new(algebra) } else { None };
        let [eta_given, tau_given] =
            [0, 1].map(|kind| given[kind] || given[kind + 2] || called[kind]);
        let graph = Graph::new();
        let all: Vec<Id> = (0..places.count()).map(|at| graph.input(at)).collect();
        let (mut eta, mut tau) = (vec![graph.zero(); dim], vec![graph.zero(); dim]);
        let (mut watched, mut expressions, mut symbols) = (Vec::new(), Vec::new(), Vec::new());
        let (mut damping, mut rates) = (Vec::new(), Vec::new());
        let add = |sum: &mut Vec<Id>, terms: &[Id]| {
            sum.iter_mut().zip(terms).for_each(|(sum, &term)| *sum = graph.add(*sum, term));
        };
        if let Some((program, of_own, texts, own_symbols)) = own {
            let seen = &all[all.len() - program.inputs()..];
            let outputs = graph.call(&program, seen);
            let present = (0..given.len()).filter(|&kind| given[kind]);
            for (kind, list) in present.zip(outputs.chunks(dim)) {
                let g = &all[..entries];
                match kind {
                    0 => add(&mut eta, list),
                    1 => add(&mut tau, list),
                    2 => add(&mut eta, &spatial.as_ref()?.velocity(&graph, g, list)),
                    3 => add(&mut tau, &spatial.as_ref()?.torque(&graph, g, list)),
                    _ => damping = list.to_vec(),
                }
            }
            let last = program.outputs().iter().rev().take(damping.len());
            let slot = |&rate: &Id| match program.nodes()[rate.index()] {
                Node::Slot(slot) => Some(slot as usize),
                _ => None,
            };
            rates = last.filter_map(slot).collect();
            watched.extend(graph.call(&of_own, seen));
            expressions.extend(texts);
            symbols.extend(own_symbols);
        }
        let of_user = tau.clone();
        let mut force = vec![graph.zero(); dim];
        let moving = potential.as_ref().is_some_and(|own| own.alone().is_some());
        let of_potential = symbols.len();
        if let Some(potential) = &potential {
            let Force::Smooth(programs) = &potential.force else { return None };
            let inputs = [&all[..entries], &all[places.omega().end..]].concat();
            force = graph.call_from(&programs.torque, &inputs, of_potential);
            watched.extend(graph.call_from(&programs.watched, &inputs, of_potential));
            expressions.extend(programs.expressions.iter().cloned());
            symbols.extend(potential.symbols.iter().cloned());
            add(&mut tau, &force);
        }
        if given[4] {
            for (i, j, k, c) in algebra.constants() {
                let product = graph.mul(graph.constant(c), all[places.omega()][i]);
                force[j] = graph.times_plus(product, all[places.mu()][k], force[j]);
            }
            for ((eta, &rate), force) in eta.iter_mut().zip(&damping).zip(force) {
                *eta = graph.times_plus(rate, force, *eta);
            }
        }
        let finish = |outputs: &[Id]| graph.finish(places.count(), outputs);
        // Nothing is known of the torque that a function is.
        let anything =
            (0..if called[1] { dim } else { 0 }).map(|i| graph.input(places.count() + i));
        let mut of_all = tau.clone();
        add(&mut of_all, &anything.collect::<Vec<_>>());
        let alone = || Potential {
            name: "torque".to_owned(),
            algebra: algebra.clone(),
            force: Force::Smooth(Box::new(Programs {
                value: None,
                torque: graph.finish(places.count() + if called[1] { dim } else { 0 }, &of_all),
                watched: finish(&[]),
                expressions: Vec::new(),
            })),
            symbols: symbols.clone(),
            parameters: Vec::new(),
            source: String::new(),
        };
        let no_energy = match (tau_given, moving) {
            (true, _) => Some("not conserved: a torque acts, which is not Hamiltonian"),
            (_, true) => Some("not conserved: the potential depends on time"),
            _ => None,
        };
        let lasting = potential.filter(|own| own.alone().is_none());
        let omega = &all[places.omega()];
        let power = |tau: &[Id]| {
            let terms = tau.iter().zip(omega);
            terms.fold(graph.zero(), |sum, (&tau, &omega)| graph.times_plus(tau, omega, sum))
        };
        let power = no_energy.map(|_| power(if lasting.is_some() { &of_user } else { &tau }));
        let torque = if no_energy.is_some() { Some(alone()) } else { lasting.clone() };
        Some(Self {
            program: finish(&[eta, tau, power.into_iter().collect()].concat()),
            watched: finish(&watched),
            functions,
            expressions,
            kinks,
            symbols,
            first: 0,
            source,
            entries,
            moves: moves || called.contains(&true),
            no_energy,
            velocity: given[4] || eta_given,
            damps: given[4] && !eta_given,
            rates,
            potential: lasting.map(|potential| (potential, of_potential)),
            torque,
        })
    }

    /// True if the energy falls: a velocity damps, and no torque acts but that of a potential.
    pub fn is_dissipative(&self) -> bool {
        self.damps && self.torque.as_ref().is_none_or(|torque| torque.alone().is_none())
    }

    /// True if a torque acts, of which the energy knows nothing.
    pub fn works(&self) -> bool {
        self.no_energy.is_some()
    }

    /// This drive without its velocity.
    pub fn without_velocity(&self) -> Self {
        let graph = Graph::new();
        let inputs: Vec<Id> = (0..self.program.inputs()).map(|at| graph.input(at)).collect();
        let mut outputs = graph.call(&self.program, &inputs);
        let dim = outputs.len() / 2;
        outputs[..dim].fill(graph.zero());
        let program = graph.finish(inputs.len(), &outputs);
        let functions = [None, self.functions[1].clone()];
        Self { program, functions, velocity: false, damps: false, ..self.clone() }
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

    /// True if a part of it is a function of the user's, of which there are no programs.
    pub fn is_function(&self) -> bool {
        self.functions.iter().any(Option::is_some)
    }

    /// True if it reads entries of the group element's matrix.
    pub fn reads_element(&self) -> bool {
        let entries = self.entries;
        if self.is_function() {
            return true;
        }
        self.program
            .nodes()
            .iter()
            .any(|node| matches!(node, Node::Input(at) if (*at as usize) < entries))
    }
}
