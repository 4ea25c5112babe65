//! The order of accuracy, measured by step halving.

use coadjoint::laws::differences;
use coadjoint::{Phase, StepError};

use super::course::Start;
use super::law::{Law, Verdict};
use super::limit::Limit;
use crate::engine::Tables;

/// Steps of the coarsest run.
const STEPS: u32 = 4;
/// The measured order may fall below that of the method by this much.
const SLACK: f64 = 0.3;
/// Neighbouring halvings that must agree on an order that is too low.
const MANY: usize = 4;
/// Differences below this are near rounding, those above [`LARGE`] near the size of the solution.
const ROUNDING: f64 = 2e-13;
const LARGE: f64 = 0.5;
/// The map is exact if differences are rounding up to steps this many times as long as the one tried.
const EXACT: f64 = 4.0;

/// Makes this number of steps of this size from this time.
pub(super) type Steps<'a> =
    dyn FnMut((f64, u32), f64, &mut Phase<Tables>) -> Result<(), StepError> + 'a;

/// The order of accuracy from these starts: their median, since at one of them the leading term of the error may happen to
/// cancel.
pub(super) fn measured(
    step: f64,
    expected: f64,
    group: &Tables,
    starts: &[Start],
    run: &mut Steps<'_>,
) -> Law {
    let (bound, limit) = (expected - SLACK, Limit::new());
    let mut run = |steps, from, state: &mut _| limit.within(|| run(steps, from, state));
    let found = starts.iter().filter_map(|start| order_from((step, bound), group, start, &mut run));
    let mut orders: Vec<f64> = found.collect();
    orders.sort_by(f64::total_cmp);
    let (value, verdict) = match orders.get(orders.len() / 2) {
        Some(&order) if order >= bound => (order, Verdict::Holds),
        Some(&order) => (order, Verdict::Fails),
        None => (f64::NAN, Verdict::NotMeasured("no two halvings of the step show the same order")),
    };
    let statement = "error ∝ h^(K+1), by step halving";
    limit.said(Law { name: "order", statement, value, bound, verdict })
}

/// The order from one start: infinite where all differences are rounding, since the map is then exact; none where no two
/// neighbouring halvings agree.
///
/// Runs h, h/2 and h/4 over the same time have differences that shrink by 2^order. Among the steps h·2^(j/2), of which the
/// smallest show the leading term of the error best, the first two neighbours that agree or are both above the bound tell the
/// order; where it rises as steps become smaller, as much as it rose is added. An order below the bound is believed where
/// [`MANY`] of them agree.
fn order_from(
    (step, bound): (f64, f64),
    group: &Tables,
    (start, from): &Start,
    run: &mut Steps<'_>,
) -> Option<f64> {
    let (mut orders, mut exact): (Vec<f64>, _) = (Vec::new(), false);
    for exponent in -12..=24 {
        let longer = 2_f64.powf(0.5 * f64::from(exponent));
        let time = f64::from(STEPS) * step * longer;
        let made = |size, count, state: &mut _| run((size, count), *from, state);
        // Beyond the step where the solve fails nothing is to be measured.
        let Ok([coarse, fine]) = differences(group, start, time, STEPS, made) else { break };
        if !(coarse < LARGE) {
            break;
        }
        if !(fine > ROUNDING) {
            // Too small to be seen: larger steps may show it.
            exact = orders.is_empty() && longer >= EXACT;
            continue;
        }
        let order = (coarse / fine).log2();
        let agree = orders.iter().rev().take_while(|finer| (*finer - order).abs() <= SLACK).count();
        if let Some(&finer) = orders.last() {
            let found = finer + if agree > 0 { (finer - order).max(0.0) } else { 0.0 };
            let enough = found >= bound && (agree > 0 || order >= bound);
            if enough || agree + 1 >= MANY {
                return Some(found);
            }
        }
        orders.push(order);
        exact = false;
    }
    exact.then_some(f64::INFINITY)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use coadjoint::LieGroup;
    use coadjoint_codegen::lie::catalogue;
    use nalgebra::DVector;

    use super::*;
    use crate::engine::group_of;

    /// A law of order p by a map whose errors over a time t are t·h^p (1 + c h), and 1e-15 of rounding.
    fn law(order: i32, expected: f64, c: f64) -> Law {
        let algebra = catalogue::lookup("SO3").unwrap();
        let group = group_of(std::path::Path::new("test"), &algebra, false).unwrap();
        let mut run = |(size, count): (f64, u32), _: f64, state: &mut Phase<Tables>| {
            let time = size * f64::from(count);
            let error = time * size.powi(order) * (1.0 + c * size);
            let rounding = 1e-15 * f64::from(count % 3);
            state.momentum *= 1.0 + error + rounding;
            Ok(())
        };
        let start = Phase::new(group.exp(&DVector::zeros(3)), DVector::from_element(3, 1.0));
        measured(0.1, expected, &group, &[(start, 0.0)], &mut run)
    }

    #[test]
    fn an_order_is_told_from_the_one_below() {
        for (order, c) in [(2, 0.0), (3, 1.0), (4, -1.0), (8, 2.0)] {
            let right = law(order, f64::from(order), c);
            assert_eq!(right.verdict, Verdict::Holds, "{right:?}");
            assert!((right.value - f64::from(order)).abs() < 0.3, "{right:?}");
            let wrong = law(order, f64::from(order) + 1.0, c);
            assert_eq!(wrong.verdict, Verdict::Fails, "{wrong:?}");
        }
    }
}
