//! The gradient in two parts: the same solutions as by Newton's method with matrices, in every lane.

use coadjoint::generating::VectorOf;
use coadjoint::lanes::ensemble::advance_all;
use coadjoint::lanes::{F64x8, Lanes};
use coadjoint::nalgebra::{SMatrix, SVector, Vector6};
use coadjoint::solve::{LaggedModel, Newton, NewtonModel, Predict, Settings, solve};
use coadjoint::steps::advance_by_with;
use coadjoint::{
    Chart, GeneratingFunction, Integrator, LieGroup, Phase, SE3, StepError, advance, advance_by,
    lie_poisson,
};

#[lie_poisson(group = SE3, truncation = 7)]
fn fluid(mu: [f64; 6]) -> f64 {
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

/// The same function without its parts: steps take the whole Hessian.
struct WithMatrices<'a, S>(&'a S);

impl<S, const N: usize> GeneratingFunction for WithMatrices<'_, S>
where
    S: LaggedModel + Integrator,
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    type Group = S::Group;
    type Chart = S::Chart;

    fn group(&self) -> &S::Group {
        self.0.group()
    }

    fn value(&self, p: &VectorOf<S>) -> f64 {
        self.0.value(p)
    }

    fn gradient(&self, p: &VectorOf<S>) -> VectorOf<S> {
        self.0.gradient(p)
    }

    fn gradient_and_hessian(&self, p: &VectorOf<S>) -> (VectorOf<S>, SMatrix<f64, N, N>) {
        self.0.gradient_and_hessian(p)
    }
}

impl<S, const N: usize> Predict for WithMatrices<'_, S>
where
    S: LaggedModel + Integrator,
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    fn predict(&self, mu: &VectorOf<S>) -> VectorOf<S> {
        self.0.predict(mu)
    }
}

impl<S, const N: usize> NewtonModel for WithMatrices<'_, S>
where
    S: LaggedModel + Integrator,
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
}

impl<S, const N: usize> Integrator for WithMatrices<'_, S>
where
    S: LaggedModel + Integrator,
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    type Method = Newton<Self>;
}

/// Momenta in many directions, of this size.
fn momenta<const N: usize>(size: f64) -> impl Iterator<Item = SVector<f64, N>> {
    (0..20)
        .map(move |k| SVector::from_fn(|i, _| size * (1.3 * f64::from(k) + 2.1 * i as f64).sin()))
}

/// The largest error of p = (d^R τ_x)ᵀ μ and of x = ∂S/∂p(p), as fractions, and of x against the way
/// with matrices.
fn errors<S, const N: usize>(step: &S, size: f64) -> Result<[f64; 3], StepError>
where
    S: LaggedModel + Integrator,
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    let (mut worst, mut made) = ([0.0; 3], 0);
    for mu in momenta::<N>(size) {
        let found = match solve(step, &mu) {
            // Few of the longest steps.
            Err(StepError::SeriesDiverges { .. }) => continue,
            found => found?,
        };
        made += 1;
        let known = solve(&WithMatrices(step), &mu)?;
        let pulled = S::Chart::default().pull_back(step.group(), &found.x, &mu);
        let errors = [
            (found.p - pulled).amax() / mu.amax(),
            (found.x - step.gradient(&found.p)).amax() / found.x.amax(),
            (found.x - known.x).amax(),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = error.max(*worst);
        }
    }
    assert!(made >= 10, "{made} of 20 steps");
    Ok(worst)
}

fn assert_small(errors: [f64; 3], case: &str) {
    assert!(errors.iter().all(|&e| e < 2e-14), "{case}: {errors:?}");
}

#[test]
fn solves_to_rounding_like_newton_with_matrices() -> Result<(), StepError> {
    for h in [1e-3, 0.05, 0.2, 0.5] {
        assert_small(errors(&Fluid::new(h)?, 0.8)?, &format!("fluid {h}"));
        assert_small(errors(&Top::new(h)?, 1.5)?, &format!("top {h}"));
        assert_small(errors(&Spins::new(h)?, 0.7)?, &format!("spins {h}"));
        assert_small(errors(&Coupled::new(h)?, 0.7)?, &format!("coupled {h}"));
    }
    Ok(())
}

