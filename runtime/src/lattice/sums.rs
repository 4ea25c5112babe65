//! Sums in an order that depends on nothing but their length.

use core::ops::Range;

/// The terms of a row, which are summed one after the other.
const ROW: usize = 512;

/// The sums of these terms: of halves, whose sizes differ by less than a row, down to rows.
pub fn tree<const N: usize>(terms: Range<usize>, of: &impl Fn(usize) -> [f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    if terms.len() <= ROW {
        for at in terms {
            let term = of(at);
            for i in 0..N {
                sum[i] += term[i];
            }
        }
        return sum;
    }
    let middle = terms.start + (terms.len() / 2).next_multiple_of(ROW);
    let (a, b) = (tree(terms.start..middle, of), tree(middle..terms.end, of));
    for i in 0..N {
        sum[i] = a[i] + b[i];
    }
    sum
}
