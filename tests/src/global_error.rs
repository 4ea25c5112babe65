//! Global errors of free bodies with plain, tuned and fitted series: what choosing coefficients is worth along whole
//! motions.

use std::fmt;

use coadjoint::tune::fit;
use coadjoint::{
    CompensatedPhase, Integrator, Phase, SO3, StepError, advance_compensated, lie_poisson,
};

use crate::stress::Random;

/// Where motions end.
pub const TIME: f64 = 100.0;
/// Moments of inertia.
pub const BODIES: [[f64; 3]; 3] = [[1.5, 2.0, 2.5], [1.3, 2.1, 3.0], [1.0, 1.5, 2.4]];
/// Errors below this count as this: they are rounding.
const ROUNDING: f64 = 1e-12;
/// Time over which a motion is followed for a fit.
const FOLLOWED: f64 = 50.0;
/// Steps of a reference, with K = 11 and compensated.
const REFERENCE_STEPS: u32 = 2400;

macro_rules! bodies {
    ($($module:ident, $truncation:literal, $frame:ident;)*) => {
        $(mod $module {
            use super::*;

            #[lie_poisson(group = SO3, truncation = $truncation, frame = $frame)]
            pub fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
                0.5 * (mu[0] * mu[0] / inertia[0]
                    + mu[1] * mu[1] / inertia[1]
                    + mu[2] * mu[2] / inertia[2])
            }

            pub fn errors(inertia: [f64; 3], h: f64, mu: [f64; 3]) -> Option<Errors> {
                let steps = (TIME / h).ceil();
                let h = TIME / steps;
                let plain = Body::new(h, inertia).ok()?;
                let tuned = Body::tuned(h, inertia, [mu]).ok()?;
                let fitted = fit(h, |h| Body::new(h, inertia), [mu], FOLLOWED).ok()?.integrator;
                let exact = reference(inertia, mu).ok()?;
                let error = |step| Some(distance(&run(step, mu, steps as u32).ok()?, &exact));
                Some(Errors { plain: error(&plain)?, tuned: error(&tuned)?, fitted: error(&fitted)? })
            }
        })*

        /// The errors by a truncation in a frame; none where a step is refused, or where there is no such integrator.
        #[must_use]
        pub fn errors(cell: &Cell, inertia: [f64; 3], mu: [f64; 3]) -> Option<Errors> {
            match (cell.truncation, cell.frame) {
                $(($truncation, stringify!($frame)) => $module::errors(inertia, cell.step, mu),)*
                _ => None,
            }
        }
    };
}

bodies! {
    seventh, 7, fixed;
    ninth, 9, fixed;
    eleventh, 11, fixed;
    comoving_seventh, 7, comoving;
    comoving_ninth, 9, comoving;
    comoving_eleventh, 11, comoving;
}

/// A way to integrate.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// K.
    pub truncation: u32,
    /// `fixed` or `comoving`.
    pub frame: &'static str,
    /// h.
    pub step: f64,
}

/// Truncations, frames and step sizes that users would take for momenta between 0.5 and 2.5.
pub const CELLS: [Cell; 18] = {
    const fn cell(truncation: u32, frame: &'static str, step: f64) -> Cell {
        Cell { truncation, frame, step }
    }
    [
        cell(7, "fixed", 0.1),
        cell(7, "fixed", 0.2),
        cell(7, "fixed", 0.4),
        cell(9, "fixed", 0.2),
        cell(9, "fixed", 0.4),
        cell(9, "fixed", 0.6),
        cell(11, "fixed", 0.2),
        cell(11, "fixed", 0.4),
        cell(11, "fixed", 0.8),
        cell(7, "comoving", 0.2),
        cell(7, "comoving", 0.4),
        cell(7, "comoving", 0.8),
        cell(9, "comoving", 0.3),
        cell(9, "comoving", 0.6),
        cell(9, "comoving", 1.0),
        cell(11, "comoving", 0.4),
        cell(11, "comoving", 0.8),
        cell(11, "comoving", 1.2),
    ]
};

/// The errors at [`TIME`]: the larger of the angle between attitudes and the momentum's difference relative to it.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Of the series as it is.
    pub plain: f64,
    /// With its tail summed.
    pub tuned: f64,
    /// With coefficients fitted.
    pub fitted: f64,
}

fn run<S: Integrator<Group = SO3>>(
    step: &S,
    mu: [f64; 3],
    steps: u32,
) -> Result<Phase<SO3>, StepError> {
    let mut state = CompensatedPhase::new(&SO3::new(), Phase::at_identity(mu));
    for _ in 0..steps {
        advance_compensated(step, &mut state)?;
    }
    Ok(state.into_phase())
}

fn reference(inertia: [f64; 3], mu: [f64; 3]) -> Result<Phase<SO3>, StepError> {
    let step = eleventh::Body::new(TIME / f64::from(REFERENCE_STEPS), inertia)?;
    run(&step, mu, REFERENCE_STEPS)
}

fn distance(found: &Phase<SO3>, exact: &Phase<SO3>) -> f64 {
    let angle = found.group_element.angle_to(&exact.group_element);
    angle.max((found.momentum - exact.momentum).amax() / exact.momentum.norm())
}

/// The errors of so many random momenta of each body, the same for every cell.
#[must_use]
pub fn sample(cell: &Cell, momenta: usize) -> Vec<Errors> {
    let mut found = Vec::new();
    for (seed, inertia) in BODIES.into_iter().enumerate() {
        let mut random = Random::new(seed as u64);
        for _ in 0..momenta {
            let direction = random.direction(3);
            let size = random.between(0.5, 2.5);
            let mu = [0, 1, 2].map(|i| size * direction[i]);
            found.extend(errors(cell, inertia, mu));
        }
    }
    found
}

/// How errors compare with those of the plain series.
#[derive(Clone, Copy, Debug)]
pub struct Comparison {
    /// How many were compared.
    pub count: usize,
    /// How many are more than 1.1 times the plain one's.
    pub worse: usize,
    /// The largest ratio.
    pub worst: f64,
    /// The geometric mean of the ratios.
    pub mean: f64,
}

impl Comparison {
    /// Of what `chosen` picks.
    #[must_use]
    pub fn of(errors: &[Errors], chosen: impl Fn(&Errors) -> f64) -> Self {
        let ratio = |e: &Errors| chosen(e).max(ROUNDING) / e.plain.max(ROUNDING);
        let ratios: Vec<f64> = errors.iter().map(ratio).collect();
        let logs: f64 = ratios.iter().map(|ratio| ratio.ln()).sum();
        Self {
            count: ratios.len(),
            worse: ratios.iter().filter(|ratio| ratio.is_nan() || **ratio > 1.1).count(),
            worst: ratios
                .iter()
                .fold(0.0, |worst, &ratio| if ratio <= worst { worst } else { ratio }),
            mean: (logs / ratios.len().max(1) as f64).exp(),
        }
    }

    /// At least 99 % at most 1.1 times the plain one's error, and none over twice.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.count > 0 && 100 * self.worse <= self.count && self.worst <= 2.0
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, worse, worst, mean } = self;
        write!(f, "{worse} of {count} worse than 1.1 times, worst {worst:.2}, mean {mean:.4}")
    }
}
