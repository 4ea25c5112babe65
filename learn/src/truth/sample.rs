//! Seeded samples of a true flow.

use coadjoint::groups::Coordinates;
use coadjoint::{LieGroup, Phase};
use nalgebra::DMatrix;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::flow::exact_flow;
use crate::data::{MomentumPairs, PhasePair};
use crate::function::{MomentumFunction, entries, vector};

/// The same interval for every coordinate of the momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumBox {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl MomentumBox {
    /// The paper's box of section 5.2: entries between 0 and 6.
    pub const PAPER: Self = Self { low: 0.0, high: 6.0 };
    /// [−1, 1]ⁿ.
    pub const UNIT: Self = Self { low: -1.0, high: 1.0 };

    fn draw<G: LieGroup<Scalar = f64>>(&self, dim: usize, rng: &mut impl Rng) -> G::Vector {
        G::Vector::from_entries(dim, |_| {
            let unit: f64 = rng.random();
            self.low + (self.high - self.low) * unit
        })
    }
}

/// `count` pairs of phase points one `step` of the exact flow apart: momenta uniform in
/// `momenta`, attitudes exp(y) with y uniform in [−1, 1]ⁿ.
pub fn phase_pairs<G, H>(
    group: &G,
    hamiltonian: &H,
    step: f64,
    momenta: MomentumBox,
    count: usize,
    seed: u64,
) -> Vec<PhasePair<G>>
where
    G: LieGroup<Scalar = f64>,
    H: MomentumFunction + ?Sized,
{
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let dim = group.dim();
    (0..count)
        .map(|_| {
            let mu = momenta.draw::<G>(dim, &mut rng);
            let attitude = group.exp(&MomentumBox::UNIT.draw::<G>(dim, &mut rng));
            let before = Phase::new(attitude, mu);
            let after = exact_flow(group, hamiltonian, &before, step);
            PhasePair { before, after }
        })
        .collect()
}

/// `count` pairs (μ, map(μ)) with μ uniform in `momenta`; `map` may be the exact flow or any
/// method of the user's, geometric or not.
pub fn momentum_pairs<G>(
    group: &G,
    momenta: MomentumBox,
    count: usize,
    seed: u64,
    mut map: impl FnMut(&G::Vector) -> G::Vector,
) -> MomentumPairs
where
    G: LieGroup<Scalar = f64>,
{
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let dim = group.dim();
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let mu = momenta.draw::<G>(dim, &mut rng);
        after.extend(entries(&map(&mu)));
        before.extend(entries(&mu));
    }
    MomentumPairs {
        before: DMatrix::from_vec(dim, count, before),
        after: DMatrix::from_vec(dim, count, after),
    }
}

/// Adds Gaussian noise of the given standard deviation: to momenta coordinate by coordinate, to
/// attitudes as g·exp(η), so that they stay in the group.
pub fn add_noise<G: LieGroup<Scalar = f64>>(
    group: &G,
    pairs: &[PhasePair<G>],
    deviation: f64,
    seed: u64,
) -> Vec<PhasePair<G>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let dim = group.dim();
    let mut gauss = || -> Vec<f64> {
        (0..dim)
            .map(|_| {
                let unit: f64 = StandardNormal.sample(&mut rng);
                deviation * unit
            })
            .collect()
    };
    let mut disturb = |phase: &Phase<G>| {
        let eta = gauss();
        let turn = group.exp(&vector::<G>(&gauss()));
        let mu = entries(&phase.momentum);
        let noisy: Vec<f64> = mu.iter().zip(&eta).map(|(m, e)| m + e).collect();
        Phase::new(group.compose(&phase.group_element, &turn), vector::<G>(&noisy))
    };
    pairs
        .iter()
        .map(|pair| PhasePair { before: disturb(&pair.before), after: disturb(&pair.after) })
        .collect()
}
