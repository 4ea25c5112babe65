//! Four numbers treated alike, so that a compiler makes one instruction of each line.

use crate::arithmetic::fma;

/// Four lanes.
pub type Lanes = [f64; 4];

/// sum + a·b lane by lane.
#[inline(always)]
#[must_use]
pub fn product(a: &Lanes, b: &Lanes, sum: Lanes) -> Lanes {
    std::array::from_fn(|i| fma(a[i], b[i], sum[i]))
}

/// sum + a·b with one number for all lanes.
#[inline(always)]
#[must_use]
pub fn scaled(a: f64, b: &Lanes, sum: Lanes) -> Lanes {
    std::array::from_fn(|i| fma(a, b[i], sum[i]))
}

/// a + b lane by lane.
#[inline(always)]
#[must_use]
pub fn sum(a: &Lanes, b: &Lanes) -> Lanes {
    std::array::from_fn(|i| a[i] + b[i])
}
