//! A Lie–Poisson system whose Hamiltonian is no polynomial, or moves in time: programs, for steps that need its gradient alone.

use std::sync::Arc;

use coadjoint_program::splitting::Splitting;
use coadjoint_program::{Argument, Node, Program};
use num_traits::ToPrimitive;

use crate::drive::{Acts, Drive};
use crate::integrator::{Kick, Kicks};
use crate::lie::LieAlgebra;
use crate::potential::undefined;
use crate::problem::{Parameter, Problem, Solver, Symbol};
use crate::signal::{self, Signal};

/// A smooth Hamiltonian H(t, μ) on the dual of a Lie algebra, as straight-line programs.
///
/// The inputs of the programs are the n coordinates of the momentum, the time t, and the values of the signals at t; they have
/// a slot for each of the symbols.
#[derive(Clone, Debug)]
pub struct Smooth {
    /// The name of the system.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: LieAlgebra,
    /// The names of the momentum's coordinates, dual to the basis of 𝔤.
    pub coordinates: Vec<String>,
    /// The factors of coordinates of a momentum where sizes are compared: [`Problem::units`] of a polynomial, else 1.
    pub units: Vec<f64>,
    /// True if H depends on the time.
    pub moves: bool,
    /// The inputs u(t) in H and the drive.
    pub signals: Vec<Signal>,
    /// Times besides those of inputs at which steps end.
    pub breaks: Vec<f64>,
    /// H.
    pub value: Program,
    /// ∂H/∂μ, n outputs.
    pub gradient: Program,
    /// As [`Programs::watched`](crate::potential::Programs::watched).
    pub watched: Program,
    /// The square of the farthest way that an argument of H's functions goes from one state to another, in the units in which
    /// its function varies; infinite over a pole or the edge of a domain. Its inputs are those of both states.
    pub reach: Program,
    /// The texts of these expressions.
    pub expressions: Vec<String>,
    /// The expressions in parameters, which the slots are.
    pub symbols: Vec<Symbol>,
    /// The parameters the symbols are made of.
    pub parameters: Vec<Parameter>,
    /// The Hamiltonian as the user wrote it.
    pub source: String,
    /// The truncation K asked for: steps have order K + 1.
    pub truncation: usize,
    /// A function in place of the programs, which are then empty.
    pub given: Option<Given>,
    /// The kicks between flows, where there are any; the symbols of their potential are then the last ones.
    pub kicks: Option<Kicks>,
    /// The velocity and the torque beside H, where there are any; their symbols are then the last ones.
    pub drive: Option<Box<Drive>>,
}

/// A Hamiltonian that is a function of the user's.
pub trait Oracle: Send + Sync {
    /// H(t, μ); NaN where it is not defined.
    fn value(&self, time: f64, mu: &[f64]) -> f64;

    /// ∂H/∂μ(t, μ), as many numbers as μ has; NaN where it is not defined.
    fn gradient(&self, time: f64, mu: &[f64]) -> Vec<f64>;
}

/// A function of the user's, shared.
#[derive(Clone)]
pub struct Given(pub Arc<dyn Oracle>);

impl std::fmt::Debug for Given {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Given").finish_non_exhaustive()
    }
}

/// Functions that a caller gives in place of parts of a text.
#[derive(Clone, Debug, Default)]
pub struct Functions {
    /// The Hamiltonian, and its name; the text then has none.
    pub energy: Option<(String, Given)>,
    /// Inputs, in place of those of the text with these names and beside the others.
    pub inputs: Vec<Signal>,
    /// The velocity and the torque, in the body; the text then has none.
    pub acting: [Option<Acts>; 2],
}

/// The facts of a system that hold however its steps are made.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// The name of the system.
    pub name: &'a str,
    /// The Lie algebra 𝔤.
    pub algebra: &'a LieAlgebra,
    /// The names of the momentum's coordinates, dual to the basis of 𝔤.
    pub coordinates: &'a [String],
    /// The parameters that are kept.
    pub parameters: &'a [Parameter],
    /// The truncation K asked for.
    pub truncation: usize,
}

impl Facts<'_> {
    /// The values that the input gives the parameters that are kept; NaN where it gives none.
    pub fn defaults(&self) -> Vec<f64> {
        let values =
            self.parameters.iter().flat_map(|parameter| parameter.default.iter().flatten());
        values.map(|value| value.to_f64().unwrap_or(f64::NAN)).collect()
    }
}

impl Problem {
    /// The facts of the system.
    pub fn facts(&self) -> Facts<'_> {
        let Self { name, algebra, coordinates, parameters, truncation, .. } = self;
        Facts { name, algebra, coordinates, parameters, truncation: *truncation }
    }
}

