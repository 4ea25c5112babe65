//! The solution of a step by itself: what derivatives of the step are made of.

use coadjoint_program::collocation::{Nodes, degree};

use super::Collocation;
use super::energy::Energy;
use super::rates::{Rates, mixed};
use super::solving::Attempt;
use crate::error::StepError;
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// A solution of the equations of a step at `M` nodes, in the notation of [`collocation`](super).
#[derive(Clone, Debug)]
pub struct Solution<V, const M: usize> {
    /// The increment x of the whole step.
    pub x: V,
    /// The nodes, in their order in time.
    pub nodes: [Node<V>; M],
    /// bᵢ.
    pub weights: [f64; M],
    /// aᵢⱼ − bⱼ/2, by j, then by i.
    pub matrix: [[f64; M]; M],
}

/// A node of a step.
#[derive(Clone, Debug)]
pub struct Node<V> {
    /// t + cᵢ h.
    pub time: f64,
    /// xᵢ.
    pub x: V,
    /// pᵢ.
    pub p: V,
    /// μᵢ = J_R(xᵢ, pᵢ).
    pub momentum: V,
}

impl<G, E, const M: usize> Collocation<G, E, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    /// The solution for the step from μ at `time`, found without those of other steps. It moves nothing.
    ///
    /// # Errors
    /// [`StepError`], as [`Collocation::advance`].
    pub fn solution(&self, mu: &G::Vector, time: f64) -> Result<Solution<G::Vector, M>, StepError> {
        let (dim, middle) = (mu.dim(), self.step().times_plus(0.5, time));
        let anywhere = Phase::new(self.group().identity(), mu.clone());
        let equations = self.equations(&anywhere, middle);
        let attempt = equations.solve(Rates::zero(dim));
        equations.judge(&attempt, true)?;
        let Attempt { rates, x, .. } = attempt;
        let Nodes { times, weights, matrix, .. } = Nodes::<M>::new();
        let p = self.group().dexp_transpose(&x, mu);
        let xs = mixed(&G::Vector::zeros(dim), &matrix, &rates.x);
        let ps = mixed(&p, &matrix, &rates.p);
        let momenta = self.group().node_momenta::<M>(&xs, &ps, degree(M));
        let at = |rows, node| G::Vector::at::<M>(dim, rows, node);
        let nodes = core::array::from_fn(|node| Node {
            time: times[node].times_plus(self.step(), middle),
            x: at(&xs, node),
            p: at(&ps, node),
            momentum: at(&momenta, node),
        });
        Ok(Solution { x, nodes, weights, matrix })
    }
}
