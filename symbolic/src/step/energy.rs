//! The Hamiltonian of a system, evaluated at momenta.

use crate::poly::Numeric;
use crate::problem::{Problem, values};
use crate::smooth::{Hamiltonian, Smooth};

/// An energy as a function of the momentum.
#[derive(Clone, Debug)]
pub enum Energy {
    /// A polynomial.
    Polynomial(Numeric),
    /// A smooth function, and the values of its symbols.
    Smooth(Box<Smooth>, Vec<f64>),
}

impl Energy {
    /// A Hamiltonian; a smooth one with the values that its input gives the parameters.
    pub fn new(hamiltonian: &Hamiltonian) -> Self {
        match hamiltonian {
            Hamiltonian::Polynomial(problem, _) => {
                let Problem { hamiltonian, algebra, symbols, .. } = &**problem;
                Self::Polynomial(Numeric::new(hamiltonian, algebra.dim(), &values(symbols)))
            }
            Hamiltonian::Smooth(smooth) => {
                Self::Smooth(smooth.clone(), smooth.symbols_at(&smooth.facts().defaults()))
            }
        }
    }

    /// H(t, μ).
    pub fn value(&self, time: f64, mu: &[f64]) -> f64 {
        match self {
            Self::Polynomial(polynomial) => polynomial.value(mu),
            Self::Smooth(smooth, symbols) => smooth.energy(symbols, time, mu),
        }
    }

    /// The expression that is not defined, or has no derivative, at (t, μ), and its argument there.
    pub fn undefined(&self, time: f64, mu: &[f64]) -> Option<(&str, f64)> {
        let Self::Smooth(smooth, symbols) = self else { return None };
        let (number, argument) = smooth.undefined(symbols, time, mu)?;
        Some((&smooth.expressions[number], argument))
    }

    /// ∂H/∂μ in `dim` coordinates.
    pub fn gradient(&self, dim: usize) -> Slopes<'_> {
        match self {
            Self::Polynomial(polynomial) => {
                let slopes = polynomial.gradient(dim);
                Box::new(move |_, mu| slopes.iter().map(|slope| slope.value(mu)).collect())
            }
            Self::Smooth(smooth, symbols) => {
                Box::new(|time, mu| smooth.gradient(symbols, time, mu))
            }
        }
    }
}

/// t, μ ↦ ∂H/∂μ(t, μ).
pub type Slopes<'a> = Box<dyn Fn(f64, &[f64]) -> Vec<f64> + 'a>;
