//! Whether a truncated series means something: the ratio of its last two terms.

use crate::number::scalar::Scalar;

/// The ratio up to which a step is accepted.
pub(crate) const LARGEST_RATIO: f64 = 0.5;

/// Degrees that the bound on all directions knows of; a series that goes beyond is judged at each momentum.
const DEGREES: usize = 64;

/// The |p| up to which the ratio is at most one half in every direction, given the terms of S_K and S_{K−2} as
/// (coefficient, order, monomial).
///
/// Each monomial c·pᵐ of degree D counts with D |c| max |pᵐ| over the unit sphere, which bounds its gradient there
/// (O. Kellogg, Math. Z. 27 (1928) 55); the maximum is Π (mᵢ/D)^{mᵢ/2}.
pub fn radius<'a, T: Scalar>(
    truncation: usize,
    terms: impl Iterator<Item = (T, usize, &'a [(u32, u32)])>,
) -> T {
    let (zero, unlimited) = (T::of(0.0), T::of(f64::MAX));
    // By the degree of the gradient: of S_K, and of S_{K−2}.
    let mut last = [zero; DEGREES];
    let mut before = [zero; DEGREES];
    for (value, order, monomial) in terms {
        let degree: u32 = monomial.iter().map(|&(_, power)| power).sum();
        if degree == 0 {
            continue;
        }
        let highest: f64 = monomial.iter().map(|&(_, power)| half_power(power)).product();
        let weight = f64::from(degree) * highest / half_power(degree);
        let of = if order == truncation { &mut last } else { &mut before };
        match of.get_mut(degree as usize - 1) {
            Some(sum) => *sum += value.simd_abs() * T::of(weight),
            None => return zero,
        }
    }
    let polynomial = |of: &[T; DEGREES], r: T| {
        let top = of.iter().rposition(|c| c.largest_lane() != 0.0).map_or(0, |top| top + 1);
        of[..top].iter().rev().fold(zero, |sum, &c| sum.times_plus(r, c))
    };
    let within = |r: T| {
        let (last, before) = (polynomial(&last, r), polynomial(&before, r));
        // Without a term to compare with there is no ratio, and rounding's own is none.
        let nothing = before.simd_le(zero) | last.simd_le(negligible());
        let bounded = last.simd_le(T::of(LARGEST_RATIO) * before) | nothing;
        bounded & last.simd_le(unlimited)
    };
    if polynomial(&last, T::of(1.0)).largest_lane() == 0.0 {
        return unlimited;
    }
    // The ratio grows with r; by powers of two, then of their roots.
    let smallest = T::of(f64::from(f32::MIN_POSITIVE));
    let mut r = smallest.select(within(smallest), zero);
    let mut exponent = 512;
    while exponent > 0 {
        r = longer(r, power_of_two(exponent), &within);
        exponent /= 2;
    }
    for factor in [core::f64::consts::SQRT_2, 1.189_207_115_002_721, 1.090_507_732_665_257_7] {
        r = longer(r, factor, &within);
    }
    r
}

/// A last term that adds no more than rounding to coordinates of order one: what is left of a term that cancels (of a
/// spherical body, say) is of this size, and its ratio means nothing.
fn negligible<T: Scalar>() -> T {
    T::of(16.0) * T::epsilon()
}

/// r times the factor where that is within.
fn longer<T: Scalar>(r: T, factor: f64, within: &impl Fn(T) -> T::SimdBool) -> T {
    let longer = r * T::of(factor);
    longer.select(within(longer), r)
}

/// 2^exponent.
fn power_of_two(exponent: u32) -> f64 {
    (0..exponent).fold(1.0, |power, _| 2.0 * power)
}

/// n^{n/2}.
fn half_power(n: u32) -> f64 {
    let whole = (0..n / 2).fold(1.0, |power, _| power * f64::from(n));
    if n.is_multiple_of(2) { whole } else { whole * nalgebra::ComplexField::sqrt(f64::from(n)) }
}

/// The ratio of S_K and S_{K−2} at p, given their terms as (coefficient, order, monomial): of the sums of the
/// absolute values of all monomials of their gradients.
#[inline(always)]
pub fn ratio<'a, T: Scalar>(
    truncation: usize,
    terms: impl Iterator<Item = (T, usize, &'a [(u32, u32)])>,
    p: impl Fn(usize) -> T,
) -> T {
    let (mut last, mut before) = (T::of(0.0), T::of(0.0));
    for (value, order, monomial) in terms {
        let mut sum = T::of(0.0);
        for (at, &(_, power)) in monomial.iter().enumerate() {
            let mut product = value * T::of(f64::from(power));
            for (other, &(i, n)) in monomial.iter().enumerate() {
                let n = if other == at { n.saturating_sub(1) } else { n };
                product = (0..n).fold(product, |product, _| product * p(i as usize));
            }
            sum += product.simd_abs();
        }
        if order == truncation {
            last += sum;
        } else {
            before += sum;
        }
    }
    // Nothing against nothing is no ratio, nor is that of roundings; NaN stays.
    let zero = T::of(0.0);
    let compared = before.simd_gt(zero) & last.simd_gt(negligible()) | last.simd_ne(last);
    (last / before).select(compared, zero * last)
}
