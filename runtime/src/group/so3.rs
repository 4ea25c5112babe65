//! SO(3), the rotations of space, and SU(2), their double cover, as unit quaternions.

use coadjoint_geometry::group::Matrices;
use coadjoint_geometry::rotation::{Quaternions, Turn};
use coadjoint_geometry::vector::{V3, cross, dot, scaled};
use nalgebra::{Matrix3, Quaternion, Rotation3, SimdBool, UnitQuaternion};

use crate::group::closed::{Closed, Formulas};
use crate::group::element_error::{ElementError, fixed, within};
use crate::group::log::log_factor;
use crate::linear::square;
use crate::number::Scalar;

/// The rotation group SO(3), elements as unit quaternions.
///
/// Basis: the generators of rotations about the three axes, [e₁, e₂] = e₃ and cyclic, so that
/// [x, y] = x × y, Ad_R x = Rx, Ad\*_R μ = Rμ, ad\*_x μ = μ × x. Casimir: |μ|². The logarithm has |x| ≤ π. Both charts.
pub type SO3<T = f64> = Closed<Quaternions<false>, T, 3, 4>;

/// The group SU(2), elements as unit quaternions; q and −q are different here.
///
/// Basis: e_k = −iσ_k/2 with the Pauli matrices, so that [e₁, e₂] = e₃ and cyclic, and brackets,
/// Ad and Ad\* are those of [`SO3`]. Matrices: the complex 2×2 matrix a + ib as the real 4×4
/// matrix ((a, −b), (b, a)). Casimir: |μ|². The logarithm has |x| < 2π, and is `None` at −1, which every direction
/// reaches. Both charts; the Cayley map is that of the 2×2 matrices, which differs from SO(3)'s.
pub type SU2<T = f64> = Closed<Quaternions<true>, T, 3, 4>;

/// The rotation whose matrix has these (finite) entries.
pub(super) fn rotation_from<T: Scalar>(
    entry: impl Fn(usize, usize) -> T,
) -> Result<UnitQuaternion<T>, ElementError> {
    let m = Matrix3::from_fn(entry);
    let gram = m.transpose() * m;
    let defect = square::largest_entry(3, &(gram - Matrix3::identity()));
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
    let q = [entry(0, 0), -entry(2, 1), entry(1, 0), -entry(2, 0)];
    let norm = dot(q, q).simd_sqrt();
    let defect = (norm - T::of(1.0)).simd_abs();
    if !within(defect, T::of(1.0)) {
        return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
    }
    let q = q.map(|entry| entry / norm);
    let matrix = Quaternions::<true>::matrix(q);
    for row in 0..4 {
        for column in 0..4 {
            let expected = matrix[row][column];
            fixed(&|i, j| entry(i, j) - expected, (row, column), 0.0)?;
        }
    }
    Ok(Quaternions::<true>::element(q))
}

impl<const COVER: bool> Formulas<3, 4> for Quaternions<COVER> {
    type Element<T: Scalar> = UnitQuaternion<T>;

    const ROWS: usize = if COVER { 4 } else { 3 };
    const CASIMIRS: usize = 1;

    #[inline(always)]
    fn numbers<T: Scalar>(q: &UnitQuaternion<T>) -> [T; 4] {
        let q = q.as_ref();
        [q.w, q.i, q.j, q.k]
    }

    #[inline(always)]
    fn element<T: Scalar>([w, i, j, k]: [T; 4]) -> UnitQuaternion<T> {
        UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k))
    }

    #[inline(always)]
    fn of_increment<T: Scalar>(h: Turn<T>) -> UnitQuaternion<T> {
        Self::element(h.quaternion())
    }

    fn compose<T: Scalar>(g: &UnitQuaternion<T>, h: &UnitQuaternion<T>) -> UnitQuaternion<T> {
        Self::element(Turn::of(Self::numbers(h)).after(Self::numbers(g)))
    }

    fn inverse<T: Scalar>(g: &UnitQuaternion<T>) -> UnitQuaternion<T> {
        g.conjugate()
    }

    fn log<T: Scalar>(g: &UnitQuaternion<T>) -> Option<V3<T>> {
        let [w, u @ ..] = Self::numbers(g);
        // q and −q are the same rotation; the one with w ≥ 0 has the smaller angle.
        let sign = if COVER { T::of(1.0) } else { T::of(1.0).simd_copysign(w) };
        let squared = dot(u, u);
        let [negative, short] =
            [w.simd_lt(T::of(0.0)), squared.simd_le(T::epsilon() * T::epsilon())];
        let known = !COVER || !negative.any() || !short.any();
        known.then(|| scaled(log_factor(w * sign, squared) * sign, u))
    }

    fn cayley_inverse<T: Scalar>(g: &UnitQuaternion<T>) -> Option<V3<T>> {
        let [w, u @ ..] = Self::numbers(g);
        // A half turn, and −1 of the cover, are never reached.
        let (below, above) = if COVER { (T::of(1.0) + w, 4.0) } else { (w, 2.0) };
        let reached = !below.simd_abs().simd_le(T::epsilon()).any();
        reached.then(|| scaled(T::of(above) / below, u))
    }

    fn casimir<T: Scalar>(_index: usize, mu: V3<T>) -> T {
        dot(mu, mu)
    }

    fn entry<T: Scalar>(g: &UnitQuaternion<T>, row: usize, column: usize) -> T {
        match COVER {
            true => Quaternions::<true>::matrix(Self::numbers(g))[row][column],
            false => Quaternions::<false>::matrix(Self::numbers(g))[row][column],
        }
    }

    fn from_matrix<T: Scalar>(
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<UnitQuaternion<T>, ElementError> {
        if COVER { complex_from(entry) } else { rotation_from(entry) }
    }
}
