//! Which curves of a motion are shown, over which time, and with how many points.
//!
//! Curves of many records are thinned before they are drawn: [`thinned`] and [`peaks`] keep every visible extreme.

/// One number at each time of a run.
#[derive(Clone, Debug, Default)]
pub struct Channel {
    /// The name.
    pub name: String,
    /// The unit, if there is one.
    pub unit: Option<String>,
    /// One value for each time.
    pub values: Vec<f64>,
}

/// The most coordinates drawn as lines with a name; the others are drawn as a band.
const NAMED: usize = 8;
/// A line with more turning points than this would be drawn as a solid block.
const MOST_TURNS: usize = 80;
/// The number of turning points shown then.
const SHOWN_TURNS: usize = 40;
/// The number of turning points that show how fast a motion is.
const FEW_TURNS: usize = 4;
/// Records from one turning point to the next that it takes to follow a motion.
const RECORDS_A_TURN: f64 = 2.5;
/// A wiggle smaller than this share of the panel is no turning point.
const WIGGLE: f64 = 0.04;

/// The least and the greatest of the finite values; `None` if there is none.
pub fn range<'a>(values: impl IntoIterator<Item = &'a f64>) -> Option<(f64, f64)> {
    values.into_iter().filter(|value| value.is_finite()).fold(None, |range, &value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((low.min(value), high.max(value))),
    })
}

/// The coordinates that vary most, in the order of the file, and all the others.
pub(crate) fn largest<'a>(series: &[&'a Channel]) -> (Vec<&'a Channel>, Vec<&'a Channel>) {
    let variation =
        |series: &Channel| range(&series.values).map_or(0.0, |(low, high)| high / 2.0 - low / 2.0);
    let mut order: Vec<usize> = (0..series.len()).collect();
    order.sort_by(|&a, &b| variation(series[b]).total_cmp(&variation(series[a])));
    let shown = &order[..order.len().min(NAMED)];
    let pick = |inside: bool| {
        (0..series.len()).filter(|i| shown.contains(i) == inside).map(|i| series[i]).collect()
    };
    (pick(true), pick(false))
}

/// The records that are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Window {
    /// This number of records from the start on.
    pub(crate) records: usize,
    /// True if the records are dense enough to follow the motion from one turning point to the next.
    pub(crate) resolved: bool,
}

/// All records, or the first ones: where all together have too many turning points to be told apart, or
/// where later records are too far apart to follow what the first ones show.
pub(crate) fn window(series: &[&Channel], times: &[f64]) -> Window {
    let all = series.iter().flat_map(|series| &series.values);
    let (low, high) = range(all).unwrap_or_default();
    let wiggle = WIGGLE * (high / 2.0 - low / 2.0) * 2.0;
    let turns = series.iter().map(|series| turning_points(&series.values, wiggle));
    let turns = turns.filter_map(|turns| Some((pace(&turns, times)?, turns)));
    let Some((pace, turns)) = turns.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Window { records: times.len(), resolved: true };
    };
    let legible = match turns.get(SHOWN_TURNS) {
        Some(end) if turns.len() > MOST_TURNS => (end + 1).min(times.len()),
        _ => times.len(),
    };
    let apart = |pair: &[f64]| (pair[1] - pair[0]).abs() > pace / RECORDS_A_TURN;
    match times[..legible].windows(2).position(apart) {
        None => Window { records: legible, resolved: true },
        Some(coarse) if turns.iter().filter(|&&at| at < coarse).count() > FEW_TURNS => {
            Window { records: coarse + 1, resolved: true }
        }
        Some(_) => Window { records: legible, resolved: false },
    }
}

/// The time from one of the first turning points to the next, in the mean; `None` if there are few.
fn pace(turns: &[usize], times: &[f64]) -> Option<f64> {
    let first = &turns[..turns.len().min(2 * FEW_TURNS)];
    let (from, to) = (times.get(*first.first()?)?, times.get(*first.last()?)?);
    (first.len() > 1).then(|| (to - from).abs() / (first.len() - 1) as f64)
}

/// The records at which a curve turns round by more than `wiggle`.
fn turning_points(values: &[f64], wiggle: f64) -> Vec<usize> {
    let mut turns = Vec::new();
    let (mut low, mut high) = ((0, f64::INFINITY), (0, f64::NEG_INFINITY));
    // `Some(true)` while the curve rises; unknown at first.
    let mut rising = None;
    for (at, &value) in values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        if value > high.1 {
            high = (at, value);
        }
        if value < low.1 {
            low = (at, value);
        }
        if rising != Some(false) && high.1 - value > wiggle {
            if rising.is_some() {
                turns.push(high.0);
            }
            (rising, low) = (Some(false), (at, value));
        } else if rising != Some(true) && value - low.1 > wiggle {
            if rising.is_some() {
                turns.push(low.0);
            }
            (rising, high) = (Some(true), (at, value));
        }
    }
    turns
}

