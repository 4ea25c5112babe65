//! The Hamiltonian that a step of collocation integrates: any smooth function of time and momentum.

use nalgebra::SimdComplexField;

use crate::linear::coordinates::Coordinates;
use crate::linear::differences;

/// A smooth Hamiltonian H(t, μ) on 𝔤\*, in coordinates dual to the group's basis.
///
/// A pair of closures is one, its value and its gradient:
///
/// ```
/// use coadjoint::collocation::Energy;
/// use nalgebra::Vector3;
///
/// let root = |mu: &Vector3<f64>| (1.0 + mu.norm_squared()).sqrt();
/// let energy = (
///     move |_time: f64, mu: &Vector3<f64>| root(mu),
///     move |_time: f64, mu: &Vector3<f64>| mu / root(mu),
/// );
/// assert_eq!(energy.value(0.0, &Vector3::zeros()), 1.0);
/// ```
pub trait Energy<V: Coordinates<f64>> {
    /// H(t, μ).
    fn value(&self, time: f64, mu: &V) -> f64;

    /// ω = ∂H/∂μ(t, μ). Not finite where H is not defined.
    fn gradient(&self, time: f64, mu: &V) -> V;

    /// ∂²H/∂μ², about: it speeds the solution up, and has no part in it. The default takes differences of the gradient.
    fn hessian(&self, time: f64, mu: &V) -> V::Matrix {
        let spacing = (mu.largest_entry() + 1e-3) * f64::EPSILON.simd_sqrt();
        differences::forward(mu, spacing, |mu| self.gradient(time, mu))
    }

    /// The square of the farthest way that an argument of H's functions goes from one (t, μ) to another, in the units in which
    /// its function varies: 1 for a wave, the argument itself for a root, a logarithm and a quotient; very large where a
    /// pole or the edge of a domain lies between. None where H is a closure of which this is not known: steps from a first
    /// guess, and those that take long to solve, are then compared with 16 parts.
    fn reach(&self, from: (f64, &V), to: (f64, &V)) -> Option<f64> {
        let _ = (from, to);
        None
    }

    /// As [`GeneratingFunction::unit`](crate::GeneratingFunction::unit).
    #[inline(always)]
    fn unit(&self, i: usize) -> f64 {
        let _ = i;
        1.0
    }

    /// The expression in H that is outside its domain at (t, μ); `None` if value and gradient are finite.
    fn undefined(&self, time: f64, mu: &V) -> Option<Undefined> {
        let _ = (time, mu);
        None
    }
}

/// An expression outside the domain of the function it is given to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undefined {
    /// The expression as H has it, with its function: `sqrt(1 - mu[0])`.
    pub expression: &'static str,
    /// The value of the function's argument.
    pub argument: f64,
}

/// One of a drive of which nothing is known.
pub(super) const UNKNOWN_DRIVE: Undefined =
    Undefined { expression: "the velocity or the torque", argument: f64::NAN };

/// One of which nothing is known.
pub(super) const UNKNOWN: Undefined = Undefined { expression: "∂H/∂μ", argument: f64::NAN };

impl<V, F, D> Energy<V> for (F, D)
where
    V: Coordinates<f64>,
    F: Fn(f64, &V) -> f64,
    D: Fn(f64, &V) -> V,
{
    fn value(&self, time: f64, mu: &V) -> f64 {
        (self.0)(time, mu)
    }

    #[inline(always)]
    fn gradient(&self, time: f64, mu: &V) -> V {
        (self.1)(time, mu)
    }
}

impl<V: Coordinates<f64>, E: Energy<V> + ?Sized> Energy<V> for &E {
    fn value(&self, time: f64, mu: &V) -> f64 {
        (**self).value(time, mu)
    }

    #[inline(always)]
    fn gradient(&self, time: f64, mu: &V) -> V {
        (**self).gradient(time, mu)
    }

    #[inline(always)]
    fn hessian(&self, time: f64, mu: &V) -> V::Matrix {
        (**self).hessian(time, mu)
    }

    fn reach(&self, from: (f64, &V), to: (f64, &V)) -> Option<f64> {
        (**self).reach(from, to)
    }

    #[inline(always)]
    fn unit(&self, i: usize) -> f64 {
        (**self).unit(i)
    }

    fn undefined(&self, time: f64, mu: &V) -> Option<Undefined> {
        (**self).undefined(time, mu)
    }
}
