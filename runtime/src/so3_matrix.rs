//! SO(3) with elements as rotation matrices.

use core::marker::PhantomData;

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::element_error::{ElementError, finite};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::scalar::Scalar;
use crate::so3::{SO3, rotation_from};

/// The rotation group SO(3), elements as 3×3 matrices; otherwise as [`SO3`], whose elements are
/// unit quaternions and cost less to compose.
///
/// Basis: the hat matrices about the three axes, [e₁, e₂] = e₃ and cyclic. Casimir: |μ|². Both
/// charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SO3Matrix<T = f64>(PhantomData<T>);

impl<T> SO3Matrix<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// A derived impl would ask for `T: Default`.
impl<T> Default for SO3Matrix<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FixedDimension for SO3Matrix<T> {
    const DIM: usize = 3;
}

/// The matrix of a unit quaternion.
#[inline(always)]
fn matrix<T: Scalar>(q: &nalgebra::UnitQuaternion<T>) -> Rotation3<T> {
    let q = q.as_ref();
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    let two = T::of(2.0);
    let one = T::of(1.0);
    Rotation3::from_matrix_unchecked(Matrix3::new(
        one - two * (y * y + z * z),
        two * (x * y - w * z),
        two * (x * z + w * y),
        two * (x * y + w * z),
        one - two * (x * x + z * z),
        two * (y * z - w * x),
        two * (x * z - w * y),
        two * (y * z + w * x),
        one - two * (x * x + y * y),
    ))
}

impl<T: Scalar> LieGroup for SO3Matrix<T> {
    type Scalar = T;
    type Vector = Vector3<T>;
    type Element = Rotation3<T>;

    #[inline(always)]
    fn dim(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        matrix(&SO3::new().identity())
    }

    /// The product, pulled back onto the orthogonal matrices to first order: g (3 − gᵀg)/2.
    #[inline(always)]
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let product = g.matrix() * h.matrix();
        let mut correction = product.transpose() * product * T::of(-0.5);
        for i in 0..3 {
            correction[(i, i)] += T::of(1.5);
        }
        Rotation3::from_matrix_unchecked(product * correction)
    }

    #[inline(always)]
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        Rotation3::from_matrix_unchecked(g.matrix().transpose())
    }

    #[inline(always)]
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        matrix(&SO3::new().exp(x))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        SO3::new().log(&rotation_from(|i, j| g.matrix()[(i, j)]).ok()?)
    }

    #[inline(always)]
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        SO3::new().bracket(x, y)
    }

    #[inline(always)]
    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        SO3::new().ad_star(x, mu)
    }

    #[inline(always)]
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        g.matrix() * x
    }

    #[inline(always)]
    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        g.matrix() * mu
    }

    #[inline(always)]
    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let (g, moved) = SO3::new().exp_transport(x, mu);
        (matrix(&g), moved)
    }

    #[inline(always)]
    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        SO3::new().dexp_transpose(x, mu)
    }

    #[inline(always)]
    fn dexp_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, Matrix3<T>) {
        SO3::new().dexp_transpose_with_derivative(x, mu)
    }

    #[inline(always)]
    fn dexp_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        SO3::new().dexp_inverse_transpose(x, p)
    }

    fn casimir_count(&self) -> usize {
        1
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        SO3::new().casimir(index, mu)
    }

    fn matrix_size(&self) -> usize {
        3
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        g.matrix()[(row, column)]
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(3, &entry)?;
        Ok(matrix(&rotation_from(entry)?))
    }
}

impl<T: Scalar> CayleyGroup for SO3Matrix<T> {
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        let (g, moved) = SO3::new().cayley_transport(x, mu);
        (matrix(&g), moved)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        SO3::new().cayley_inverse(&rotation_from(|i, j| g.matrix()[(i, j)]).ok()?)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        SO3::new().dcay_transpose(x, mu)
    }

    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, Matrix3<T>) {
        SO3::new().dcay_transpose_with_derivative(x, mu)
    }

    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        SO3::new().dcay_inverse_transpose(x, p)
    }
}
