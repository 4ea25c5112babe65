//! Steps of any smooth Hamiltonian H(t, μ): collocation in the exponential chart about the middle of the step.
//!
//! A step needs ∂H/∂μ alone, at `M` nodes, and has order 2M. In the canonical coordinates (x, p) of the chart centred on
//! the middle of the step, in which it goes from −x/2 to x/2, Gauss's method with its `M` nodes is applied to H∘J_R: a
//! method that is symplectic and symmetric in (x, p), and so are they on T\*G. Whatever x is found, the group acts on the
//! state: the momentum J_L and all Casimirs are kept to rounding. With cᵢ, bᵢ, aᵢⱼ Gauss's coefficients and ω = ∂H/∂μ,
//!
//! ```text
//! xᵢ = h Σ (aᵢⱼ − bⱼ/2) ẋⱼ      pᵢ = P + h Σ (aᵢⱼ − bⱼ/2) ṗⱼ      μᵢ = J_R(xᵢ, pᵢ)
//! ẋᵢ = (∂J_R/∂p)ᵀ ωᵢ            ṗᵢ = −(∂J_R/∂x)ᵀ ωᵢ               ωᵢ = ω(t + cᵢ h, μᵢ)
//! x = h Σ bᵢ ẋᵢ                 P: the momentum in the middle of the step from μ by x
//! ```
//!
//! With a [`Drive`], a velocity η and a torque τ of t, g, μ and ω, ωᵢ + ηᵢ takes the place of ωᵢ, and at gᵢ = g exp(x/2) exp(xᵢ)
//!
//! ```text
//! ṗᵢ += (d^R exp_{−xᵢ})ᵀ τᵢ     K = h Σ bᵢ Ad*_{exp(xᵢ)} τᵢ        μ″ = Ad*_{exp(−x)} (μ + Ad*_{exp(x/2)} K)
//! P   = ½ [(d^R exp_{x/2})ᵀ μ + (d^R exp_{−x/2})ᵀ μ″]              which without τ is (d^R exp_x)ᵀ μ
//! ```
//!
//! The order stays 2M. Casimirs and J_L stay without τ, whatever η is; with it J_L changes by h Σ bᵢ (gᵢ·τᵢ), and by nothing else.
//!
//! J_R has the powers of x up to 2M − 2, in closed form on SO(3), SU(2), SE(3) and SE(2); the programs of kernels compute the same
//! map. Gauss's method: E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, II.1.3.

mod drive;
mod energy;
mod following;
mod rates;
mod refused;
mod solving;

pub use coadjoint_program::collocation::MAX_NODES;
#[allow(deprecated)]
pub use drive::Damping;
pub use drive::{DoubleBracket, Drive};
pub use energy::{Energy, Undefined};
#[doc(hidden)]
pub use refused::collocated;

use crate::error::{StepError, Stopped};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::step::{StepReport, check};
use coadjoint_program::collocation::{KEPT, KEPT_LONG, LONG};

use following::Moved;
use rates::{Rates, largest};
use solving::{Attempt, Equations};

/// Steps of size h of the flow of H(t, μ), by collocation at `M` nodes (1 to 8): order 2M.
///
/// ```
/// use coadjoint::collocation::Collocation;
/// use coadjoint::{Phase, SO3};
/// use nalgebra::Vector3;
///
/// // H = √(1 + Σ μᵢ²/Iᵢ), and its gradient.
/// let inertia = Vector3::new(1.5, 2.0, 2.5);
/// let velocity = move |mu: &Vector3<f64>| mu.component_div(&inertia);
/// let root = move |mu: &Vector3<f64>| (1.0 + mu.dot(&velocity(mu))).sqrt();
/// let energy = (
///     move |_time: f64, mu: &Vector3<f64>| root(mu),
///     move |_time: f64, mu: &Vector3<f64>| velocity(mu) / root(mu),
/// );
///
/// let mut step = Collocation::<_, _, 4>::new(SO3::new(), energy, 0.2)?;
/// let mut body = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
/// step.advance_by(&mut body, 0.0, 1000)?;
/// assert!((root(&body.momentum) - root(&Vector3::new(2.0, 0.5, 1.0))).abs() < 1e-10);
/// assert!((body.spatial_momentum(&SO3::new()).x - 2.0).abs() < 1e-13);
/// # Ok::<(), coadjoint::StepError>(())
/// ```
///
/// A step starts from a guess that follows the steps before it, where it goes on from their end; its bits then depend on
/// them, within rounding. A step from any other state starts anew.
#[derive(Clone, Debug)]
pub struct Collocation<G: LieGroup<Scalar = f64>, E, const M: usize, D = ()> {
    group: G,
    energy: E,
    drive: D,
    step: f64,
    /// The rates of the last steps in a ring, and how many were noted since the first guess.
    rates: [Option<Rates<G::Vector, M>>; KEPT],
    noted: usize,
    /// The momentum after the last step.
    end: Option<G::Vector>,
}

