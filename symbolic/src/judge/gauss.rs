//! The equations of a step by collocation, about the middle of the step; the runtime's `collocation` states them.
//!
//! Gauss's nodes are roots of Legendre's polynomials found by Newton's method, and weights integrate powers. The unknowns
//! are the rates hẋ and hṗ at the nodes, momenta in the units of the step: the right side is a multiple of them where ω is
//! multiplied by s, so that the right solution is the one continued from s = 0, as it is with a series.

use nalgebra::{DMatrix, Dyn};
use num_traits::{One, Zero};

use super::energy::Expression;
use super::geometry::Geometry;
use super::linear::{Real, column, derivative, size};
use super::{DoubleDouble, JudgeError};

/// Gauss's method and a Hamiltonian.
#[derive(Clone, Debug)]
pub(super) struct Collocation {
    pub(super) energy: Expression,
    /// cᵢ − ½, the times of the nodes.
    times: Vec<DoubleDouble>,
    /// bᵢ in the first row, and aᵢⱼ − bⱼ/2 in row i + 1.
    weights: DMatrix<DoubleDouble>,
    /// The coefficients of J_R.
    chart: Vec<DoubleDouble>,
}

/// A step from μ of this size about this middle; momenta are in units of 2^scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage<'a> {
    pub(super) collocation: &'a Collocation,
    pub(super) symbols: &'a [f64],
    pub(super) step: f64,
    pub(super) middle: DoubleDouble,
    pub(super) scale: i64,
}

fn number(value: usize) -> DoubleDouble {
    DoubleDouble::from(value as f64)
}

/// Half the roots of Legendre's polynomial of this degree, ascending.
fn half_roots(degree: usize) -> Vec<DoubleDouble> {
    let one = DoubleDouble::one();
    let root = |i: usize| {
        let angle = std::f64::consts::PI * (i as f64 + 0.75) / (degree as f64 + 0.5);
        let mut x = DoubleDouble::from(-angle.cos());
        for _ in 0..6 {
            let (mut before, mut value) = (one, x);
            for k in 1..degree {
                let next = number(2 * k + 1) * x * value - number(k) * before;
                (before, value) = (value, next / number(k + 1));
            }
            x -= value * (x * x - one) / (number(degree) * (x * value - before));
        }
        x * DoubleDouble::from(0.5)
    };
    (0..degree).map(root).collect()
}

/// βₖ of J_R = Σ βₖ (ad\*_x)ᵏ p, those of z/(1 − e⁻ᶻ), up to this power.
fn beta(degree: usize) -> Vec<DoubleDouble> {
    let mut beta = vec![DoubleDouble::one()];
    for k in 1..=degree {
        let (mut sum, mut factor) = (DoubleDouble::zero(), DoubleDouble::one());
        for back in 1..=k {
            factor *= -DoubleDouble::one() / number(back + 1);
            sum -= beta[k - back] * factor;
        }
        beta.push(sum);
    }
    beta
}

impl Collocation {
    /// Collocation with this many nodes, and J_R up to the power `degree` of x.
    pub(super) fn new(energy: Expression, nodes: usize, degree: usize) -> Option<Self> {
        let (times, half) = (half_roots(nodes), DoubleDouble::from(0.5));
        let power = |x: DoubleDouble, k: usize| (0..k).fold(DoubleDouble::one(), |p, _| p * x);
        let powers = DMatrix::from_fn(nodes, nodes, |k, j| power(times[j], k));
        // ∫ sᵏ over the whole step, and to each node less half of that over the whole.
        let integrals = DMatrix::from_fn(nodes, nodes + 1, |k, i| {
            let end = power(half, k + 1);
            let start = if k % 2 == 0 { -end } else { end };
            let to = if i == 0 {
                end - start
            } else {
                power(times[i - 1], k + 1) - half * (end + start)
            };
            to / number(k + 1)
        });
        let weights = Real::solve(&powers, &integrals)?.transpose();
        Some(Self { energy, times, weights, chart: beta(degree) })
    }
}

