//! Families of steps by collocation: Hamiltonians with a root, a quadratic form and a linear one, drawn at random, in steps
//! h|Ω| up to 3, whose results are compared with the flow by another method in short steps.

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::{Coordinates, Power, SE2, SL2, SU2};
use coadjoint::{LieGroup, Phase, SE3, SO3};

use super::family::Family;
use super::random::Random;
use super::verdict::{Tally, Wrong};

/// Systems and momenta drawn of one seed.
const DRAWS: usize = 32;
/// Steps made from each, the later ones from guesses by the earlier ones.
const STEPS: usize = 4;
/// Steps of the other method for one of ours.
const FINE: usize = 128;
/// How far, relatively, a step with 1, 2, 3 or more nodes may be from the flow. Another branch is farther away than any.
const FARTHEST: [f64; 4] = [0.2, 0.2, 2e-2, 5e-3];

/// √(1 + Σ wᵢ μᵢ²) + ½ Σ qᵢⱼ μᵢ μⱼ + Σ bᵢ μᵢ
#[derive(Clone, Debug)]
pub struct Drawn {
    pub root: Vec<f64>,
    pub form: Vec<Vec<f64>>,
    pub linear: Vec<f64>,
}

impl Drawn {
    fn new(dim: usize, random: &mut Random) -> Self {
        let mut form = vec![vec![0.0; dim]; dim];
        for i in 0..dim {
            for j in 0..i {
                let entry = random.between(-0.25, 0.25);
                (form[i][j], form[j][i]) = (entry, entry);
            }
        }
        let root = (0..dim).map(|_| random.between(0.2, 1.5)).collect();
        let linear = (0..dim).map(|_| random.between(-0.35, 0.35)).collect();
        Self { root, form, linear }
    }

    fn root<V: Coordinates<f64>>(&self, m: &V) -> f64 {
        (1.0 + (0..m.dim()).map(|i| self.root[i] * m[i] * m[i]).sum::<f64>()).sqrt()
    }

    fn half<V: Coordinates<f64>>(&self, m: &V, i: usize) -> f64 {
        (0..m.dim()).map(|j| self.form[i][j] * m[j]).sum()
    }
}

impl<V: Coordinates<f64>> Energy<V> for Drawn {
    fn value(&self, _time: f64, m: &V) -> f64 {
        let sum = |i: usize| m[i] * (0.5 * self.half(m, i) + self.linear[i]);
        self.root(m) + (0..m.dim()).map(sum).sum::<f64>()
    }

    fn gradient(&self, _time: f64, m: &V) -> V {
        let root = self.root(m);
        let entry = |i: usize| self.root[i] * m[i] / root + self.half(m, i) + self.linear[i];
        V::from_entries(m.dim(), entry)
    }
}

/// The momentum after the time h, by the classical Runge–Kutta method.
fn flow<G: LieGroup<Scalar = f64>>(group: &G, energy: &Drawn, h: f64, mu: &G::Vector) -> G::Vector {
    let n = group.dim();
    let slope = |m: &G::Vector| group.ad_star(&energy.gradient(0.0, m), m);
    let ahead =
        |m: &G::Vector, s: f64, k: &G::Vector| G::Vector::from_entries(n, |i| m[i] + s * k[i]);
    let (mut m, h) = (mu.clone(), h / FINE as f64);
    for _ in 0..FINE {
        let a = slope(&m);
        let b = slope(&ahead(&m, 0.5 * h, &a));
        let c = slope(&ahead(&m, 0.5 * h, &b));
        let d = slope(&ahead(&m, h, &c));
        let mean = G::Vector::from_entries(n, |i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0);
        m = ahead(&m, h, &mean);
    }
    m
}

/// The largest sum of magnitudes in a coordinate of Ad\*_g μ, in which they may cancel.
fn summands<G: LieGroup<Scalar = f64>>(group: &G, state: &Phase<G>) -> f64 {
    let n = group.dim();
    let mut sums = vec![0.0; n];
    for j in 0..n {
        let column = group.coadjoint(&state.group_element, &G::Vector::unit(n, j));
        for i in 0..n {
            sums[i] += (column[i] * state.momentum[j]).abs();
        }
    }
    sums.into_iter().fold(0.0, f64::max)
}

