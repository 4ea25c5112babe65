//! Exact polynomials as numbers, and the energy.

use coadjoint::Phase;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::potential::Potential;
use coadjoint_codegen::problem::{Problem, Symbol};
use num_traits::ToPrimitive;

use super::Group;

/// Σ c · ∏ x_i^power over (c, [(i, power)]).
#[derive(Clone, Debug)]
pub struct FloatPolynomial(Vec<(f64, Vec<(usize, i32)>)>);

impl FloatPolynomial {
    /// `polynomial` in its first `variables` variables, with numbers for the symbols after them.
    pub fn new(polynomial: &Polynomial, variables: usize, symbols: &[Symbol]) -> Self {
        // Parameters are substituted; what symbols are left (sqrt(2)) need none.
        let symbols: Vec<f64> = symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect();
        let term = |(factors, value): (Vec<(u32, u32)>, Rational)| {
            let (own, of_symbols): (Vec<_>, Vec<_>) =
                factors.into_iter().partition(|&(i, _)| (i as usize) < variables);
            let symbol =
                |&(i, power): &(u32, u32)| symbols[i as usize - variables].powi(power as i32);
            let scale: f64 = of_symbols.iter().map(symbol).product();
            let factors = own.into_iter().map(|(i, power)| (i as usize, power as i32)).collect();
            (scale * value.to_f64().unwrap_or(f64::NAN), factors)
        };
        Self(polynomial.factors().map(term).collect())
    }

    /// The value at x.
    pub fn evaluate(&self, x: &[f64]) -> f64 {
        self.terms(x).sum()
    }

    /// The sum of the absolute values of the terms: what rounding and drift of the value are
    /// measured against, which may itself be zero.
    pub fn magnitude(&self, x: &[f64]) -> f64 {
        self.terms(x).map(f64::abs).sum()
    }

    fn terms<'a>(&'a self, x: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.0.iter().map(|(value, factors)| {
            value * factors.iter().map(|&(i, power)| x[i].powi(power)).product::<f64>()
        })
    }
}

/// H_red(μ), plus V(g) where there is a potential.
#[derive(Clone, Debug)]
pub struct Energy {
    hamiltonian: FloatPolynomial,
    potential: Option<FloatPolynomial>,
}

impl Energy {
    /// The energy of a system.
    pub fn new(problem: &Problem, potential: Option<&Potential>) -> Self {
        let dim = problem.algebra.dim();
        Self {
            hamiltonian: FloatPolynomial::new(&problem.hamiltonian, dim, &problem.symbols),
            potential: potential
                .map(|v| FloatPolynomial::new(&v.energy, v.size() * v.size(), &v.symbols)),
        }
    }

    /// The energy.
    pub fn value<G: Group>(&self, group: &G, phase: &Phase<G>) -> f64 {
        self.sum(group, phase, FloatPolynomial::evaluate)
    }

    /// The energy of a system without a potential.
    pub fn kinetic(&self, mu: &[f64]) -> f64 {
        self.hamiltonian.evaluate(mu)
    }

    /// The sum of the absolute values of its terms.
    pub fn magnitude<G: Group>(&self, group: &G, phase: &Phase<G>) -> f64 {
        self.sum(group, phase, FloatPolynomial::magnitude)
    }

    fn sum<G: Group>(
        &self,
        group: &G,
        phase: &Phase<G>,
        of: impl Fn(&FloatPolynomial, &[f64]) -> f64,
    ) -> f64 {
        let kinetic = of(&self.hamiltonian, phase.momentum.as_slice());
        let Some(potential) = &self.potential else { return kinetic };
        let size = group.matrix_size();
        let entry = |at: usize| group.matrix_entry(&phase.group_element, at / size, at % size);
        let entries: Vec<f64> = (0..size * size).map(entry).collect();
        kinetic + of(potential, &entries)
    }
}
