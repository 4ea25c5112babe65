//! The part of a Hamiltonian on se(3)\* that depends on the linear momentum Γ.

use crate::{
    arithmetic::{Vector, cross, rotate},
    number::Number,
};

/// V = ∂H/∂Γ and what is made of it, each kind written without its vanishing terms.
pub trait Translation: Copy {
    /// V.
    fn velocity<T: Number>(&self, force: &[T; 3]) -> [T; 3];
    /// Γ × V.
    fn torque<T: Number>(&self, force: &[T; 3]) -> [T; 3];
    /// R V with R given by a unit quaternion.
    fn moved<T: Number>(&self, q: &[T; 4], force: &[T; 3]) -> [T; 3];
}

/// H(Γ) = w Γ_AXIS: a heavy top whose centre of mass lies on a principal axis; Γ is gravity's direction in the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity<const AXIS: usize> {
    /// Weight times the distance of the centre of mass from the fixed point.
    pub weight: f64,
}

impl<const AXIS: usize> Translation for Gravity<AXIS> {
    #[inline(always)]
    fn velocity<T: Number>(&self, _: &[T; 3]) -> [T; 3] {
        let mut v = [T::splat(0.0); 3];
        v[AXIS] = T::splat(self.weight);
        v
    }

    #[inline(always)]
    fn torque<T: Number>(&self, force: &[T; 3]) -> [T; 3] {
        let (next, last) = ((AXIS + 1) % 3, (AXIS + 2) % 3);
        let mut t = [T::splat(0.0); 3];
        t[next] = force[last] * self.weight;
        t[last] = force[next] * -self.weight;
        t
    }

    #[inline(always)]
    fn moved<T: Number>(&self, q: &[T; 4], _: &[T; 3]) -> [T; 3] {
        let (next, last) = ((AXIS + 1) % 3, (AXIS + 2) % 3);
        let (w, x, y, z) = (q[0], q[1 + AXIS], q[1 + next], q[1 + last]);
        let twice = 2.0 * self.weight;
        let mut column = [T::splat(0.0); 3];
        column[AXIS] = T::splat(self.weight) - (y * y + z * z) * twice;
        column[next] = (x * y + w * z) * twice;
        column[last] = (x * z - w * y) * twice;
        column
    }
}

/// H(Γ) = ½ Σ Γᵢ²/Mᵢ: a body in an ideal fluid (Kirchhoff).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// 1/Mᵢ, added mass included.
    pub inverse: Vector,
}

impl Translation for Mass {
    #[inline(always)]
    fn velocity<T: Number>(&self, force: &[T; 3]) -> [T; 3] {
        [force[0] * self.inverse[0], force[1] * self.inverse[1], force[2] * self.inverse[2]]
    }

    #[inline(always)]
    fn torque<T: Number>(&self, force: &[T; 3]) -> [T; 3] {
        cross(force, &self.velocity(force))
    }

    #[inline(always)]
    fn moved<T: Number>(&self, q: &[T; 4], force: &[T; 3]) -> [T; 3] {
        rotate(q, &self.velocity(force))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_is_a_constant_velocity() {
        let (q, force) = ([0.5, -0.5, 0.5, 0.5], [0.2, -0.7, 0.4]);
        fn check<const AXIS: usize>(q: &[f64; 4], force: &Vector) {
            let gravity = Gravity::<AXIS> { weight: 3.0 };
            let v = gravity.velocity(force);
            assert_eq!(gravity.torque(force), cross(force, &v).map(|x| x + 0.0));
            assert_eq!(gravity.moved(q, force), rotate(q, &v));
        }
        check::<0>(&q, &force);
        check::<1>(&q, &force);
        check::<2>(&q, &force);
    }
}
