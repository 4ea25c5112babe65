//! The order of accuracy of steps, where it shows.

use coadjoint::laws::{OrderError, measured_order};
use coadjoint::{LieGroup, Phase, StepError};

/// The order of steps over the time 4 from a state, by runs of 1, 2, 4 … `finest` steps; `None` where it never shows
/// between rounding and refusal.
///
/// The finest halving still well above rounding shows the order best. Coarse steps may be refused.
pub fn seen<G: LieGroup<Scalar = f64>>(
    group: &G,
    start: &Phase<G>,
    finest: u32,
    run: impl Fn(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Option<f64> {
    let mut order = None;
    for steps in (0..=finest.ilog2()).map(|k| 1 << k) {
        match measured_order(group, start, 4.0, steps, &run) {
            Ok(value) => order = Some(value),
            Err(OrderError::OutOfRange { fine, .. }) if fine < 1e-12 => break,
            Err(_) => {}
        }
    }
    order
}
