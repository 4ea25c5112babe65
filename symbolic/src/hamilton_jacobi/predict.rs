//! The momentum p of the chart as a power series in t, from the exact flow.
//!
//! p solves J_L(∂S/∂p(p), p) = μ′. Along the exact flow from μ(0) = μ′, x(0) = 0,
//! μ̇ = ad*_ξ μ and ẋ = (d^L τ_x)⁻¹ ξ with ξ = ∂H/∂μ(μ(t)), and then p = (d^R τ_x)^T μ′. So p follows
//! without composing with S; it agrees with the solution for the truncated S through t^{K+1}.

use super::online::{Composition, Numbers, Series, Work, adjoint, coadjoint, identity, reciprocal};
use super::recurrence::quadratic;
use super::{DeriveError, TermLimit};
use crate::lie::{Chart, CubicEntry, LieAlgebra, cubic};
use crate::number::{BernoulliWeights, Rational, ratio};
use crate::poly::{Factors, Polynomial, split_at};
use num_traits::{One, Zero};
use std::collections::HashSet;

/// Derives the solution p = Σ_m h^m p_m(μ′) of J_L(∂S/∂p(p), p) = μ′ as a power series in the step h. The result
/// is indexed by the order m, from 0 to `degree`, then by the component of p; the variables are those of
/// `hamiltonian`, with μ′ in place of the momenta.
///
/// # Errors
/// If the chart does not exist, the Hamiltonian has too few variables, or a limit is exceeded.
pub fn predictor(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    degree: usize,
    limit: TermLimit,
) -> Result<Vec<Vec<Polynomial>>, DeriveError> {
    let mut rows = Rows::new(algebra, chart, hamiltonian, Numbers::Rational, limit)?;
    (0..=degree).map(|_| rows.next_row()).collect()
}

/// The number of monomials of μ′ in all components of a [`predictor`], degree by degree. The polynomials are
/// expanded modulo a prime, so that no exact coefficient is computed.
pub(crate) struct PredictorSize<'a> {
    rows: Rows<'a>,
    monomials: HashSet<(usize, Factors)>,
}

impl<'a> PredictorSize<'a> {
    /// # Errors
    /// As [`predictor`].
    pub(crate) fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        hamiltonian: &Polynomial,
        limit: TermLimit,
    ) -> Result<Self, DeriveError> {
        let rows = Rows::new(algebra, chart, hamiltonian, Numbers::Modular, limit)?;
        Ok(Self { rows, monomials: HashSet::new() })
    }

    /// The number up to the next degree, which is 0 at the first call; counting stops beyond `most`.
    ///
    /// # Errors
    /// As [`predictor`].
    pub(crate) fn next_degree(&mut self, most: usize) -> Result<usize, DeriveError> {
        let row = self.rows.next_row()?;
        let dimension = self.rows.algebra.dim();
        let terms = row.iter().enumerate().flat_map(|(i, p)| p.factors().map(move |(f, _)| (i, f)));
        for (component, factors) in terms {
            self.monomials.insert((component, Factors(split_at(&factors, dimension).0.into())));
            if self.monomials.len() > most {
                break;
            }
        }
        Ok(self.monomials.len())
    }
}

/// The rows p₀, p₁, … of a predictor, computed one after the other.
struct Rows<'a> {
    algebra: &'a LieAlgebra,
    chart: Chart,
    cubic: Vec<CubicEntry>,
    work: Work,
    gradient: Composition,
    velocity: Velocity,
    mu: Vec<Series>,
    xi: Vec<Series>,
    x: Vec<Series>,
    /// The rows so far, by component.
    p: Vec<Series>,
    /// (ad_x^T)^k μ′ for k ≥ 1, in the exponential chart; x has no constant term, so power k begins at order k.
    powers: Vec<Vec<Series>>,
    order: usize,
}

