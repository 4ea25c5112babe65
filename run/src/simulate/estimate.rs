//! The error at the end of a run, estimated by steps of another size beside it.

use coadjoint::StepError;

use super::recorder::Outcome;
use super::sink::Sink;
use super::tally::Warning;
use crate::engine::{Motion, Numbers};

/// The most steps that an estimate takes: 3 % of a run of ten thousand.
const MOST: u64 = 288;
/// Parts of a run that is too long to be gone along as a whole, at whose ends states are compared.
const PARTS: u64 = 16;
/// Why a run that an event has ended has no estimate.
pub(crate) const ENDED: &str = "not known: an event ended the run";
/// Growth that is faster than linear is believed up to this factor: a short beginning may show it by chance.
const FASTER: f64 = 10.0;
/// An error above this is worth a warning.
pub const LARGE: f64 = 0.01;

/// Estimates the error at the end of `steps` steps of `motion` from `start` to `end`: the larger of the relative errors of
/// μ and of the matrix of g, in Euclidean norms. `order` is that of the method, and `other` makes the steps of a size that is
/// given as a multiple of the motion's.
///
/// Beside the run goes one with steps of twice the size, or of half the size where these are refused, and Richardson's
/// extrapolation of the difference is the error (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.4).
/// Of a run that is longer than [`MOST`] allows only the beginning is compared; the error is taken to grow on by the power of
/// the time by which it grows there, to 1 at most. Below the rounding of one unit a step, truncation is not seen.
///
/// # Errors
/// Why there is no estimate.
pub(crate) fn estimate<'a>(
    motion: &dyn Motion,
    other: impl Fn(f64) -> Result<Box<dyn Motion + 'a>, StepError>,
    [start, end]: [&Numbers; 2],
    steps: u64,
    order: u32,
) -> Result<f64, &'static str> {
    let power = 2_f64.powi(order as i32);
    // The steps of the run in the place of which the other makes some, and how many these are.
    for ([own, others], gain) in [([2, 1], 1.0 / (power - 1.0)), ([1, 2], power / (power - 1.0))] {
        let Ok(other) = other(own as f64 / others as f64) else { continue };
        let beside = Beside { motion, other: other.as_ref(), own, others, gain };
        let found = if steps / own * others <= MOST {
            beside.whole(start, end, steps)
        } else {
            beside.beginning(start, steps)
        };
        match found {
            Ok(error) if error.is_finite() => return Ok(error),
            Ok(_) => return Err("not known: it is no finite number"),
            Err(_) => {}
        }
    }
    Err("not known: steps of twice and of half the size are refused")
}

/// The same for a run from `start` in steps of this size over this time, which `make` makes.
///
/// # Errors
/// Why there is no estimate.
pub(crate) fn estimate_from<'a>(
    make: impl Fn(f64) -> Result<Box<dyn Motion + 'a>, StepError>,
    start: &Numbers,
    (step, duration): (f64, f64),
    order: u32,
) -> Result<f64, &'static str> {
    let refused = "not known: steps are refused";
    let motion = make(step).map_err(|_| refused)?;
    let steps = (duration / step).round() as u64;
    let mut end = start.clone();
    // The end of a run that is not gone along as a whole is not looked at.
    if steps <= 2 * MOST + 1 {
        motion.advance(&mut end, 0, steps).map_err(|_| refused)?;
    }
    estimate(motion.as_ref(), |size| make(step * size), [start, &end], steps, order)
}

impl Outcome {
    /// Takes note of an estimate, with a warning where it is large.
    pub(crate) fn estimated(&mut self, found: Result<f64, &'static str>, sink: &mut dyn Sink) {
        self.estimated_error = found;
        if let Ok(error) = found
            && error > LARGE
        {
            let warning = Warning::Inaccurate { error };
            sink.warn(&warning.text());
            self.warnings.push(warning);
        }
    }
}

/// A run and one beside it.
struct Beside<'a> {
    motion: &'a dyn Motion,
    other: &'a dyn Motion,
    own: u64,
    others: u64,
    /// The error as a multiple of the difference.
    gain: f64,
}

impl Beside<'_> {
    /// The error at the end of a run that is followed as a whole.
    fn whole(&self, start: &Numbers, end: &Numbers, steps: u64) -> Result<f64, (u64, StepError)> {
        let mut beside = start.clone();
        let left = steps % self.own;
        self.follow(&mut beside, 0, steps / self.own * self.others)?;
        self.motion.advance(&mut beside, steps - left, left)?;
        Ok(self.error(end, &beside, steps))
    }

    /// The error at the end of a run of which the beginning is followed.
    fn beginning(&self, start: &Numbers, steps: u64) -> Result<f64, (u64, StepError)> {
        let part = MOST / (self.own + self.others) / PARTS;
        let (mut here, mut beside) = (start.clone(), start.clone());
        let (mut half, mut whole) = (0.0, 0.0);
        for number in 1..=PARTS {
            let (own, others) = (part * self.own, part * self.others);
            self.motion.advance(&mut here, (number - 1) * own, own)?;
            self.follow(&mut beside, (number - 1) * others, others)?;
            whole = self.error(&here, &beside, number * own).max(whole);
            if 2 * number == PARTS {
                half = whole;
            }
        }
        let longer = steps as f64 / (PARTS * part * self.own) as f64;
        let power = if half > 0.0 { (whole / half).log2() } else { 1.0 };
        let growth = longer.powf(power).min(longer * FASTER);
        Ok(whole.max((whole * growth).min(1.0)))
    }

    /// Makes steps of the other size; long ones that programs refuse are not made by other means, which would take long.
    fn follow(&self, state: &mut Numbers, first: u64, count: u64) -> Result<(), (u64, StepError)> {
        match self.other.lanes() {
            Some(programs) if self.own > self.others => {
                let refused = |_: &mut Numbers, _| Err(StepError::InvalidStep { step: f64::NAN });
                let start = self.other.grid().start;
                programs.advance(state, start, [first, count], refused).map(drop)
            }
            _ => self.other.advance(state, first, count).map(drop),
        }
    }

    /// The error of a state after this many steps of the run, by the one beside it.
    fn error(&self, here: &Numbers, beside: &Numbers, steps: u64) -> f64 {
        let space = self.motion.space();
        let attitudes = [space.matrix(&here.g), space.matrix(&beside.g)];
        let apart = apart(&here.mu, &beside.mu).max(apart(&attitudes[0], &attitudes[1]));
        (apart * self.gain).max(apart.min(steps as f64 * f64::EPSILON))
    }
}

/// The difference of two vectors, relative to the first.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    let difference = norm(&mut a.iter().zip(b).map(|(a, b)| a - b));
    if difference == 0.0 { 0.0 } else { difference / norm(&mut a.iter().copied()) }
}
