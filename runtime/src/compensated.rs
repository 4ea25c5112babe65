//! Steps whose rounding does not pile up: compensated accumulation of g and μ.
//!
//! A step changes the state by something of size h, so rounding the *change* costs h times less
//! than rounding the state. What the state cannot hold is carried along and added to the next
//! change (Kahan 1965; for geometric integrators Hairer, Lubich and Wanner, *Geometric Numerical
//! Integration*, VIII.5).

use core::fmt::{self, Debug};

use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf};
use crate::group::LieGroup;
use crate::phase::Phase;
use crate::reconstruct::StepReport;
use crate::scalar::Scalar;
use crate::solve::solve;

/// A group whose elements and momenta can be moved by small increments without cancellation.
pub trait CompensatedGroup: LieGroup {
    /// What an element's last rounding left over.
    type Remainder: Clone + Debug;

    /// Nothing left over.
    fn no_remainder(&self) -> Self::Remainder;

    /// Ad\*_{k⁻¹} μ − μ for an increment k near the neutral element, accurate relative to its own
    /// size.
    fn momentum_change(&self, k: &Self::Element, mu: &Self::Vector) -> Self::Vector;

    /// Replaces g by g·k, carrying the rounding along in `remainder`.
    fn compose_compensated(
        &self,
        g: &mut Self::Element,
        remainder: &mut Self::Remainder,
        k: &Self::Element,
    );
}

/// sum + (change − remainder), with the new remainder: Kahan's step.
#[inline(always)]
pub(crate) fn kahan<T: Scalar>(sum: &mut T, remainder: &mut T, change: T) {
    let corrected = change - *remainder;
    let next = *sum + corrected;
    *remainder = (next - *sum) - corrected;
    *sum = next;
}

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

    /// (g, μ) ↦ (g·k, Ad\*_{k⁻¹} μ).
    #[inline(always)]
    fn displace(&mut self, group: &G, k: &G::Element) {
        let change = group.momentum_change(k, &self.phase.momentum);
        for i in 0..change.dim() {
            kahan(&mut self.phase.momentum[i], &mut self.momentum_remainder[i], change[i]);
        }
        group.compose_compensated(&mut self.phase.group_element, &mut self.element_remainder, k);
    }

    /// The phase point, rounded; what rounding left over is dropped.
    #[must_use]
    pub fn into_phase(self) -> Phase<G> {
        self.phase
    }
}

impl<G: CompensatedGroup> Clone for CompensatedPhase<G> {
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

/// [`advance`](crate::advance) with compensated accumulation: two digits more over long runs.
///
/// # Errors
/// As [`solve`]; `state` is then left as it was.
#[inline(always)]
pub fn advance_compensated<S>(
    generating: &S,
    state: &mut CompensatedPhase<S::Group>,
) -> Result<StepReport<ScalarOf<S>>, StepError>
where
    S: GeneratingFunction + ?Sized,
    S::Group: CompensatedGroup,
{
    let group = generating.group();
    let mu = &state.phase.momentum;
    let solution = solve(generating, mu)?;
    let increment = generating.chart().transport(group, &solution.x, mu).0;
    state.displace(group, &increment);
    let mut part = 0;
    while let Some(y) = generating.frame(part, &state.phase.momentum) {
        state.displace(group, &group.exp(&y));
        part += 1;
    }
    Ok(StepReport { iterations: solution.iterations, residual: solution.residual })
}