/// A curve with at most two points in each of `columns` stretches of time, the least and the
/// greatest, so that no peak is lost.
pub fn thinned(times: &[f64], values: &[f64], columns: usize) -> Vec<(f64, f64)> {
    let points = points(times, values);
    let mut kept = Vec::new();
    for stretch in stretches(&points, columns) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (least, greatest) = (stretch.iter().min_by(by_value), stretch.iter().max_by(by_value));
        let mut pair: Vec<(f64, f64)> = least.into_iter().chain(greatest).copied().collect();
        pair.dedup();
        // In the order of the run, which may go backwards in time.
        if let ([a, b], Some(first)) = (&pair[..], stretch.first())
            && (a.0 - first.0).abs() > (b.0 - first.0).abs()
        {
            pair.reverse();
        }
        kept.extend(pair);
    }
    // The end of the run is shown as it is.
    kept.extend(points.last());
    kept
}

/// The greatest value of each of at most `columns` stretches of time, at its time.
pub fn peaks(times: &[f64], values: &[f64], columns: usize) -> Vec<(f64, f64)> {
    let points = points(times, values);
    let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    stretches(&points, columns).filter_map(|part| part.iter().max_by(by_value).copied()).collect()
}

/// The points (error, cost) that no other point beats in both, by growing error.
pub fn unbeaten(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut cheapest = f64::INFINITY;
    points.retain(|&(_, cost)| {
        let better = cost < cheapest;
        cheapest = cheapest.min(cost);
        better
    });
    points
}

/// The finite points.
fn points(times: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let both = times.iter().zip(values).map(|(&time, &value)| (time, value));
    both.filter(|(time, value)| time.is_finite() && value.is_finite()).collect()
}

/// Consecutive points that fall into the same of `columns` equal parts of the time.
fn stretches(points: &[(f64, f64)], columns: usize) -> impl Iterator<Item = &[(f64, f64)]> {
    let (first, last) = match points {
        [first, .., last] => (first.0, last.0),
        _ => (0.0, 1.0),
    };
    // The last moment belongs to the last part.
    let most = columns.saturating_sub(1) as f64;
    let column =
        move |time: f64| ((time - first) / (last - first) * columns as f64).floor().min(most);
    points.chunk_by(move |a, b| column(a.0) == column(b.0))
}

#[cfg(test)]
mod tests {
    use super::{Channel, Window, largest, thinned, turning_points, unbeaten, window};

    fn wave(name: &str, rate: f64, records: usize) -> Channel {
        let values = (0..records).map(|n| (rate * n as f64).sin()).collect();
        Channel { name: name.to_owned(), unit: None, values }
    }

    #[test]
    fn a_motion_that_oscillates_too_often_is_shown_in_part() {
        let slow = wave("slow", 0.05, 1000);
        let times: Vec<f64> = (0..1000).map(f64::from).collect();
        assert_eq!(window(&[&slow], &times), Window { records: 1000, resolved: true });
        let fast = wave("fast", 0.5, 1000);
        // 1000/2π half turns; forty of them are 2·20π records.
        let part = window(&[&slow, &fast], &times);
        assert!(part.resolved && part.records.abs_diff(255) < 5, "{part:?}");
        // Fewer than two records from one turn to the next follow no motion.
        assert!(!window(&[&wave("too fast", 2.5, 1000)], &times).resolved);
        // If only the beginning is dense, only the beginning is shown.
        let thin: Vec<f64> =
            times.iter().map(|&n| if n < 200.0 { n } else { 200.0 + 64.0 * (n - 199.0) }).collect();
        let values = thin.iter().map(|time| (0.3 * time).sin()).collect();
        let part = window(&[&Channel { values, ..fast }], &thin);
        assert_eq!(part, Window { records: 200, resolved: true });
        // Rounding of a constant is no motion.
        let noise = Channel { values: vec![1.0, 1.0 - 1e-16, 1.0], ..slow.clone() };
        assert!(turning_points(&noise.values, 0.04).is_empty());
    }

    #[test]
    fn the_eight_that_vary_most_are_shown_in_order() {
        let mut all: Vec<Channel> = (0..12).map(|i| wave(&format!("c{i}"), 0.1, 200)).collect();
        for series in &mut all[2..6] {
            series.values.iter_mut().for_each(|value| *value *= 0.1);
        }
        let (shown, rest) = largest(&all.iter().collect::<Vec<_>>());
        let names: Vec<&str> = shown.iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["c0", "c1", "c6", "c7", "c8", "c9", "c10", "c11"]);
        assert_eq!(rest.len(), 4);
    }

    #[test]
    fn thinning_keeps_every_peak() {
        let times: Vec<f64> = (0..10_000).map(f64::from).collect();
        let mut values = vec![0.0; 10_000];
        values[4567] = 3.0;
        values[4568] = -2.0;
        let kept = thinned(&times, &values, 100);
        assert!(kept.len() <= 201);
        assert!(kept.contains(&(4567.0, 3.0)) && kept.contains(&(4568.0, -2.0)));
    }

    #[test]
    fn beaten_points_are_left_out() {
        let points = vec![(1e-2, 1.0), (1e-6, 9.0), (1e-4, 3.0), (1e-3, 4.0), (1e-5, 9.0)];
        assert_eq!(unbeaten(points), [(1e-6, 9.0), (1e-4, 3.0), (1e-2, 1.0)]);
    }
}
