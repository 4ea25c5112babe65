//! Each method at its best setting for a given error.

use crate::measure::Measurement;

/// The errors in (Π, R) at which methods are compared.
pub const TARGETS: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// A method's cheapest measurement at or below each target.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Best {
    /// The method's name.
    pub method: String,
    /// One entry for each of [`TARGETS`]; `None` where the method does not get there.
    pub at: [Option<Measurement>; TARGETS.len()],
}

/// The best of each method, in the order of first appearance.
#[must_use]
pub fn best(measurements: &[Measurement]) -> Vec<Best> {
    let mut names: Vec<&str> = Vec::new();
    for measurement in measurements {
        if !names.contains(&measurement.method.as_str()) {
            names.push(&measurement.method);
        }
    }
    let cheapest = |name: &str, target: f64| {
        measurements
            .iter()
            .filter(|row| row.method == name && row.error <= target)
            .min_by(|a, b| a.nanoseconds.total_cmp(&b.nanoseconds))
            .cloned()
    };
    names
        .into_iter()
        .map(|name| Best {
            method: name.to_owned(),
            at: TARGETS.map(|target| cheapest(name, target)),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cheapest_that_is_accurate_enough() {
        let row = |method: &str, error, nanoseconds| Measurement {
            method: method.to_owned(),
            family: method.to_owned(),
            setting: String::new(),
            error,
            nanoseconds,
        };
        let rows =
            [row("a", 1e-5, 10.0), row("a", 1e-7, 30.0), row("a", 1e-9, 20.0), row("b", 1e-3, 1.0)];
        let best = best(&rows);
        let costs: Vec<Vec<Option<f64>>> = best
            .iter()
            .map(|b| b.at.iter().map(|m| m.as_ref().map(|m| m.nanoseconds)).collect())
            .collect();
        assert_eq!(costs[0], [Some(10.0), Some(20.0), Some(20.0), None, None]);
        assert_eq!(costs[1], [None; 5]);
    }
}
