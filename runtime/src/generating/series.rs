//! Whether a truncated series means something: the ratio of its last two terms.

use crate::number::scalar::Scalar;

/// The ratio up to which a step is accepted.
pub(crate) const LARGEST_RATIO: f64 = 0.5;

/// Degrees that the bound on all directions knows of; a series that goes beyond is judged at each momentum.
const DEGREES: usize = 64;

/// The |p| of each direct factor of the group up to which the ratio of every factor is at most one half in all
/// directions, given the terms of S_K and S_{K−2} as (coefficient, order, monomial), and the factor of each coordinate.
pub fn radius<'a, T: Scalar>(
    truncation: usize,
    factors: &[u32],
    terms: impl Iterator<Item = (T, usize, &'a [(u32, u32)])> + Clone,
) -> T {
    let count = factors.last().map_or(0, |&last| last + 1);
    (0..count).fold(T::of(f64::MAX), |least, factor| {
        let own = terms.clone().map(|(value, order, monomial)| {
            let bound = gradient_bound(monomial, |i| factor_of(factors, i), factor);
            (value.simd_abs(), order, bound)
        });
        least.simd_min(radius_of_factor(truncation, own))
    })
}

/// The factor of coordinate i.
fn factor_of(factors: &[u32], i: u32) -> u32 {
    factors.get(i as usize).copied().unwrap_or(0)
}

/// Degree and size of a bound on the gradient of a monomial in the coordinates of one factor, where |p| of each factor is
/// one: D_f Π max |pᵐ|, D_f being its degree in those coordinates and the maximum of the part in each factor g over the
/// unit sphere Π (mᵢ/D_g)^{mᵢ/2} (O. Kellogg, Math. Z. 27 (1928) 55). `None` where the monomial has none of them.
fn gradient_bound(
    monomial: &[(u32, u32)],
    factor_of: impl Fn(u32) -> u32,
    factor: u32,
) -> Option<(usize, f64)> {
    let degree_in = |of: u32| -> u32 {
        monomial.iter().filter(|&&(i, _)| factor_of(i) == of).map(|&(_, power)| power).sum()
    };
    let own = degree_in(factor);
    let degree: u32 = monomial.iter().map(|&(_, power)| power).sum();
    let highest: f64 = monomial.iter().map(|&(_, power)| half_power(power)).product();
    let first_of_factor = monomial.iter().enumerate().filter(|&(at, &(i, _))| {
        monomial.iter().take(at).all(|&(other, _)| factor_of(other) != factor_of(i))
    });
    let spheres: f64 =
        first_of_factor.map(|(_, &(i, _))| half_power(degree_in(factor_of(i)))).product();
    (own > 0).then(|| (degree as usize - 1, f64::from(own) * highest / spheres))
}

/// The same of one factor, given (|coefficient|, order, degree and size of the bound on the gradient).
fn radius_of_factor<T: Scalar>(
    truncation: usize,
    terms: impl Iterator<Item = (T, usize, Option<(usize, f64)>)>,
) -> T {
    let (zero, unlimited) = (T::of(0.0), T::of(f64::MAX));
    // By the degree of the gradient: of S_K, and of S_{K−2}.
    let mut last = [zero; DEGREES];
    let mut before = [zero; DEGREES];
    for (value, order, bound) in terms {
        let Some((degree, weight)) = bound else { continue };
        let of = if order == truncation { &mut last } else { &mut before };
        match of.get_mut(degree) {
            Some(sum) => *sum += value * T::of(weight),
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

/// The ratio of S_K and S_{K−2} at p, given their terms as (coefficient, order, monomial): of the sums of the absolute
/// values of all monomials of their gradients, the largest of those of the direct factors of the group. `sums` has a
/// place of zeros for each coordinate.
#[inline(always)]
pub fn ratio<'a, T: Scalar>(
    truncation: usize,
    factors: &[u32],
    terms: impl Iterator<Item = (T, usize, &'a [(u32, u32)])>,
    sums: &mut [[T; 2]],
    p: impl Fn(usize) -> T,
) -> T {
    for (value, order, monomial) in terms {
        for (at, &(coordinate, power)) in monomial.iter().enumerate() {
            let mut product = value * T::of(f64::from(power));
            for (other, &(i, n)) in monomial.iter().enumerate() {
                let n = if other == at { n.saturating_sub(1) } else { n };
                product = (0..n).fold(product, |product, _| product * p(i as usize));
            }
            if let Some(sums) = sums.get_mut(factor_of(factors, coordinate) as usize) {
                sums[usize::from(order != truncation)] += product.simd_abs();
            }
        }
    }
    // Nothing against nothing is no ratio, nor is that of roundings; NaN stays.
    let zero = T::of(0.0);
    sums.iter().fold(zero, |largest, &[last, before]| {
        let compared = before.simd_gt(zero) & last.simd_gt(negligible()) | last.simd_ne(last);
        largest.worse((last / before).select(compared, zero * last))
    })
}
