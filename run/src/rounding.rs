//! Whether a drift can be measured, or rounding of the numbers of a state hides it.

use coadjoint_codegen::step::{Conserved, Drift, Start};

/// Far above rounding, and so small that what is conserved changes in proportion to it.
const NUDGE: f64 = 1e-9;

/// Where rounding of a state alone may move a conserved quantity by more than this, relative to the scale of its drift, the
/// drift is not measured: the numbers have grown too large, as they do in groups that are not compact.
const MEASURABLE: f64 = 1e-11;

/// Moves each number by 1e-9, relatively, up or down without a pattern.
pub fn nudge(numbers: &mut [f64]) {
    for (place, number) in numbers.iter_mut().enumerate() {
        let up = (place as u32 + 1).wrapping_mul(0x9e37_79b9).count_ones().is_multiple_of(2);
        *number *= if up { 1.0 + NUDGE } else { 1.0 - NUDGE };
    }
}

/// The drift of a state, where it can be measured; `beside` is what is conserved of the state whose numbers are
/// [nudged](nudge).
pub fn measured(start: &Start, now: &Conserved, beside: Conserved) -> Drift {
    let beside = Start { conserved: beside, scales: start.scales.clone() };
    let moved = beside.drift(now).numbers().map(|moved| moved * (f64::EPSILON / NUDGE));
    let mut drift = start.drift(now).numbers();
    for (drift, moved) in drift.iter_mut().zip(moved) {
        // NaN is not measured either.
        if !drift.is_finite() || moved.is_nan() || moved > MEASURABLE {
            *drift = f64::NAN;
        }
    }
    Drift::of_numbers(drift)
}
