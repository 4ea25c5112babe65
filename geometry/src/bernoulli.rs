//! The series of exp's J_R about the middle of a step.

use crate::number::Number;
use crate::series::{ROUNDING, TRIED, Taylor};

/// The powers of x that a series of the exponential chart may have.
pub const MAX_DEGREE: usize = 14;

/// βₖ = (−1)ᵏ Bₖ/k! with Bernoulli's numbers, B₁ = −½: J_R = Σ βₖ (ad\*_x)ᵏ p.
pub const BETA: [f64; MAX_DEGREE + 1] = [
    1.0,
    0.5,
    1.0 / 12.0,
    0.0,
    -1.0 / 720.0,
    0.0,
    1.0 / 30_240.0,
    0.0,
    -1.0 / 1_209_600.0,
    0.0,
    1.0 / 47_900_160.0,
    0.0,
    -691.0 / 1_307_674_368_000.0,
    0.0,
    1.0 / 74_724_249_600.0,
];

/// Σ |β₂ₖ| tᵏ⁻¹ up to the term of x^degree.
const fn bernoulli_of(degree: usize) -> Taylor {
    let mut c = [0.0; TRIED];
    let mut k = 2;
    while k <= degree {
        c[k / 2 - 1] = BETA[k].abs();
        k += 2;
    }
    Taylor::new(c, 1.0, [ROUNDING; 4])
}

/// The factors of exp's J_R for the degrees 0, 2, …, 14.
const BERNOULLI: &[Taylor; 8] = &[
    bernoulli_of(0),
    bernoulli_of(2),
    bernoulli_of(4),
    bernoulli_of(6),
    bernoulli_of(8),
    bernoulli_of(10),
    bernoulli_of(12),
    bernoulli_of(14),
];

/// c(t) = Σ |B₂ₖ|/(2k)! tᵏ⁻¹, t = |x|², the factor of exp's J_R on so(3), with as many terms as its series has to this degree;
/// and 2 dc/dt.
#[inline(always)]
pub(crate) fn bernoulli<T: Number>(x: [T; 3], degree: usize) -> [T; 2] {
    let series = &BERNOULLI[if degree > MAX_DEGREE { MAX_DEGREE } else { degree } / 2];
    [T::even(x, series, 0), T::even(x, series, 1)]
}
