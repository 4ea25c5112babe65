//! Damping along the coadjoint orbits: steps of the double bracket.

use coadjoint_program::collocation::Nodes;

use super::energy::{Energy, UNKNOWN, Undefined};
use crate::error::{Circumstances, StepError};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::step::{StepReport, check};

/// The most evaluations of the fixed point.
const EVALUATIONS: u32 = 60;

/// The evaluations after which those that converge slowly are extrapolated, and the change below which they do converge.
const PLAIN: u32 = 20;
const CONVERGING: f64 = 1e-2;

/// The change of x that is rounding, in units of it.
const ROUNDINGS: f64 = 8.0;

/// The change below which an evaluation that changes x no less than the one before is down to rounding too: the torque of a
/// potential is made of the entries of g, which grow on groups that are not compact, and its rounding with them.
const STAGNANT: f64 = 1e-12;

/// Damping by the double bracket: ġ = g x and μ̇ = ad\*_x μ with x = Γ ad\*_ω μ, ω = ∂H/∂μ, and Γ diagonal in the group's
/// basis (A. Bloch, P. S. Krishnaprasad, J. E. Marsden, T. S. Ratiu, Commun. Math. Phys. 175, 1996).
///
/// The energy falls at the rate ⟨a, Γa⟩, a = ad\*_ω μ, where no number of Γ is negative. The group acts on the state, so
/// that Casimirs and the spatial momentum are kept to rounding. With ω averaged over the way from μ to μ″ by `M` of Gauss's
/// nodes, and p = (d^R exp_x)ᵀ μ, a step is
///
/// ```text
/// x = h Γ ad*_ω p      g″ = g exp(x)      μ″ = Ad*_{exp(−x)} μ      H(μ″) − H(μ) = −⟨ad*_ω p, x⟩
/// ```
///
/// It is symmetric, of order 2, and its energy is exact for polynomials of degree up to 2`M`. Half a step of it before and after
/// each step of H makes steps of order 2 of the damped motion, whose error is proportional to Γ:
///
/// ```
/// use coadjoint::collocation::{Collocation, Damping};
/// use coadjoint::{Phase, SO3};
/// use nalgebra::Vector3;
///
/// let inertia = Vector3::new(1.0, 2.0, 3.0);
/// let energy = (
///     move |_time: f64, mu: &Vector3<f64>| 0.5 * mu.dot(&mu.component_div(&inertia)),
///     move |_time: f64, mu: &Vector3<f64>| mu.component_div(&inertia),
/// );
/// let mut step = Collocation::<_, _, 2>::new(SO3::new(), energy, 0.1)?;
/// let damping = Damping::<_, _, 1>::new(SO3::new(), energy, Vector3::repeat(0.2))?;
/// let mut body = Phase::<SO3>::at_identity([2.0, 0.3, 0.1]);
/// let size = body.momentum.norm();
/// for n in 0..3000 {
///     let time = 0.1 * f64::from(n);
///     damping.advance(&mut body, time, 0.05)?;
///     step.advance(&mut body, time)?;
///     damping.advance(&mut body, time + 0.1, 0.05)?;
/// }
/// // The body ends turning about its major axis, with all of its momentum.
/// assert!((body.momentum.z.abs() - size).abs() < 1e-12);
/// assert!((body.spatial_momentum(&SO3::new()).x - 2.0).abs() < 1e-12);
/// # Ok::<(), coadjoint::StepError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Damping<G: LieGroup<Scalar = f64>, E, const M: usize> {
    group: G,
    energy: E,
    rates: G::Vector,
}

