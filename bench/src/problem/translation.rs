//! The part of a Hamiltonian on se(3)\* that depends on the linear momentum Γ.

use crate::arithmetic::{Quaternion, Vector, cross, rotate};

/// V = ∂H/∂Γ and what is made of it, each kind written without its vanishing terms.
pub trait Translation: Copy {
    /// V.
    fn velocity(&self, force: &Vector) -> Vector;
    /// Γ × V.
    fn torque(&self, force: &Vector) -> Vector;
    /// R V with R given by a unit quaternion.
    fn moved(&self, q: &Quaternion, force: &Vector) -> Vector;
}

/// H(Γ) = w Γ_AXIS: a heavy top whose centre of mass lies on a principal axis; Γ is gravity's direction in the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity<const AXIS: usize> {
    /// Weight times the distance of the centre of mass from the fixed point.
    pub weight: f64,
}

impl<const AXIS: usize> Translation for Gravity<AXIS> {
    #[inline(always)]
    fn velocity(&self, _: &Vector) -> Vector {
        let mut v = [0.0; 3];
        v[AXIS] = self.weight;
        v
    }

    #[inline(always)]
    fn torque(&self, force: &Vector) -> Vector {
        let (next, last) = ((AXIS + 1) % 3, (AXIS + 2) % 3);
        let mut t = [0.0; 3];
        t[next] = force[last] * self.weight;
        t[last] = -force[next] * self.weight;
        t
    }

    #[inline(always)]
    fn moved(&self, q: &Quaternion, _: &Vector) -> Vector {
        let (next, last) = ((AXIS + 1) % 3, (AXIS + 2) % 3);
        let (w, x, y, z) = (q[0], q[1 + AXIS], q[1 + next], q[1 + last]);
        let twice = 2.0 * self.weight;
        let mut column = [0.0; 3];
        column[AXIS] = self.weight - twice * (y * y + z * z);
        column[next] = twice * (x * y + w * z);
        column[last] = twice * (x * z - w * y);
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
    fn velocity(&self, force: &Vector) -> Vector {
        [self.inverse[0] * force[0], self.inverse[1] * force[1], self.inverse[2] * force[2]]
    }

    #[inline(always)]
    fn torque(&self, force: &Vector) -> Vector {
        cross(force, &self.velocity(force))
    }

    #[inline(always)]
    fn moved(&self, q: &Quaternion, force: &Vector) -> Vector {
        rotate(q, &self.velocity(force))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_is_a_constant_velocity() {
        let (q, force) = ([0.5, -0.5, 0.5, 0.5], [0.2, -0.7, 0.4]);
        fn check<const AXIS: usize>(q: &Quaternion, force: &Vector) {
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
