//! Where a run ended, and how far that is from the reference.

use crate::arithmetic::{Quaternion, Vector, matrix};

/// A rotation as the method at hand carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rotation {
    /// A unit quaternion, scalar part first.
    Quaternion(Quaternion),
    /// A matrix by rows.
    Matrix([Vector; 3]),
}

/// A point of T\*G in the left trivialisation: body momentum and group element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Angular momentum in the body.
    pub momentum: Vector,
    /// Linear momentum in the body (for a top: gravity's direction in the body); zero for the free body.
    pub force: Vector,
    /// The attitude, body to space.
    pub rotation: Rotation,
    /// The translation part of the group element; zero for the free body.
    pub position: Vector,
}

/// The units in which the components of a state are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Unit of the angular momentum.
    pub momentum: f64,
    /// Unit of the position.
    pub position: f64,
}

impl State {
    /// The largest difference of a component of (momentum, force, rotation, position) from `reference`, in units of
    /// `scale`; a rotation given as a quaternion counts as 2|q − ±q_ref|. Not a number counts as infinite.
    #[must_use]
    pub fn error(&self, reference: &State, scale: &Scale) -> f64 {
        let parts = [
            difference(&self.momentum, &reference.momentum) / scale.momentum,
            difference(&self.force, &reference.force),
            self.rotation.error(&reference.rotation),
            difference(&self.position, &reference.position) / scale.position,
        ];
        parts.into_iter().fold(0.0, largest)
    }
}

impl Rotation {
    fn error(&self, reference: &Rotation) -> f64 {
        if let (Self::Quaternion(a), Self::Quaternion(b)) = (self, reference) {
            let opposite = b.map(|component| -component);
            return 2.0 * difference(a, b).min(difference(a, &opposite));
        }
        let (a, b) = (self.matrix(), reference.matrix());
        (0..3).map(|row| difference(&a[row], &b[row])).fold(0.0, largest)
    }

    /// The rotation matrix by rows.
    #[must_use]
    pub fn matrix(&self) -> [Vector; 3] {
        match self {
            Self::Quaternion(q) => matrix(q),
            Self::Matrix(rows) => *rows,
        }
    }
}

fn difference<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, largest)
}

/// The maximum that does not drop a NaN.
fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: State = State {
        momentum: [1.0, 2.0, 3.0],
        force: [0.0; 3],
        rotation: Rotation::Quaternion([0.6, 0.0, 0.8, 0.0]),
        position: [0.0; 3],
    };
    const UNIT: Scale = Scale { momentum: 1.0, position: 1.0 };

    #[test]
    fn the_sign_of_a_quaternion_does_not_matter() {
        let there = State { rotation: Rotation::Quaternion([-0.6, 0.0, -0.8, 0.0]), ..HERE };
        assert_eq!(there.error(&HERE, &UNIT), 0.0);
    }

    #[test]
    fn matrix_and_quaternion_compare() {
        let there = State { rotation: Rotation::Matrix(HERE.rotation.matrix()), ..HERE };
        assert_eq!(there.error(&HERE, &UNIT), 0.0);
    }

    #[test]
    fn not_a_number_is_infinitely_wrong() {
        let there = State { position: [0.0, f64::NAN, 0.0], ..HERE };
        assert_eq!(there.error(&HERE, &UNIT), f64::INFINITY);
    }
}
