//! Which curves of a motion are shown, over which time, and with how many points.

use super::Series;

/// So many coordinates are drawn as lines with a name; the others as a band.
pub const NAMED: usize = 8;
/// A line with more turning points than this is a block of ink.
const MOST_TURNS: usize = 80;
/// How many turning points are shown then.
const SHOWN_TURNS: usize = 40;
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
pub fn largest<'a>(series: &[&'a Series]) -> (Vec<&'a Series>, Vec<&'a Series>) {
    let variation =
        |series: &Series| range(&series.values).map_or(0.0, |(low, high)| high / 2.0 - low / 2.0);
    let mut order: Vec<usize> = (0..series.len()).collect();
    order.sort_by(|&a, &b| variation(series[b]).total_cmp(&variation(series[a])));
    let shown = &order[..order.len().min(NAMED)];
    let pick = |inside: bool| {
        (0..series.len()).filter(|i| shown.contains(i) == inside).map(|i| series[i]).collect()
    };
    (pick(true), pick(false))
}

/// How many records are shown, and whether they are dense enough to follow the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// So many records from the start on.
    pub records: usize,
    /// Whether there are at least three records from one turning point to the next.
    pub resolved: bool,
}

/// All records, or the first ones where all together have too many turning points to be told apart.
pub fn window(series: &[&Series], records: usize) -> Window {
    let all = series.iter().flat_map(|series| &series.values);
    let (low, high) = range(all).unwrap_or_default();
    let wiggle = WIGGLE * (high / 2.0 - low / 2.0) * 2.0;
    let turns: Vec<Vec<usize>> =
        series.iter().map(|series| turning_points(&series.values, wiggle)).collect();
    let most = turns.iter().max_by_key(|turns| turns.len());
    let Some(most) = most.filter(|turns| !turns.is_empty()) else {
        return Window { records, resolved: true };
    };
    let shown = match most.get(SHOWN_TURNS) {
        Some(end) if most.len() > MOST_TURNS => (end + 1).min(records),
        _ => records,
    };
    let inside = most.iter().filter(|&&at| at < shown).count();
    Window { records: shown, resolved: shown >= 3 * inside }
}

/// The records at which a curve turns round by more than `wiggle`.
fn turning_points(values: &[f64], wiggle: f64) -> Vec<usize> {
    let mut turns = Vec::new();
    let (mut low, mut high) = ((0, f64::INFINITY), (0, f64::NEG_INFINITY));
    // Whether the curve rises; unknown at first.
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

/// A curve with at most two points in each of `columns` stretches of records, the least and the
/// greatest, so that no peak is lost.
pub fn thinned(times: &[f64], values: &[f64], columns: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = times
        .iter()
        .zip(values)
        .filter(|(time, value)| time.is_finite() && value.is_finite())
        .map(|(&time, &value)| (time, value))
        .collect();
    if points.len() <= 2 * columns {
        return points;
    }
    let mut kept = Vec::new();
    for stretch in points.chunks(points.len().div_ceil(columns).max(1)) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (least, greatest) = (stretch.iter().min_by(by_value), stretch.iter().max_by(by_value));
        let mut pair: Vec<(f64, f64)> = least.into_iter().chain(greatest).copied().collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        kept.extend(pair);
    }
    // The end of the run is shown as it is.
    kept.extend(points.last());
    kept
}

/// The greatest value of each of at most `columns` stretches, at its time.
pub fn peaks(times: &[f64], values: &[f64], columns: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = times
        .iter()
        .zip(values)
        .filter(|(time, value)| time.is_finite() && value.is_finite())
        .map(|(&time, &value)| (time, value))
        .collect();
    let stretches = points.chunks(points.len().div_ceil(columns).max(1));
    stretches.filter_map(|part| part.iter().max_by(|a, b| a.1.total_cmp(&b.1)).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::{Series, Window, largest, thinned, turning_points, window};

    fn wave(name: &str, rate: f64, records: usize) -> Series {
        let values = (0..records).map(|n| (rate * n as f64).sin()).collect();
        Series { name: name.to_owned(), unit: None, values }
    }

    #[test]
    fn a_motion_that_oscillates_too_often_is_shown_in_part() {
        let slow = wave("slow", 0.05, 1000);
        assert_eq!(window(&[&slow], 1000), Window { records: 1000, resolved: true });
        let fast = wave("fast", 0.5, 1000);
        // 1000/2π half turns; forty of them are 2·20π records.
        let part = window(&[&slow, &fast], 1000);
        assert!(part.resolved && part.records.abs_diff(255) < 5, "{part:?}");
        // Two records from one turn to the next follow no motion.
        assert!(!window(&[&wave("too fast", 2.5, 1000)], 1000).resolved);
        // Rounding of a constant is no motion.
        let noise = Series { values: vec![1.0, 1.0 - 1e-16, 1.0], ..slow.clone() };
        assert!(turning_points(&noise.values, 0.04).is_empty());
    }

    #[test]
    fn the_eight_that_vary_most_are_shown_in_order() {
        let mut all: Vec<Series> = (0..12).map(|i| wave(&format!("c{i}"), 0.1, 200)).collect();
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
}
