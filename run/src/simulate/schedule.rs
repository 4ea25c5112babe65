//! In which steps a run reaches its end.

use std::path::Path;

use coadjoint_codegen::system::Run;

use crate::error::RunError;
use crate::number::shortest;

/// The most steps of a run: beyond, the time is surely a slip.
const MOST_STEPS: f64 = 1e12;
/// T/h may be above a whole number by so much, relatively, without another step: decimals of h are rounded.
const SLACK: f64 = 1e-12;

/// The steps of a run: a whole number of equal ones, the last of which ends at T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// The step size asked for.
    pub asked: f64,
    /// The step size used: T/⌈T/h⌉ with the sign of h, or h itself where h divides T.
    pub step: f64,
    /// How many steps.
    pub steps: u64,
    /// Where the run ends: T with the sign of h.
    pub end: f64,
}

impl Schedule {
    /// The schedule by the options, else by the file.
    ///
    /// # Errors
    /// Where the step or the time is missing or makes no sense.
    pub fn new(
        file: &Path,
        step: Option<f64>,
        time: Option<f64>,
        run: &Run,
    ) -> Result<Self, RunError> {
        let missing =
            |key, example, option| RunError::Missing { file: file.into(), key, example, option };
        let asked = step.or(run.step);
        let asked =
            asked.ok_or_else(|| missing("[integrator] step", "step = 0.1", "--step 0.1"))?;
        let time = time.or(run.time);
        let time = time.ok_or_else(|| missing("[run] time", "time = 100.0", "--time 100"))?;
        Self::of(asked, time)
    }

    /// Steps of about this size that end at this time.
    ///
    /// # Errors
    /// Where the step or the time makes no sense.
    pub fn of(asked: f64, time: f64) -> Result<Self, RunError> {
        let refuse = |what: &str| Err(RunError::Option(what.to_owned()));
        if asked == 0.0 || !asked.is_finite() {
            return refuse("--step must be finite and other than zero; try --step 0.1");
        }
        if time <= 0.0 || !time.is_finite() {
            return refuse("--time must be finite and positive; try --time 100");
        }
        let steps = (time / asked.abs() * (1.0 - SLACK)).ceil().max(1.0);
        if steps > MOST_STEPS {
            return refuse("more than 1e12 steps; take a larger --step or a smaller --time");
        }
        let rounding = 4.0 * f64::EPSILON * time;
        let fits = (steps * asked.abs() - time).abs() <= rounding;
        let step = if fits { asked } else { (time / steps).copysign(asked) };
        if step == 0.0 {
            return refuse("the time is too short to be cut into steps; take a larger --time");
        }
        Ok(Self { asked, step, steps: steps as u64, end: time.copysign(asked) })
    }

    /// The time after `n` steps; the last is the end itself, not what rounding makes of it.
    pub fn time(&self, n: u64) -> f64 {
        if n == self.steps { self.end } else { n as f64 * self.step }
    }

    /// A line about the step, where another is used than was asked for.
    pub fn announcement(&self) -> Option<String> {
        let Self { asked, step, steps, end } = *self;
        (step != asked).then(|| {
            let plural = if steps == 1 { "step ends" } else { "steps end" };
            format!(
                "step {} in place of {}, so that {steps} {plural} at {}",
                shortest(step),
                shortest(asked),
                shortest(end)
            )
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_at_the_time() {
        for (time, step, steps, used) in [
            (50.0, 0.1, 500, 0.1),
            (1000.0, 0.001, 1_000_000, 0.001),
            (50.0, 0.8, 63, 50.0 / 63.0),
            (1.0, 0.333333333333, 3, 1.0 / 3.0),
            (1.0, 0.34, 3, 1.0 / 3.0),
            (0.05, 0.1, 1, 0.05),
            (50.0, -0.8, 63, -50.0 / 63.0),
        ] {
            let run = Run::default();
            let found = Schedule::new(Path::new("x"), Some(step), Some(time), &run).unwrap();
            assert_eq!((found.steps, found.step), (steps, used), "{time} by {step}");
            assert_eq!(found.time(steps), time.copysign(step));
            assert_eq!(found.announcement().is_some(), step != used);
        }
    }
}
