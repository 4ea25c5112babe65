//! SE(3): rigid motions of space.

use coadjoint_geometry::group::Matrices;
use coadjoint_geometry::motion::{Motion, Motions, halves};
use coadjoint_geometry::rotation::{Quaternions, Turn};
use coadjoint_geometry::vector::{V3, cross, dot, minus, plus, plus_by};
use nalgebra::{Isometry3, Translation3};

use crate::group::closed::{Closed, Formulas};
use crate::group::element_error::{ElementError, fixed};
use crate::group::log::dexp_inverse;
use crate::group::so3::rotation_from;
use crate::number::Scalar;

/// The Euclidean group SE(3), elements as a rotation (unit quaternion) and a translation.
///
/// Coordinates x = (ω, v): three rotations about the axes, then three translations along them; on
/// the dual μ = (Π, Γ), the angular and the linear momentum (for a heavy top, the momentum and the
/// advected vertical). Brackets: [(ω, v), (η, w)] = (ω×η, ω×w − η×v). Matrices: 4×4, rotation and
/// translation column. Ad\*_g (Π, Γ) = (RΠ + t×RΓ, RΓ). Casimirs: |Γ|², Π·Γ. Both charts.
pub type SE3<T = f64> = Closed<Motions, T, 6, 7>;

/// The rotations of space.
type Space = Quaternions<false>;

/// The turn of an element, and its translation.
#[inline(always)]
fn parts<T: Scalar>(g: &Isometry3<T>) -> (Turn<T>, V3<T>) {
    (Turn::of(Space::numbers(&g.rotation)), g.translation.vector.into())
}

#[inline(always)]
fn whole<T: Scalar>([a, b, c]: V3<T>, [d, e, f]: V3<T>) -> [T; 6] {
    [a, b, c, d, e, f]
}

impl Formulas<6, 7> for Motions {
    type Element<T: Scalar> = Isometry3<T>;

    const ROWS: usize = 4;
    const CASIMIRS: usize = 2;

    #[inline(always)]
    fn numbers<T: Scalar>(g: &Isometry3<T>) -> [T; 7] {
        let ([w, i, j, k], (_, [a, b, c])) = (Space::numbers(&g.rotation), parts(g));
        [w, i, j, k, a, b, c]
    }

    #[inline(always)]
    fn element<T: Scalar>([w, i, j, k, a, b, c]: [T; 7]) -> Isometry3<T> {
        Self::of_increment(Motion { turn: Turn::of([w, i, j, k]), place: [a, b, c] })
    }

    #[inline(always)]
    fn of_increment<T: Scalar>(h: Motion<T>) -> Isometry3<T> {
        let translation = Translation3 { vector: h.place.into() };
        Isometry3 { rotation: Space::of_increment(h.turn), translation }
    }

    fn compose<T: Scalar>(g: &Isometry3<T>, h: &Isometry3<T>) -> Isometry3<T> {
        Self::element(Motion::of(Self::numbers(h)).after(Self::numbers(g)))
    }

    fn inverse<T: Scalar>(g: &Isometry3<T>) -> Isometry3<T> {
        let (turn, t) = parts(g);
        Self::of_increment(Motion { turn: turn.inverse(), place: minus(turn.back(t)) })
    }

    fn log<T: Scalar>(g: &Isometry3<T>) -> Option<[T; 6]> {
        let ((_, t), omega) = (parts(g), Space::log(&g.rotation)?);
        let c = dexp_inverse(omega.map(|entry| entry * T::of(0.5)));
        let once = cross(omega, t);
        Some(whole(omega, plus(plus_by(t, -0.5, once), c, cross(omega, once))))
    }

    fn cayley_inverse<T: Scalar>(g: &Isometry3<T>) -> Option<[T; 6]> {
        let ((_, t), omega) = (parts(g), Space::cayley_inverse(&g.rotation)?);
        Some(whole(omega, plus_by(t, -0.5, cross(omega, t))))
    }

    fn casimir<T: Scalar>(index: usize, mu: [T; 6]) -> T {
        let [pi, gamma] = halves(mu);
        dot(gamma, if index == 0 { gamma } else { pi })
    }

    fn entry<T: Scalar>(g: &Isometry3<T>, row: usize, column: usize) -> T {
        Self::matrix(Self::numbers(g))[row][column]
    }

    fn from_matrix<T: Scalar>(
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Isometry3<T>, ElementError> {
        for column in 0..4 {
            fixed(&entry, (3, column), if column == 3 { 1.0 } else { 0.0 })?;
        }
        let vector = [entry(0, 3), entry(1, 3), entry(2, 3)].into();
        Ok(Isometry3 { rotation: rotation_from(entry)?, translation: Translation3 { vector } })
    }
}
