//! SO(3), the rotations of space, and SU(2), their double cover, as unit quaternions.

use core::marker::PhantomData;

use coadjoint_geometry::angle::Length;
use coadjoint_geometry::group::{Group, Matrices};
use coadjoint_geometry::rotation::{self, Quaternions as Formulas, Turn};
use coadjoint_geometry::vector::{cross, dot};
use nalgebra::{Matrix3, Quaternion, Rotation3, SimdBool, UnitQuaternion, Vector3};

use crate::group::arrays::{array, by_formulas, cayley_by_formulas, nodes, rows};
use crate::group::element_error::{ElementError, finite, fixed, within};
use crate::group::log::log_factor;
use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
use crate::number::Scalar;

/// The rotation group SO(3), elements as unit quaternions.
///
/// Basis: the generators of rotations about the three axes, [e₁, e₂] = e₃ and cyclic, so that
/// [x, y] = x × y, Ad_R x = Rx, Ad\*_R μ = Rμ, ad\*_x μ = μ × x. Casimir: |μ|². Both charts.
pub type SO3<T = f64> = Quaternions<T, false>;

/// The group SU(2), elements as unit quaternions; q and −q are different here.
///
/// Basis: e_k = −iσ_k/2 with the Pauli matrices, so that [e₁, e₂] = e₃ and cyclic, and brackets,
/// Ad and Ad\* are those of [`SO3`]. Matrices: the complex 2×2 matrix a + ib as the real 4×4
/// matrix ((a, −b), (b, a)). Casimir: |μ|². Both charts; the Cayley map is that of the 2×2
/// matrices, which differs from SO(3)'s.
pub type SU2<T = f64> = Quaternions<T, true>;

/// The groups of unit quaternions: [`SO3`], where q and −q are one element, and [`SU2`], the double cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quaternions<T, const DOUBLE_COVER: bool>(PhantomData<T>);

// Not derived: that would ask for `T: Default`, which lanes need not have.
impl<T, const DOUBLE_COVER: bool> Default for Quaternions<T, DOUBLE_COVER> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T, const DOUBLE_COVER: bool> Quaternions<T, DOUBLE_COVER> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<T, const DOUBLE_COVER: bool> FixedDimension for Quaternions<T, DOUBLE_COVER> {
    const DIM: usize = 3;
}

type V<T> = Vector3<T>;

/// The numbers (w, i, j, k) of a quaternion.
#[inline(always)]
pub(crate) fn numbers<T: Scalar>(q: &UnitQuaternion<T>) -> [T; 4] {
    let q = q.as_ref();
    [q.w, q.i, q.j, q.k]
}

/// The quaternion of these numbers.
#[inline(always)]
pub(crate) fn quaternion<T: Scalar>([w, i, j, k]: [T; 4]) -> UnitQuaternion<T> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k))
}

/// The rotation whose matrix has these (finite) entries.
pub(crate) fn rotation_from<T: Scalar>(
    entry: impl Fn(usize, usize) -> T,
) -> Result<UnitQuaternion<T>, ElementError> {
    let m = Matrix3::from_fn(entry);
    let gram = m.transpose() * m;
    let mut defect = T::of(0.0);
    for i in 0..3 {
        for j in 0..3 {
            let unit = T::of(if i == j { 1.0 } else { 0.0 });
            defect = defect.simd_max((gram[(i, j)] - unit).simd_abs());
        }
    }
    if !within(defect, T::of(1.0)) {
        return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
    }
    let [a, b, c] = m.data.0;
    let determinant = dot(a, cross(b, c));
    if !determinant.simd_gt(T::of(0.0)).all() {
        return Err(ElementError::Determinant {
            determinant: determinant.largest_lane(),
            required: "a rotation needs determinant 1",
        });
    }
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(m));
    Ok(UnitQuaternion::new_normalize(q.into_inner()))
}

