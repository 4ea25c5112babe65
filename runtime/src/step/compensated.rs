//! Steps whose rounding does not pile up: compensated accumulation of g and μ.
//!
//! A step changes the state by something of size h, so rounding the *change* costs h times less
//! than rounding the state. What the state cannot hold is carried along and added to the next
//! change (Kahan 1965; for geometric integrators Hairer, Lubich and Wanner, *Geometric Numerical
//! Integration*, VIII.5).

use core::fmt::{self, Debug};

use super::moves::Moves;
use super::phase::Phase;
use super::{StepReport, check, single};
use crate::error::StepError;
use crate::generating::ScalarOf;
use crate::group::compensated::{CompensatedGroup, kahan};
use crate::linear::coordinates::Coordinates;
use crate::solve::{Integrator, Settings};

/// A phase point with what rounding has left over so far.
pub struct CompensatedPhase<G: CompensatedGroup> {
    phase: Phase<G>,
    element_remainder: G::Remainder,
    momentum_remainder: G::Vector,
}

impl<G: CompensatedGroup> CompensatedPhase<G> {
    /// Starts at `phase`, taken as exact.
    #[must_use]
    pub fn new(group: &G, phase: Phase<G>) -> Self {
        let momentum_remainder = G::Vector::zeros(group.dim());
        Self { phase, element_remainder: group.no_remainder(), momentum_remainder }
    }

    /// The phase point, rounded.
    #[must_use]
    pub fn phase(&self) -> &Phase<G> {
        &self.phase
    }

    /// The phase point, rounded; what rounding left over is dropped.
    #[must_use]
    pub fn into_phase(self) -> Phase<G> {
        self.phase
    }
}

impl<G: CompensatedGroup> Clone for CompensatedPhase<G> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Self {
            phase: self.phase.clone(),
            element_remainder: self.element_remainder.clone(),
            momentum_remainder: self.momentum_remainder.clone(),
        }
    }
}

impl<G: CompensatedGroup> Debug for CompensatedPhase<G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CompensatedPhase")
            .field("phase", &self.phase)
            .field("element_remainder", &self.element_remainder)
            .field("momentum_remainder", &self.momentum_remainder)
            .finish()
    }
}

impl<G: CompensatedGroup> Moves<G> for CompensatedPhase<G> {
    #[inline(always)]
    fn momentum(&self) -> &G::Vector {
        &self.phase.momentum
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn move_by(&mut self, group: &G, k: &G::Element, _: G::Vector) {
        let change = group.momentum_change(k, &self.phase.momentum);
        for i in 0..change.dim() {
            kahan(&mut self.phase.momentum[i], &mut self.momentum_remainder[i], change[i]);
        }
        group.compose_compensated(&mut self.phase.group_element, &mut self.element_remainder, k);
    }

    #[inline(always)]
    fn check(&self, group: &G) -> Result<(), StepError> {
        check(group, &self.phase)
    }
}

/// [`advance`](crate::advance) with compensated accumulation: two digits more over long runs.
///
/// # Errors
/// [`StepError`]; `state` is then left as it was.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn advance_compensated<S>(
    generating: &S,
    state: &mut CompensatedPhase<S::Group>,
) -> Result<StepReport<ScalarOf<S>>, StepError>
where
    S: Integrator + ?Sized,
    S::Group: CompensatedGroup,
{
    single(generating, state, Settings::default())
}
