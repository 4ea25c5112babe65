//! Puts momenta back onto their coadjoint orbit.

use coadjoint_codegen::lie::LieAlgebra;
use nalgebra::{DMatrix, DVector};

use crate::engine::{Numbers, Space};

/// If increments repeat, as in a steady rotation, so does their rounding: a momentum leaves its coadjoint orbit, and the
/// spatial momentum J = Ad\*_g μ its value, in proportion to the steps. So from time to time μ becomes Ad\*_{g⁻¹} J with
/// the J of the start: its error is then that of g alone, which returns to its group in every step.
pub(super) struct Orbit {
    /// J, which is the same for all states of the run.
    spatial: Vec<f64>,
    /// The dimensions of the group's direct factors.
    factors: Vec<usize>,
}

impl Orbit {
    /// Momenta are put back after this number of steps.
    pub(crate) const EVERY: u64 = 8192;

    /// The orbit of states with this spatial momentum.
    pub(super) fn new(algebra: &LieAlgebra, spatial: Vec<f64>) -> Self {
        Self { spatial, factors: algebra.factors().iter().map(LieAlgebra::dim).collect() }
    }

    /// Puts the momentum back, factor by factor, where that moves it by rounding.
    pub(super) fn restore(&self, space: &Space, state: &mut Numbers) {
        let widest = self.factors.iter().copied().max().unwrap_or(0);
        let columns: Vec<Vec<f64>> = (0..widest).map(|k| self.column(space, state, k)).collect();
        let now = space.spatial_momentum(state);
        let mut first = 0;
        for &dim in &self.factors {
            let own = first..first + dim;
            let action = DMatrix::from_fn(dim, dim, |i, k| columns[k][first + i]);
            let spatial = DVector::from_column_slice(&self.spatial[own.clone()]);
            let error = &spatial - DVector::from_column_slice(&now[own.clone()]);
            let mu = &mut state.mu[own];
            if let Some(change) = change(action, &spatial, &error, mu) {
                mu.iter_mut().zip(&change).for_each(|(mu, change)| *mu += change);
            }
            first += dim;
        }
    }

    /// Column k of the matrix of Ad\*_g, those of all factors one below the other.
    fn column(&self, space: &Space, state: &Numbers, k: usize) -> Vec<f64> {
        let units = self.factors.iter().flat_map(|&dim| (0..dim).map(move |i| i == k));
        let mu = units.map(|one| if one { 1.0 } else { 0.0 }).collect();
        space.spatial_momentum(&Numbers { g: state.g.clone(), mu })
    }
}

/// The change of μ that makes up for the error of its spatial momentum. None where g takes away more digits than rounding
/// does, as long motions in groups that are not compact do, and where the change is more than rounding.
fn change(
    action: DMatrix<f64>,
    spatial: &DVector<f64>,
    error: &DVector<f64>,
    mu: &[f64],
) -> Option<DVector<f64>> {
    /// The length of a momentum changes this much at most in groups that keep digits, for lack of an orthonormal basis.
    const STRETCH: f64 = 8.0;
    /// Above what rounding adds up to between two calls, and below every other mistake.
    const ROUNDING: f64 = 1e-11;
    let length = DVector::from_column_slice(mu).norm();
    let inverse = action.try_inverse()?;
    let stretch = inverse.norm() / (mu.len() as f64).sqrt() * spatial.norm();
    let change = inverse * error;
    (stretch <= STRETCH * length && change.norm() <= ROUNDING * length).then_some(change)
}
