//! The size of a vector.

/// The Euclidean norm, without overflow; NaN where an entry is.
pub(super) fn norm(v: &[f64]) -> f64 {
    let largest =
        v.iter().fold(0.0_f64, |a, b| if b.is_nan() { f64::NAN } else { maximum(a, b.abs()) });
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * v.iter().map(|x| (x / largest) * (x / largest)).sum::<f64>().sqrt()
}

/// The larger of two numbers; NaN where one is, unlike `f64::max`.
pub(super) fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
