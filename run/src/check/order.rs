//! The order of accuracy, measured by step halving.

use coadjoint::laws::{OrderError, measured_order};
use coadjoint::{Phase, StepError};

use super::law::Law;
use crate::engine::Group;

/// Steps of the coarsest run.
const STEPS: u32 = 4;
/// How far the measured order may fall below K + 1.
const SLACK: f64 = 0.3;

/// The median over these starts, from one of which the leading term of the error may happen to cancel.
///
/// Runs h, h/2 and h/4 over the same time; the differences shrink by 2^order. Among the steps
/// h·2^j tried, it takes the smallest whose differences are above rounding, where the leading term
/// of the error dominates best. Where all differences are rounding the map is exact, and the order
/// counts as infinite.
pub(crate) fn measure<G: Group>(
    step: f64,
    expected: f64,
    group: &G,
    starts: &[Phase<G>],
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Law {
    let mut orders: Vec<f64> =
        starts.iter().map(|start| order(step, group, start, &mut run)).collect();
    orders.sort_by(f64::total_cmp);
    let order = orders.get(orders.len() / 2).copied().unwrap_or(f64::INFINITY);
    Law {
        name: "order",
        statement: "error ∝ h^(K+1), by step halving",
        value: order,
        bound: expected - SLACK,
        pass: order >= expected - SLACK,
    }
}

/// The order from one start; infinite where all differences are rounding.
fn order<G: Group>(
    step: f64,
    group: &G,
    start: &Phase<G>,
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> f64 {
    for exponent in -6..=12 {
        let time = f64::from(STEPS) * step * 2_f64.powi(exponent);
        match measured_order(group, start, time, STEPS, &mut run) {
            Ok(value) => return value,
            // Too small to be seen: try larger steps.
            Err(OrderError::OutOfRange { coarse, .. }) if coarse < 0.5 => {}
            // Beyond the step where the solve fails nothing is to be measured.
            Err(_) => break,
        }
    }
    f64::INFINITY
}
