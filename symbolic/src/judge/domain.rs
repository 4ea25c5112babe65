//! The domain of a chart.

use nalgebra::{DMatrix, Schur};

use super::geometry::Geometry;
use super::linear::norm;
use crate::lie::Chart;

/// Exponential chart: |Im λ| must be less for every eigenvalue λ of ad_x: a half turn. On groups that are not unimodular
/// the runtime asks for |tr ad_x| ≤ π besides. Where ad_x is nilpotent there is no limit.
const EXPONENTIAL: f64 = std::f64::consts::PI;

/// Cayley chart: |λ| must not be more for every eigenvalue λ of the matrix x, which on SO(3) is |x| ≤ 2 and on
/// SU(2) |x| ≤ 4.
const CAYLEY: f64 = 2.0;

/// Eigenvalues of a defective matrix are as inexact as the root of its rounding.
const DEFECTIVE: f64 = 4e-8;

/// The verdict on x as an element of the chart's domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inside {
    /// It is.
    Yes,
    /// It is not; the largest |Im λ|, or |λ| for the Cayley chart.
    No(f64),
    /// It is too near the limit for the accuracy of the eigenvalues.
    CannotTell,
}

pub(super) fn inside(geometry: &Geometry, x: &DMatrix<f64>) -> Inside {
    let (matrix, limit) = match geometry.chart {
        Chart::Exponential => (geometry.ad_transpose(x), EXPONENTIAL),
        Chart::Cayley => (geometry.matrix_of(x), CAYLEY),
    };
    // Sufficient: no eigenvalue is larger than any norm.
    let length = norm(&matrix);
    if length < limit {
        return Inside::Yes;
    }
    if !length.is_finite() {
        return Inside::CannotTell;
    }
    // Powers of a nilpotent matrix vanish without rounding where the basis is adapted to it, as in the catalogue.
    if geometry.chart == Chart::Exponential {
        let squarings = 0..usize::BITS - matrix.nrows().leading_zeros();
        let power = squarings.fold(&matrix / length, |power, _| &power * &power);
        if power.amax() == 0.0 {
            return Inside::Yes;
        }
    }
    let antisymmetric = (&matrix + matrix.transpose()).amax() == 0.0;
    let uncertain = if antisymmetric { 1e-13 } else { DEFECTIVE } * length;
    let Some(schur) = Schur::try_new(matrix, f64::EPSILON, 1000) else {
        return Inside::CannotTell;
    };
    let eigenvalues = schur.complex_eigenvalues();
    let sizes = eigenvalues.iter().map(|z| match geometry.chart {
        Chart::Exponential => z.im.abs(),
        Chart::Cayley => z.re.hypot(z.im),
    });
    let largest = sizes.fold(0.0, f64::max);
    if largest < limit - uncertain {
        Inside::Yes
    } else if largest > limit + uncertain {
        Inside::No(largest)
    } else {
        Inside::CannotTell
    }
}
