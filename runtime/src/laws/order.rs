//! The order of accuracy, measured by step halving.

use super::{element_difference, relative};
use crate::error::StepError;
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::number::scalar::Scalar;

/// Why an order could not be measured.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrderError {
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The differences are lost in rounding, or not smaller than the solution.
    #[error(
        "the order cannot be seen between {coarse:.1e} and {fine:.1e}: choose steps that leave \
         both differences well above rounding and below one"
    )]
    OutOfRange {
        /// Relative difference of the two coarser runs.
        coarse: f64,
        /// Relative difference of the two finer runs.
        fine: f64,
    },
}

/// The order of a method over the time `time`, from runs with `steps`, 2·`steps` and 4·`steps`
/// steps: the binary logarithm of the ratio of their successive differences, in momentum and
/// group element. `run(h, n, state)` makes n steps of size h.
///
/// # Errors
/// [`OrderError`] where a step fails or the differences say nothing.
pub fn measured_order<G: LieGroup<Scalar = f64>>(
    group: &G,
    start: &Phase<G>,
    time: f64,
    steps: u32,
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Result<f64, OrderError> {
    let mut end = |steps: u32| {
        let mut state = start.clone();
        run(time / f64::from(steps), steps, &mut state).map(|()| state)
    };
    let ends = [end(steps)?, end(2 * steps)?, end(4 * steps)?];
    let difference = |a: &Phase<G>, b: &Phase<G>| {
        let elements = element_difference(group, &a.group_element, &b.group_element);
        elements.worse(relative(&a.momentum, &b.momentum))
    };
    let coarse = difference(&ends[0], &ends[1]);
    let fine = difference(&ends[1], &ends[2]);
    if !(coarse < 0.5 && fine > 1e-12) {
        return Err(OrderError::OutOfRange { coarse, fine });
    }
    Ok(nalgebra::ComplexField::ln(coarse / fine) / core::f64::consts::LN_2)
}