#[test]
fn the_parts_make_up_the_gradient() -> Result<(), StepError> {
    let p = Vector6::new(1.0, 0.3, -0.4, 0.2, 0.8, -0.6);
    let parts = |h: f64| -> Result<[f64; 3], StepError> {
        let step = Fluid::new(h)?;
        let (coarse, fine) = (step.coarse_gradient(&p), step.fine_gradient(&p));
        let whole = step.gradient(&p);
        Ok([(coarse + fine - whole).amax(), fine.amax(), whole.amax()])
    };
    let (long, short) = (parts(0.4)?, parts(0.2)?);
    assert!(long[0] < 1e-15 * long[2] && short[0] < 1e-15 * short[2]);
    // What is fine is S₇.
    assert!((long[1] / short[1] - 128.0).abs() < 1e-9, "{}", long[1] / short[1]);

    // S₃ and beyond vanish with h: there the Hessian is that of S₁.
    let step = Coupled::new(1e-4)?;
    let v = Vector6::new(0.1, -0.7, 0.4, 0.9, 0.2, 0.5);
    let exact = step.gradient_and_hessian(&p).1 * v;
    let off = (step.leading_product(&p, &v) - exact).amax() / exact.amax();
    assert!(off > 1e-12 && off < 1e-7, "{off:e}");
    Ok(())
}

/// Guesses that lead from one to the next, and fine parts taken at them, leave no trace.
#[test]
fn steps_at_once_are_steps_one_by_one() -> Result<(), StepError> {
    let start = Phase::<SE3>::at_identity(Vector6::new(1.0, 0.3, -0.4, 0.2, 0.8, -0.6));
    for h in [0.02, 0.1, 0.3, 0.5, 0.8] {
        let step = Fluid::new(h)?;
        for steps in [1, 2, 3, 4, 9, 30] {
            let (mut one, mut many) = (start.clone(), start.clone());
            for _ in 0..steps {
                advance(&step, &mut one)?;
            }
            let report = advance_by(&step, &mut many, steps)?;
            let apart = (one.momentum - many.momentum).amax()
                + one.group_element.rotation.angle_to(&many.group_element.rotation)
                + (one.group_element.translation.vector - many.group_element.translation.vector)
                    .amax();
            assert!(apart < 1e-14 * (1.0 + steps as f64), "{h} {steps}: {apart:e}");
            assert!(report.residual < 1e-15, "{report:?}");
        }
    }
    Ok(())
}

#[test]
fn where_corrections_gain_little_newton_takes_over() -> Result<(), StepError> {
    let step = Fluid::new(1.6)?;
    assert_small(errors(&step, 1.0)?, "fluid 1.6");
    Ok(())
}

#[test]
fn a_state_that_is_not_finite_is_an_error() -> Result<(), StepError> {
    let mut mu = Vector6::repeat(1.0);
    mu[4] = f64::NAN;
    assert_eq!(solve(&Fluid::new(0.1)?, &mu).err(), Some(StepError::NonFiniteState));
    assert!(solve(&Fluid::new(0.1)?, &Vector6::zeros())?.x.amax() == 0.0);
    Ok(())
}

/// Lanes of very different speed: some need one fine gradient, some more, some Newton's method; and in some packs a
/// lane is refused, so that all of them go one by one.
fn lanes_are_scalars<S>(step: &S) -> Result<(), StepError>
where
    S: Integrator<Group = SE3> + Lanes + Sync,
    S::Over<F64x8>: Sync,
{
    let sizes = [0.05, 0.3, 1.0, 2.6, 0.0, 0.7, 1.7, 0.2];
    let mut states: Vec<_> = momenta::<6>(1.0)
        .zip(sizes)
        .map(|(mu, size)| Phase::<SE3>::at_identity(mu * size))
        .collect();
    let mut alone = states.clone();
    let failures = advance_all(step, &mut states, 10);
    let settings = Settings::default().with_single_steps();
    for (lane, (together, alone)) in states.iter().zip(&mut alone).enumerate() {
        let stopped = advance_by_with(step, alone, 10, settings).err();
        let failed = failures.iter().find(|failure| failure.index == lane);
        assert_eq!(failed.map(|f| (f.step, f.error)), stopped.map(|s| (s.steps, s.error)));
        assert_eq!(together.momentum, alone.momentum, "lane {lane}");
        assert_eq!(together.group_element, alone.group_element, "lane {lane}");
    }
    Ok(())
}

#[test]
fn lanes_equal_scalars_bit_for_bit() -> Result<(), StepError> {
    for h in [0.05, 0.3, 0.8] {
        lanes_are_scalars(&Fluid::new(h)?)?;
    }
    Ok(())
}
