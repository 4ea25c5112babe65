//! Rows of numbers as vectors.

/// Sums kept side by side in [`dot`], so that additions need not wait for each other. Fixed: the
/// order of additions is part of the result.
const SUMS: usize = 8;

/// a·b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, a_rest) = a.as_chunks::<SUMS>();
    let (b, b_rest) = b.as_chunks::<SUMS>();
    let mut sums = [0.0; SUMS];
    for (a, b) in a.iter().zip(b) {
        for i in 0..SUMS {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// |a|.
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// target += factor·other.
pub(super) fn add(target: &mut [f64], factor: f64, other: &[f64]) {
    target.iter_mut().zip(other).for_each(|(t, o)| *t += factor * o);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_counts_once() {
        for count in [0, 1, 7, 8, 9, 33] {
            let a: Vec<f64> = (1..=count).map(f64::from).collect();
            let squares = f64::from(count * (count + 1) * (2 * count + 1) / 6);
            assert_eq!(dot(&a, &a), squares);
        }
    }
}