impl Smooth {
    /// The times at which steps end: those at which inputs jump or bend, and those that are named besides.
    pub fn breaks(&self) -> Vec<f64> {
        let of_inputs = self.signals.iter().flat_map(Signal::breaks);
        of_inputs.chain(&self.breaks).copied().collect()
    }

    /// The facts of the system.
    pub fn facts(&self) -> Facts<'_> {
        let Self { name, algebra, coordinates, parameters, truncation, .. } = self;
        Facts { name, algebra, coordinates, parameters, truncation: *truncation }
    }

    /// Adds kicks between flows; `None` if the parameters of the potential are not those of the Hamiltonian.
    pub fn with_kicks(mut self, kick: Kick, splitting: Splitting) -> Option<Self> {
        if kick.potential.parameters != self.parameters {
            return None;
        }
        self.symbols.extend(kick.potential.symbols.iter().cloned());
        // After the symbols comes the step size.
        let first = self.symbols.len() + 1;
        self.kicks = Some(Kicks { kick, first, splitting });
        Some(self)
    }

    /// This system with a drive, the symbols of which become its last ones.
    pub fn with_drive(mut self, drive: Drive) -> Self {
        let first = self.symbols.len();
        self.symbols.extend(drive.symbols.iter().cloned());
        self.drive = Some(Box::new(Drive { first, ..drive }));
        self
    }

    /// η and τ in a state, for these values of the symbols, by the entries of g's matrix, μ and ω = ∂H/∂μ; zeros without a drive.
    pub fn acting(
        &self,
        symbols: &[f64],
        time: f64,
        entries: &[f64],
        [mu, omega]: [&[f64]; 2],
    ) -> [Vec<f64>; 2] {
        let Some(drive) = &self.drive else { return [vec![0.0; mu.len()], vec![0.0; mu.len()]] };
        let inputs = drive.inputs(entries, [mu, omega], time, &self.signals);
        let mut velocity = drive.program.run(&inputs, symbols.get(drive.first..).unwrap_or(&[]));
        let mut torque = velocity.split_off(mu.len());
        torque.truncate(mu.len());
        for (sum, function) in [&mut velocity, &mut torque].into_iter().zip(&drive.functions) {
            let own = function.iter().flat_map(|function| function.0.acting(time, entries, mu));
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
        [velocity, torque]
    }

    /// The text of the first expression of the drive that is not defined there, and its argument.
    pub fn undefined_in_drive(
        &self,
        symbols: &[f64],
        time: f64,
        entries: &[f64],
        [mu, omega]: [&[f64]; 2],
    ) -> Option<(&str, f64)> {
        let drive = self.drive.as_ref()?;
        let inputs = drive.inputs(entries, [mu, omega], time, &self.signals);
        let watched = drive.watched.run(&inputs, symbols.get(drive.first..).unwrap_or(&[]));
        let (number, argument) = undefined(&watched)?;
        Some((&drive.expressions[number], argument))
    }

    /// True if a part of the system is a function of the user's, of which there are no programs.
    pub fn is_function(&self) -> bool {
        self.given.is_some() || self.drive.as_ref().is_some_and(|drive| drive.is_function())
    }

    /// True if H is known to be of degree at most two in the momentum.
    pub fn is_quadratic(&self) -> bool {
        if self.given.is_some() {
            return false;
        }
        let momentum: Vec<Argument> = (0..self.algebra.dim()).map(Argument::Input).collect();
        let bent = self.gradient.push_forward(&momentum).push_forward(&momentum);
        bent.outputs().iter().all(|id| bent.nodes()[id.index()] == Node::Zero)
    }

    /// The nodes of a step of collocation, (K + 1)/2: its order is twice their number.
    pub fn nodes(&self) -> usize {
        self.truncation.div_ceil(2)
    }

    /// True if the programs read the time or signals.
    pub fn depends_on_time(&self) -> bool {
        let driven = self.drive.as_ref().is_some_and(|drive| drive.moves);
        self.moves || driven || !self.signals.is_empty()
    }

    /// The values of the symbols for these of the parameters that are kept.
    pub fn symbols_at(&self, parameters: &[f64]) -> Vec<f64> {
        self.symbols.iter().map(|symbol| symbol.expr.evaluate(parameters)).collect()
    }

    /// The inputs of the programs at (t, μ).
    pub fn inputs(&self, time: f64, mu: &[f64]) -> Vec<f64> {
        signal::inputs(Vec::new(), mu, time, &self.signals)
    }

    /// H(t, μ) for these values of the symbols.
    pub fn energy(&self, symbols: &[f64], time: f64, mu: &[f64]) -> f64 {
        if let Some(Given(function)) = &self.given {
            return function.value(time, mu);
        }
        self.value.run(&self.inputs(time, mu), symbols).first().copied().unwrap_or(f64::NAN)
    }

    /// ∂H/∂μ(t, μ) for these values of the symbols.
    pub fn gradient(&self, symbols: &[f64], time: f64, mu: &[f64]) -> Vec<f64> {
        if let Some(Given(function)) = &self.given {
            return function.gradient(time, mu);
        }
        self.gradient.run(&self.inputs(time, mu), symbols)
    }

    /// ∂H/∂μ at these times, one after the other, for one momentum.
    pub fn gradients(&self, symbols: &[f64], times: &[f64], mu: &[f64]) -> Vec<f64> {
        if let Some(Given(function)) = &self.given {
            return times.iter().flat_map(|&time| function.gradient(time, mu)).collect();
        }
        let inputs: Vec<f64> = times.iter().flat_map(|&time| self.inputs(time, mu)).collect();
        let width = self.gradient.inputs();
        self.gradient.run_each(times.len(), |row, i| inputs[row * width + i], symbols)
    }

    /// The square of the [reach](Smooth::reach) from one (t, μ) to another; none of a function of the user's.
    pub fn reach(&self, symbols: &[f64], from: (f64, &[f64]), to: (f64, &[f64])) -> Option<f64> {
        let mut inputs = self.inputs(from.0, from.1);
        inputs.extend(self.inputs(to.0, to.1));
        self.reach.run(&inputs, symbols).first().copied()
    }

    /// The first expression that is not defined, or has no derivative, at (t, μ), by its number, and its argument there.
    pub fn undefined(&self, symbols: &[f64], time: f64, mu: &[f64]) -> Option<(usize, f64)> {
        undefined(&self.watched.run(&self.inputs(time, mu), symbols))
    }
}

