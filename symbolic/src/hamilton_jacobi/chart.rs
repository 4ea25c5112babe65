//! The chart's derivatives as power series in t, coefficient by coefficient, for a series x(t) without constant term.

use super::DeriveError;
use super::online::{Series, Work, convolve};
use crate::lie::{Chart, CubicEntry, LieAlgebra, cubic};
use crate::number::{BernoulliWeights, Rational, ratio};
use crate::poly::Polynomial;
use num_traits::{One, Zero};

/// Whether a map of the algebra is taken, or its transpose.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// ad_x and xξx.
    Algebra,
    /// ad_x^T and ξ ↦ ⟨v, xξx⟩.
    Dual,
}

/// The coefficient of t^`order` in [x, v], whose component k is Σ_{i,j} c_ij^k x_i v_j, or in ad_x^T v, whose component j is
/// Σ_{i,k} c_ij^k x_i v_k.
pub(super) fn bilinear(
    work: &mut Work,
    algebra: &LieAlgebra,
    side: Side,
    (x, v): (&[Series], &[Series]),
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    // Looking through zeros is work too, or a long truncation of a trivial flow would never end.
    work.charge(algebra.structure().len().saturating_mul(order + 1))?;
    let mut lists = vec![Vec::new(); algebra.dim()];
    for c in algebra.structure() {
        let (from, to) = match side {
            Side::Algebra => (c.j, c.k),
            Side::Dual => (c.k, c.j),
        };
        convolve(&mut lists[to], &c.value, &x[c.i], &v[from], order);
    }
    lists.iter().map(|list| work.sum(list)).collect()
}

/// Σ_j weight(j) A^j v for A = ad_x or its transpose.
pub(super) struct Powers<'a> {
    algebra: &'a LieAlgebra,
    side: Side,
    /// A^j v for j ≥ 1; x has no constant term, so power j begins at order j.
    powers: Vec<Vec<Series>>,
}

impl<'a> Powers<'a> {
    pub(super) fn new(algebra: &'a LieAlgebra, side: Side) -> Self {
        Self { algebra, side, powers: Vec::new() }
    }

    /// The coefficient of t^`order`, that of v counting as 0 where it is missing.
    pub(super) fn extend(
        &mut self,
        work: &mut Work,
        (x, v): (&[Series], &[Series]),
        order: usize,
        mut weight: impl FnMut(usize) -> Rational,
    ) -> Result<Vec<Polynomial>, DeriveError> {
        if order > 0 {
            let zeros = vec![Polynomial::zero(work.variables); order];
            self.powers.push(vec![zeros; v.len()]);
        }
        for j in 1..=order {
            let below = if j == 1 { v } else { &self.powers[j - 2] };
            let next = bilinear(work, self.algebra, self.side, (x, below), order)?;
            for (series, coefficient) in self.powers[j - 1].iter_mut().zip(next) {
                series.push(coefficient);
            }
        }
        let one = Polynomial::constant(work.variables, Rational::one());
        let weights: Vec<Rational> = (0..=order).map(&mut weight).collect();
        let sum = |(i, v): (usize, &Series)| {
            let of = |j: usize| match j {
                0 => v.get(order),
                j => self.powers[j - 1][i].get(order),
            };
            let terms = weights.iter().enumerate().filter(|(_, weight)| !weight.is_zero());
            let terms: Vec<_> =
                terms.filter_map(|(j, weight)| Some((weight.clone(), of(j)?, &one))).collect();
            work.sum(&terms)
        };
        v.iter().enumerate().map(sum).collect()
    }
}

/// (d^L τ_x)⁻¹ v, or its transpose J_R(x, v).
pub(super) struct Inverse<'a> {
    form: Form<'a>,
    side: Side,
    algebra: &'a LieAlgebra,
}

enum Form<'a> {
    /// With the weights (−1)^k B_k/k!.
    Exponential(BernoulliWeights, Powers<'a>),
    /// v + ½ A v − ¼ xvx.
    Cayley(Vec<CubicEntry>),
}

impl<'a> Inverse<'a> {
    pub(super) fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        side: Side,
    ) -> Result<Self, DeriveError> {
        let form = match chart {
            Chart::Exponential => {
                Form::Exponential(BernoulliWeights::default(), Powers::new(algebra, side))
            }
            Chart::Cayley => Form::Cayley(cubic(algebra)?),
        };
        Ok(Self { form, side, algebra })
    }

    /// The coefficient of t^`order`; x and v must be known through that order, a missing coefficient of v counting as 0.
    pub(super) fn extend(
        &mut self,
        work: &mut Work,
        (x, v): (&[Series], &[Series]),
        order: usize,
    ) -> Result<Vec<Polynomial>, DeriveError> {
        match &mut self.form {
            Form::Exponential(weights, powers) => {
                powers.extend(work, (x, v), order, |j| weights.get(j))
            }
            Form::Cayley(cubic) => {
                let linear = bilinear(work, self.algebra, self.side, (x, v), order)?;
                let square = sandwich(work, cubic, self.side, (x, v), order)?;
                let one = Polynomial::constant(work.variables, Rational::one());
                let zero = Polynomial::zero(work.variables);
                let sum = |i: usize| {
                    work.sum(&[
                        (Rational::one(), v[i].get(order).unwrap_or(&zero), &one),
                        (ratio(1, 2), &linear[i], &one),
                        (ratio(-1, 4), &square[i], &one),
                    ])
                };
                (0..v.len()).map(sum).collect()
            }
        }
    }
}

/// The coefficient of t^`order` of xvx, or of ξ ↦ ⟨v, xξx⟩.
pub(super) fn sandwich(
    work: &mut Work,
    cubic: &[CubicEntry],
    side: Side,
    (x, v): (&[Series], &[Series]),
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    let mut result = vec![Polynomial::zero(work.variables); v.len()];
    let one = Polynomial::constant(work.variables, Rational::one());
    for entry in cubic {
        // The same trilinear form, read with argument and result exchanged.
        let (from, to) = match side {
            Side::Algebra => (entry.argument, entry.result),
            Side::Dual => (entry.result, entry.argument),
        };
        for i in 0..=order {
            let Some(v) = v[from].get(order - i).filter(|v| !v.is_zero()) else { continue };
            let mut list = Vec::new();
            convolve(&mut list, &entry.value, &x[entry.first], &x[entry.second], i);
            let square = work.sum(&list)?;
            result[to] =
                work.sum(&[(Rational::one(), &result[to], &one), (Rational::one(), &square, v)])?;
        }
    }
    Ok(result)
}