impl<G, E, const M: usize> Damping<G, E, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    const NODES: Nodes<M> = Nodes::new();

    /// With the diagonal of Γ.
    ///
    /// # Errors
    /// [`StepError::InvalidParameter`] where a number of it is not finite.
    pub fn new(group: G, energy: E, rates: G::Vector) -> Result<Self, StepError> {
        let mut numbers = (0..rates.dim()).map(|i| rates[i]);
        if let Some(value) = numbers.find(|value| !value.all_finite()) {
            return Err(StepError::InvalidParameter { name: "of the damping", value });
        }
        Ok(Self { group, energy, rates })
    }

    /// Advances (g, μ), the state at `time`, by a step of this length, which may be negative, with H as it is at `time`.
    ///
    /// # Errors
    /// [`StepError`]; `phase` is then left as it was.
    pub fn advance(
        &self,
        phase: &mut Phase<G>,
        time: f64,
        length: f64,
    ) -> Result<StepReport<f64>, StepError> {
        let none = G::Vector::zeros(phase.momentum.dim());
        self.advance_with(phase, time, length, |_, _| Ok(none.clone()))
    }

    /// Damps beside a potential V(g) with this body torque τ = −g⁻¹dV, which falls with H: x = h Γ (ad\*_ω p + τ), τ in the
    /// middle g exp(x/2), so that H + V changes by −⟨ad\*_ω p + τ, x⟩, to third order in x.
    ///
    /// # Errors
    /// [`StepError`], also that of `torque`; `phase` is then left as it was.
    pub fn advance_beside(
        &self,
        phase: &mut Phase<G>,
        time: f64,
        length: f64,
        torque: impl Fn(&G::Element) -> Result<G::Vector, StepError>,
    ) -> Result<StepReport<f64>, StepError> {
        self.advance_with(phase, time, length, |g, x| {
            let half = self.group.exp(&G::Vector::from_entries(x.dim(), |i| 0.5 * x[i]));
            torque(&self.group.compose(g, &half))
        })
    }

    /// A step with this torque from g by x.
    fn advance_with(
        &self,
        phase: &mut Phase<G>,
        time: f64,
        length: f64,
        torque: impl Fn(&G::Element, &G::Vector) -> Result<G::Vector, StepError>,
    ) -> Result<StepReport<f64>, StepError> {
        let (group, mu) = (&self.group, &phase.momentum);
        let mut x = G::Vector::zeros(mu.dim());
        if (0..mu.dim()).any(|i| !mu[i].all_finite()) {
            return Err(StepError::NonFiniteState);
        }
        let (mut residual, mut last) = (f64::INFINITY, None::<[G::Vector; 2]>);
        for iterations in 1..=EVALUATIONS {
            let (increment, moved) = group.exp_transport(&x, mu);
            let omega = self.slope(time, mu, &moved);
            let at = Circumstances { x: x.largest_entry(), ratio: 0.0, usable_step: None };
            if (0..mu.dim()).any(|i| !omega[i].all_finite()) {
                let known = self.energy.undefined(time, &moved);
                let Undefined { expression, argument } = known.unwrap_or(UNKNOWN);
                // At the start no length is short enough.
                let at = (iterations > 1).then_some(at);
                return Err(StepError::Undefined { expression, argument, time, at });
            }
            let p = group.dexp_transpose(&x, mu);
            let force = group.ad_star(&omega, &p);
            let torque = torque(&phase.group_element, &x)?;
            let next = G::Vector::from_entries(mu.dim(), |i| {
                length * self.rates[i] * (force[i] + torque[i])
            });
            // Of the products of which the force is made.
            let size = length.abs()
                * self.rates.largest_entry()
                * (omega.largest_entry() * p.largest_entry() + torque.largest_entry());
            let change = next.clone().minus(&x).largest_entry();
            let before = residual;
            residual = if change == 0.0 { 0.0 } else { change / size };
            let stagnant = residual >= before && residual <= STAGNANT;
            if residual <= ROUNDINGS * f64::EPSILON || stagnant {
                let element = group.compose(&phase.group_element, &increment);
                let next = Phase { group_element: element, momentum: moved };
                check(group, &next)?;
                *phase = next;
                return Ok(StepReport { iterations, residual });
            }
            let step = next.clone().minus(&x);
            x = match last {
                Some([before, image]) if iterations > PLAIN && residual < CONVERGING => {
                    secant([&next, &image], [&step, &before])
                }
                _ => next.clone(),
            };
            last = Some([step, next]);
        }
        let at = Circumstances { x: x.largest_entry(), ratio: 0.0, usable_step: None };
        Err(StepError::NotConverged { iterations: EVALUATIONS, residual, at })
    }

    /// ∂H/∂μ, averaged over the way between two momenta.
    fn slope(&self, time: f64, from: &G::Vector, to: &G::Vector) -> G::Vector {
        let dim = from.dim();
        let mut mean = G::Vector::zeros(dim);
        for (place, weight) in Self::NODES.times.into_iter().zip(Self::NODES.weights) {
            let share = 0.5 + place;
            let mu = G::Vector::from_entries(dim, |i| (to[i] - from[i]).times_plus(share, from[i]));
            let slope = self.energy.gradient(time, &mu);
            mean = G::Vector::from_entries(dim, |i| slope[i].times_plus(weight, mean[i]));
        }
        mean
    }
}

/// The fixed point, from the last two images of the map and the changes by which it made them, to first order along their
/// difference (D. G. Anderson, J. ACM 12, 1965, with one step of memory).
fn secant<V: Coordinates<f64>>([next, image]: [&V; 2], [step, before]: [&V; 2]) -> V {
    let bend = step.clone().minus(before);
    let size = bend.pairing(&bend);
    let share = if size > 0.0 { step.pairing(&bend) / size } else { 0.0 };
    V::from_entries(next.dim(), |i| (image[i] - next[i]).times_plus(share, next[i]))
}