/// A system as its Hamiltonian is.
#[derive(Clone, Debug)]
pub enum Hamiltonian {
    /// A polynomial, whose generating function is a series; where the input leaves the method open, also what steps by
    /// collocation are made of.
    Polynomial(Box<Problem>, Option<Box<Smooth>>),
    /// A smooth function, of the time too, whose steps are made by collocation.
    Smooth(Box<Smooth>),
}

impl From<Problem> for Hamiltonian {
    fn from(problem: Problem) -> Self {
        Self::Polynomial(Box::new(problem), None)
    }
}

impl From<Smooth> for Hamiltonian {
    fn from(smooth: Smooth) -> Self {
        Self::Smooth(Box::new(smooth))
    }
}

impl Hamiltonian {
    /// The facts of the system.
    pub fn facts(&self) -> Facts<'_> {
        match self {
            Self::Polynomial(problem, _) => problem.facts(),
            Self::Smooth(smooth) => smooth.facts(),
        }
    }

    /// True if it is known to be of degree at most two in the momentum.
    pub fn is_quadratic(&self) -> bool {
        match self {
            Self::Polynomial(problem, _) => problem.is_quadratic(),
            Self::Smooth(smooth) => smooth.is_quadratic(),
        }
    }

    /// The smooth function, where it is taken as one.
    pub fn smooth(&self) -> Option<&Smooth> {
        match self {
            Self::Polynomial(..) => None,
            Self::Smooth(smooth) => Some(smooth),
        }
    }

    /// The inputs u(t) that it reads.
    pub fn signals_mut(&mut self) -> &mut [Signal] {
        match self {
            Self::Polynomial(..) => &mut [],
            Self::Smooth(smooth) => &mut smooth.signals,
        }
    }

    /// The values of its symbols for those that the input gives the parameters.
    pub fn symbols(&self) -> Vec<f64> {
        match self {
            Self::Polynomial(problem, _) => problem.symbols_at(&self.facts().defaults()),
            Self::Smooth(smooth) => smooth.symbols_at(&self.facts().defaults()),
        }
    }

    /// Asks for another truncation.
    pub fn set_truncation(&mut self, truncation: usize) {
        match self {
            Self::Polynomial(problem, _) => problem.truncation = truncation,
            Self::Smooth(smooth) => smooth.truncation = truncation,
        }
    }

    /// Asks for a solver of the equation of a series; another Hamiltonian has its own.
    pub fn set_solver(&mut self, solver: Solver) {
        if let Self::Polynomial(problem, _) = self {
            problem.solver = Some(solver);
        }
    }

    /// The polynomial that it is.
    ///
    /// # Errors
    /// The smooth function, where it is taken as one.
    pub fn into_polynomial(self) -> Result<Problem, Box<Smooth>> {
        match self {
            Self::Polynomial(problem, _) => Ok(*problem),
            Self::Smooth(smooth) => Err(smooth),
        }
    }

    /// The polynomial, where it is one.
    pub fn polynomial(&self) -> Option<&Problem> {
        match self {
            Self::Polynomial(problem, _) => Some(problem),
            Self::Smooth(_) => None,
        }
    }
}
