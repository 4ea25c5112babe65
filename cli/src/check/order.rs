//! The order of accuracy, measured by step halving.

use coadjoint::{Chart, StepError, poisson_map};
use nalgebra::DVector;
use rand_chacha::ChaCha8Rng;

use super::laws::vector;
use super::{Law, Trial};
use crate::engine::{Group, Interpreter};
use crate::error::CliError;

/// Steps of the coarsest run.
const STEPS: usize = 4;
/// Differences below this, relative to the momentum, are rounding.
const ROUNDING: f64 = 2e-12;
/// How far the measured order may fall below K + 1.
const SLACK: f64 = 0.3;

/// Runs h, h/2 and h/4 over the same time; the differences shrink by 2^order. Of the steps
/// h·2^j tried the smallest is taken whose differences are above rounding: there the leading term
/// of the error dominates best. Where all differences are rounding the map is exact, and the order
/// counts as infinite.
pub fn measure<G: Group, C: Chart<G>>(
    trial: &Trial<'_>,
    group: &G,
    random: &mut ChaCha8Rng,
) -> Result<Law, CliError> {
    let mu = vector(random, group.dim(), trial.size);
    let run = |step: f64, steps: usize| -> Result<DVector<f64>, StepError> {
        let map = Interpreter::<G, C>::new(trial.integrator, group.clone(), step)?;
        (0..steps).try_fold(mu.clone(), |mu, _| poisson_map(&map, &mu))
    };
    let mut order = f64::INFINITY;
    for exponent in -6..=12 {
        let h = trial.step * 2_f64.powi(exponent);
        let runs: Result<Vec<_>, _> =
            (0..3).map(|halvings| run(h / f64::from(1 << halvings), STEPS << halvings)).collect();
        // Beyond the step where the solve fails nothing is to be measured.
        let Ok(runs) = runs else { break };
        let coarse = (&runs[0] - &runs[1]).amax() / trial.size;
        let fine = (&runs[1] - &runs[2]).amax() / trial.size;
        if fine > ROUNDING {
            order = (coarse / fine).log2();
            break;
        }
    }
    let expected = trial.integrator.order() as f64;
    Ok(Law {
        name: "order",
        statement: "error ∝ h^(K+1), by step halving",
        value: order,
        bound: expected - SLACK,
        pass: order >= expected - SLACK,
    })
}
