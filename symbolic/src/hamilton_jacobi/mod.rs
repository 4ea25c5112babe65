//! The generating function of the flow as a power series in time, and its inverse.
//!
//! S = Σ t^k S_k(p) solves S_t = H(J_R(∂S/∂p, p)); see Vaquero, Cortés and Martín de Diego,
//! *Symmetry Preservation in Hamiltonian Systems*. The sign is that of the forward flow.

mod chart;
mod error;
mod predict;

use crate::lie::{Chart, LieAlgebra};
use crate::poly::{Arithmetic, Polynomial};
use chart::{Composition, Inverse, Side, Work, identity, reciprocal};

pub use error::{DeriveError, TermLimit};
pub(crate) use predict::PredictorRows;
pub use predict::predictor;

#[cfg(test)]
mod tests;

/// The truncated series S = S_1 t + … + S_K t^K of a generating function, with exact coefficients.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeneratingSeries {
    dimension: usize,
    chart: Chart,
    orders: Vec<Polynomial>,
}

impl GeneratingSeries {
    /// The chart in which S generates the flow.
    pub fn chart(&self) -> Chart {
        self.chart
    }

    /// The truncation K.
    pub fn truncation(&self) -> usize {
        self.orders.len() - 1
    }

    /// S_k as a polynomial in p and the symbols, for k from 1 to K; zero for any other k.
    pub fn order(&self, k: usize) -> &Polynomial {
        self.orders.get(k).unwrap_or(&self.orders[0])
    }
}

/// Derives S_1, …, S_K for a Hamiltonian whose first `dim` variables are the momenta and whose
/// other variables are opaque symbols.
///
/// S is odd in t, so the even orders are not computed.
///
/// # Errors
/// If the chart does not exist, the Hamiltonian has too few variables, or a limit is exceeded.
pub fn derive(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    truncation: usize,
    limit: TermLimit,
) -> Result<GeneratingSeries, DeriveError> {
    derive_orders(algebra, chart, hamiltonian, truncation, limit, (true, Arithmetic::Exact))
}

/// As [`derive`], with coefficients that are rounded to floating point where they do not fit into machine integers: for estimates.
///
/// # Errors
/// As [`derive`].
pub(crate) fn estimate(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    truncation: usize,
    limit: TermLimit,
) -> Result<GeneratingSeries, DeriveError> {
    derive_orders(algebra, chart, hamiltonian, truncation, limit, (true, Arithmetic::Rounded))
}

fn derive_orders(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    truncation: usize,
    limit: TermLimit,
    (odd_only, arithmetic): (bool, Arithmetic),
) -> Result<GeneratingSeries, DeriveError> {
    let dimension = algebra.dim();
    let variables = hamiltonian.variables();
    if variables < dimension {
        return Err(DeriveError::Variables { variables, dimension });
    }
    let mut work = Work::new(variables, limit, arithmetic);
    let mut body_momentum = Inverse::new(algebra, chart, Side::Dual)?;
    let mut energy = Composition::new(dimension, std::slice::from_ref(hamiltonian))?;
    let zero = Polynomial::zero(variables);
    let p = identity(dimension, variables);
    let mut x = vec![vec![zero.clone()]; dimension];
    let mut momentum = vec![Vec::new(); dimension];
    let mut orders = vec![zero.clone()];
    for k in 1..=truncation {
        work.order = k;
        let next = body_momentum.extend(&mut work, (&x, &p), k - 1)?;
        momentum.iter_mut().zip(next).for_each(|(series, next)| series.push(next));
        energy.extend(&mut work, &momentum, k - 1)?;
        if k % 2 == 0 && odd_only {
            orders.push(zero.clone());
        } else {
            orders.push(energy.coefficient(0, k - 1).scale(&reciprocal(k)));
        }
        let next = orders[k].gradient(dimension);
        x.iter_mut().zip(next).for_each(|(series, next)| series.push(next));
    }
    Ok(GeneratingSeries { dimension, chart, orders })
}
