//! Why a step was refused, in words.

use coadjoint_program::{Attempt, Kernel, Stepper};

use crate::system::System;

/// Halves of a refused step that are tried.
const MOST_HALVINGS: u32 = 20;

/// Why the kernel refuses the next step from (g, μ), as `emit --language c` tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// μ is not finite.
    NotFinite,
    /// |μ| is beyond the radius up to which the truncated series means something.
    BeyondSeries,
    /// The equation of the step was not solved to rounding near the first guess.
    NotSolved,
    /// The increment of the step is beyond the chart.
    BeyondChart,
    /// The group element has left the group.
    OffGroup,
}

impl Reason {
    /// The reason.
    #[must_use]
    pub fn of(kernel: &Kernel, slots: &[f64], mu: &[f64]) -> Self {
        if !mu.iter().all(|entry| entry.is_finite()) {
            return Self::NotFinite;
        }
        let square: f64 = mu.iter().map(|entry| entry * entry).sum();
        if !slots.last().is_some_and(|&limit| square <= limit) {
            return Self::BeyondSeries;
        }
        let Attempt { residual_bound, distance, accepted, .. } = kernel.attempt(slots, mu);
        if !(residual_bound <= kernel.tolerance() && distance <= kernel.near()) {
            return Self::NotSolved;
        }
        if accepted { Self::OffGroup } else { Self::BeyondChart }
    }

    /// It, for people.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::NotFinite => "the momentum is no longer a finite number",
            Self::BeyondSeries => {
                "beyond the series: the momentum is so large for this step size that the last terms of S no longer shrink"
            }
            Self::NotSolved => {
                "not solved: the equation of the step has no solution to rounding near the first guess"
            }
            Self::BeyondChart => {
                "beyond the chart: the body would turn farther in one step than the programs accept"
            }
            Self::OffGroup => "off the group: rounding has carried the group element away",
        }
    }
}

/// The longest of h/2, h/4, … with which the step can be made.
#[must_use]
pub fn usable(system: &System, g: &[f64], mu: &[f64]) -> Option<f64> {
    let mut shorter = system.h;
    (0..MOST_HALVINGS).find_map(|_| {
        shorter *= 0.5;
        let slots = system.step.fold(shorter, &[]).unwrap_or_default();
        let made = system.step.kernel().advance(&slots, &mut g.to_vec(), &mut mu.to_vec(), 1);
        (made.steps == 1).then_some(shorter)
    })
}
