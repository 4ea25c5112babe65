//! The element-wise passes of back-propagation, with the widest vectors the processor has.
//!
//! Nothing here is added up and nothing fused, so the bits do not depend on the width.

use multiversion::multiversion;

use super::activation::{Activation, Curve, Logistic, Tanh};

/// Calls `$work` with the type of the activation: inside the loops nothing is left to decide.
macro_rules! with_curve {
    ($activation:expr, $work:ident($($argument:expr),*)) => {
        match $activation {
            Activation::Tanh => $work::<Tanh>($($argument),*),
            Activation::Logistic => $work::<Logistic>($($argument),*),
        }
    };
}

/// A ← σ(A).
pub(super) fn apply(activation: Activation, values: &mut [f64]) {
    #[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2"))]
    fn work<C: Curve>(values: &mut [f64]) {
        values.iter_mut().for_each(|z| *z = C::value(*z));
    }
    with_curve!(activation, work(values));
}

/// C ← B∘σ′, σ being A.
pub(super) fn inner(activation: Activation, value: &[f64], above: &[f64], inner: &mut [f64]) {
    #[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2"))]
    fn work<C: Curve>(value: &[f64], above: &[f64], inner: &mut [f64]) {
        for ((c, b), a) in inner.iter_mut().zip(above).zip(value) {
            *c = b * C::slope(*a);
        }
    }
    with_curve!(activation, work(value, above, inner));
}

/// From the derivative in C = B∘σ′, which is in `by_above`: that in Z and that in B.
pub(super) fn upwards(
    activation: Activation,
    value: &[f64],
    above: &[f64],
    by_above: &mut [f64],
    by_input: &mut [f64],
) {
    #[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2"))]
    fn work<C: Curve>(value: &[f64], above: &[f64], by_above: &mut [f64], by_input: &mut [f64]) {
        let targets = by_above.iter_mut().zip(by_input);
        for ((up, input), (a, b)) in targets.zip(value.iter().zip(above)) {
            *input = *up * b * C::bend(*a);
            *up *= C::slope(*a);
        }
    }
    with_curve!(activation, work(value, above, by_above, by_input));
}

/// Adds to the derivative in Z what comes from that in A = σ(Z).
pub(super) fn downwards(
    activation: Activation,
    value: &[f64],
    by_value: &[f64],
    by_input: &mut [f64],
) {
    #[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2"))]
    fn work<C: Curve>(value: &[f64], by_value: &[f64], by_input: &mut [f64]) {
        for ((input, by_value), a) in by_input.iter_mut().zip(by_value).zip(value) {
            *input += by_value * C::slope(*a);
        }
    }
    with_curve!(activation, work(value, by_value, by_input));
}
