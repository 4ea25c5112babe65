//! Printed steps of long series in more than three dimensions: those of the reference (`lanes`: in every lane).

use coadjoint::generating::VectorOf;
use coadjoint::nalgebra::SVector;
use coadjoint::solve::{Integrator, solve};
use coadjoint::steps::{poisson_map, reconstruct};
use coadjoint::{LieGroup, Phase, StepError, lie_poisson};

#[lie_poisson(group = SE3, truncation = 7)]
pub fn fluid(mu: [f64; 6]) -> f64 {
    let [a, b, c, u, v, w] = mu;
    (a * a + b * b / 2.0 + c * c / 3.0 + u * u + v * v / 2.0 + w * w / 4.0) / 2.0
}

#[lie_poisson(group = SE3, truncation = 7, chart = cayley)]
fn top(mu: [f64; 6]) -> f64 {
    (mu[0] * mu[0] + mu[1] * mu[1]) / 4.0 + mu[2] * mu[2] / 2.0 + mu[3]
}

#[lie_poisson(group = SO3^2, truncation = 7)]
fn spins(mu: [f64; 6]) -> f64 {
    let [a, b, c, d, e, f] = mu;
    a * d + b * e + c * f / 2.0
}

#[lie_poisson(group = Heisenberg^2, truncation = 7)]
fn coupled(mu: [f64; 6]) -> f64 {
    let [a, b, c, d, e, f] = mu;
    (a * a + b * b) / 2.0 + (d * d + e * e) / 3.0 + a * a * d / 5.0 + c * f
}

/// Momenta in many directions, of this size.
pub fn momenta<const N: usize>(size: f64) -> impl Iterator<Item = SVector<f64, N>> {
    (0..20)
        .map(move |k| SVector::from_fn(|i, _| size * (1.3 * f64::from(k) + 2.1 * i as f64).sin()))
}

/// The largest difference of the momentum after a step from that by Newton's method in loops, the reference.
fn error<S, const N: usize>(step: &S, size: f64) -> Result<f64, StepError>
where
    S: Integrator,
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    let (mut worst, mut made) = (0.0, 0);
    for mu in momenta::<N>(size) {
        let moved: VectorOf<S> = match poisson_map(step, &mu) {
            // Few of the longest steps.
            Err(StepError::SeriesDiverges { .. }) => continue,
            moved => moved?,
        };
        made += 1;
        let mut reference = Phase::<S::Group>::new(step.group().identity(), mu);
        let found = solve(step, &mu)?;
        reconstruct(step, &mut reference, &found.x)?;
        worst = f64::max(worst, (moved - reference.momentum).amax());
    }
    assert!(made >= 10, "{made} of 20 steps");
    Ok(worst)
}

#[test]
fn steps_are_those_of_the_reference() -> Result<(), StepError> {
    for h in [1e-3, 0.05, 0.2, 0.5] {
        let errors = [
            error(&Fluid::new(h)?, 0.8)?,
            error(&Top::new(h)?, 1.5)?,
            error(&Spins::new(h)?, 0.7)?,
            error(&Coupled::new(h)?, 0.7)?,
        ];
        assert!(errors.iter().all(|&e| e < 2e-14), "{h}: {errors:?}");
    }
    let long = error(&Fluid::new(1.6)?, 1.0)?;
    assert!(long < 2e-14, "{long}");
    Ok(())
}
