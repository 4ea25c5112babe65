//! Storage of the tables of an algebra, and its types of numbers.

use core::f64::consts::PI;
use core::fmt::Debug;

use super::algebra::Algebra;
use super::domain;
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::Scalar;

/// Matrices of the representation.
pub type MatrixOf<K> = <<K as Tables>::Column as Coordinates<<K as Tables>::Scalar>>::Matrix;

/// A Lie algebra as tables, with the types its coordinates and matrices are stored in.
///
/// Implemented by `StaticTables` (tables in the program, no allocation) and `DynamicTables` (tables known at run time).
/// Everything a group does follows from this; see [`TableGroup`](crate::groups::TableGroup).
pub trait Tables: Clone + Debug {
    /// The number type of coordinates.
    type Scalar: Scalar;
    /// Coordinates of 𝔤 and 𝔤\*; length n.
    type Vector: Coordinates<Self::Scalar>;
    /// Columns of the representation; its matrices are d×d.
    type Column: Coordinates<Self::Scalar>;

    /// The tables.
    fn algebra(&self) -> Algebra<'_>;

    /// See [`LieGroup::exp_extent`](crate::LieGroup::exp_extent).
    fn exp_extent(&self, x: &Self::Vector) -> Self::Scalar {
        let Algebra { dim, elliptic, .. } = self.algebra();
        domain::evaluate(elliptic, dim, x) * Self::Scalar::of(1.0 / (PI * PI))
    }

    /// The product of two matrices of the representation.
    fn multiply(&self, a: &MatrixOf<Self>, b: &MatrixOf<Self>) -> MatrixOf<Self> {
        square::multiply(self.algebra().size, a, b)
    }

    /// The inverse of a matrix of the representation; entries that are not finite where there is none.
    fn invert(&self, m: &MatrixOf<Self>) -> MatrixOf<Self> {
        square::invert(self.algebra().size, m).0
    }

    /// The number of known Casimirs.
    fn casimir_count(&self) -> usize;

    /// The Casimir number `index` at μ; zero for an index out of range.
    fn casimir(&self, index: usize, mu: &Self::Vector) -> Self::Scalar;
}

/// c·∏ μ_i^power
pub(super) fn monomial<T: Scalar, V: Coordinates<T>>(
    c: f64,
    factors: &[(usize, u32)],
    mu: &V,
) -> T {
    factors.iter().fold(T::of(c), |product, &(i, power)| {
        (0..power).fold(product, |product, _| product * mu[i])
    })
}
