//! A Lie–Poisson system whose Hamiltonian is no polynomial, or moves in time: programs, for steps that need its gradient alone.

use coadjoint_program::Program;

use crate::lie::LieAlgebra;
use crate::problem::{Parameter, Problem, Symbol};

/// A smooth Hamiltonian H(t, μ) on the dual of a Lie algebra, as straight-line programs.
///
/// The programs have n + 1 inputs, the coordinates of the momentum and the time t, and a slot for each of the symbols.
#[derive(Clone, Debug)]
pub struct Smooth {
    /// The name of the system.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: LieAlgebra,
    /// The names of the momentum's coordinates, dual to the basis of 𝔤.
    pub coordinates: Vec<String>,
    /// Whether H depends on the time.
    pub moves: bool,
    /// H.
    pub value: Program,
    /// ∂H/∂μ, n outputs.
    pub gradient: Program,
    /// For each of the expressions watched two outputs: its argument, and a number that is finite where the expression
    /// is differentiable in it.
    pub watched: Program,
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
}

impl Smooth {
    /// The nodes of a step of collocation, (K + 1)/2: its order is twice their number.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.truncation.div_ceil(2)
    }

    /// The inputs of the programs at (t, μ).
    fn inputs(time: f64, mu: &[f64]) -> Vec<f64> {
        let mut inputs = mu.to_vec();
        inputs.push(time);
        inputs
    }

    /// H(t, μ) for these values of the symbols.
    #[must_use]
    pub fn energy(&self, symbols: &[f64], time: f64, mu: &[f64]) -> f64 {
        self.value.run(&Self::inputs(time, mu), symbols).first().copied().unwrap_or(f64::NAN)
    }

    /// ∂H/∂μ(t, μ) for these values of the symbols.
    #[must_use]
    pub fn gradient(&self, symbols: &[f64], time: f64, mu: &[f64]) -> Vec<f64> {
        self.gradient.run(&Self::inputs(time, mu), symbols)
    }

    /// The first expression that is not defined, or has no derivative, at (t, μ), by its number, and its argument there.
    #[must_use]
    pub fn undefined(&self, symbols: &[f64], time: f64, mu: &[f64]) -> Option<(usize, f64)> {
        let values = self.watched.run(&Self::inputs(time, mu), symbols);
        let (pairs, _) = values.as_chunks::<2>();
        let found =
            pairs.iter().position(|[argument, test]| argument.is_finite() && !test.is_finite())?;
        Some((found, pairs[found][0]))
    }
}

/// A system as its Hamiltonian is.
#[derive(Clone, Debug)]
pub enum Hamiltonian {
    /// A polynomial, whose generating function is a series.
    Polynomial(Box<Problem>),
    /// A smooth function, of the time too, whose steps are made by collocation.
    Smooth(Box<Smooth>),
}

impl Hamiltonian {
    /// The truncation K asked for.
    #[must_use]
    pub fn truncation(&self) -> usize {
        match self {
            Self::Polynomial(problem) => problem.truncation,
            Self::Smooth(smooth) => smooth.truncation,
        }
    }
}
