//! One-step methods that keep no geometry: what `geometrize` is for.

use std::str::FromStr;

use coadjoint::LieGroup;

use crate::error::LearnError;
use crate::function::{entries, vector};

/// An explicit Runge–Kutta method on μ̇ = ad\*_{∂H/∂μ} μ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OneStep {
    /// Forward Euler, of order 1: the paper's.
    Euler,
    /// Heun's trapezoidal method, of order 2.
    Heun,
    /// The classical method of order 4.
    Rk4,
}

impl FromStr for OneStep {
    type Err = LearnError;

    fn from_str(name: &str) -> Result<Self, LearnError> {
        match name {
            "euler" => Ok(Self::Euler),
            "heun" => Ok(Self::Heun),
            "rk4" => Ok(Self::Rk4),
            _ => Err(LearnError::option("map", name, "use euler, heun or rk4")),
        }
    }
}

impl OneStep {
    /// One step of size `step` from `mu`, given ∂H/∂μ.
    pub fn advance<G: LieGroup<Scalar = f64>>(
        self,
        group: &G,
        gradient: impl Fn(&[f64], &mut [f64]),
        mu: &G::Vector,
        step: f64,
    ) -> G::Vector {
        let start = entries(mu);
        let rate = |at: &[f64]| {
            let mut velocity = vec![0.0; at.len()];
            gradient(at, &mut velocity);
            entries(&group.ad_star(&vector::<G>(&velocity), &vector::<G>(at)))
        };
        let along = |rate: &[f64], part: f64| -> Vec<f64> {
            start.iter().zip(rate).map(|(y, k)| y + part * step * k).collect()
        };
        let first = rate(&start);
        let next = match self {
            Self::Euler => along(&first, 1.0),
            Self::Heun => {
                let second = rate(&along(&first, 1.0));
                let mean: Vec<f64> =
                    first.iter().zip(&second).map(|(a, b)| 0.5 * (a + b)).collect();
                along(&mean, 1.0)
            }
            Self::Rk4 => {
                let second = rate(&along(&first, 0.5));
                let third = rate(&along(&second, 0.5));
                let fourth = rate(&along(&third, 1.0));
                let mean: Vec<f64> = (0..start.len())
                    .map(|i| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0)
                    .collect();
                along(&mean, 1.0)
            }
        };
        vector::<G>(&next)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use coadjoint::SO3;
    use nalgebra::Vector3;

    use super::*;
    use crate::function::MomentumFunction;
    use crate::truth::{Quadratic, exact_momentum_flow};

    /// Halving the step divides the error of one step by 2^(order + 1).
    #[test]
    fn each_method_has_its_order() {
        let (group, body) = (SO3::new(), Quadratic::paper());
        let start = Vector3::new(2.0, 0.5, 1.0);
        for (name, order) in [("euler", 1), ("heun", 2), ("rk4", 4)] {
            let method: OneStep = name.parse().unwrap();
            let error = |h: f64| {
                let next = method.advance(&group, |p, g| body.gradient(p, g), &start, h);
                (next - exact_momentum_flow(&group, &body, &start, h)).norm()
            };
            let slope = (error(0.05) / error(0.025)).log2();
            assert!((slope - f64::from(order + 1)).abs() < 0.15, "{name}: {slope}");
        }
        assert!("verlet".parse::<OneStep>().unwrap_err().to_string().contains("rk4"));
    }
}
