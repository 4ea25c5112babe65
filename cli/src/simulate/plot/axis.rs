//! Axes: their ranges, and the places and labels of their ticks.

/// A tick: where it is, and what is written there.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The value.
    pub at: f64,
    /// Its label.
    pub label: String,
}

/// A range of values that is drawn from one end of an axis to the other.
#[derive(Clone, Debug)]
pub struct Axis {
    low: f64,
    high: f64,
    /// Ticks, ascending.
    pub ticks: Vec<Tick>,
}

impl Axis {
    /// A linear axis with about `count` ticks. An empty range is widened.
    pub fn linear(low: f64, high: f64, count: usize) -> Self {
        const LARGEST: f64 = 8e307;
        let (mut low, mut high) = (low.clamp(-LARGEST, LARGEST), high.clamp(-LARGEST, LARGEST));
        let least = 1e-9 * low.abs().max(high.abs());
        if high - low <= least || high - low < f64::MIN_POSITIVE {
            let widening = if least > 0.0 { least } else { 1.0 };
            (low, high) = (low - widening, high + widening);
        }
        Self { low, high, ticks: ticks(low, high, count) }
    }

    /// An axis of decades from 10^low to 10^high, on which values are their logarithms; the lowest
    /// tick is labelled as the floor, where everything below is drawn.
    pub fn decades(low: i32, high: i32, count: usize) -> Self {
        let high = high.max(low + 1);
        let step = ((high - low) as usize).div_ceil(count.max(1)).max(1);
        let label = |decade: i32| match decade {
            decade if decade == low => format!("≤ 1e{decade}"),
            0 => "1".to_owned(),
            decade => format!("1e{decade}"),
        };
        let tick = |decade: i32| Tick { at: f64::from(decade), label: label(decade) };
        let ticks = (low..=high).step_by(step).map(tick).collect();
        Self { low: low.into(), high: high.into(), ticks }
    }

    /// Where a value is between the ends, from 0 to 1.
    pub fn share(&self, value: f64) -> f64 {
        // Halves, so that no difference overflows.
        let span = self.high / 2.0 - self.low / 2.0;
        ((value / 2.0 - self.low / 2.0) / span).clamp(0.0, 1.0)
    }
}

/// Ticks at whole multiples n·10^e of 1, 2 or 5 powers of ten. Labels are written from the whole
/// number n, so there is no rounding in them and no negative zero.
fn ticks(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let rough = (high / 2.0 - low / 2.0) / count.max(1) as f64 * 2.0;
    let mut exponent = rough.log10().floor() as i32;
    let mut step = rough / 10f64.powi(exponent);
    step = match step {
        step if step <= 1.0 => 1.0,
        step if step <= 2.0 => 2.0,
        step if step <= 5.0 => 5.0,
        _ => {
            exponent += 1;
            1.0
        }
    };
    let unit = 10f64.powi(exponent);
    let (first, last) = ((low / unit / step).ceil(), (high / unit / step).floor());
    if !(first.is_finite() && last.is_finite() && first.abs().max(last.abs()) < 1e15) {
        return Vec::new();
    }
    let numbers: Vec<i64> = (first as i64..=last as i64).map(|k| k * step as i64).collect();
    let largest = numbers.iter().map(|n| n.unsigned_abs()).max().unwrap_or(0);
    // The decimal exponent of the largest label.
    let top = exponent + largest.max(1).ilog10() as i32;
    let scientific = top >= 6 || exponent < -5;
    let tick = |&n: &i64| {
        let label = match n {
            0 => "0".to_owned(),
            n if scientific => {
                format!("{}e{top}", fixed(n, (top - exponent).max(0) as usize))
            }
            n if exponent >= 0 => {
                format!("{}{}", fixed(n, 0), "0".repeat(exponent as usize))
            }
            n => fixed(n, exponent.unsigned_abs() as usize),
        };
        Tick { at: n as f64 * unit, label }
    };
    numbers.iter().map(tick).collect()
}

/// n·10^−places in decimals, n ≠ 0.
fn fixed(n: i64, places: usize) -> String {
    let sign = if n < 0 { "−" } else { "" };
    let digits = format!("{:0>width$}", n.unsigned_abs(), width = places + 1);
    let (whole, rest) = digits.split_at(digits.len() - places);
    if places == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{rest}") }
}

#[cfg(test)]
mod tests {
    use super::Axis;

    fn labels(low: f64, high: f64) -> Vec<String> {
        Axis::linear(low, high, 5).ticks.into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn labels_are_exact_and_zero_has_no_sign() {
        assert_eq!(labels(-0.32, 0.31), ["−0.2", "0", "0.2"]);
        assert_eq!(labels(0.0, 100.0), ["0", "20", "40", "60", "80", "100"]);
        assert_eq!(labels(-30.0, 0.0), ["−30", "−20", "−10", "0"]);
        assert_eq!(labels(-3e-7, 3e-7), ["−2e-7", "0", "2e-7"]);
        assert_eq!(labels(0.0, 2.5e7), ["0", "0.5e7", "1.0e7", "1.5e7", "2.0e7", "2.5e7"]);
        for (low, high) in [(-1e-12, 1e-3), (-0.05, 0.0), (-7.0, 1e300), (0.0, 0.0), (2.0, 2.0)] {
            for label in labels(low, high) {
                let zero = label.trim_start_matches('−').chars().all(|c| "0.".contains(c));
                assert!(!zero || label == "0", "{label}");
            }
        }
    }

    #[test]
    fn no_range_is_too_wide_or_too_narrow() {
        for (low, high) in [(-1.7e308, 1.7e308), (0.0, 5e-324), (1e9, 1e9), (-1e-320, 1e-310)] {
            let axis = Axis::linear(low, high, 5);
            assert!(axis.ticks.len() < 20, "{axis:?}");
            assert!((0.0..=1.0).contains(&axis.share(low)), "{axis:?}");
        }
        assert_eq!(Axis::decades(-17, -13, 6).ticks[0].label, "≤ 1e-17");
        assert_eq!(Axis::decades(-17, 300, 6).ticks.len(), 6);
    }
}
