//! RK45: Dormand and Prince's pair of orders 5 and 4, on fixed-size arrays.
//!
//! Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., table II.5.2.

use super::embedded::{Pair, combine, mean_square, weigh};
use crate::problem::VectorField;

/// The pair of order 5(4).
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince;

const A2: [f64; 1] = [0.2];
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0];
const A6: [f64; 5] =
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0];
/// From stages 1, 3, 4, 5, 6.
const B: [f64; 5] = [35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0];
/// From stages 1, 3, 4, 5, 6, 7.
const E: [f64; 6] = [
    71.0 / 57600.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

impl Pair for DormandPrince {
    const EXPONENT: f64 = 1.0 / 5.0;

    #[inline(always)]
    fn attempt<const N: usize, F: VectorField<N>>(
        field: &F,
        y: &[f64; N],
        k1: &[f64; N],
        h: f64,
        tolerance: f64,
    ) -> ([f64; N], [f64; N], f64) {
        let k2 = field.evaluate(&combine(y, h, &A2, [k1]));
        let k3 = field.evaluate(&combine(y, h, &A3, [k1, &k2]));
        let k4 = field.evaluate(&combine(y, h, &A4, [k1, &k2, &k3]));
        let k5 = field.evaluate(&combine(y, h, &A5, [k1, &k2, &k3, &k4]));
        let k6 = field.evaluate(&combine(y, h, &A6, [k1, &k2, &k3, &k4, &k5]));
        let new = combine(y, h, &B, [k1, &k3, &k4, &k5, &k6]);
        let k7 = field.evaluate(&new);
        let error = mean_square(&weigh(&E, [k1, &k3, &k4, &k5, &k6, &k7]), h, y, &new, tolerance);
        (new, k7, error.sqrt())
    }
}
