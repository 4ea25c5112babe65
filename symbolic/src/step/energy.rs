//! The Hamiltonian of a system, evaluated at momenta.

use super::Origin;
use crate::graph::{Graph, Id, Program};
use crate::poly::Numeric;
use crate::problem::Problem;
use crate::smooth::{Hamiltonian, Smooth};

/// An energy as a function of the time and the momentum.
#[derive(Clone, Debug)]
pub enum Energy<'a> {
    /// A polynomial, and its derivatives by the coordinates of the momentum.
    Polynomial(Numeric, Vec<Numeric>),
    /// A smooth function, and the values of its symbols.
    Smooth(&'a Smooth, Vec<f64>),
}

impl<'a> Energy<'a> {
    /// A Hamiltonian, with the values that its input gives the parameters.
    pub fn new(hamiltonian: &'a Hamiltonian) -> Self {
        match hamiltonian {
            Hamiltonian::Polynomial(problem, _) => {
                Self::of(problem, &problem.symbols_at(&problem.facts().defaults()))
            }
            Hamiltonian::Smooth(smooth) => Self::smooth(smooth, &smooth.facts().defaults()),
        }
    }

    /// A polynomial with these values of its symbols.
    fn of(problem: &Problem, symbols: &[f64]) -> Self {
        let dim = problem.algebra.dim();
        let value = Numeric::new(&problem.hamiltonian, dim, symbols);
        let slopes = value.gradient(dim);
        Self::Polynomial(value, slopes)
    }

    /// A smooth function, for these values of the parameters that are kept.
    pub fn smooth(smooth: &'a Smooth, parameters: &[f64]) -> Self {
        Self::Smooth(smooth, smooth.symbols_at(parameters))
    }

    /// H(t, μ).
    pub fn value(&self, time: f64, mu: &[f64]) -> f64 {
        match self {
            Self::Polynomial(value, _) => value.value(mu),
            Self::Smooth(smooth, symbols) => smooth.energy(symbols, time, mu),
        }
    }

    /// ∂H/∂μ(t, μ).
    pub fn gradient(&self, time: f64, mu: &[f64]) -> Vec<f64> {
        match self {
            Self::Polynomial(_, slopes) => slopes.iter().map(|slope| slope.value(mu)).collect(),
            Self::Smooth(smooth, symbols) => smooth.gradient(symbols, time, mu),
        }
    }

    /// The expression that is not defined, or has no derivative, at (t, μ), and its argument there.
    pub fn undefined(&self, time: f64, mu: &[f64]) -> Option<(&str, f64)> {
        let Self::Smooth(smooth, symbols) = self else { return None };
        let (number, argument) = smooth.undefined(symbols, time, mu)?;
        Some((&smooth.expressions[number], argument))
    }

    /// The square of the farthest way that an argument of H's functions goes from one (t, μ) to another, as [`Smooth::reach`];
    /// none of a function of the user's, and of a polynomial.
    pub fn reach(&self, from: (f64, &[f64]), to: (f64, &[f64])) -> Option<f64> {
        let Self::Smooth(smooth, symbols) = self else { return None };
        smooth.reach(symbols, from, to)
    }

    /// The factor of a coordinate of a momentum where steps of collocation compare sizes; 1 of a polynomial.
    pub fn unit(&self, i: usize) -> f64 {
        match self {
            Self::Polynomial(..) => 1.0,
            Self::Smooth(smooth, _) => smooth.units[i],
        }
    }

    /// μ, then t and the signals where H is no polynomial, ↦ ∂H/∂μ; a smooth function has its symbols as slots. That of a
    /// polynomial is made coordinate by coordinate, which takes fewer operations than reverse mode.
    pub fn slope(&self) -> Program {
        let slopes = match self {
            Self::Polynomial(_, slopes) => slopes,
            Self::Smooth(smooth, _) => return smooth.gradient.clone(),
        };
        let graph = Graph::new();
        let mu: Vec<Id> = (0..slopes.len()).map(|i| graph.input(i)).collect();
        let outputs: Vec<Id> = slopes.iter().map(|slope| slope.node(&graph, &mu)).collect();
        graph.finish(slopes.len(), &outputs)
    }
}

impl Origin {
    /// The Hamiltonian, for these values of the parameters that are kept.
    pub fn energy(&self, parameters: &[f64]) -> Energy<'_> {
        match self {
            Self::Series(integrator) => {
                let problem = &integrator.problem;
                Energy::of(problem, &problem.symbols_at(parameters))
            }
            Self::Collocation(smooth) => Energy::smooth(smooth, parameters),
        }
    }
}
