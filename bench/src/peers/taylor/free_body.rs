//! The recurrence of the free body: one lane product for Π and three for q per pair of orders.

use super::{
    Recurrence,
    lanes::{Lanes, product, scaled, sum},
};
use crate::problem::FreeBody;

/// The series so far, in the arrangements the products read.
struct Work<const N: usize> {
    /// (Π₂, Π₃, Π₁) and (Π₃, Π₁, Π₂).
    turned: [[Lanes; 2]; N],
    /// ½Ω.
    half_velocity: [Lanes; N],
    /// q i, q j, q k.
    turned_attitude: [[Lanes; 3]; N],
}

impl<const N: usize> Work<N> {
    #[inline(always)]
    fn push(&mut self, k: usize, half: &Lanes, m: &Lanes, q: &Lanes) {
        self.turned[k] = [[m[1], m[2], m[0], 0.0], [m[2], m[0], m[1], 0.0]];
        self.half_velocity[k] = [half[0] * m[0], half[1] * m[1], half[2] * m[2], 0.0];
        self.turned_attitude[k] =
            [[-q[1], q[0], q[3], -q[2]], [-q[2], -q[3], q[0], q[1]], [-q[3], q[2], -q[1], q[0]]];
    }

    /// [tᴷ] of Π × Ω (without the differences of 1/I) and of ½ q Ω. The newest orders come last, so that the rest of
    /// the sum does not wait for them.
    #[inline(always)]
    fn rates<const K: usize>(&self) -> (Lanes, Lanes) {
        let (mut even, mut odd) = ([0.0; 4], [0.0; 4]);
        let mut attitude = [[0.0; 4]; 3];
        for n in 0..=K {
            let j = inwards::<K>(n);
            let (left, right) = (&self.turned[j][0], &self.turned[K - j][1]);
            if n % 2 == 0 {
                even = product(left, right, even);
            } else {
                odd = product(left, right, odd);
            }
            for (i, part) in attitude.iter_mut().enumerate() {
                *part = scaled(self.half_velocity[j][i], &self.turned_attitude[K - j][i], *part);
            }
        }
        (sum(&even, &odd), sum(&sum(&attitude[0], &attitude[1]), &attitude[2]))
    }
}

/// The n-th index of 0..=K counted from the middle outwards.
#[inline(always)]
pub(super) fn inwards<const K: usize>(n: usize) -> usize {
    let middle = K / 2;
    if n.is_multiple_of(2) { middle - n / 2 } else { middle + n.div_ceil(2) }
}

impl Recurrence<2> for FreeBody {
    #[inline(always)]
    fn expand<const N: usize>(&self, y: &[Lanes; 2]) -> [[Lanes; 2]; N] {
        let a = &self.inverse_inertia;
        let half = [0.5 * a[0], 0.5 * a[1], 0.5 * a[2], 0.0];
        let differences = [a[2] - a[1], a[0] - a[2], a[1] - a[0], 0.0];
        let mut series = [[[0.0; 4]; 2]; N];
        let mut work = Work::<N> {
            turned: [[[0.0; 4]; 2]; N],
            half_velocity: [[0.0; 4]; N],
            turned_attitude: [[[0.0; 4]; 3]; N],
        };
        series[0] = *y;
        work.push(0, &half, &y[0], &y[1]);
        super::for_each_order!(K, N, {
            let (momentum, attitude) = work.rates::<K>();
            let scale = 1.0 / (K + 1) as f64;
            let m: Lanes = std::array::from_fn(|i| momentum[i] * (differences[i] * scale));
            let q: Lanes = std::array::from_fn(|i| attitude[i] * scale);
            series[K + 1] = [m, q];
            work.push(K + 1, &half, &m, &q);
        });
        series
    }
}
