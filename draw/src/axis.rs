//! Axes: their ranges, and the positions and labels of their ticks.

/// A tick: its place and its label.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// The value.
    pub(crate) at: f64,
    /// Its label.
    pub(crate) label: String,
}

/// A range of values that is drawn from one end of an axis to the other.
#[derive(Clone, Debug)]
pub struct Axis {
    low: f64,
    high: f64,
    /// True for a logarithmic axis.
    logarithmic: bool,
    /// Ticks, ascending.
    pub(crate) ticks: Vec<Tick>,
}

impl Default for Axis {
    fn default() -> Self {
        Self::linear(0.0, 1.0, 5)
    }
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
        Self { low, high, logarithmic: false, ticks: ticks(low, high, count) }
    }

    /// A linear axis that holds all these values with a margin, and 0 if `zero`.
    pub fn around<'a>(values: impl IntoIterator<Item = &'a f64>, zero: bool, count: usize) -> Self {
        let (mut low, mut high) = crate::curves::range(values).unwrap_or((0.0, 0.0));
        if zero {
            (low, high) = (low.min(0.0), high.max(0.0));
        }
        let margin = 0.06 * (high / 2.0 - low / 2.0) * 2.0;
        Self::linear(low - margin, high + margin, count)
    }

    /// A logarithmic axis with about `count` ticks; values that are not positive are drawn at its low end. Ticks are powers of
    /// ten, or 1, 2 and 5 times these where there would be few.
    pub fn logarithmic(low: f64, high: f64, count: usize) -> Self {
        let low = low.max(f64::MIN_POSITIVE);
        let high = high.min(1e307).max(low * 1.000_001);
        let (first, last) = (low.log10(), high.log10());
        let decades = (last.floor() - first.ceil()) as i32 + 1;
        let inside = |value: f64| value >= low * 0.999_999 && value <= high * 1.000_001;
        let mut ticks = Vec::new();
        if decades >= 3 {
            let step = (decades as usize).div_ceil(count.max(1)).max(1);
            for decade in (first.ceil() as i32..=last.floor() as i32).step_by(step) {
                ticks.push(Tick { at: 10f64.powi(decade), label: power(decade) });
            }
        } else {
            let digits: &[i32] = if decades == 2 && count < 6 { &[1, 3] } else { &[1, 2, 5] };
            for decade in first.floor() as i32..=last.ceil() as i32 {
                for &digit in digits {
                    let at = f64::from(digit) * 10f64.powi(decade);
                    if inside(at) {
                        ticks.push(Tick { at, label: small(digit, decade) });
                    }
                }
            }
        }
        Self { low, high, logarithmic: true, ticks }
    }

    /// A logarithmic axis that holds all the positive ones of these values, from at least `floor` on.
    pub fn logarithmic_around<'a>(
        values: impl IntoIterator<Item = &'a f64>,
        floor: f64,
        count: usize,
    ) -> Self {
        let positive = values.into_iter().filter(|&&value| value >= floor);
        let (low, high) = crate::curves::range(positive).unwrap_or((floor, 10.0 * floor));
        Self::logarithmic(low / 1.5, high * 1.5, count)
    }

    /// A logarithmic axis from 10^low to 10^high; the lowest tick is labelled as the floor, where everything below is
    /// drawn.
    fn decades(low: i32, high: i32, count: usize) -> Self {
        let high = high.max(low + 1);
        let step = ((high - low) as usize).div_ceil(count.max(1)).max(1);
        let label = |decade: i32| match decade {
            decade if decade == low => format!("≤ 1e{decade}"),
            decade => power(decade),
        };
        let tick = |decade: i32| Tick { at: 10f64.powi(decade), label: label(decade) };
        let ticks = (low..=high).step_by(step).map(tick).collect();
        Self { low: 10f64.powi(low), high: 10f64.powi(high), logarithmic: true, ticks }
    }

    /// The axis from `floor`, below which values are not distinguished, up to the largest of these.
    pub fn floored<'a>(
        values: impl IntoIterator<Item = &'a f64>,
        (floor, least_top): (i32, i32),
        count: usize,
    ) -> Self {
        let highest = crate::curves::range(values).map_or(0.0, |(_, high)| high);
        let top = if highest > 0.0 { highest.log10().ceil() as i32 } else { least_top };
        Self::decades(floor, top.max(least_top), count)
    }

    /// The place of a value between the ends, from 0 to 1.
    pub(crate) fn share(&self, value: f64) -> f64 {
        if self.logarithmic {
            if value <= self.low {
                return 0.0;
            }
            let (low, high) = (self.low.log10(), self.high.log10());
            return ((value.log10() - low) / (high - low)).clamp(0.0, 1.0);
        }
        // Halves, so that no difference overflows.
        let span = self.high / 2.0 - self.low / 2.0;
        ((value / 2.0 - self.low / 2.0) / span).clamp(0.0, 1.0)
    }
}

/// A power of ten.
fn power(decade: i32) -> String {
    match decade {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        2 => "100".to_owned(),
        decade => format!("1e{decade}"),
    }
}

/// A digit times a power of ten.
fn small(digit: i32, decade: i32) -> String {
    match decade {
        0..=4 => format!("{digit}{}", "0".repeat(decade as usize)),
        -3..=-1 => format!("0.{}{digit}", "0".repeat(decade.unsigned_abs() as usize - 1)),
        decade => format!("{digit}e{decade}"),
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

    #[test]
    fn logarithms_have_powers_of_ten_or_simple_numbers() {
        let labels = |low, high| -> Vec<String> {
            Axis::logarithmic(low, high, 6).ticks.into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels(1e-13, 1e-3), ["1e-13", "1e-11", "1e-9", "1e-7", "1e-5", "1e-3"]);
        assert_eq!(labels(0.025, 1.6), ["0.05", "0.1", "0.2", "0.5", "1"]);
        assert_eq!(labels(90.0, 2500.0), ["100", "200", "500", "1000", "2000"]);
        let axis = Axis::logarithmic(1e-3, 1e3, 6);
        assert!((axis.share(1.0) - 0.5).abs() < 1e-12 && axis.share(-1.0) == 0.0);
        assert_eq!(axis.share(0.0), 0.0);
        assert!(Axis::logarithmic(0.0, 0.0, 5).share(1.0).is_finite());
    }
}
