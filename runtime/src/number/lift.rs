//! Coefficients in numbers that may be wider than they are.

use nalgebra::SimdValue;
use simba::simd::WideF64x4;

use super::scalar::Scalar;

/// Numbers into which coefficients of type `C` can be put.
pub trait Lift<C> {
    /// The coefficient, in every lane.
    fn lift(coefficient: C) -> Self;
}

impl<T: Scalar> Lift<T> for T {
    #[inline(always)]
    fn lift(coefficient: T) -> T {
        coefficient
    }
}

impl Lift<f64> for WideF64x4 {
    #[inline(always)]
    fn lift(coefficient: f64) -> Self {
        Self::splat(coefficient)
    }
}
