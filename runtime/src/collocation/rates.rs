//! The unknowns of a step: the velocities of the canonical coordinates at its nodes, times the step size.

use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// hẋᵢ and hṗᵢ at the nodes.
#[derive(Clone, Debug)]
pub(super) struct Rates<V, const M: usize> {
    pub x: [V; M],
    pub p: [V; M],
}

/// a ← a + s·b
#[inline(always)]
pub(super) fn add<V: Coordinates<f64>>(a: &mut V, s: f64, b: &V) {
    for i in 0..a.dim() {
        a[i] = b[i].times_plus(s, a[i]);
    }
}

/// start + Σ weightsᵢ rowᵢ
#[inline(always)]
pub(super) fn mixed<V, const M: usize>(start: &V, weights: &[f64; M], row: &[V; M]) -> V
where
    V: Coordinates<f64>,
{
    let mut sum = start.clone();
    for i in 0..M {
        add(&mut sum, weights[i], &row[i]);
    }
    sum
}

/// The largest coordinate of several vectors.
#[inline(always)]
pub(super) fn largest<V: Coordinates<f64>, const M: usize>(row: &[V; M]) -> f64 {
    let mut largest = row[0].largest_entry();
    for i in 1..M {
        largest = largest.worse(row[i].largest_entry());
    }
    largest
}

impl<V: Coordinates<f64>, const M: usize> Rates<V, M> {
    /// Rates that are all zero.
    pub(super) fn zero(dim: usize) -> Self {
        let zeros = || core::array::from_fn(|_| V::zeros(dim));
        Self { x: zeros(), p: zeros() }
    }

    /// self ← self + s·other
    #[inline(always)]
    pub(super) fn add(&mut self, s: f64, other: &Self) {
        for i in 0..M {
            add(&mut self.x[i], s, &other.x[i]);
            add(&mut self.p[i], s, &other.p[i]);
        }
    }

    /// The largest coordinate, those of p divided by `scale`.
    #[inline(always)]
    pub(super) fn size(&self, scale: f64) -> f64 {
        largest(&self.x).worse(largest(&self.p) / scale)
    }
}
