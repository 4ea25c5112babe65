//! The momentum p of the chart as a power series in t, from the exact flow.
//!
//! p solves J_L(∂S/∂p(p), p) = μ′. Along the exact flow from μ(0) = μ′, x(0) = 0,
//! μ̇ = ad*_ξ μ and ẋ = (d^L τ_x)⁻¹ ξ with ξ = ∂H/∂μ(μ(t)), and then p = (d^R τ_x)^T μ′. So p follows
//! without composing with S; it agrees with the solution for the truncated S through t^{K+1}.

use super::{DeriveError, TermLimit};
use crate::hamilton_jacobi::chart::{
    Composition, Inverse, Powers, Series, Side, Work, bilinear, identity, reciprocal, sandwich,
};
use crate::lie::{Chart, CubicEntry, LieAlgebra, cubic};
use crate::number::{Rational, ratio};
use crate::poly::{Arithmetic, Polynomial};
use num_traits::One;

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
    let mut rows = PredictorRows::new(algebra, chart, hamiltonian, limit, Arithmetic::Exact)?;
    (0..=degree).map(|_| rows.next_row()).collect()
}

/// The rows p₀, p₁, … of a predictor, computed one after the other.
pub(crate) struct PredictorRows<'a> {
    algebra: &'a LieAlgebra,
    work: Work,
    gradient: Composition,
    velocity: Inverse<'a>,
    mu: Vec<Series>,
    xi: Vec<Series>,
    x: Vec<Series>,
    /// The rows so far, by component.
    p: Vec<Series>,
    pull_back: PullBack<'a>,
    order: usize,
}

/// p = (d^R τ_x)^T μ′.
enum PullBack<'a> {
    /// Σ_k (ad_x^T)^k μ′ / (k+1)!.
    Exponential(Powers<'a>),
    /// The solution of J_L = p − ½ ad_x^T p − ¼ ⟨p, x·x⟩ = μ′, order by order.
    Cayley(Vec<CubicEntry>),
}

impl<'a> PredictorRows<'a> {
    /// # Errors
    /// As [`predictor`].
    pub(crate) fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        hamiltonian: &Polynomial,
        limit: TermLimit,
        arithmetic: Arithmetic,
    ) -> Result<Self, DeriveError> {
        let dimension = algebra.dim();
        let variables = hamiltonian.variables();
        let gradient = hamiltonian.gradient(dimension);
        Ok(Self {
            algebra,
            work: Work::on(hamiltonian, dimension, limit, arithmetic)?,
            gradient: Composition::new(dimension, &gradient)?,
            velocity: Inverse::new(algebra, chart, Side::Algebra)?,
            mu: identity(dimension, variables),
            xi: vec![Vec::new(); dimension],
            x: vec![vec![Polynomial::zero(variables)]; dimension],
            p: identity(dimension, variables),
            pull_back: match chart {
                Chart::Exponential => PullBack::Exponential(Powers::new(algebra, Side::Dual)),
                Chart::Cayley => PullBack::Cayley(cubic(algebra)?),
            },
            order: 0,
        })
    }

    /// # Errors
    /// As [`predictor`].
    pub(crate) fn next_row(&mut self) -> Result<Vec<Polynomial>, DeriveError> {
        let order = self.order;
        self.order += 1;
        if order > 0 {
            self.extend_flow(order)?;
            let row = self.pull_back(order)?;
            self.p.iter_mut().zip(row).for_each(|(series, next)| series.push(next));
        }
        Ok(self.p.iter().map(|series| series[order].clone()).collect())
    }

    /// The coefficients of t^`order` of x and μ.
    fn extend_flow(&mut self, order: usize) -> Result<(), DeriveError> {
        let Self { algebra, work, gradient, velocity, mu, xi, x, .. } = self;
        work.order = order;
        gradient.extend(work, mu, order - 1)?;
        for (i, series) in xi.iter_mut().enumerate() {
            series.push(gradient.coefficient(i, order - 1).clone());
        }
        let rate = velocity.extend(work, (x, xi), order - 1)?;
        let turn = bilinear(work, algebra, Side::Dual, (xi, mu), order - 1)?;
        let factor = reciprocal(order);
        for i in 0..algebra.dim() {
            x[i].push(rate[i].scale(&factor));
            mu[i].push(turn[i].scale(&factor));
        }
        Ok(())
    }

    /// The coefficient of t^`order` of p.
    fn pull_back(&mut self, order: usize) -> Result<Vec<Polynomial>, DeriveError> {
        let Self { algebra, work, x, p, pull_back, .. } = self;
        match pull_back {
            PullBack::Exponential(powers) => {
                let start: Vec<Series> = p.iter().map(|series| vec![series[0].clone()]).collect();
                let mut factor = Rational::one();
                let weight = |k: usize| {
                    factor *= reciprocal(k + 1);
                    factor.clone()
                };
                powers.extend(work, (x, &start), order, weight)
            }
            PullBack::Cayley(cubic) => {
                let one = Polynomial::constant(work.variables, Rational::one());
                let linear = bilinear(work, algebra, Side::Dual, (x, p), order)?;
                let square = sandwich(work, cubic, Side::Dual, (x, p), order)?;
                let value = |(linear, square)| {
                    work.sum(&[(ratio(1, 2), linear, &one), (ratio(1, 4), square, &one)])
                };
                linear.iter().zip(&square).map(value).collect()
            }
        }
    }
}
