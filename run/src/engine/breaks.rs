//! Times at which equations jump or bend: steps end there, so that each sees a smooth function.

use crate::grid::Grid;

/// A time that is as near to the end of a step, as a share of it, is that end.
const SLACK: f64 = 1e-9;

/// The times at which steps end, which ascend.
#[derive(Clone, Debug, Default)]
pub(crate) struct Breaks(Vec<f64>);

impl Breaks {
    /// Of these times, in any order.
    pub(crate) fn new(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        times.dedup();
        Self(times)
    }

    /// The beginnings and the sizes of the parts of a step of this size from this time; of a step without breaks one.
    pub(crate) fn parts(&self, [time, size]: [f64; 2]) -> Vec<[f64; 2]> {
        let (edge, end) = (SLACK * size.abs(), time + size);
        let [from, to] = [time.min(end) + edge, time.max(end) - edge];
        let inside = self.0.iter().copied().filter(|at| from < *at && *at < to);
        let mut stops: Vec<f64> = inside.collect();
        if stops.is_empty() {
            return vec![[time, size]];
        }
        if size < 0.0 {
            stops.reverse();
        }
        let starts = [time].into_iter().chain(stops.iter().copied());
        let ends = stops.iter().copied().chain([end]);
        starts.zip(ends).map(|(start, end)| [start, end - start]).collect()
    }

    /// The number of the first step of a grid, from this one on, that has several parts.
    pub(crate) fn next(&self, grid: Grid, first: u64) -> Option<u64> {
        let inside = |at: &f64| {
            let place = (at - grid.start) / grid.step;
            let on_grid = (place - place.round()).abs() <= SLACK;
            (!on_grid && place >= first as f64).then_some(place as u64)
        };
        // They ascend: the first ones in the direction of time are those next.
        let time = grid.time(first);
        match grid.step > 0.0 {
            true => self.0[self.0.partition_point(|at| *at < time)..].iter().find_map(inside),
            false => {
                self.0[..self.0.partition_point(|at| *at <= time)].iter().rev().find_map(inside)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_at_breaks_in_both_directions_of_time() {
        let breaks = Breaks::new(vec![2.5, 1.0, 1.25, 2.0]);
        assert_eq!(breaks.parts([0.5, 1.0]), [[0.5, 0.5], [1.0, 0.25], [1.25, 0.25]]);
        assert_eq!(breaks.parts([1.5, -1.0]), [[1.5, -0.25], [1.25, -0.25], [1.0, -0.5]]);
        // Ends of steps are no parts, up to rounding.
        assert_eq!(breaks.parts([1.25 - 1e-12, 0.75]), [[1.25 - 1e-12, 0.75]]);
        let next = |start, step, first| breaks.next(Grid { start, step }, first);
        assert_eq!([0, 2, 3, 5].map(|first| next(0.0, 0.5, first)), [Some(2), Some(2), None, None]);
        assert_eq!(next(0.0, 0.75, 0), Some(1));
        assert_eq!(next(0.0, 0.75, 2), Some(2));
        assert_eq!(next(3.0, -0.75, 0), Some(0));
        assert_eq!(next(0.0, 0.25, 0), None);
    }
}
