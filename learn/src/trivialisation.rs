//! Trivialised derivatives of a chart as matrices, from what [`Chart`] offers.

use coadjoint::LieGroup;
use coadjoint::groups::{Chart, Coordinates};
use nalgebra::DMatrix;

use crate::function::{entries, vector};

/// The unit covectors e¹ … eⁿ.
fn units<G: LieGroup<Scalar = f64>>(dim: usize) -> impl Iterator<Item = G::Vector> {
    (0..dim).map(move |j| G::Vector::from_entries(dim, |i| if i == j { 1.0 } else { 0.0 }))
}

fn negative<G: LieGroup<Scalar = f64>>(x: &G::Vector) -> G::Vector {
    let flipped: Vec<f64> = entries(x).iter().map(|v| -v).collect();
    vector::<G>(&flipped)
}

/// d^Lτ_x, where τ⁻¹dτ = d^Lτ_x dx: row j is (d^Lτ_x)ᵀ e^j, and d^Lτ_x = d^Rτ_{−x}.
pub(crate) fn left_derivative<G, C>(group: &G, chart: C, x: &G::Vector) -> DMatrix<f64>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let dim = x.dim();
    let minus = negative::<G>(x);
    let rows: Vec<f64> =
        units::<G>(dim).flat_map(|e| entries(&chart.pull_back(group, &minus, &e))).collect();
    DMatrix::from_row_slice(dim, dim, &rows)
}

/// The matrix of ξ ↦ ad\*_ξ μ.
pub(crate) fn ad_star_matrix<G>(group: &G, mu: &G::Vector) -> DMatrix<f64>
where
    G: LieGroup<Scalar = f64>,
{
    let dim = mu.dim();
    let columns: Vec<f64> =
        units::<G>(dim).flat_map(|xi| entries(&group.ad_star(&xi, mu))).collect();
    DMatrix::from_column_slice(dim, dim, &columns)
}
