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
    let mut derivation = Derivation::new(algebra, chart, hamiltonian, limit, Arithmetic::Exact)?;
    (1..=truncation).try_for_each(|k| derivation.extend(k, true))?;
    Ok(derivation.series())
}

/// As [`derive`], with coefficients that are rounded to floating point where they do not fit into machine integers, for estimates;
/// up to an odd order from `least` to `truncation`, the last one within the limit.
///
/// # Errors
/// As [`derive`], where the order `least` exceeds a limit.
pub(crate) fn estimate(
    algebra: &LieAlgebra,
    chart: Chart,
    hamiltonian: &Polynomial,
    [least, truncation]: [usize; 2],
    limit: TermLimit,
) -> Result<GeneratingSeries, DeriveError> {
    let mut derivation = Derivation::new(algebra, chart, hamiltonian, limit, Arithmetic::Rounded)?;
    for k in 1..=truncation {
        match derivation.extend(k, true) {
            Err(error) if error.is_of_size() && k > least => {
                // The last odd order before this one.
                derivation.orders.truncate(((k - 2) | 1) + 1);
                break;
            }
            made => made?,
        }
    }
    Ok(derivation.series())
}

/// A series under way.
struct Derivation<'a> {
    dimension: usize,
    chart: Chart,
    work: Work,
    body_momentum: Inverse<'a>,
    energy: Composition,
    /// p, ∂S/∂p and the body momentum, `[coordinate][order]`.
    p: Vec<Vec<Polynomial>>,
    x: Vec<Vec<Polynomial>>,
    momentum: Vec<Vec<Polynomial>>,
    orders: Vec<Polynomial>,
}

impl<'a> Derivation<'a> {
    fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        hamiltonian: &Polynomial,
        limit: TermLimit,
        arithmetic: Arithmetic,
    ) -> Result<Self, DeriveError> {
        let (dimension, variables) = (algebra.dim(), hamiltonian.variables());
        let zero = Polynomial::zero(variables);
        Ok(Self {
            dimension,
            chart,
            work: Work::on(hamiltonian, dimension, limit, arithmetic)?,
            body_momentum: Inverse::new(algebra, chart, Side::Dual)?,
            energy: Composition::new(dimension, std::slice::from_ref(hamiltonian))?,
            p: identity(dimension, variables),
            x: vec![vec![zero.clone()]; dimension],
            momentum: vec![Vec::new(); dimension],
            orders: vec![zero],
        })
    }

    /// Derives S_k after all lower orders.
    fn extend(&mut self, k: usize, odd_only: bool) -> Result<(), DeriveError> {
        let Self { work, body_momentum, energy, x, p, momentum, orders, .. } = self;
        work.order = k;
        let next = body_momentum.extend(work, (&*x, &*p), k - 1)?;
        momentum.iter_mut().zip(next).for_each(|(series, next)| series.push(next));
        energy.extend(work, &*momentum, k - 1)?;
        orders.push(match k.is_multiple_of(2) && odd_only {
            true => orders[0].clone(),
            false => energy.coefficient(0, k - 1).scale(&reciprocal(k)),
        });
        let next = orders[k].gradient(self.dimension);
        x.iter_mut().zip(next).for_each(|(series, next)| series.push(next));
        Ok(())
    }

    fn series(self) -> GeneratingSeries {
        let Self { dimension, chart, orders, .. } = self;
        GeneratingSeries { dimension, chart, orders }
    }
}
