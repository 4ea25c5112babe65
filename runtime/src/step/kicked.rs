//! Forces that break the symmetry: kicks between generated flows.

use coadjoint_program::splitting::Splitting;

use crate::error::StepError;
use crate::generating::{ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::solve::Integrator;
use crate::step::advance;

/// One step of H_red(μ) + V(t, g): the generated flows of H_red and kicks by the torque of V,
/// composed by a splitting.
///
/// A kick is μ ← μ + h·τ(t, g) with the body torque τ = −g⁻¹·dV, coordinates
/// τ_j = −d/ds V(t, g·exp(s eⱼ)) at s = 0. Kicks of a potential are symplectic on T\*G, and so is
/// the whole step; a torque without potential is allowed but then nothing is symplectic. Time
/// advances with the flows, so that a torque may depend on it. The order of accuracy is the lesser
/// of the splitting's and the flows' (truncation + 1).
///
/// ```
/// use coadjoint::{LieGroup, Phase, SO3};
/// use coadjoint::generating::PolynomialFunction;
/// use coadjoint::groups::Exponential;
/// use coadjoint::steps::{Kicked, Splitting};
/// use nalgebra::Vector3;
///
/// // A heavy top: V = m·g·l times the height of the body's third axis; torque mgl e₃ × Rᵀ(−ẑ).
/// let flow = |h: f64| {
///     let terms = [1.5, 1.5, 1.0].iter().enumerate().map(|(i, m)| (0.5 * h / m, vec![(i, 2)]));
///     let map = PolynomialFunction::new(SO3::new(), Exponential, terms.collect::<Vec<_>>());
///     Ok(map.expect("three coordinates"))
/// };
/// let torque = |_time: f64, attitude: &nalgebra::UnitQuaternion<f64>| {
///     Vector3::z().cross(&(attitude.inverse() * -Vector3::z()))
/// };
/// let step = Kicked::new(Splitting::Rkn4, 0.01, torque, flow)?;
/// let mut top = Phase::new(SO3::new().exp(&Vector3::new(0.3, 0.0, 0.0)), Vector3::new(0.0, 0.0, 5.0));
/// for n in 0..100 {
///     step.advance(&mut top, 0.01 * f64::from(n))?;
/// }
/// assert!((top.momentum.z - 5.0).abs() < 1e-12); // the third axis feels no torque
/// # Ok::<(), coadjoint::StepError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Kicked<S: Integrator, F> {
    flows: Flows<S>,
    torque: F,
}

/// The flows of a step, between which anything may be done with a state.
#[derive(Clone, Debug)]
pub struct Flows<S: Integrator> {
    splitting: Splitting,
    step: ScalarOf<S>,
    /// The first half of the splitting's.
    flows: [Option<S>; Splitting::MAX_FLOWS],
}

impl<S: Integrator> Flows<S> {
    /// As in [`Kicked::new`].
    ///
    /// # Errors
    /// The error of `flow`.
    pub fn new(
        splitting: Splitting,
        step: ScalarOf<S>,
        mut flow: impl FnMut(ScalarOf<S>) -> Result<S, StepError>,
    ) -> Result<Self, StepError> {
        let mut flows = [const { None }; Splitting::MAX_FLOWS];
        let different = splitting.flows().len().div_ceil(2);
        for (place, part) in flows.iter_mut().zip(splitting.flows().take(different)) {
            *place = Some(flow(step * ScalarOf::<S>::of(part))?);
        }
        Ok(Self { splitting, step, flows })
    }

    /// Advances the state, given at `time`, by one step; `kick` is given the state, the time, and the length of the kick.
    ///
    /// # Errors
    /// [`StepError`] as for [`advance`], and that of `kick`; `phase` is then left as it was.
    pub fn advance(
        &self,
        phase: &mut Phase<S::Group>,
        time: ScalarOf<S>,
        mut kick: impl FnMut(&mut Phase<S::Group>, ScalarOf<S>, ScalarOf<S>) -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        let last = self.splitting.flows().len() - 1;
        compose(
            self.splitting,
            phase,
            [time, self.step],
            |piece, state, time, length| match piece {
                Piece::Kick => kick(state, time, length),
                Piece::Flow(stage) => match self.flows.get(stage.min(last - stage)) {
                    Some(Some(flow)) => advance(flow, state).map(drop),
                    _ => Ok(()),
                },
            },
        )
    }
}

/// A piece of a step of kicks and flows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece {
    /// A kick.
    Kick,
    /// The flow of this number, from 0.
    Flow(usize),
}

/// Advances the state, given at `time`, by one step of kicks and flows. `make` makes each piece of a state from a time on, with
/// its length; time advances with the flows.
///
/// # Errors
/// Errors of `make`, and [`StepError::NonFiniteState`]; `phase` is then left as it was.
pub fn compose<G: LieGroup>(
    splitting: Splitting,
    phase: &mut Phase<G>,
    [mut time, step]: [G::Scalar; 2],
    mut make: impl FnMut(Piece, &mut Phase<G>, G::Scalar, G::Scalar) -> Result<(), StepError>,
) -> Result<(), StepError> {
    let mut state = phase.clone();
    let mut parts = splitting.flows().enumerate();
    for part in splitting.kicks() {
        make(Piece::Kick, &mut state, time, step * G::Scalar::of(part))?;
        let Some((stage, part)) = parts.next() else { break };
        let length = step * G::Scalar::of(part);
        make(Piece::Flow(stage), &mut state, time, length)?;
        time += length;
    }
    let dim = state.momentum.dim();
    if (0..dim).any(|i| !state.momentum[i].all_finite()) {
        return Err(StepError::NonFiniteState);
    }
    *phase = state;
    Ok(())
}

impl<S, F> Kicked<S, F>
where
    S: Integrator,
    F: Fn(ScalarOf<S>, &<S::Group as LieGroup>::Element) -> VectorOf<S>,
{
    /// The integrator of this step. `flow` makes the generating function of H_red for a step of
    /// its own, which may be negative; it is called once for each different length needed.
    ///
    /// # Errors
    /// The error of `flow`.
    pub fn new(
        splitting: Splitting,
        step: ScalarOf<S>,
        torque: F,
        flow: impl FnMut(ScalarOf<S>) -> Result<S, StepError>,
    ) -> Result<Self, StepError> {
        Ok(Self { flows: Flows::new(splitting, step, flow)?, torque })
    }

    /// The step size.
    pub fn step(&self) -> ScalarOf<S> {
        self.flows.step
    }

    /// Advances the state, given at `time`, by one step.
    ///
    /// # Errors
    /// [`StepError`] as for [`advance`], and for a torque that is not finite; `phase` is then left
    /// as it was.
    pub fn advance(&self, phase: &mut Phase<S::Group>, time: ScalarOf<S>) -> Result<(), StepError> {
        self.flows.advance(phase, time, |state, time, length| {
            let torque = (self.torque)(time, &state.group_element);
            let mu = &state.momentum;
            state.momentum =
                VectorOf::<S>::from_entries(mu.dim(), |i| torque[i].times_plus(length, mu[i]));
            Ok(())
        })
    }
}
