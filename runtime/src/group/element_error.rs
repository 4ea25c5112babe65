//! Errors of reading a user's matrix as an element of a group.

use nalgebra::SimdBool;

use crate::number::Scalar;

/// Reasons for which a matrix is not an element of a group.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ElementError {
    /// An entry is infinite or not a number.
    #[error("the entry in row {row}, column {column} of the group element is not finite")]
    NonFinite {
        /// Row, counted from 0.
        row: usize,
        /// Column, counted from 0.
        column: usize,
    },
    /// The matrix has no inverse, or reverses orientation where the group does not.
    #[error("the group element has determinant {determinant}: {required}")]
    Determinant {
        /// The determinant found.
        determinant: f64,
        /// The group's requirement.
        required: &'static str,
    },
    /// The columns are not orthonormal.
    #[error(
        "the group element is not orthogonal: an entry of gᵀg differs by {defect:.1e} from the \
         identity's; give orthonormal columns to 8 digits"
    )]
    NotOrthogonal {
        /// The largest difference.
        defect: f64,
    },
    /// Conjugation with the matrix leaves the Lie algebra.
    #[error(
        "the matrix is no element of the group: g·ξ·g⁻¹ leaves the Lie algebra by {defect:.1e}"
    )]
    NotInGroup {
        /// The largest distance from the algebra.
        defect: f64,
    },
    /// An entry does not have the form the group's matrices have.
    #[error("entry ({row}, {column}) of the group element must be {expected}, but is {found}")]
    WrongEntry {
        /// Row, counted from 0.
        row: usize,
        /// Column, counted from 0.
        column: usize,
        /// The group's value there.
        expected: f64,
        /// The value given.
        found: f64,
    },
}

/// The largest distance of a user's matrix from the group, in entries of order one.
pub(crate) const TOLERANCE: f64 = 1e-8;

/// True if `defect` is small against `scale`, in every lane; not if it is NaN.
pub(crate) fn within<T: Scalar>(defect: T, scale: T) -> bool {
    defect.simd_le(scale * T::of(TOLERANCE)).all()
}

/// Checks that every entry of a matrix is finite.
pub(crate) fn finite<T: Scalar>(
    size: usize,
    entry: impl Fn(usize, usize) -> T,
) -> Result<(), ElementError> {
    for row in 0..size {
        for column in 0..size {
            if !entry(row, column).all_finite() {
                return Err(ElementError::NonFinite { row, column });
            }
        }
    }
    Ok(())
}

/// Checks that an entry has the value that all matrices of the group have there.
pub(crate) fn fixed<T: Scalar>(
    entry: &impl Fn(usize, usize) -> T,
    (row, column): (usize, usize),
    expected: f64,
) -> Result<(), ElementError> {
    let found = entry(row, column);
    if within((found - T::of(expected)).simd_abs(), T::of(1.0)) {
        return Ok(());
    }
    Err(ElementError::WrongEntry { row, column, expected, found: found.largest_lane() })
}
