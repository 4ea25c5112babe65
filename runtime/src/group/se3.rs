//! SE(3): rigid motions of space.

use core::marker::PhantomData;

use coadjoint_geometry::angle::Length;
use coadjoint_geometry::group::Group;
use coadjoint_geometry::motion::{Motion, Motions};
use coadjoint_geometry::rotation::Turn;
use nalgebra::{Isometry3, Translation3, Vector3, Vector6};

use crate::group::arrays::{array, by_formulas, cayley_by_formulas, nodes, rows};
use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::log::dexp_inverse;
use crate::group::so3::{self, SO3, rotation_from};
use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
use crate::number::Scalar;

/// The Euclidean group SE(3), elements as a rotation (unit quaternion) and a translation.
///
/// Coordinates x = (ω, v): three rotations about the axes, then three translations along them; on
/// the dual μ = (Π, Γ), the angular and the linear momentum (for a heavy top, the momentum and the
/// advected vertical). Brackets: [(ω, v), (η, w)] = (ω×η, ω×w − η×v). Matrices: 4×4, rotation and
/// translation column. Ad\*_g (Π, Γ) = (RΠ + t×RΓ, RΓ). Casimirs: |Γ|², Π·Γ. Both charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SE3<T = f64>(PhantomData<T>);

impl<T> SE3<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// A derived impl would ask for `T: Default`.
impl<T> Default for SE3<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FixedDimension for SE3<T> {
    const DIM: usize = 6;
}

type V<T> = Vector3<T>;

#[inline(always)]
fn split<T: Scalar>(x: &Vector6<T>) -> (V<T>, V<T>) {
    (V::new(x[0], x[1], x[2]), V::new(x[3], x[4], x[5]))
}

#[inline(always)]
fn join<T: Scalar>(a: &V<T>, b: &V<T>) -> Vector6<T> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

#[inline(always)]
fn isometry<T: Scalar>(rotation: nalgebra::UnitQuaternion<T>, t: V<T>) -> Isometry3<T> {
    Isometry3 { rotation, translation: Translation3 { vector: t } }
}

/// The numbers of an element: its quaternion, then its translation.
#[inline(always)]
pub(crate) fn numbers<T: Scalar>(g: &Isometry3<T>) -> [T; 7] {
    let ([w, i, j, k], [a, b, c]) = (so3::numbers(&g.rotation), array(&g.translation.vector));
    [w, i, j, k, a, b, c]
}

/// The element of these numbers.
#[inline(always)]
pub(crate) fn element<T: Scalar>([w, i, j, k, a, b, c]: [T; 7]) -> Isometry3<T> {
    isometry(so3::quaternion([w, i, j, k]), V::new(a, b, c))
}

#[inline(always)]
fn of_motion<T: Scalar>(motion: Motion<T>) -> Isometry3<T> {
    isometry(so3::quaternion(motion.turn.quaternion()), motion.place.into())
}

impl<T: Scalar> LieGroup for SE3<T> {
    type Scalar = T;
    type Vector = Vector6<T>;
    type Element = Isometry3<T>;

    by_formulas!(Motions);

    fn dim(&self) -> usize {
        6
    }

    fn identity(&self) -> Self::Element {
        isometry(SO3::new().identity(), V::repeat(T::of(0.0)))
    }

    /// The product; its rotation is kept on the unit sphere as SO(3)'s is.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        element(Motion::of(numbers(h)).after(numbers(g)))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        let place = Turn::of(so3::numbers(&g.rotation)).back(array(&g.translation.vector));
        isometry(g.rotation.conjugate(), -V::from(place))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        of_motion(Motions::exp(array(x), Length::Any))
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let motion = Motions::exp(array(x), Length::Any);
        (of_motion(motion), motion.back(array(mu)).into())
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let omega = SO3::new().log(&g.rotation)?;
        let c = dexp_inverse(array(&(omega * T::of(0.5))));
        let t = &g.translation.vector;
        let once = omega.cross(t);
        Some(join(&omega, &(t - once * T::of(0.5) + omega.cross(&once) * c)))
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        Motions::coadjoint(numbers(g), array(mu)).into()
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        Motions::defect(numbers(g))
    }

    fn casimir_count(&self) -> usize {
        2
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (pi, gamma) = split(mu);
        if index == 0 { gamma.norm_squared() } else { pi.dot(&gamma) }
    }

    fn matrix_size(&self) -> usize {
        4
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        match (row, column) {
            (0..3, 0..3) => SO3::new().matrix_entry(&g.rotation, row, column),
            (0..3, _) => g.translation.vector[row],
            _ => T::of(if column == 3 { 1.0 } else { 0.0 }),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(4, &entry)?;
        for column in 0..4 {
            fixed(&entry, (3, column), if column == 3 { 1.0 } else { 0.0 })?;
        }
        let t = V::from_fn(|row, _| entry(row, 3));
        Ok(isometry(rotation_from(entry)?, t))
    }
}

impl<T: Scalar> CayleyGroup for SE3<T> {
    cayley_by_formulas!(Motions);

    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        of_motion(Motions::cayley(array(x)))
    }

    fn cayley_inverse(&self, g: &Isometry3<T>) -> Option<Self::Vector> {
        let omega = SO3::new().cayley_inverse(&g.rotation)?;
        let t = &g.translation.vector;
        Some(join(&omega, &(t - omega.cross(t) * T::of(0.5))))
    }
}