/// The element of SU(2) whose matrix has these (finite) entries.
fn complex_from<T: Scalar>(
    entry: impl Fn(usize, usize) -> T,
) -> Result<UnitQuaternion<T>, ElementError> {
    let u = V::new(-entry(2, 1), entry(1, 0), -entry(2, 0));
    let w = entry(0, 0);
    let norm = (w * w + u.norm_squared()).simd_sqrt();
    let defect = (norm - T::of(1.0)).simd_abs();
    if !within(defect, T::of(1.0)) {
        return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
    }
    let q = quaternion([w, u.x, u.y, u.z].map(|entry| entry / norm));
    let matrix = Formulas::<true>::matrix(numbers(&q));
    for row in 0..4 {
        for column in 0..4 {
            let expected = matrix[row][column];
            fixed(&|i, j| entry(i, j) - expected, (row, column), 0.0)?;
        }
    }
    Ok(q)
}

impl<T: Scalar, const DOUBLE_COVER: bool> LieGroup for Quaternions<T, DOUBLE_COVER> {
    type Scalar = T;
    type Vector = Vector3<T>;
    type Element = UnitQuaternion<T>;

    by_formulas!(Formulas::<DOUBLE_COVER>);

    fn dim(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        quaternion([1.0, 0.0, 0.0, 0.0].map(T::of))
    }

    /// The product, pulled back onto the unit sphere to first order so that rounding does not
    /// accumulate in the norm over many steps.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        quaternion(Turn::of(numbers(h)).after(numbers(g)))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.conjugate()
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        quaternion(Formulas::<DOUBLE_COVER>::exp(array(x), Length::Any).quaternion())
    }

    /// The logarithm with |x| ≤ π; of the double cover with |x| < 2π, and `None` at −1, which every direction reaches.
    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let q = g.as_ref();
        if DOUBLE_COVER {
            let u = V::new(q.i, q.j, q.k);
            let squared = u.norm_squared();
            if q.w.simd_lt(T::of(0.0)).any() && squared.simd_le(T::epsilon() * T::epsilon()).any() {
                return None;
            }
            return Some(u * log_factor(q.w, squared));
        }
        // q and −q are the same rotation; the one with w ≥ 0 has the smaller angle.
        let sign = T::of(1.0).simd_copysign(q.w);
        let u = V::new(q.i, q.j, q.k) * sign;
        let factor = log_factor(q.w * sign, u.norm_squared());
        Some(u * factor)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        rotation::rotate(numbers(g), array(mu)).into()
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let turn = Formulas::<DOUBLE_COVER>::exp(array(x), Length::Any);
        (quaternion(turn.quaternion()), turn.back(array(mu)).into())
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        Formulas::<DOUBLE_COVER>::defect(numbers(g))
    }

    fn casimir_count(&self) -> usize {
        1
    }

    fn casimir(&self, _index: usize, mu: &Self::Vector) -> T {
        dot(array(mu), array(mu))
    }

    fn matrix_size(&self) -> usize {
        if DOUBLE_COVER { 4 } else { 3 }
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        if DOUBLE_COVER {
            return Formulas::<true>::matrix(numbers(g))[row][column];
        }
        let mut unit = V::repeat(T::of(0.0));
        unit[column] = T::of(1.0);
        self.coadjoint(g, &unit)[row]
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(self.matrix_size(), &entry)?;
        if DOUBLE_COVER { complex_from(entry) } else { rotation_from(entry) }
    }
}

impl<T: Scalar, const DOUBLE_COVER: bool> CayleyGroup for Quaternions<T, DOUBLE_COVER> {
    cayley_by_formulas!(Formulas::<DOUBLE_COVER>);

    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        quaternion(Formulas::<DOUBLE_COVER>::cayley(array(x)).quaternion())
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        if DOUBLE_COVER {
            let q = g.as_ref();
            let below = T::of(1.0) + q.w;
            if below.simd_le(T::epsilon()).any() {
                return None; // −1: cay never reaches it
            }
            return Some(V::new(q.i, q.j, q.k) * (T::of(4.0) / below));
        }
        let q = g.as_ref();
        if q.w.simd_abs().simd_le(T::epsilon()).any() {
            return None; // a half turn: cay never reaches it
        }
        let factor = T::of(2.0) / q.w;
        Some(V::new(q.i, q.j, q.k) * factor)
    }
}
