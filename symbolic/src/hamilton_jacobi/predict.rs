//! The momentum p of the chart as a power series in t, from the exact flow.
//!
//! p solves J_L(∂S/∂p(p), p) = μ′. Along the exact flow from μ(0) = μ′, x(0) = 0,
//! μ̇ = ad*_ξ μ and ẋ = (d^L τ_x)⁻¹ ξ with ξ = ∂H/∂μ(μ(t)), and then p = (d^R τ_x)^T μ′. So p follows
//! without composing with S; it agrees with the solution for the truncated S through t^{K+1}.

use super::online::{Composition, Series, Work, adjoint, coadjoint, identity, reciprocal};
use super::recurrence::quadratic;
use super::{DeriveError, TermLimit};
use crate::lie::{Chart, CubicEntry, LieAlgebra, cubic};
use crate::number::{BernoulliWeights, Rational, ratio};
use crate::poly::Polynomial;
use num_traits::{One, Zero};

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
    let dimension = algebra.dim();
    let variables = hamiltonian.variables();
    if variables < dimension {
        return Err(DeriveError::Variables { variables, dimension });
    }
    let cubic = match chart {
        Chart::Exponential => Vec::new(),
        Chart::Cayley => cubic(algebra)?,
    };
    let mut work = Work::new(variables, limit);
    let mut gradient = Composition::new(dimension, &hamiltonian.gradient(dimension))?;
    let mut mu = identity(dimension, variables);
    let mut xi: Vec<Series> = vec![Vec::new(); dimension];
    let mut x = vec![vec![Polynomial::zero(variables)]; dimension];
    let mut velocity = Velocity::new(dimension, variables);
    for order in 0..degree {
        work.order = order + 1;
        gradient.extend(&mut work, &mu, order)?;
        for (i, series) in xi.iter_mut().enumerate() {
            series.push(gradient.coefficient(i, order).clone());
        }
        let rate = velocity.extend(&mut work, algebra, chart, &cubic, &x, &xi, order)?;
        let turn = coadjoint(&mut work, algebra, &xi, &mu, order)?;
        let factor = reciprocal(order + 1);
        for i in 0..dimension {
            x[i].push(rate[i].scale(&factor));
            mu[i].push(turn[i].scale(&factor));
        }
    }
    let start = identity(dimension, variables);
    match chart {
        Chart::Exponential => right_exponential(&mut work, algebra, &x, &start, degree),
        Chart::Cayley => right_cayley(&mut work, algebra, &cubic, &x, degree),
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

/// Σ_k (ad_x^T)^k μ′ / (k+1)!.
fn right_exponential(
    work: &mut Work,
    algebra: &LieAlgebra,
    x: &[Series],
    start: &[Series],
    degree: usize,
) -> Result<Vec<Vec<Polynomial>>, DeriveError> {
    let one = Polynomial::constant(work.variables, Rational::one());
    let mut rows: Vec<Vec<Polynomial>> = Vec::new();
    // (ad_x^T)^k μ′ for k ≥ 1; x has no constant term, so power k begins at order k.
    let mut powers: Vec<Vec<Series>> = Vec::new();
    for order in 0..=degree {
        work.order = order;
        let mut row: Vec<Polynomial> = start
            .iter()
            .map(|s| s.get(order).cloned().unwrap_or_else(|| Polynomial::zero(work.variables)))
            .collect();
        if order > 0 {
            let zeros = vec![Polynomial::zero(work.variables); order];
            powers.push(vec![zeros; start.len()]);
        }
        let mut factor = Rational::one();
        for k in 1..=order {
            factor *= reciprocal(k + 1);
            let below = if k == 1 { start } else { &powers[k - 2] };
            let next = coadjoint(work, algebra, x, below, order)?;
            for (i, coefficient) in next.into_iter().enumerate() {
                row[i] = work.sum(&[
                    (Rational::one(), &row[i], &one),
                    (factor.clone(), &coefficient, &one),
                ])?;
                powers[k - 1][i].push(coefficient);
            }
        }
        rows.push(row);
    }
    Ok(rows)
}

/// p from J_L = p − ½ ad_x^T p − ¼ ⟨p, x·x⟩ = μ′, order by order.
fn right_cayley(
    work: &mut Work,
    algebra: &LieAlgebra,
    cubic: &[CubicEntry],
    x: &[Series],
    degree: usize,
) -> Result<Vec<Vec<Polynomial>>, DeriveError> {
    let dimension = algebra.dim();
    let mut p = identity(dimension, work.variables);
    let mut result: Vec<Vec<Polynomial>> = vec![p.iter().map(|s| s[0].clone()).collect()];
    let one = Polynomial::constant(work.variables, Rational::one());
    for order in 1..=degree {
        let linear = coadjoint(work, algebra, x, &p, order)?;
        let square = quadratic(work, dimension, work.variables, cubic, x, &p, order)?;
        let mut row = Vec::with_capacity(dimension);
        for i in 0..dimension {
            let value =
                work.sum(&[(ratio(1, 2), &linear[i], &one), (ratio(1, 4), &square[i], &one)])?;
            p[i].push(value.clone());
            row.push(value);
        }
        result.push(row);
    }
    Ok(result)
}
