//! True flows to make data from: Hamiltonians, their exact flow to rounding, seeded samples, and methods that keep no
//! geometry.

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::Coordinates;
use coadjoint::{LieGroup, Phase};
use nalgebra::DMatrix;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::data::{MomentumPairs, PhasePair};
use crate::function::{Hamiltonian, MomentumFunction, entries, vector};

/// H = ½ Σ wᵢ μᵢ² + Σ bᵢ μᵢ + ¼ Σ vᵢ μᵢ⁴: the free rigid body, the heavy top, and their like.
#[derive(Clone, Debug, PartialEq)]
pub struct Separable {
    /// w, of a body the reciprocal moments of inertia.
    pub weights: Vec<f64>,
    /// b, of the same length.
    pub linear: Vec<f64>,
    /// v, of the same length.
    pub quartic: Vec<f64>,
}

impl Separable {
    /// The quadratic function with these w; b = v = 0.
    pub fn quadratic(weights: Vec<f64>) -> Self {
        let zero = vec![0.0; weights.len()];
        Self { weights, linear: zero.clone(), quartic: zero }
    }

    /// The free rigid body on so(3)\* with the principal moments of inertia given.
    pub fn rigid_body(inertia: [f64; 3]) -> Self {
        Self::quadratic(inertia.map(f64::recip).to_vec())
    }

    /// The rigid body of the paper, inertia (1.5, 2, 2.5).
    pub fn paper() -> Self {
        Self::rigid_body([1.5, 2.0, 2.5])
    }

    /// The heavy top on se(3)\*, μ = (Π, Γ): H = ½ Π·I⁻¹Π + mgl χ·Γ (Marsden and Ratiu,
    /// *Introduction to Mechanics and Symmetry*, section 1.4).
    pub fn heavy_top(inertia: [f64; 3], weight_arm: [f64; 3]) -> Self {
        let [a, b, c] = inertia.map(f64::recip);
        let [x, y, z] = weight_arm;
        let linear = vec![0.0, 0.0, 0.0, x, y, z];
        Self { linear, ..Self::quadratic(vec![a, b, c, 0.0, 0.0, 0.0]) }
    }
}

impl MomentumFunction for Separable {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let term = |i: usize| {
            let (w, b, v) = (self.weights[i], self.linear[i], self.quartic[i]);
            ((0.5 * w + 0.25 * v * p[i] * p[i]) * p[i] + b) * p[i]
        };
        (0..self.dim()).map(term).sum()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        for (i, entry) in gradient.iter_mut().enumerate() {
            let (w, b, v) = (self.weights[i], self.linear[i], self.quartic[i]);
            *entry = (w + v * p[i] * p[i]) * p[i] + b;
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        hessian.fill(0.0);
        let dim = self.dim();
        for i in 0..dim {
            hessian[i * dim + i] = self.weights[i] + 3.0 * self.quartic[i] * p[i] * p[i];
        }
    }
}

/// H = √(1 + Σ wᵢ μᵢ²) + a sin μ₁: no polynomial, and no polynomial S either.
#[derive(Clone, Debug, PartialEq)]
pub struct Relativistic {
    /// The weights w, one for each coordinate of the momentum.
    pub weights: Vec<f64>,
    /// The amplitude a of the sine.
    pub ripple: f64,
}

impl Relativistic {
    fn root(&self, p: &[f64]) -> f64 {
        (1.0 + p.iter().zip(&self.weights).map(|(v, w)| w * v * v).sum::<f64>()).sqrt()
    }
}

impl MomentumFunction for Relativistic {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        self.root(p) + self.ripple * p[0].sin()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let root = self.root(p);
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.weights[i] * p[i] / root;
        }
        gradient[0] += self.ripple * p[0].cos();
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let root = self.root(p);
        let dim = self.dim();
        for i in 0..dim {
            for j in 0..dim {
                let slope = |k: usize| self.weights[k] * p[k] / root;
                let diagonal = if i == j { self.weights[i] } else { 0.0 };
                hessian[i * dim + j] = (diagonal - slope(i) * slope(j)) / root;
            }
        }
        hessian[0] -= self.ripple * p[0].sin();
    }
}

/// H = ½ Σ wᵢ μᵢ² + a exp(−½ Σ sᵢ (μᵢ − cᵢ)²): a body with a bump off its axes, far from any
/// polynomial and no function of a simpler Hamiltonian.
#[derive(Clone, Debug, PartialEq)]
pub struct Bump {
    /// The weights w, one for each coordinate of the momentum.
    pub weights: Vec<f64>,
    /// The height a of the bump.
    pub height: f64,
    /// The sharpness s of the bump in each coordinate.
    pub sharpness: Vec<f64>,
    /// The centre c of the bump.
    pub centre: Vec<f64>,
}

