//! The recurrence k S_k = [t^{k−1}] H(J_R(Σ t^i ∂S_i/∂p, p)), where [t^m] takes the coefficient of t^m.

use super::online::{
    Composition, Numbers, Series, Work, coadjoint, convolve, identity, reciprocal,
};
use super::{DeriveError, TermLimit};
use crate::lie::{Chart, CubicEntry, LieAlgebra, cubic};
use crate::number::{BernoulliWeights, Rational, ratio};
use crate::poly::Polynomial;
use num_traits::{One, Zero};

/// The truncated series S = S_1 t + … + S_K t^K of a generating function, with exact coefficients.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeneratingSeries {
    dimension: usize,
    chart: Chart,
    orders: Vec<Polynomial>,
}

impl GeneratingSeries {
    /// The dimension of the algebra; the first `dim` variables of every S_k are the momenta p.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.dimension
    }

    /// The chart in which S generates the flow.
    #[must_use]
    pub fn chart(&self) -> Chart {
        self.chart
    }

    /// The truncation K.
    #[must_use]
    pub fn truncation(&self) -> usize {
        self.orders.len() - 1
    }

    /// S_k as a polynomial in p and the symbols, for k from 1 to K; zero for any other k.
    #[must_use]
    pub fn order(&self, k: usize) -> &Polynomial {
        self.orders.get(k).unwrap_or(&self.orders[0])
    }
}

/// Derives S_1, …, S_K for a Hamiltonian whose first `dim` variables are the momenta and whose
/// other variables are opaque symbols.
///
/// S is odd in t, so the even orders are not computed.
///
/// # Errors
/// If the chart does not exist, the Hamiltonian has too few variables, or a limit is exceeded.
pub fn derive(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    truncation: usize,
    limit: TermLimit,
) -> Result<GeneratingSeries, DeriveError> {
    derive_orders(algebra, chart, hamiltonian, truncation, limit, true)
}

pub(super) fn derive_orders(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    truncation: usize,
    limit: TermLimit,
    odd_only: bool,
) -> Result<GeneratingSeries, DeriveError> {
    let dimension = algebra.dim();
    let variables = hamiltonian.variables();
    if variables < dimension {
        return Err(DeriveError::Variables { variables, dimension });
    }
    let mut work = Work::new(variables, Numbers::Rational, limit);
    let mut momentum = BodyMomentum::new(algebra, chart, variables)?;
    let mut energy = Composition::new(dimension, std::slice::from_ref(hamiltonian))?;
    let zero = Polynomial::zero(variables);
    let mut orders = vec![zero.clone()];
    for k in 1..=truncation {
        work.order = k;
        momentum.extend(&mut work, k - 1)?;
        energy.extend(&mut work, &momentum.value, k - 1)?;
        if k % 2 == 0 && odd_only {
            orders.push(zero.clone());
        } else {
            orders.push(energy.coefficient(0, k - 1).scale(&reciprocal(k)));
        }
        for (x, derivative) in momentum.x.iter_mut().zip(orders[k].gradient(dimension)) {
            x.push(derivative);
        }
    }
    Ok(GeneratingSeries { dimension, chart, orders })
}

/// J_R(x(t), p), coefficient by coefficient, for a series x(t) without constant term.
pub(super) struct BodyMomentum<'a> {
    algebra: &'a LieAlgebra,
    variables: usize,
    /// The series x(t), which the caller extends.
    pub(super) x: Vec<Series>,
    /// The momenta p(t), known in advance.
    p: Vec<Series>,
    /// The series J_R(x(t), p), as far as it is known.
    pub(super) value: Vec<Series>,
    form: Form,
}

enum Form {
    /// The weights (−1)^k B_k/k! and the powers (ad_x^T)^j p, j ≥ 1.
    Exponential { weights: BernoulliWeights, powers: Vec<Vec<Series>> },
    /// x ξ x in the basis, and the products x_a x_c.
    Cayley { cubic: Vec<CubicEntry> },
}