impl<G, E, const M: usize> Collocation<G, E, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    /// Steps of size `step`, which may be negative, of the flow of `energy` on a group.
    ///
    /// # Errors
    /// [`StepError::InvalidStep`].
    pub fn new(group: G, energy: E, step: f64) -> Result<Self, StepError> {
        Self::driven(group, energy, (), step)
    }
}

impl<G, E, D, const M: usize> Collocation<G, E, M, D>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
    D: Drive<G>,
{
    /// Steps of size `step`, which may be negative, of the flow of `energy` with a drive beside it.
    ///
    /// # Errors
    /// [`StepError::InvalidStep`].
    pub fn driven(group: G, energy: E, drive: D, step: f64) -> Result<Self, StepError> {
        if step == 0.0 || !step.all_finite() {
            return Err(StepError::InvalidStep { step });
        }
        Ok(Self { group, energy, drive, step, rates: [const { None }; KEPT], noted: 0, end: None })
    }

    /// The step size.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The group.
    #[must_use]
    pub fn group(&self) -> &G {
        &self.group
    }

    /// The Hamiltonian.
    #[must_use]
    pub fn energy(&self) -> &E {
        &self.energy
    }

    /// Advances (g, μ), the state at `time`, by one step. The report counts sweeps, of `M` gradients each.
    ///
    /// # Errors
    /// [`StepError`]; `phase` is then left as it was.
    pub fn advance(
        &mut self,
        phase: &mut Phase<G>,
        time: f64,
    ) -> Result<StepReport<f64>, StepError> {
        let mu = &phase.momentum;
        if (0..mu.dim()).any(|i| !mu[i].all_finite()) {
            return Err(StepError::NonFiniteState);
        }
        if self.end.as_ref() != Some(mu) {
            self.noted = 0;
        }
        let middle = self.step.times_plus(0.5, time);
        let (attempt, (increment, momentum)) = if self.noted > 0 {
            let equations = self.equations(phase, middle);
            let attempt = equations.solve(self.guess(mu.dim()));
            match equations.judge(&attempt, false) {
                Ok(moved) => (attempt, moved),
                Err(_) => self.anew(phase, middle)?,
            }
        } else {
            self.anew(phase, middle)?
        };
        let Attempt { rates, sweeps, residual, .. } = attempt;
        let element = self.group.compose(&phase.group_element, &increment);
        let next = Phase { group_element: element, momentum };
        check(&self.group, &next)?;
        self.end = Some(next.momentum.clone());
        *phase = next;
        self.rates[self.noted % KEPT] = Some(rates);
        self.noted += 1;
        Ok(StepReport { iterations: sweeps, residual })
    }

    /// Many steps of [`Collocation::advance`] from the state at `time`. The report holds the largest number of sweeps and
    /// the largest residual of a step.
    ///
    /// # Errors
    /// [`Stopped`]: how many steps were made, and why the next one was not; `phase` is then the state before that.
    pub fn advance_by(
        &mut self,
        phase: &mut Phase<G>,
        time: f64,
        steps: u64,
    ) -> Result<StepReport<f64>, Stopped> {
        let mut worst = StepReport { iterations: 0, residual: 0.0 };
        for done in 0..steps {
            let now = self.step.times_plus(done as f64, time);
            let report =
                self.advance(phase, now).map_err(|error| Stopped { steps: done, error })?;
            worst.iterations = worst.iterations.max(report.iterations);
            worst.residual = f64::max(worst.residual, report.residual);
        }
        Ok(worst)
    }

    fn equations<'a>(&'a self, phase: &'a Phase<G>, middle: f64) -> Equations<'a, G, E, D, M> {
        let Self { group, energy, drive, step, .. } = self;
        let Phase { group_element: element, momentum: mu } = phase;
        Equations { group, energy, drive, element, mu, middle, step: *step }
    }

    /// The step from a guess that knows no steps before it.
    #[cold]
    fn anew(
        &mut self,
        phase: &Phase<G>,
        middle: f64,
    ) -> Result<(Attempt<G::Vector, M>, Moved<G>), StepError> {
        self.noted = 0;
        let equations = self.equations(phase, middle);
        let attempt = equations.solve(Rates::zero(phase.momentum.dim()));
        let moved = equations.judge(&attempt, true)?;
        Ok((attempt, moved))
    }

    /// The rates of the steps before, extrapolated by the polynomial through them.
    fn guess(&self, dim: usize) -> Rates<G::Vector, M> {
        let mut guess = Rates::zero(dim);
        let last = |back: usize| self.rates[(self.noted - 1 - back) % KEPT].as_ref();
        let long = last(0).is_some_and(|rates| largest::<G::Vector, M>(dim, &rates.x) > LONG);
        let count = self.noted.min(if long { KEPT_LONG } else { KEPT });
        let mut weight = -1.0;
        for back in 0..count {
            weight *= -((count - back) as f64) / (back + 1) as f64;
            if let Some(rates) = last(back) {
                guess.add(dim, weight, rates);
            }
        }
        guess
    }
}
