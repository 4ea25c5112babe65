//! Measures a map: errors of x, μ″ and g″ on pairs, and drifts over many steps.

use coadjoint::groups::Chart;
use coadjoint::steps::{Monitor, advance, poisson_map};
use coadjoint::{LieGroup, Phase};
use serde::{Deserialize, Serialize};

use crate::data::{MomentumPairs, PairRows, ReducedData};
use crate::error::LearnError;
use crate::function::{Generating, MomentumFunction, entries, vector};
use crate::group::matrix_of;

/// An error in each of the three quantities; a quantity the data do not have is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// The error of ∂S/∂p(p) against x, at the p of the data.
    pub x: Option<f64>,
    /// The error of the momentum μ″ after a step.
    pub momentum: Option<f64>,
    /// The error of the group element g″ after a step, in entries of its matrix.
    pub group: Option<f64>,
}

/// Errors of a map on data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// The number of samples.
    pub samples: usize,
    /// Mean squared errors, over samples and coordinates.
    pub mse: Errors,
    /// Largest absolute errors of a coordinate.
    pub max_error: Errors,
    /// Row numbers of samples whose step could not be made; they are left out of momentum and
    /// group errors.
    pub unsolved: Vec<usize>,
}

/// Gathers squares and largest values.
#[derive(Default)]
struct Gauge {
    squares: f64,
    largest: f64,
    count: usize,
}

impl Gauge {
    fn add(&mut self, error: f64) {
        self.squares += error * error;
        self.largest = self.largest.max(error.abs());
        self.count += 1;
    }

    fn mse(&self) -> Option<f64> {
        (self.count > 0).then(|| self.squares / self.count as f64)
    }

    fn largest(&self) -> Option<f64> {
        (self.count > 0).then_some(self.largest)
    }
}

/// Measures the errors of the map that S generates, on pairs of phase points and their reduction.
pub fn evaluate<G, C, M>(
    map: &Generating<G, C, M>,
    group: &G,
    pairs: &PairRows<G>,
    reduced: &ReducedData,
) -> Figures
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
    M: MomentumFunction,
{
    let dim = group.dim();
    let mut x = Gauge::default();
    let mut found = vec![0.0; dim];
    for (p, expected) in reduced.p.column_iter().zip(reduced.x.column_iter()) {
        map.function.gradient(p.as_slice(), &mut found);
        found.iter().zip(expected.iter()).for_each(|(a, b)| x.add(a - b));
    }
    let mut figures = evaluate_with(group, pairs, |before| {
        let mut phase = before.clone();
        advance(map, &mut phase).ok()?;
        Some(phase)
    });
    figures.mse.x = x.mse();
    figures.max_error.x = x.largest();
    figures
}

/// Measures the errors of any map of phase points on pairs; `map` returns `None` for a point it cannot take.
pub fn evaluate_with<G: LieGroup<Scalar = f64>>(
    group: &G,
    pairs: &PairRows<G>,
    map: impl Fn(&Phase<G>) -> Option<Phase<G>>,
) -> Figures {
    let [mut momentum, mut attitude] = [(); 2].map(|()| Gauge::default());
    let mut unsolved = Vec::new();
    for (row, pair) in &pairs.pairs {
        let Some(phase) = map(&pair.before) else {
            unsolved.push(*row);
            continue;
        };
        let expected = &pair.after;
        (0..group.dim()).for_each(|i| momentum.add(phase.momentum[i] - expected.momentum[i]));
        let difference =
            matrix_of(group, &phase.group_element) - matrix_of(group, &expected.group_element);
        difference.iter().for_each(|&e| attitude.add(e));
    }
    Figures {
        samples: pairs.pairs.len(),
        mse: Errors { x: None, momentum: momentum.mse(), group: attitude.mse() },
        max_error: Errors { x: None, momentum: momentum.largest(), group: attitude.largest() },
        unsolved,
    }
}

/// Measures the errors of the Poisson map that S generates, on pairs of momenta.
pub fn evaluate_momenta<G, C, M>(map: &Generating<G, C, M>, pairs: &MomentumPairs) -> Figures
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
    M: MomentumFunction,
{
    let mut momentum = Gauge::default();
    let mut unsolved = Vec::new();
    let columns = pairs.before.column_iter().zip(pairs.after.column_iter());
    for (i, (before, after)) in columns.enumerate() {
        match poisson_map(map, &vector::<G>(before.as_slice())) {
            Ok(next) => (0..after.len()).for_each(|j| momentum.add(next[j] - after[j])),
            Err(_) => unsolved.push(i + 1),
        }
    }
    Figures {
        samples: pairs.count(),
        mse: Errors { momentum: momentum.mse(), ..Errors::default() },
        max_error: Errors { momentum: momentum.largest(), ..Errors::default() },
        unsolved,
    }
}

/// Drifts of conserved quantities along a trajectory: the largest over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Drifts {
    /// The number of steps made.
    pub steps: usize,
    /// The drift of the spatial momentum J_L, relative to its largest coordinate.
    pub momentum: f64,
    /// The largest drift of a Casimir, relative to its scale, as in [`Monitor`].
    pub casimir: f64,
    /// The relative drift of the energy; `None` where no Hamiltonian is known.
    pub energy: Option<f64>,
}

/// Follows the map from `start` and measures the drifts.
///
/// # Errors
/// [`LearnError::NotConverged`] when a step cannot be made, naming it.
pub fn drifts<G, C, M>(
    map: &Generating<G, C, M>,
    group: &G,
    start: &Phase<G>,
    steps: usize,
    hamiltonian: Option<&dyn MomentumFunction>,
) -> Result<Drifts, LearnError>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
    M: MomentumFunction,
{
    let energy = |phase: &Phase<G>| {
        hamiltonian.map_or(0.0, |hamiltonian| hamiltonian.value(&entries(&phase.momentum)))
    };
    let mut phase = start.clone();
    let mut monitor = Monitor::new(group.clone(), start, energy(start));
    for step in 1..=steps {
        advance(map, &mut phase)
            .map_err(|error| LearnError::NotConverged(format!("step {step}: {error}")))?;
        monitor.observe(&phase, energy(&phase));
    }
    let drift = monitor.drift();
    Ok(Drifts {
        steps,
        momentum: drift.spatial_momentum,
        casimir: drift.casimirs,
        energy: hamiltonian.map(|_| drift.energy),
    })
}
