//! The tables a matrix group is made of, wherever they are stored.

use core::fmt::Debug;

use super::linear;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// (i, j, k, c): [eᵢ, eⱼ] contains c·eₖ. Both (i, j, …) and (j, i, …) are listed.
pub type StructureConstant = (usize, usize, usize, f64);

/// (i, row, column, value): a non-zero entry of the matrix of eᵢ.
pub type BasisEntry = (usize, usize, usize, f64);

/// A term c·∏ μ_i^power of a Casimir, as (c, [(i, power), …]).
pub type CasimirTerm = (f64, &'static [(usize, u32)]);

/// Matrices of the representation.
pub type MatrixOf<K> = <<K as Tables>::Column as Coordinates<<K as Tables>::Scalar>>::Matrix;

/// A Lie algebra as tables, with the types its coordinates and matrices are stored in.
///
/// Implemented by [`StaticTables`](crate::groups::StaticTables) (tables in the program, no allocation)
/// and `DynamicTables` (tables known at run time). Everything a group does follows from this; see
/// [`TableGroup`](crate::groups::TableGroup).
pub trait Tables: Clone + Debug {
    /// The number type of coordinates.
    type Scalar: Scalar;
    /// Coordinates of 𝔤 and 𝔤\*; length n.
    type Vector: Coordinates<Self::Scalar>;
    /// Columns of the representation; its matrices are d×d.
    type Column: Coordinates<Self::Scalar>;

    /// n, the dimension of the algebra.
    fn dim(&self) -> usize;

    /// d, the size of the matrices; n where the adjoint representation is used.
    fn matrix_size(&self) -> usize;

    /// The non-zero structure constants.
    fn structure(&self) -> &[StructureConstant];

    /// The matrices of the basis; `None` where only the brackets are known. Elements are then
    /// matrices of the adjoint representation.
    fn basis(&self) -> Option<&[BasisEntry]>;

    /// Entry (i, j) of the inverse of the Gram matrix ⟨eᵢ, eⱼ⟩ = Σ entries of eᵢ times entries of
    /// eⱼ, in the representation in use.
    fn gram_inverse(&self, i: usize, j: usize) -> f64;

    /// Whether the Gram matrix is diagonal.
    fn gram_is_diagonal(&self) -> bool;

    /// Whether the matrices in use are linearly independent. Always so for a matrix basis; the
    /// adjoint representation has it only if the centre is trivial.
    fn is_faithful(&self) -> bool;

    /// Whether every matrix in use is antisymmetric, so that elements are orthogonal.
    fn is_orthogonal(&self) -> bool;

    /// Whether every matrix in use has trace 0, so that elements have determinant 1.
    fn is_traceless(&self) -> bool;

    /// See [`LieGroup::exp_extent`](crate::LieGroup::exp_extent).
    fn exp_extent(&self, x: &Self::Vector) -> Self::Scalar;

    /// See [`CayleyGroup::cayley_extent`](crate::groups::CayleyGroup::cayley_extent).
    fn cayley_extent(&self, x: &Self::Vector) -> Self::Scalar;

    /// The product of two matrices of the representation.
    fn multiply(&self, a: &MatrixOf<Self>, b: &MatrixOf<Self>) -> MatrixOf<Self> {
        linear::multiply(self.matrix_size(), a, b)
    }

    /// The inverse of a matrix of the representation; entries that are not finite where there is none.
    fn invert(&self, m: &MatrixOf<Self>) -> MatrixOf<Self> {
        linear::invert(self.matrix_size(), m)
    }

    /// How many Casimirs are known.
    fn casimir_count(&self) -> usize;

    /// The Casimir number `index` at μ; zero for an index out of range.
    fn casimir(&self, index: usize, mu: &Self::Vector) -> Self::Scalar;
}

/// c·∏ μ_i^power
pub(crate) fn monomial<T: Scalar, V: Coordinates<T>>(
    c: f64,
    factors: &[(usize, u32)],
    mu: &V,
) -> T {
    let mut product = T::of(c);
    for &(i, power) in factors {
        for _ in 0..power {
            product *= mu[i];
        }
    }
    product
}