/// Steps of one system with `M` nodes.
fn steps<G, const M: usize>(group: &G, random: &mut Random, tally: &mut Tally)
where
    G: LieGroup<Scalar = f64>,
{
    let n = group.dim();
    let energy = Drawn::new(n, random);
    let far = |a: &G::Vector, b: &G::Vector| a.clone().minus(b).largest_entry();
    let size = random.between(0.2, 3.0);
    let direction = random.direction(n);
    let mu = G::Vector::from_entries(n, |i| size * direction[i]);
    let velocity = energy.gradient(0.0, &mu);
    let longest = if random.one_in(2) { 3.0 } else { 0.8 };
    let h = random.between(0.05, longest) / velocity.pairing(&velocity).sqrt();
    let h = if random.one_in(8) { -h } else { h };
    let turn = G::Vector::from_entries(n, |_| random.between(-1.0, 1.0));
    let mut state = Phase::<G>::new(group.exp(&turn), mu);
    let spatial = state.spatial_momentum(group);
    let Ok(mut step) = Collocation::<_, _, M>::new(group.clone(), energy.clone(), h) else {
        return;
    };
    for _ in 0..STEPS {
        let before = state.clone();
        let example = || format!("M = {M}, h = {h}, μ = {:?}, {energy:?}", before.momentum);
        if step.advance(&mut state, 0.0).is_err() {
            tally.refused += 1;
            if far(&state.momentum, &before.momentum) != 0.0 {
                tally.note(Wrong::Changed, example);
            }
            break;
        }
        tally.accepted += 1;
        let kept = far(&state.spatial_momentum(group), &spatial) / summands(group, &state);
        tally.deviation = tally.deviation.max(kept / 1e-12);
        if kept.is_nan() || kept > 1e-12 {
            tally.note(Wrong::State, example);
        }
        let exact = flow(group, &energy, h, &before.momentum);
        let error = far(&state.momentum, &exact) / before.momentum.largest_entry();
        let share = error / FARTHEST[M.min(FARTHEST.len()) - 1];
        if share.is_nan() || share > 1.0 {
            tally.note(Wrong::Branch, || format!("{error:.1e} from the flow: {}", example()));
        } else if share > tally.residual {
            (tally.residual, tally.worst) = (share, example());
        }
    }
}

/// Steps of the systems of a seed, with any number of nodes.
fn instance<G: LieGroup<Scalar = f64>>(group: &G, seed: u64, tally: &mut Tally) {
    let mut random = Random::new(seed);
    for _ in 0..DRAWS {
        match random.below(6) {
            0 => steps::<G, 1>(group, &mut random, tally),
            1 => steps::<G, 2>(group, &mut random, tally),
            2 => steps::<G, 3>(group, &mut random, tally),
            3 => steps::<G, 4>(group, &mut random, tally),
            4 => steps::<G, 5>(group, &mut random, tally),
            _ => steps::<G, 6>(group, &mut random, tally),
        }
    }
}

type Instances = fn(u64, &mut Tally);

pub(super) fn families(only: &str) -> Vec<Family> {
    let all: [(&str, Instances); 6] = [
        ("collocation-so3", |seed, tally| instance(&SO3::<f64>::new(), seed, tally)),
        ("collocation-su2", |seed, tally| instance(&SU2::<f64>::new(), seed, tally)),
        ("collocation-se2", |seed, tally| instance(&SE2::<f64>::new(), seed, tally)),
        ("collocation-se3", |seed, tally| instance(&SE3::<f64>::new(), seed, tally)),
        ("collocation-sl2", |seed, tally| instance(&SL2::<f64>::new(), seed, tally)),
        ("collocation-power", |seed, tally| instance(&Power::<SO3, 2, 6>::new(), seed, tally)),
    ];
    let chosen = all.into_iter().filter(|(name, _)| name.contains(only));
    chosen.map(|(name, instance)| Family::alone(name, instance)).collect()
}
