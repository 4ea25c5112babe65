//! Drifts of conserved quantities since the start of a run: their one definition.

/// The largest differences from the start, each relative to its [scale](Scales). `None` where a quantity is not known, is
/// not conserved, or cannot be measured: an unknown drift is never 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// The drift of the spatial momentum J_L, or of its components that a potential leaves conserved.
    pub spatial_momentum: Option<f64>,
    /// The drift of the Casimirs.
    pub casimirs: Option<f64>,
    /// The drift of the energy.
    pub energy: Option<f64>,
}

impl Drift {
    /// Takes the larger of each; NaN where one is NaN, and the other where one is `None`.
    pub fn raise(&mut self, other: Self) {
        let larger = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(maximum(a, b)),
            (a, b) => a.or(b),
        };
        self.spatial_momentum = larger(self.spatial_momentum, other.spatial_momentum);
        self.casimirs = larger(self.casimirs, other.casimirs);
        self.energy = larger(self.energy, other.energy);
    }

    /// Spatial momentum, Casimirs, energy; NaN for `None`.
    pub fn numbers(self) -> [f64; 3] {
        let number = |drift: Option<f64>| drift.unwrap_or(f64::NAN);
        [number(self.spatial_momentum), number(self.casimirs), number(self.energy)]
    }

    /// The inverse of [`Self::numbers`].
    pub fn of_numbers(numbers: [f64; 3]) -> Self {
        let known = |x: f64| (!x.is_nan()).then_some(x);
        let [spatial_momentum, casimirs, energy] = numbers;
        Self {
            spatial_momentum: known(spatial_momentum),
            casimirs: known(casimirs),
            energy: known(energy),
        }
    }
}

/// The sizes that drifts are relative to; a drift whose scale is 0 is absolute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scales {
    /// The largest coordinate of the spatial momentum at the start.
    pub spatial_momentum: f64,
    /// For each Casimir the sum of the absolute values of its terms at the start: Π·Γ of a top may be 0 there.
    pub casimirs: Vec<f64>,
    /// |E₀|, or where that is rounding the sum of the absolute values of its terms.
    pub energy: f64,
}

/// The start of a run, from which drifts are measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// The conserved quantities: momenta, Casimirs, the energy if there is one.
    pub(super) conserved: Vec<f64>,
    /// The number of momenta among them.
    pub(super) momenta: usize,
    /// The sizes that drifts are relative to.
    pub scales: Scales,
}

impl Scales {
    /// Of a state with this spatial momentum, these sizes of the terms of Casimirs, and this energy with the size of its terms,
    /// which counts where the energy is 0 up to rounding.
    pub(super) fn new(
        spatial: impl IntoIterator<Item = f64>,
        casimirs: Vec<f64>,
        [energy, size]: [f64; 2],
    ) -> Self {
        const ROUNDING: f64 = 64.0 * f64::EPSILON;
        let spatial_momentum = spatial.into_iter().fold(0.0, |size, j| maximum(size, j.abs()));
        let energy = if energy.abs() > ROUNDING * size { energy.abs() } else { size };
        Self { spatial_momentum, casimirs, energy }
    }
}

impl Start {
    /// The conserved quantities there.
    pub fn conserved(&self) -> &[f64] {
        &self.conserved
    }

    /// The components of the spatial momentum that are conserved.
    pub fn momenta(&self) -> &[f64] {
        &self.conserved[..self.momenta]
    }

    /// The drift of a state of which this is conserved.
    pub fn drift(&self, now: &[f64]) -> Drift {
        self.between(&self.conserved, now)
    }

    /// The drift from one to another, on the scales of the start.
    fn between(&self, then: &[f64], now: &[f64]) -> Drift {
        let Self { momenta, scales, .. } = self;
        let change = |at: usize, scale: f64| relative(now[at] - then[at], scale);
        let casimirs = scales.casimirs.iter().enumerate();
        let casimirs = casimirs.map(|(at, &scale)| change(momenta + at, scale));
        let energy = momenta + scales.casimirs.len();
        Drift {
            spatial_momentum: (0..*momenta)
                .map(|at| change(at, scales.spatial_momentum))
                .reduce(maximum),
            casimirs: casimirs.reduce(maximum),
            energy: (energy < then.len()).then(|| change(energy, scales.energy)),
        }
    }

    /// The drift of a state, as far as it can be measured: where rounding of a state alone may move a conserved quantity by
    /// more than 1e-11 of its scale, as it does after long motions in groups that are not compact, there is none. `beside`
    /// is what is conserved of the state whose numbers are [nudged](nudge).
    pub fn measured(&self, now: &[f64], beside: &[f64]) -> Drift {
        let moved = self.between(beside, now).numbers();
        let mut drift = self.drift(now).numbers();
        for (drift, moved) in drift.iter_mut().zip(moved) {
            let moved = moved * (f64::EPSILON / NUDGE);
            // NaN is not measured either.
            if !drift.is_finite() || moved.is_nan() || moved > MEASURABLE {
                *drift = f64::NAN;
            }
        }
        Drift::of_numbers(drift)
    }
}

/// Rounding of a state may move a quantity whose drift is measured by this much, relative to its scale.
pub const MEASURABLE: f64 = 1e-11;

/// The drift that rounding explains after this many steps of what every step conserves: it adds up at random, and each step
/// may round ten times.
pub fn rounding(steps: u64) -> f64 {
    10.0 * MEASURABLE * (steps.max(1) as f64).sqrt()
}

/// Far above rounding, and so small that what is conserved changes in proportion to it.
pub const NUDGE: f64 = 1e-9;

/// Moves each number by 1e-9, relatively, up or down without a pattern.
pub fn nudge(numbers: &mut [f64]) {
    numbers.iter_mut().enumerate().for_each(|(place, number)| *number *= nudged(place));
}

/// The factor by which [`nudge`] moves the number in this place.
pub(super) fn nudged(place: usize) -> f64 {
    let up = (place as u32 + 1).wrapping_mul(0x9e37_79b9).count_ones().is_multiple_of(2);
    if up { 1.0 + NUDGE } else { 1.0 - NUDGE }
}

fn relative(difference: f64, scale: f64) -> f64 {
    if scale == 0.0 { difference.abs() } else { (difference / scale).abs() }
}

/// The larger of two numbers; NaN where one of them is, unlike `f64::max`.
fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_unknown_has_no_drift_and_nan_stays() {
        let scales = Scales::new([3.0, -4.0], Vec::new(), [0.0; 2]);
        let start = Start { conserved: vec![3.0, -4.0], momenta: 2, scales };
        let mut drift = start.drift(&[3.0, -4.5]);
        assert_eq!(drift, Drift { spatial_momentum: Some(0.125), ..Drift::default() });
        assert_eq!(Drift::of_numbers(drift.numbers()), drift);
        drift.raise(Drift { spatial_momentum: None, casimirs: Some(1.0), energy: Some(f64::NAN) });
        assert_eq!((drift.spatial_momentum, drift.casimirs), (Some(0.125), Some(1.0)));
        drift.raise(Drift { energy: Some(1.0), ..Drift::default() });
        assert!(drift.energy.is_some_and(f64::is_nan));
    }

    #[test]
    fn energies_are_compared_with_their_terms_where_they_are_zero_to_rounding() {
        let scale = |energy: f64, size: f64| Scales::new([], Vec::new(), [energy, size]).energy;
        assert_eq!(scale(-0.0475, 1.4525), 0.0475);
        assert_eq!(scale(1e-17, 1.5), 1.5);
        assert_eq!(scale(0.0, 0.0), 0.0);
    }
}
