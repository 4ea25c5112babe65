//! Points of a motion, with the steps that lead to and from them.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::FitError;
use crate::chart::Chart;
use crate::generating_function::{GeneratingFunction, VectorOf};
use crate::group::LieGroup;
use crate::reconstruct::about_onwards;
use crate::solve::solve_after;

/// A point of the Lagrangian submanifold of the exact flow over a step.
#[derive(Clone, Debug)]
pub struct Step<V> {
    pub x: V,
    pub p: V,
}

/// A momentum on a motion.
#[derive(Clone, Debug)]
pub struct Point<V> {
    pub mu: V,
    /// The step that ends there.
    pub before: Step<V>,
    /// The step that begins there.
    pub after: Step<V>,
}

/// A step of the exact flow in the making: a product of increments.
struct Window<V, E> {
    start: u64,
    mu: V,
    increment: E,
}

/// The points of the motion from `mu` that lie `length` and `places` steps of `fine` later; a step from
/// point to point is made of `length` of these. From one place to another far away it goes by guesses of
/// steps of `coarse`, as long as `length` of `fine`: their error leads to a motion beside the one meant,
/// and the points are those of an exact motion still. The error is `None` where a step has no
/// coordinate.
pub fn follow<S: GeneratingFunction>(
    coarse: &S,
    fine: &S,
    mut mu: VectorOf<S>,
    places: &[u64],
    length: u64,
    points: &mut Vec<Point<VectorOf<S>>>,
) -> Result<(), Option<FitError>> {
    let (group, chart) = (fine.group(), fine.chart());
    let starts: BTreeSet<u64> = places.iter().flat_map(|&s| [s, s + length]).collect();
    let mut starts = starts.into_iter().peekable();
    let mut open: Vec<Window<VectorOf<S>, _>> = Vec::new();
    let mut done: Vec<(u64, VectorOf<S>, Step<VectorOf<S>>)> = Vec::new();
    let (mut now, mut last) = (0, None);
    while starts.peek().is_some() || !open.is_empty() {
        let far = open.is_empty() && starts.peek().is_some_and(|&start| start >= now + length);
        if far && let Ok(next) = about_onwards(coarse, &mu) {
            (mu, last, now) = (next, None, now + length);
            continue;
        }
        if starts.next_if_eq(&now).is_some() {
            open.push(Window { start: now, mu: mu.clone(), increment: group.identity() });
        }
        let solution = solve_after(fine, &mu, last.as_ref()).map_err(FitError::from)?;
        let (increment, next) = chart.transport(group, &solution.x, &mu);
        for window in &mut open {
            window.increment = group.compose(&window.increment, &increment);
        }
        (mu, last, now) = (next, Some(solution.p), now + 1);
        // The oldest window is the first to be complete.
        if open.first().is_some_and(|window| window.start + length == now) {
            let Window { start, mu, increment } = open.remove(0);
            let x = chart.coordinate(group, &increment).ok_or(None)?;
            let p = chart.pull_back(group, &x, &mu);
            done.push((start, mu, Step { x, p }));
        }
    }
    let at = |start: u64| done.binary_search_by_key(&start, |(start, ..)| *start).ok();
    for &place in places {
        if let (Some(before), Some(after)) = (at(place), at(place + length)) {
            let (_, mu, after) = done[after].clone();
            points.push(Point { mu, before: done[before].2.clone(), after });
        }
    }
    Ok(())
}