impl<'a> Rows<'a> {
    fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        hamiltonian: &Polynomial,
        numbers: Numbers,
        limit: TermLimit,
    ) -> Result<Self, DeriveError> {
        let dimension = algebra.dim();
        let variables = hamiltonian.variables();
        if variables < dimension {
            return Err(DeriveError::Variables { variables, dimension });
        }
        let cubic = match chart {
            Chart::Exponential => Vec::new(),
            Chart::Cayley => cubic(algebra)?,
        };
        let gradient = numbers.reduce(hamiltonian.clone()).gradient(dimension);
        Ok(Self {
            algebra,
            chart,
            cubic,
            work: Work::new(variables, numbers, limit),
            gradient: Composition::new(dimension, &gradient)?,
            velocity: Velocity::new(dimension, variables),
            mu: identity(dimension, variables),
            xi: vec![Vec::new(); dimension],
            x: vec![vec![Polynomial::zero(variables)]; dimension],
            p: identity(dimension, variables),
            powers: Vec::new(),
            order: 0,
        })
    }

    fn next_row(&mut self) -> Result<Vec<Polynomial>, DeriveError> {
        let order = self.order;
        self.order += 1;
        if order > 0 {
            self.extend_flow(order)?;
            let row = match self.chart {
                Chart::Exponential => self.exponential(order)?,
                Chart::Cayley => self.cayley(order)?,
            };
            for (series, coefficient) in self.p.iter_mut().zip(row) {
                series.push(coefficient);
            }
        }
        Ok(self.p.iter().map(|series| series[order].clone()).collect())
    }

    /// The coefficients of t^`order` of x and μ.
    fn extend_flow(&mut self, order: usize) -> Result<(), DeriveError> {
        let Self { algebra, chart, cubic, work, gradient, velocity, mu, xi, x, .. } = self;
        work.order = order;
        gradient.extend(work, mu, order - 1)?;
        for (i, series) in xi.iter_mut().enumerate() {
            series.push(gradient.coefficient(i, order - 1).clone());
        }
        let rate = velocity.extend(work, algebra, *chart, cubic, x, xi, order - 1)?;
        let turn = coadjoint(work, algebra, xi, mu, order - 1)?;
        let factor = reciprocal(order);
        for i in 0..algebra.dim() {
            x[i].push(work.scale(&rate[i], &factor));
            mu[i].push(work.scale(&turn[i], &factor));
        }
        Ok(())
    }

    /// Σ_k (ad_x^T)^k μ′ / (k+1)!.
    fn exponential(&mut self, order: usize) -> Result<Vec<Polynomial>, DeriveError> {
        let Self { algebra, work, x, p, powers, .. } = self;
        let one = Polynomial::constant(work.variables, Rational::one());
        let zero = Polynomial::zero(work.variables);
        let start: Vec<Series> = p.iter().map(|series| vec![series[0].clone()]).collect();
        let mut row = vec![zero.clone(); start.len()];
        powers.push(vec![vec![zero; order]; start.len()]);
        let mut factor = Rational::one();
        for k in 1..=order {
            factor *= reciprocal(k + 1);
            let below = if k == 1 { &start } else { &powers[k - 2] };
            let next = coadjoint(work, algebra, x, below, order)?;
            for (i, coefficient) in next.into_iter().enumerate() {
                row[i] = work.sum(&[
                    (Rational::one(), &row[i], &one),
                    (factor.clone(), &coefficient, &one),
                ])?;
                powers[k - 1][i].push(coefficient);
            }
        }
        Ok(row)
    }

    /// p from J_L = p − ½ ad_x^T p − ¼ ⟨p, x·x⟩ = μ′, order by order.
    fn cayley(&mut self, order: usize) -> Result<Vec<Polynomial>, DeriveError> {
        let Self { algebra, cubic, work, x, p, .. } = self;
        let (dimension, variables) = (algebra.dim(), work.variables);
        let one = Polynomial::constant(variables, Rational::one());
        let linear = coadjoint(work, algebra, x, p, order)?;
        let square = quadratic(work, dimension, variables, cubic, x, p, order)?;
        let value = |(linear, square)| {
            work.sum(&[(ratio(1, 2), linear, &one), (ratio(1, 4), square, &one)])
        };
        linear.iter().zip(&square).map(value).collect()
    }
}

/// The series of ẋ = (d^L τ_x)⁻¹ ξ, coefficient by coefficient.
struct Velocity {
    variables: usize,
    dimension: usize,
    weights: BernoulliWeights,
    /// ad_x^j ξ for j ≥ 1.
    powers: Vec<Vec<Series>>,
}

impl Velocity {
    fn new(dimension: usize, variables: usize) -> Self {
        Self { variables, weights: BernoulliWeights::default(), dimension, powers: Vec::new() }
    }

    #[allow(clippy::too_many_arguments)]
    fn extend(
        &mut self,
        work: &mut Work,
        algebra: &LieAlgebra,
        chart: Chart,
        cubic: &[CubicEntry],
        x: &[Series],
        xi: &[Series],
        order: usize,
    ) -> Result<Vec<Polynomial>, DeriveError> {
        let one = Polynomial::constant(self.variables, Rational::one());
        let mut result: Vec<Polynomial> = xi.iter().map(|s| s[order].clone()).collect();
        if chart == Chart::Cayley {
            let linear = adjoint(work, algebra, x, xi, order)?;
            let square = sandwich(work, algebra.dim(), self.variables, cubic, x, xi, order)?;
            for i in 0..result.len() {
                result[i] = work.sum(&[
                    (Rational::one(), &result[i], &one),
                    (ratio(1, 2), &linear[i], &one),
                    (ratio(-1, 4), &square[i], &one),
                ])?;
            }
            return Ok(result);
        }
        if order > 0 {
            // A new power begins at this order; below it is zero.
            let zeros = vec![Polynomial::zero(self.variables); order];
            self.powers.push(vec![zeros; self.dimension]);
        }
        for j in 1..=order {
            let next = {
                let below = if j == 1 { xi } else { &self.powers[j - 2] };
                adjoint(work, algebra, x, below, order)?
            };
            let weight = self.weights.get(j);
            for (i, coefficient) in next.into_iter().enumerate() {
                if !weight.is_zero() {
                    result[i] = work.sum(&[
                        (Rational::one(), &result[i], &one),
                        (weight.clone(), &coefficient, &one),
                    ])?;
                }
                self.powers[j - 1][i].push(coefficient);
            }
        }
        Ok(result)
    }
}

/// The coefficient of t^`order` of xξx.
fn sandwich(
    work: &mut Work,
    dimension: usize,
    variables: usize,
    cubic: &[CubicEntry],
    x: &[Series],
    xi: &[Series],
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    // The same trilinear form, read with argument and result exchanged.
    let turned: Vec<CubicEntry> = cubic
        .iter()
        .map(|e| CubicEntry { argument: e.result, result: e.argument, ..e.clone() })
        .collect();
    quadratic(work, dimension, variables, &turned, x, xi, order)
}
