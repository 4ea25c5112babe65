//! Points of a motion, with the steps that lead to and from them.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::super::trial::about_onwards;
use super::FitError;
use crate::chart::Chart;
use crate::generating::VectorOf;
use crate::group::LieGroup;
use crate::solve::{Integrator, Method, Predict, Settings, judge};

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
pub fn follow<S: Integrator + Predict>(
    coarse: &S,
    fine: &S,
    mut mu: VectorOf<S>,
    places: &[u64],
    length: u64,
    points: &mut Vec<Point<VectorOf<S>>>,
) -> Result<(), Option<FitError>> {
    let (group, chart) = (fine.group(), S::Chart::default());
    let settings = Settings::default();
    let mut method = S::Method::begin(fine);
    let starts: BTreeSet<u64> = places.iter().flat_map(|&s| [s, s + length]).collect();
    let mut starts = starts.into_iter().peekable();
    let mut open: Vec<Window<VectorOf<S>, _>> = Vec::new();
    let mut done: Vec<(u64, VectorOf<S>, Step<VectorOf<S>>)> = Vec::new();
    let mut now = 0;
    while starts.peek().is_some() || !open.is_empty() {
        let far = open.is_empty() && starts.peek().is_some_and(|&start| start >= now + length);
        if far && let Ok(next) = about_onwards(coarse, &mu) {
            (mu, now) = (next, now + length);
            method.forget();
            continue;
        }
        if starts.next_if_eq(&now).is_some() {
            open.push(Window { start: now, mu: mu.clone(), increment: group.identity() });
        }
        let candidate = method.propose(fine, &mu, 1, settings);
        let x = judge(fine, &mu, candidate, settings).map_err(FitError::from)?.x;
        let (increment, next) = chart.transport(group, &x, &mu);
        for window in &mut open {
            window.increment = group.compose(&window.increment, &increment);
        }
        (mu, now) = (next, now + 1);
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
