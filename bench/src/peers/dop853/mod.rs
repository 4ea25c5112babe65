//! DOP853: order 8 with error estimators of orders 5 and 3, on fixed-size arrays.

mod tableau;

use super::embedded::{Pair, combine, mean_square, weigh};
use crate::problem::VectorField;
use tableau as c;

/// The pair of order 8(5, 3).
#[derive(Clone, Copy, Debug)]
pub struct Dop853;

impl Pair for Dop853 {
    const EXPONENT: f64 = 1.0 / 8.0;

    #[inline(always)]
    fn attempt<const N: usize, F: VectorField<N>>(
        field: &F,
        y: &[f64; N],
        k1: &[f64; N],
        h: f64,
        tolerance: f64,
    ) -> ([f64; N], [f64; N], f64) {
        let k2 = field.evaluate(&combine(y, h, &c::A2, [k1]));
        let k3 = field.evaluate(&combine(y, h, &c::A3, [k1, &k2]));
        let k4 = field.evaluate(&combine(y, h, &c::A4, [k1, &k3]));
        let k5 = field.evaluate(&combine(y, h, &c::A5, [k1, &k3, &k4]));
        let k6 = field.evaluate(&combine(y, h, &c::A6, [k1, &k4, &k5]));
        let k7 = field.evaluate(&combine(y, h, &c::A7, [k1, &k4, &k5, &k6]));
        let k8 = field.evaluate(&combine(y, h, &c::A8, [k1, &k4, &k5, &k6, &k7]));
        let k9 = field.evaluate(&combine(y, h, &c::A9, [k1, &k4, &k5, &k6, &k7, &k8]));
        let k10 = field.evaluate(&combine(y, h, &c::A10, [k1, &k4, &k5, &k6, &k7, &k8, &k9]));
        let k11 = field.evaluate(&combine(y, h, &c::A11, [k1, &k4, &k5, &k6, &k7, &k8, &k9, &k10]));
        let k12 =
            field.evaluate(&combine(y, h, &c::A12, [k1, &k4, &k5, &k6, &k7, &k8, &k9, &k10, &k11]));
        let new = combine(y, h, &c::B, [k1, &k6, &k7, &k8, &k9, &k10, &k11, &k12]);
        let stages = [k1, &k6, &k7, &k8, &k9, &k10, &k11, &k12];
        let fifth = mean_square(&weigh(&c::E5, stages), h, y, &new, tolerance);
        let third = mean_square(&weigh(&c::E3, stages), h, y, &new, tolerance);
        // The estimate of order 7 made of both: err5²/√(err5² + 0.01 err3²).
        let error = if fifth == 0.0 { 0.0 } else { fifth / (fifth + 0.01 * third).sqrt() };
        (new, field.evaluate(&new), error)
    }
}