impl<'a> BodyMomentum<'a> {
    pub(super) fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        variables: usize,
    ) -> Result<Self, DeriveError> {
        let p = identity(algebra.dim(), variables);
        Self::at(algebra, chart, p, variables)
    }

    /// As [`new`](Self::new), at a given series p(t).
    pub(super) fn at(
        algebra: &'a LieAlgebra,
        chart: Chart,
        p: Vec<Series>,
        variables: usize,
    ) -> Result<Self, DeriveError> {
        let dimension = algebra.dim();
        let form = match chart {
            Chart::Exponential => {
                Form::Exponential { weights: BernoulliWeights::default(), powers: Vec::new() }
            }
            Chart::Cayley => Form::Cayley { cubic: cubic(algebra)? },
        };
        let x = vec![vec![Polynomial::zero(variables)]; dimension];
        Ok(Self { algebra, variables, x, p, value: vec![Vec::new(); dimension], form })
    }

    /// Computes the coefficient of t^`order`; x must be known through that order.
    pub(super) fn extend(&mut self, work: &mut Work, order: usize) -> Result<(), DeriveError> {
        let one = Polynomial::constant(self.variables, Rational::one());
        let dimension = self.algebra.dim();
        let mut result: Vec<Polynomial> = (0..dimension)
            .map(|i| {
                let p = self.p[i].get(order).cloned();
                p.unwrap_or_else(|| Polynomial::zero(self.variables))
            })
            .collect();
        match &mut self.form {
            Form::Exponential { weights, powers } => {
                if order > 0 {
                    // A new power begins at this order; below it is zero.
                    powers.push(vec![vec![Polynomial::zero(self.variables); order]; dimension]);
                }
                for j in 1..=order {
                    let below = if j == 1 { &self.p } else { &powers[j - 2] };
                    let next = coadjoint(work, self.algebra, &self.x, below, order)?;
                    let weight = weights.get(j);
                    for (i, coefficient) in next.into_iter().enumerate() {
                        if !weight.is_zero() {
                            result[i] = work.sum(&[
                                (Rational::one(), &result[i], &one),
                                (weight.clone(), &coefficient, &one),
                            ])?;
                        }
                        powers[j - 1][i].push(coefficient);
                    }
                }
            }
            Form::Cayley { cubic } => {
                let linear = coadjoint(work, self.algebra, &self.x, &self.p, order)?;
                let quadratic =
                    quadratic(work, dimension, self.variables, cubic, &self.x, &self.p, order)?;
                for i in 0..dimension {
                    result[i] = work.sum(&[
                        (Rational::one(), &result[i], &one),
                        (ratio(1, 2), &linear[i], &one),
                        (ratio(-1, 4), &quadratic[i], &one),
                    ])?;
                }
            }
        }
        for (series, coefficient) in self.value.iter_mut().zip(result) {
            series.push(coefficient);
        }
        Ok(())
    }
}

/// The coefficient of t^`order` of ξ ↦ ⟨w, xξx⟩.
pub(super) fn quadratic(
    work: &mut Work,
    dimension: usize,
    variables: usize,
    cubic: &[CubicEntry],
    x: &[Series],
    w: &[Series],
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    let mut result = vec![Polynomial::zero(variables); dimension];
    let one = Polynomial::constant(variables, Rational::one());
    for entry in cubic {
        for i in 0..=order {
            let Some(momentum) = w[entry.result].get(order - i) else { continue };
            if momentum.is_zero() {
                continue;
            }
            let mut list = Vec::new();
            convolve(&mut list, &entry.value, &x[entry.first], &x[entry.second], i);
            let square = work.sum(&list)?;
            result[entry.argument] = work.sum(&[
                (Rational::one(), &result[entry.argument], &one),
                (Rational::one(), &square, momentum),
            ])?;
        }
    }
    Ok(result)
}
