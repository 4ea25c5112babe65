//! The rate at which motions part in a step: what tells whether a series of few terms means something, where the ratio of
//! its last two terms does not.

use coadjoint_program::limits::{LARGEST_RATIO, RATE_OF_HALF_TURN};
use nalgebra::SimdComplexField;

use super::{Integrator, Solver};
use crate::chart::Chart;
use crate::generating::{ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// The ratio of terms that the rate at x stands for: up to [`LARGEST_RATIO`] where the rate is at most
/// [`largest_rate`](crate::GeneratingFunction::largest_rate), zero where that is unbounded.
pub fn estimated_ratio<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
) -> ScalarOf<S> {
    let largest = generating.largest_rate();
    if largest >= f64::MAX {
        return ScalarOf::<S>::of(0.0);
    }
    let square = match generating.solver() {
        Solver::Newton => square_of_rate(generating, mu, x),
        Solver::FixedPoint => {
            let half_turn = ScalarOf::<S>::of(RATE_OF_HALF_TURN * RATE_OF_HALF_TURN);
            half_turn * S::Chart::default().extent(generating.group(), x)
        }
    };
    square.simd_sqrt() * ScalarOf::<S>::of(LARGEST_RATIO / largest)
}

/// maxᵢ Σⱼ |ZᵢⱼZⱼᵢ| of Z = ad_xᵀ + 2 ∂p/∂x·Hess S.
fn square_of_rate<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
) -> ScalarOf<S> {
    let (group, dim) = (generating.group(), mu.dim());
    let (p, derivative) = S::Chart::default().pull_back_with_derivative(group, x, mu);
    let (_, hessian) = generating.gradient_and_hessian(&p);
    let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
    let [zero, one, two] = [0.0, 1.0, 2.0].map(ScalarOf::<S>::of);
    let mut z = VectorOf::<S>::zero_matrix(dim);
    for j in 0..dim {
        let unit = VectorOf::<S>::from_entries(dim, |i| if i == j { one } else { zero });
        let turned = group.ad_star(x, &unit);
        for i in 0..dim {
            let identity = if i == j { one } else { zero };
            z[(i, j)] = turned[i] + two * (identity - jacobian[(i, j)]);
        }
    }
    (0..dim).fold(zero, |largest, i| {
        let row = (0..dim).fold(zero, |sum, j| sum + (z[(i, j)] * z[(j, i)]).simd_abs());
        largest.worse(row)
    })
}
