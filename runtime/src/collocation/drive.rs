//! Velocities and torques beside a Hamiltonian.

use super::energy::Undefined;
use crate::error::StepError;
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// A velocity and a torque beside a Hamiltonian: ġ = g ξ, μ̇ = ad\*_ξ μ + τ with ξ = ω + η, ω = ∂H/∂μ.
///
/// A velocity η, whatever it is, keeps Casimirs and the spatial momentum; a torque τ changes the spatial momentum by its integral, and
/// keeps each component along which it does not act. Steps with a drive are not symplectic. A closure of t, g, μ and ω is one, and gives η
/// and τ, both in body coordinates:
///
/// ```
/// use coadjoint::collocation::Collocation;
/// use coadjoint::{Phase, SO3};
/// use nalgebra::Vector3;
///
/// let inertia = Vector3::new(1.0, 2.0, 3.0);
/// let energy = (
///     move |_time: f64, mu: &Vector3<f64>| 0.5 * mu.dot(&mu.component_div(&inertia)),
///     move |_time: f64, mu: &Vector3<f64>| mu.component_div(&inertia),
/// );
/// // Friction that grows with the momentum.
/// let drag = |_: f64, _: &_, mu: &Vector3<f64>, _: &_| [Vector3::zeros(), -0.1 * mu.norm() * mu];
/// let mut step = Collocation::<_, _, 3, _>::driven(SO3::new(), energy, drag, 0.1)?;
/// let mut body = Phase::<SO3>::at_identity([2.0, 0.3, 0.1]);
/// let size = body.momentum.norm();
/// step.advance_by(&mut body, 0.0, 100)?;
/// assert!((body.momentum.norm() - size / (1.0 + 0.1 * size * 10.0)).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Drive<G: LieGroup<Scalar = f64>> {
    /// False where nothing acts.
    const ACTS: bool = true;

    /// η and τ at this time, in body coordinates. Not finite where one is not defined.
    fn acting(
        &self,
        time: f64,
        g: &G::Element,
        mu: &G::Vector,
        omega: &G::Vector,
    ) -> [G::Vector; 2];

    /// The expression that is outside its domain there; `None` if η and τ are finite.
    fn undefined(
        &self,
        time: f64,
        g: &G::Element,
        mu: &G::Vector,
        omega: &G::Vector,
    ) -> Option<Undefined> {
        let _ = (time, g, mu, omega);
        None
    }
}

/// Nothing.
impl<G: LieGroup<Scalar = f64>> Drive<G> for () {
    const ACTS: bool = false;

    fn acting(&self, _: f64, _: &G::Element, mu: &G::Vector, _: &G::Vector) -> [G::Vector; 2] {
        [G::Vector::zeros(mu.dim()), G::Vector::zeros(mu.dim())]
    }
}

impl<G, F> Drive<G> for F
where
    G: LieGroup<Scalar = f64>,
    F: Fn(f64, &G::Element, &G::Vector, &G::Vector) -> [G::Vector; 2],
{
    #[inline(always)]
    fn acting(
        &self,
        time: f64,
        g: &G::Element,
        mu: &G::Vector,
        omega: &G::Vector,
    ) -> [G::Vector; 2] {
        self(time, g, mu, omega)
    }
}

/// The damping that earlier versions composed with steps.
#[deprecated = "give `DoubleBracket` to `Collocation::driven`: damping acts within the step, at its order"]
#[derive(Debug)]
pub enum Damping {}

/// Damping by the double bracket: η = Γ ad\*_ω μ with Γ diagonal in the group's basis (A. Bloch, P. S. Krishnaprasad, J. E. Marsden,
/// T. S. Ratiu, Commun. Math. Phys. 175, 1996). The energy falls at the rate ⟨a, Γa⟩, a = ad\*_ω μ, where no number of Γ is negative.
///
/// ```
/// use coadjoint::collocation::{Collocation, DoubleBracket};
/// use coadjoint::{Phase, SO3};
/// use nalgebra::Vector3;
///
/// let inertia = Vector3::new(1.0, 2.0, 3.0);
/// let energy = (
///     move |_time: f64, mu: &Vector3<f64>| 0.5 * mu.dot(&mu.component_div(&inertia)),
///     move |_time: f64, mu: &Vector3<f64>| mu.component_div(&inertia),
/// );
/// let damping = DoubleBracket::new(SO3::new(), Vector3::repeat(0.2))?;
/// let mut step = Collocation::<_, _, 2, _>::driven(SO3::new(), energy, damping, 0.1)?;
/// let mut body = Phase::<SO3>::at_identity([2.0, 0.3, 0.1]);
/// let size = body.momentum.norm();
/// step.advance_by(&mut body, 0.0, 3000)?;
/// // The body ends turning about its major axis, with all of its momentum.
/// assert!((body.momentum.z.abs() - size).abs() < 1e-12);
/// assert!((body.spatial_momentum(&SO3::new()).x - 2.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct DoubleBracket<G: LieGroup<Scalar = f64>> {
    group: G,
    rates: G::Vector,
}

impl<G: LieGroup<Scalar = f64>> DoubleBracket<G> {
    /// With the diagonal of Γ.
    ///
    /// # Errors
    /// [`StepError::InvalidParameter`] where a number of it is not finite.
    pub fn new(group: G, rates: G::Vector) -> Result<Self, StepError> {
        let mut numbers = (0..rates.dim()).map(|i| rates[i]);
        match numbers.find(|value| !value.all_finite()) {
            Some(value) => Err(StepError::InvalidParameter { name: "of the damping", value }),
            None => Ok(Self { group, rates }),
        }
    }
}

impl<G: LieGroup<Scalar = f64>> Drive<G> for DoubleBracket<G> {
    #[inline(always)]
    fn acting(&self, _: f64, _: &G::Element, mu: &G::Vector, omega: &G::Vector) -> [G::Vector; 2] {
        let force = self.group.ad_star(omega, mu);
        let velocity = G::Vector::from_entries(mu.dim(), |i| self.rates[i] * force[i]);
        [velocity, G::Vector::zeros(mu.dim())]
    }
}
