//! The recurrence of a body on SE(3): Γ obeys the equation of a row of R, so it rides as a fourth row.

use super::{
    Recurrence,
    free_body::inwards,
    lanes::{Lanes, product, scaled, sum},
};
use crate::{
    arithmetic::Vector,
    problem::{Gravity, Mass, MovingBody, Translation},
};

/// The columns of R with Γ below: lane 3 of column i is Γᵢ.
type Columns = [Lanes; 3];

/// What H(Γ) adds to the orders.
pub trait Translating: Translation {
    /// [tᴷ] Γ × V.
    fn torque_order<const K: usize, const N: usize>(&self, columns: &[Columns; N]) -> Vector;
    /// [tᴷ] R V (lane 3 unused).
    fn moved_order<const K: usize, const N: usize>(&self, columns: &[Columns; N]) -> Lanes;
}

impl<const AXIS: usize> Translating for Gravity<AXIS> {
    #[inline(always)]
    fn torque_order<const K: usize, const N: usize>(&self, columns: &[Columns; N]) -> Vector {
        self.torque(&[columns[K][0][3], columns[K][1][3], columns[K][2][3]])
    }

    #[inline(always)]
    fn moved_order<const K: usize, const N: usize>(&self, columns: &[Columns; N]) -> Lanes {
        scaled(self.weight, &columns[K][AXIS], [0.0; 4])
    }
}

impl Translating for Mass {
    #[inline(always)]
    fn torque_order<const K: usize, const N: usize>(&self, columns: &[Columns; N]) -> Vector {
        let b = &self.inverse;
        let mut products = [0.0; 4];
        for n in 0..=K {
            let j = inwards::<K>(n);
            let (l, r) = (&columns[j], &columns[K - j]);
            products = product(
                &[l[1][3], l[2][3], l[0][3], 0.0],
                &[r[2][3], r[0][3], r[1][3], 0.0],
                products,
            );
        }
        [(b[2] - b[1]) * products[0], (b[0] - b[2]) * products[1], (b[1] - b[0]) * products[2]]
    }

    #[inline(always)]
    fn moved_order<const K: usize, const N: usize>(&self, columns: &[Columns; N]) -> Lanes {
        let mut parts = [[0.0; 4]; 3];
        for n in 0..=K {
            let j = inwards::<K>(n);
            for (i, part) in parts.iter_mut().enumerate() {
                *part = scaled(columns[j][i][3], &columns[K - j][i], *part);
            }
        }
        let mut moved = [0.0; 4];
        for (part, inverse) in parts.iter().zip(&self.inverse) {
            moved = scaled(*inverse, part, moved);
        }
        moved
    }
}

/// The series so far, in the arrangements the products read.
struct Work<const N: usize> {
    /// (Π₂, Π₃, Π₁) and (Π₃, Π₁, Π₂).
    turned: [[Lanes; 2]; N],
    /// Ω.
    velocity: [Lanes; N],
    columns: [Columns; N],
}

impl<const N: usize> Work<N> {
    #[inline(always)]
    fn push(&mut self, k: usize, inverse_inertia: &Vector, m: &Lanes, columns: Columns) {
        let a = inverse_inertia;
        self.turned[k] = [[m[1], m[2], m[0], 0.0], [m[2], m[0], m[1], 0.0]];
        self.velocity[k] = [a[0] * m[0], a[1] * m[1], a[2] * m[2], 0.0];
        self.columns[k] = columns;
    }

    /// [tᴷ] of Π × Ω (without the differences of 1/I) and of the columns times Ω^.
    #[inline(always)]
    fn rates<const K: usize>(&self) -> (Lanes, Columns) {
        let mut momentum = [0.0; 4];
        let (mut plus, mut minus) = ([[0.0; 4]; 3], [[0.0; 4]; 3]);
        for n in 0..=K {
            let j = inwards::<K>(n);
            momentum = product(&self.turned[j][0], &self.turned[K - j][1], momentum);
            for i in 0..3 {
                let (next, last) = ((i + 1) % 3, (i + 2) % 3);
                plus[i] = scaled(self.velocity[j][last], &self.columns[K - j][next], plus[i]);
                minus[i] = scaled(-self.velocity[j][next], &self.columns[K - j][last], minus[i]);
            }
        }
        (momentum, std::array::from_fn(|i| sum(&plus[i], &minus[i])))
    }
}

impl<T: Translating> Recurrence<5> for MovingBody<T> {
    #[inline(always)]
    fn expand<const N: usize>(&self, y: &[Lanes; 5]) -> [[Lanes; 5]; N] {
        let a = &self.inverse_inertia;
        let differences = [a[2] - a[1], a[0] - a[2], a[1] - a[0]];
        let mut series = [[[0.0; 4]; 5]; N];
        let mut work = Work::<N> {
            turned: [[[0.0; 4]; 2]; N],
            velocity: [[0.0; 4]; N],
            columns: [[[0.0; 4]; 3]; N],
        };
        series[0] = *y;
        work.push(0, a, &y[0], [y[1], y[2], y[3]]);
        super::for_each_order!(K, N, {
            let scale = 1.0 / (K + 1) as f64;
            let (products, rate) = work.rates::<K>();
            let torque = self.translation.torque_order::<K, N>(&work.columns);
            let moved = self.translation.moved_order::<K, N>(&work.columns);
            let mut m = [0.0; 4];
            for i in 0..3 {
                m[i] = (products[i] * differences[i] + torque[i]) * scale;
            }
            let columns = rate.map(|column| column.map(|v| v * scale));
            series[K + 1] = [m, columns[0], columns[1], columns[2], moved.map(|v| v * scale)];
            work.push(K + 1, a, &m, columns);
        });
        series
    }
}