impl Bump {
    /// sᵢ (μᵢ − cᵢ).
    fn pull(&self, p: &[f64], i: usize) -> f64 {
        self.sharpness[i] * (p[i] - self.centre[i])
    }

    /// The second term.
    fn bell(&self, p: &[f64]) -> f64 {
        let square: f64 = (0..p.len()).map(|i| self.pull(p, i) * (p[i] - self.centre[i])).sum();
        self.height * (-0.5 * square).exp()
    }
}

impl MomentumFunction for Bump {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        0.5 * p.iter().zip(&self.weights).map(|(v, w)| w * v * v).sum::<f64>() + self.bell(p)
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let bell = self.bell(p);
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.weights[i] * p[i] - self.pull(p, i) * bell;
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let (bell, dim) = (self.bell(p), self.dim());
        for i in 0..dim {
            for j in 0..dim {
                let diagonal =
                    if i == j { self.weights[i] - self.sharpness[i] * bell } else { 0.0 };
                hessian[i * dim + j] = diagonal + self.pull(p, i) * self.pull(p, j) * bell;
            }
        }
    }
}

/// The largest coordinate of h ∂H/∂μ in a step of order 12: its error is then below rounding.
const STEP_ANGLE: f64 = 0.4;

/// The largest number of times a refused step is halved.
const HALVINGS: u32 = 10;

/// Advances (g, μ) by the exact flow of H∘J_R for the time `time`: ġ = g·ξ, μ̇ = ad\*_ξ μ with
/// ξ = ∂H/∂μ, to about 10⁻¹⁴, by collocation in short steps. The momentum is NaN where H varies too much for these.
pub fn exact_flow<G, H>(group: &G, hamiltonian: &H, phase: &Phase<G>, time: f64) -> Phase<G>
where
    G: LieGroup<Scalar = f64>,
    H: MomentumFunction + ?Sized,
{
    if time == 0.0 {
        return phase.clone();
    }
    let energy = Hamiltonian(hamiltonian);
    let speed = energy.gradient(0.0, &phase.momentum).largest_entry();
    let mut parts = (time.abs() * speed / STEP_ANGLE).ceil().max(1.0);
    for _ in 0..HALVINGS {
        let mut end = phase.clone();
        let step = Collocation::<_, _, 6>::new(group.clone(), &energy, time / parts);
        if step.is_ok_and(|mut step| step.advance_by(&mut end, 0.0, parts as u64).is_ok()) {
            return end;
        }
        parts *= 2.0;
    }
    let nothing = G::Vector::from_entries(group.dim(), |_| f64::NAN);
    Phase::new(phase.group_element.clone(), nothing)
}

/// A box with one interval for all coordinates of the momentum.
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

#[cfg(test)]
mod tests {
    use super::*;
    use coadjoint::SO3;
    use nalgebra::Vector3;

    /// The end state A of the free body I = (1.5, 2, 2.5), T = 100, computed at 40 digits with a
    /// separate implementation (first row of the group element and the momentum).
    #[test]
    fn agrees_with_the_reference_end_state() {
        let start = Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0));
        let end = exact_flow(&SO3::new(), &Separable::paper(), &start, 100.0);
        let momentum = [2.010_707_126_264_523, -0.368_082_789_198_529, -1.035_167_577_102_806_4];
        let row = [0.651_502_388_035_256_8, -0.611_371_780_984_644_3, -0.449_187_248_038_077_9];
        for i in 0..3 {
            assert!((end.momentum[i] - momentum[i]).abs() < 1e-11, "{}", end.momentum);
            let entry = SO3::<f64>::new().matrix_entry(&end.group_element, 0, i);
            assert!((entry - row[i]).abs() < 1e-11);
        }
    }

    #[test]
    fn one_long_step_is_many_short_ones() {
        let group = SO3::new();
        let start = Phase::<SO3>::at_identity(Vector3::new(5.0, 1.0, 3.0));
        let whole = exact_flow(&group, &Separable::paper(), &start, 1.0);
        let mut parts = start;
        for _ in 0..64 {
            parts = exact_flow(&group, &Separable::paper(), &parts, 1.0 / 64.0);
        }
        assert!((whole.momentum - parts.momentum).norm() < 1e-12);
        assert!(whole.group_element.angle_to(&parts.group_element) < 1e-12);
    }
}
