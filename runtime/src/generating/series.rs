//! The convergence of a truncated series: the ratio of its last two terms.

use coadjoint_program::limits::NEGLIGIBLE;

use crate::number::Scalar;

/// The ratio of S_K and S_{K−2} at p, given their terms as (coefficient, whether it is one of S_K, monomial): of the sums
/// of the absolute values of all monomials of their gradients, the largest of those of the direct factors of the group.
/// `factors` has the factor of each coordinate, `sums` a place of zeros for each factor.
#[inline(always)]
pub fn ratio<'a, T: Scalar>(
    factors: &[u32],
    terms: impl Iterator<Item = (T, bool, &'a [(u32, u32)])>,
    sums: &mut [[T; 2]],
    p: impl Fn(usize) -> T,
) -> T {
    for (value, highest, monomial) in terms {
        for (at, &(coordinate, power)) in monomial.iter().enumerate() {
            let mut product = value * T::of(f64::from(power));
            for (other, &(i, n)) in monomial.iter().enumerate() {
                let n = if other == at { n.saturating_sub(1) } else { n };
                product = (0..n).fold(product, |product, _| product * p(i as usize));
            }
            let factor = factors.get(coordinate as usize).copied().unwrap_or(0);
            if let Some(sums) = sums.get_mut(factor as usize) {
                sums[usize::from(!highest)] += product.simd_abs();
            }
        }
    }
    // Nothing against nothing is no ratio, nor is that of roundings; NaN stays.
    let zero = T::of(0.0);
    sums.iter().fold(zero, |largest, &[last, before]| {
        let compared = before.simd_gt(zero) & last.simd_gt(T::of(NEGLIGIBLE) * T::epsilon())
            | last.simd_ne(last);
        largest.worse((last / before).select(compared, zero * last))
    })
}
