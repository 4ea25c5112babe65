//! Functions on 𝔤\*, and the maps with exact geometry that they generate.

use core::marker::PhantomData;

use coadjoint::collocation::Energy;
use coadjoint::groups::{Chart, Coordinates};
use coadjoint::solve::Integrator;
use coadjoint::{GeneratingFunction, LieGroup};
use coadjoint_codegen::cancel;

/// A smooth function f: 𝔤\* → ℝ in the coordinates dual to the basis, with its derivatives.
///
/// Models learned from data and Hamiltonians are both of this kind; [`Generating`] reads one as a
/// generating function S(p).
pub trait MomentumFunction {
    /// n, the number of coordinates.
    fn dim(&self) -> usize;

    /// f(p), `p` of length n.
    fn value(&self, p: &[f64]) -> f64;

    /// Writes ∂f/∂p, of length n, to `gradient`.
    fn gradient(&self, p: &[f64], gradient: &mut [f64]);

    /// Writes ∂f/∂p and the n×n Hessian (symmetric, so rows or columns) to the slices.
    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]);

    /// As [`GeneratingFunction::rounding`].
    fn rounding(&self) -> f64 {
        1.0
    }
}

impl<M: MomentumFunction + ?Sized> MomentumFunction for &M {
    fn dim(&self) -> usize {
        (**self).dim()
    }

    fn value(&self, p: &[f64]) -> f64 {
        (**self).value(p)
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        (**self).gradient(p, gradient);
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        (**self).gradient_and_hessian(p, gradient, hessian);
    }

    fn rounding(&self) -> f64 {
        (**self).rounding()
    }
}

/// The function factor · f: with factor = Δt and f = H the trivial answer S = Δt·H, with factor = 0 that of the identity
/// map.
#[derive(Clone, Copy, Debug)]
pub struct Scaled<M> {
    /// The factor.
    pub factor: f64,
    /// The function f.
    pub function: M,
}

impl<M: MomentumFunction> MomentumFunction for Scaled<M> {
    fn dim(&self) -> usize {
        self.function.dim()
    }

    fn value(&self, p: &[f64]) -> f64 {
        self.factor * self.function.value(p)
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        self.function.gradient(p, gradient);
        gradient.iter_mut().for_each(|entry| *entry *= self.factor);
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.function.gradient_and_hessian(p, gradient, hessian);
        gradient.iter_mut().chain(hessian).for_each(|entry| *entry *= self.factor);
    }

    fn rounding(&self) -> f64 {
        self.function.rounding()
    }
}

/// A function of momenta read as a generating function on a group, in the chart `C`.
///
/// Whatever the function, the map it induces is Poisson, symplectic and G-equivariant, and
/// conserves the spatial momentum and every Casimir to rounding.
#[derive(Clone, Copy, Debug)]
pub struct Generating<G, C, M> {
    group: G,
    chart: PhantomData<C>,
    /// The function read as S.
    pub function: M,
}

impl<G, C, M> Generating<G, C, M> {
    /// Reads `function` as the generating function S on `group`, in the chart `C`.
    pub fn new(group: G, function: M) -> Self {
        Self { group, chart: PhantomData, function }
    }
}

impl<G, C, M> GeneratingFunction for Generating<G, C, M>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
    M: MomentumFunction,
{
    type Group = G;
    type Chart = C;

    fn group(&self) -> &G {
        &self.group
    }

    fn value(&self, p: &G::Vector) -> f64 {
        Hamiltonian(&self.function).value(0.0, p)
    }

    fn gradient(&self, p: &G::Vector) -> G::Vector {
        Hamiltonian(&self.function).gradient(0.0, p)
    }

    fn gradient_and_hessian(
        &self,
        p: &G::Vector,
    ) -> (G::Vector, <G::Vector as Coordinates<f64>>::Matrix) {
        cancel::check();
        let dim = p.dim();
        let mut gradient = vec![0.0; dim];
        let mut hessian = vec![0.0; dim * dim];
        self.function.gradient_and_hessian(&entries(p), &mut gradient, &mut hessian);
        let matrix = G::Vector::matrix_from_entries(dim, |i, j| hessian[i * dim + j]);
        (vector::<G>(&gradient), matrix)
    }

    fn rounding(&self) -> f64 {
        self.function.rounding()
    }
}

impl<G, C, M> Integrator for Generating<G, C, M>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
    M: MomentumFunction,
{
}

/// A function of momenta read as a Hamiltonian, whose steps [`Collocation`](coadjoint::collocation::Collocation) makes.
///
/// Whatever the function, momentum and Casimirs are conserved to rounding, and its own value stays near its start. It is fitted to
/// momenta and angular velocities ω = ∂H/∂μ, as generating functions are to p and x.
#[derive(Clone, Copy, Debug)]
pub struct Hamiltonian<M>(pub M);

impl<V: Coordinates<f64>, M: MomentumFunction> Energy<V> for Hamiltonian<M> {
    fn value(&self, _time: f64, mu: &V) -> f64 {
        self.0.value(&entries(mu))
    }

    fn gradient(&self, _time: f64, mu: &V) -> V {
        cancel::check();
        let mut gradient = vec![0.0; mu.dim()];
        self.0.gradient(&entries(mu), &mut gradient);
        V::from_entries(gradient.len(), |i| gradient[i])
    }
}

pub(crate) fn entries<V: Coordinates<f64>>(vector: &V) -> Vec<f64> {
    (0..vector.dim()).map(|i| vector[i]).collect()
}

pub(crate) fn vector<G: LieGroup<Scalar = f64>>(entries: &[f64]) -> G::Vector {
    G::Vector::from_entries(entries.len(), |i| entries[i])
}