impl Stage<'_> {
    /// True if ∂H/∂μ is finite at μ in the middle of the step.
    pub(super) fn is_defined(&self, mu: &DMatrix<DoubleDouble>) -> bool {
        self.velocity(self.middle, mu).is_ok()
    }

    /// h ∂H/∂μ at (t, μ).
    fn velocity<T: Real>(&self, time: T, mu: &DMatrix<T>) -> Result<DMatrix<T>, JudgeError> {
        let mu: Vec<T> = mu.iter().map(|mu| mu.scaled(self.scale)).collect();
        let omega = self.collocation.energy.gradient(self.symbols, time, &mu);
        match size(&omega).is_finite() {
            true => Ok(column(omega.into_iter()) * T::from(self.step)),
            false => Err(JudgeError::Undefined),
        }
    }

    /// The number of unknowns.
    pub(super) fn unknowns(&self, geometry: &Geometry) -> usize {
        2 * geometry.dim * self.collocation.times.len()
    }

    /// The increment of the whole step.
    pub(super) fn increment<T: Real>(&self, rates: &DMatrix<T>) -> DMatrix<T> {
        let nodes = self.collocation.times.len();
        let rates = rates.clone().reshape_generic(Dyn(rates.len() / (2 * nodes)), Dyn(2 * nodes));
        rates.columns(0, nodes) * self.collocation.weights.rows(0, 1).map(T::of).transpose()
    }

    /// The rates that follow from others, where all numbers of the step are multiplied by 1 + `shift`.
    pub(super) fn rates<T: Real>(
        &self,
        geometry: &Geometry,
        mu: &DMatrix<T>,
        rates: &DMatrix<T>,
        shift: f64,
    ) -> Result<DMatrix<T>, JudgeError> {
        let (n, m) = (geometry.dim, self.collocation.times.len());
        let mu = mu * T::from(1.0 + shift);
        let p = geometry.pull_back(geometry.chart, &self.increment(rates), &mu)?;
        let beta: Vec<T> = self.collocation.chart.iter().map(|b| T::of(*b)).collect();
        let mut next = DMatrix::zeros(n, 2 * m);
        for (i, [x, p]) in self.nodes(rates, &p).enumerate() {
            let [x, p] = self.node(geometry, &beta, (i, shift), [&x, &p])?;
            next.set_column(i, &x.column(0));
            next.set_column(m + i, &p.column(0));
        }
        Ok(next.reshape_generic(Dyn(2 * n * m), Dyn(1)))
    }

    /// x and p at the nodes, where the step has these rates and this p in its middle.
    fn nodes<T: Real>(
        &self,
        rates: &DMatrix<T>,
        p: &DMatrix<T>,
    ) -> impl Iterator<Item = [DMatrix<T>; 2]> {
        let (n, m) = (p.nrows(), self.collocation.times.len());
        let rates = rates.clone().reshape_generic(Dyn(n), Dyn(2 * m));
        let matrix = self.collocation.weights.rows(1, m).map(T::of).transpose();
        let (xs, ps) = (rates.columns(0, m) * &matrix, rates.columns(m, m) * &matrix);
        let p = p.clone();
        (0..m).map(move |i| [xs.columns(i, 1).into_owned(), &p + ps.columns(i, 1)])
    }

    /// The rates at node i, where x and p are these.
    fn node<T: Real>(
        &self,
        geometry: &Geometry,
        beta: &[T],
        (i, shift): (usize, f64),
        [x, p]: [&DMatrix<T>; 2],
    ) -> Result<[DMatrix<T>; 2], JudgeError> {
        let time = T::of(self.middle) + T::from(self.step) * T::of(self.collocation.times[i]);
        let momentum = geometry.momentum(beta, x, p);
        let omega = self.velocity(time * T::from(1.0 + shift), &momentum)?;
        Ok(geometry.canonical(beta, x, p, &omega))
    }

    /// The derivative of the rates that follow in those that they follow from: at each node by differences over this
    /// spacing in its own x and p, which are linear in the rates but for the p of the middle.
    pub(super) fn slope(
        &self,
        geometry: &Geometry,
        mu: &DMatrix<f64>,
        rates: &DMatrix<f64>,
        spacing: f64,
    ) -> Result<DMatrix<f64>, JudgeError> {
        let Collocation { weights, chart, .. } = self.collocation;
        let (n, m) = (geometry.dim, self.collocation.times.len());
        let weights = weights.map(f64::of);
        let beta: Vec<f64> = chart.iter().map(|b| b.to_f64()).collect();
        let x = self.increment(rates);
        let pull_back = |x: &DMatrix<f64>| geometry.pull_back(geometry.chart, x, mu);
        let p = pull_back(&x)?;
        let pulled = derivative(&x, &p, spacing, pull_back)?;
        let mut slope = DMatrix::zeros(2 * n * m, 2 * n * m);
        for (i, [x, p]) in self.nodes(rates, &p).enumerate() {
            let both = |x: &DMatrix<f64>, p: &DMatrix<f64>| {
                column(x.iter().chain(p).copied().collect::<Vec<_>>().into_iter())
            };
            let here = both(&x, &p);
            let rates = |at: &DMatrix<f64>| {
                let [x, p] = [0, n].map(|first| at.rows(first, n).into_owned());
                self.node(geometry, &beta, (i, 0.0), [&x, &p]).map(|[x, p]| both(&x, &p))
            };
            let own = derivative(&here, &rates(&here)?, spacing, rates)?;
            let (by_x, by_p) = (own.columns(0, n), own.columns(n, n));
            let by_middle = by_p * &pulled;
            for j in 0..m {
                let (whole, part) = (weights[(0, j)], weights[(i + 1, j)]);
                let blocks = [by_x * part + &by_middle * whole, by_p * part];
                for (block, first) in blocks.iter().zip([j, m + j]) {
                    for (rows, to) in [(0, i), (n, m + i)] {
                        let mut place = slope.view_mut((to * n, first * n), (n, n));
                        place.copy_from(&block.rows(rows, n));
                    }
                }
            }
        }
        Ok(slope)
    }
}
