//! The unknowns of a step: the velocities of the canonical coordinates at its nodes, times the step size.

use crate::group::middle::add;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// hẋᵢ and hṗᵢ at the nodes, and the impulse of the torque.
#[derive(Clone, Debug)]
pub(super) struct Rates<V: Coordinates<f64>, const M: usize> {
    pub x: V::Rows<M>,
    pub p: V::Rows<M>,
    /// h Σ bᵢ Ad\*_{exp(xᵢ)} τᵢ.
    pub impulse: V,
}

/// start + Σⱼ weightsⱼᵢ rowsⱼ at each node i.
#[inline(always)]
pub(super) fn mixed<V, const M: usize>(
    start: &V,
    weights: &[[f64; M]; M],
    rows: &V::Rows<M>,
) -> V::Rows<M>
where
    V: Coordinates<f64>,
{
    let dim = start.dim();
    let mut result = V::zero_rows::<M>(dim);
    for k in 0..dim {
        let mut sum = [start[k]; M];
        for j in 0..M {
            for i in 0..M {
                sum[i] = weights[j][i].times_plus(rows[k][j], sum[i]);
            }
        }
        result[k] = sum;
    }
    result
}

/// Σᵢ weightsᵢ rowsᵢ
#[inline(always)]
pub(super) fn total<V, const M: usize>(dim: usize, weights: &[f64; M], rows: &V::Rows<M>) -> V
where
    V: Coordinates<f64>,
{
    V::from_entries(dim, |k| {
        let mut sum = 0.0;
        for i in 0..M {
            sum = weights[i].times_plus(rows[k][i], sum);
        }
        sum
    })
}

/// The largest coordinate at any node; NaN if one is.
#[inline(always)]
pub(super) fn largest<V: Coordinates<f64>, const M: usize>(dim: usize, rows: &V::Rows<M>) -> f64 {
    largest_by::<V, M>(dim, rows, |_| 1.0)
}

/// The largest coordinate at any node, each times a factor; NaN if one is.
#[inline(always)]
fn largest_by<V, const M: usize>(dim: usize, rows: &V::Rows<M>, by: impl Fn(usize) -> f64) -> f64
where
    V: Coordinates<f64>,
{
    let (mut largest, mut poison) = ([0.0_f64; M], [0.0; M]);
    for k in 0..dim {
        for i in 0..M {
            largest[i] = largest[i].max(rows[k][i].abs() * by(k));
            poison[i] = rows[k][i].times_plus(0.0, poison[i]);
        }
    }
    let mut worst = largest[0] + poison[0];
    for i in 1..M {
        worst = worst.worse(largest[i] + poison[i]);
    }
    worst
}

/// The largest coordinate, each times a factor; NaN if one is.
#[inline(always)]
pub(super) fn in_units<V: Coordinates<f64>>(vector: &V, unit: impl Fn(usize) -> f64) -> f64 {
    let sizes = (0..vector.dim()).map(|i| vector[i].abs() * unit(i));
    sizes.fold(0.0, |largest, size| size.worse(largest))
}

impl<V: Coordinates<f64>, const M: usize> Rates<V, M> {
    pub(super) fn zero(dim: usize) -> Self {
        let (x, p) = (V::zero_rows::<M>(dim), V::zero_rows::<M>(dim));
        Self { x, p, impulse: V::zeros(dim) }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, dim: usize, s: f64, other: &Self) {
        add::<f64, V, M>(dim, &mut self.x, s, &other.x);
        add::<f64, V, M>(dim, &mut self.p, s, &other.p);
        self.impulse = V::from_entries(dim, |i| s.times_plus(other.impulse[i], self.impulse[i]));
    }

    /// The largest coordinate, those of p in these units and divided by `scale`, those of x by the units.
    #[inline(always)]
    pub(super) fn size(&self, dim: usize, scale: f64, unit: impl Fn(usize) -> f64) -> f64 {
        let x = largest_by::<V, M>(dim, &self.x, |k| 1.0 / unit(k));
        let p = largest_by::<V, M>(dim, &self.p, &unit);
        x.worse(p.worse(in_units(&self.impulse, unit)) / scale)
    }
}
