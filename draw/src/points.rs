//! Points of a cost against an error.

/// The points (error, cost) that no other point beats in both, by growing error.
#[must_use]
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beaten_points_are_left_out() {
        let points = vec![(1e-2, 1.0), (1e-6, 9.0), (1e-4, 3.0), (1e-3, 4.0), (1e-5, 9.0)];
        assert_eq!(unbeaten(points), [(1e-6, 9.0), (1e-4, 3.0), (1e-2, 1.0)]);
    }
}
