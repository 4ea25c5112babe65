//! Families of steps by collocation that a Hamiltonian makes hard: with a pole, a tangent or the edge of a root that the motion comes to
//! within three steps; and smooth ones with steep flanks and short waves.

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::{Coordinates, MatrixGroup, SL2};
use coadjoint::{LieGroup, Phase, SE3, SO3};

use super::family::Family;
use super::flow::{DRAWS, Generic, Trial};
use super::random::Random;
use super::verdict::Tally;

/// The largest relative distance of an accepted step from the flow.
const FARTHEST: f64 = 0.2;

/// A function of one variable.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Profile {
    Pole,
    Tan,
    Root,
    Sin,
    Tanh,
    /// exp(w tanh u)
    ExpTanh,
}

/// `height`·f(u), u = `width`·(Σ `slope`ᵢ μᵢ − `offset`)
#[derive(Clone, Debug)]
struct Ridge {
    shape: Profile,
    height: f64,
    width: f64,
    slope: Vec<f64>,
    offset: f64,
}

impl Ridge {
    fn argument<V: Coordinates<f64>>(&self, m: &V) -> f64 {
        self.width * ((0..m.dim()).map(|i| self.slope[i] * m[i]).sum::<f64>() - self.offset)
    }

    /// f and f′.
    fn of(&self, u: f64) -> [f64; 2] {
        match self.shape {
            Profile::Pole => [1.0 / u, -1.0 / (u * u)],
            Profile::Tan => [u.tan(), 1.0 + u.tan() * u.tan()],
            Profile::Root => [u.sqrt(), 0.5 / u.sqrt()],
            Profile::Sin => [u.sin(), u.cos()],
            Profile::Tanh => [u.tanh(), 1.0 - u.tanh() * u.tanh()],
            Profile::ExpTanh => {
                let (t, w) = (u.tanh(), 4.0);
                let e = (w * t).exp();
                [e, w * e * (1.0 - t * t)]
            }
        }
    }

    /// The square of the way between two arguments, in the units in which f varies: as the programs of a text have it.
    fn square(&self, a: f64, b: f64) -> f64 {
        let ratio = |a: f64, b: f64| match (a - b) * (a - b) / (a * b) {
            _ if a == b => 0.0,
            square if square >= 0.0 => square,
            _ => f64::INFINITY,
        };
        let bounded = |u: f64| u.clamp(-9.0, 9.0);
        match self.shape {
            Profile::Pole | Profile::Root => ratio(a, b),
            Profile::Tan => ratio(a.cos(), b.cos()).max((a - b).powi(2)),
            Profile::Sin => (a - b).powi(2),
            Profile::Tanh => (bounded(a) - bounded(b)).powi(2),
            // Of exp, too.
            Profile::ExpTanh => {
                let inner = 16.0 * (a.tanh() - b.tanh()).powi(2);
                inner.max((bounded(a) - bounded(b)).powi(2))
            }
        }
    }

    /// Between which of its poles or edges a momentum is.
    fn side<V: Coordinates<f64>>(&self, m: &V) -> f64 {
        let u = self.argument(m);
        match self.shape {
            Profile::Pole | Profile::Root => u.signum(),
            Profile::Tan => (u / core::f64::consts::PI + 0.5).floor(),
            Profile::Sin | Profile::Tanh | Profile::ExpTanh => 0.0,
        }
    }
}

/// ½ Σ qᵢⱼ μᵢ μⱼ + terms
#[derive(Clone, Debug)]
struct Steep {
    form: Vec<Vec<f64>>,
    terms: Vec<Ridge>,
}

impl<V: Coordinates<f64>> Energy<V> for Steep {
    fn value(&self, _time: f64, m: &V) -> f64 {
        let half = |i: usize| (0..m.dim()).map(|j| self.form[i][j] * m[j]).sum::<f64>();
        let form: f64 = (0..m.dim()).map(|i| 0.5 * m[i] * half(i)).sum();
        form + self.terms.iter().map(|t| t.height * t.of(t.argument(m))[0]).sum::<f64>()
    }

    fn gradient(&self, _time: f64, m: &V) -> V {
        let mut slope =
            V::from_entries(m.dim(), |i| (0..m.dim()).map(|j| self.form[i][j] * m[j]).sum());
        for term in &self.terms {
            let along = term.height * term.width * term.of(term.argument(m))[1];
            for i in 0..m.dim() {
                slope[i] += along * term.slope[i];
            }
        }
        slope
    }

    fn reach(&self, from: (f64, &V), to: (f64, &V)) -> Option<f64> {
        let squares = self.terms.iter().map(|t| t.square(t.argument(from.1), t.argument(to.1)));
        Some(squares.fold(0.0, f64::max))
    }
}

/// A random system of a kind, a momentum and a step of it.
fn draw<G: LieGroup<Scalar = f64>>(
    group: &G,
    edges: bool,
    random: &mut Random,
) -> (Steep, f64, G::Vector) {
    let n = group.dim();
    let mut form = vec![vec![0.0; n]; n];
    for i in 0..n {
        form[i][i] = random.between(0.2, 1.5) * if random.one_in(4) { -1.0 } else { 1.0 };
        for j in 0..i {
            let entry = random.between(-0.25, 0.25);
            (form[i][j], form[j][i]) = (entry, entry);
        }
    }
    let size = random.between(0.2, 3.0);
    let direction = random.direction(n);
    let mu = G::Vector::from_entries(n, |i| size * direction[i]);
    let mut energy = Steep { form, terms: Vec::new() };
    let count = if edges { 1 } else { 1 + random.below(3) };
    for _ in 0..count {
        let slope = (0..n).map(|_| random.between(-2.0, 2.0)).collect();
        let shape = match (edges, random.below(3)) {
            (true, 0) => Profile::Pole,
            (true, 1) => Profile::Tan,
            (true, _) => Profile::Root,
            (false, 0) => Profile::Sin,
            (false, 1) => Profile::Tanh,
            (false, _) => Profile::ExpTanh,
        };
        let height =
            10_f64.powf(random.between(-3.0, 0.0)) * if random.one_in(2) { -1.0 } else { 1.0 };
        let width = if edges { 1.0 } else { 10_f64.powf(random.between(-0.5, 1.5)) };
        energy.terms.push(Ridge { shape, height, width, slope, offset: 0.0 });
    }
    let quadratic = Steep { terms: Vec::new(), ..energy.clone() };
    let mut velocity: G::Vector = quadratic.gradient(0.0, &mu);
    if !edges {
        velocity = energy.gradient(0.0, &mu);
    }
    let speed = velocity.pairing(&velocity).sqrt().max(1e-3);
    let longest = if random.one_in(2) { 2.0 } else { 0.7 };
    let h = random.between(0.02, longest) / speed;
    let h = if random.one_in(8) { -h } else { h };
    if edges {
        // The argument goes at this rate at first, were it not for the term, and is to be at the edge within three steps.
        let rate = group.ad_star(&velocity, &mu);
        let term = &mut energy.terms[0];
        let along = |v: &G::Vector| (0..n).map(|i| term.slope[i] * v[i]).sum::<f64>();
        let (now, away) = (along(&mu), along(&rate) * h * random.between(0.02, 3.0));
        term.offset = now + away;
        match term.shape {
            Profile::Tan => {
                term.width = random.between(0.3, 3.0);
                term.offset -= away.signum() * core::f64::consts::FRAC_PI_2 / term.width;
            }
            Profile::Root if away > 0.0 => {
                term.slope.iter_mut().for_each(|slope| *slope = -*slope);
                term.offset = -term.offset;
            }
            _ => {}
        }
        if random.one_in(3) {
            // As large a velocity as a share of the other.
            let alone = Steep { form: vec![vec![0.0; n]; n], terms: energy.terms.clone() };
            let own: G::Vector = alone.gradient(0.0, &mu);
            let own = own.pairing(&own).sqrt();
            if own > 0.0 && own.is_finite() {
                energy.terms[0].height *= speed * random.between(0.01, 1.0) / own;
            }
        }
    }
    (energy, h, mu)
}

/// An energy whose arguments are said to go nowhere, so that its steps are not followed.
struct Unfollowed<'a>(&'a Steep);

impl<V: Coordinates<f64>> Energy<V> for Unfollowed<'_> {
    fn value(&self, time: f64, m: &V) -> f64 {
        self.0.value(time, m)
    }

    fn gradient(&self, time: f64, m: &V) -> V {
        self.0.gradient(time, m)
    }

    fn reach(&self, _: (f64, &V), _: (f64, &V)) -> Option<f64> {
        Some(0.0)
    }
}

/// The momentum after a step that is judged at its nodes alone, where it is accepted.
fn unfollowed<G: LieGroup<Scalar = f64>, const M: usize>(
    group: &G,
    energy: &Steep,
    h: f64,
    mu: &G::Vector,
) -> Option<G::Vector> {
    let mut step = Collocation::<_, _, M>::new(group.clone(), Unfollowed(energy), h).ok()?;
    let mut state = Phase::<G>::new(group.identity(), mu.clone());
    step.advance(&mut state, 0.0).ok()?;
    Some(state.momentum)
}

/// Steps of one system with `M` nodes.
fn steps<G, const M: usize>(
    group: &G,
    (edges, seed): (bool, u64),
    random: &mut Random,
    tally: &mut Tally,
) where
    G: LieGroup<Scalar = f64> + 'static,
{
    let (energy, h, mu) = draw(group, edges, random);
    let Ok(step) = Collocation::<_, _, M>::new(group.clone(), energy.clone(), h) else { return };
    let sides = |m: &G::Vector| energy.terms.iter().map(|t| t.side(m)).collect::<Vec<_>>();
    let about = format!("seed {seed}, M = {M}, {energy:?}");
    let trial = Trial { group, energy: &energy, h, farthest: FARTHEST, sides: &sides, about };
    let mut mover = Generic { group: group.clone(), step, element: group.identity() };
    let right = |from: &G::Vector| {
        let end = unfollowed::<G, M>(group, &energy, h, from);
        end.and_then(|end| trial.share(from, &end)).is_some_and(|share| share <= 1.0)
    };
    trial.follow(&mut mover, mu, right, tally);
}

/// Steps of the systems of a seed, on all groups.
fn instance<const M: usize>(edges: bool, seed: u64, tally: &mut Tally) {
    let mut random = Random::new(seed);
    for _ in 0..DRAWS {
        let (random, of) = (&mut random, (edges, seed));
        match random.below(5) {
            0 => steps::<_, M>(&SO3::<f64>::new(), of, random, tally),
            1 => steps::<_, M>(&SE3::<f64>::new(), of, random, tally),
            2 => steps::<_, M>(&SL2::<f64>::new(), of, random, tally),
            3 => steps::<_, M>(&skew(SO21_SIGNS, random), of, random, tally),
            _ => steps::<_, M>(&skew(SO3_SIGNS, random), of, random, tally),
        }
    }
}

/// The structure constants [eᵢ, eⱼ] = ±eₖ, by the signs for (1, 2), (0, 2), (0, 1).
type Signs = [f64; 3];
const SO3_SIGNS: Signs = [1.0, -1.0, 1.0];
const SO21_SIGNS: Signs = [1.0, -1.0, -1.0];

/// A group of three dimensions in a basis of whole-numbered sums of its usual one.
fn skew(signs: Signs, random: &mut Random) -> MatrixGroup {
    let n = 3;
    let unit = |i, j| if i == j { 1.0 } else { 0.0 };
    let mut rows: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| unit(i, j)).collect()).collect();
    let mut back = rows.clone();
    for _ in 0..random.below(2 * n) {
        let (i, j) = (random.below(n), random.below(n));
        let by = random.below(5) as f64 - 2.0;
        if i != j {
            // Row i gains `by` times row j; of the inverse, column j loses as much of column i.
            for k in 0..n {
                rows[i][k] += by * rows[j][k];
                back[k][j] -= by * back[k][i];
            }
        }
    }
    let pairs = [(1, 2, 0), (0, 2, 1), (0, 1, 2)].into_iter().zip(signs);
    let old: Vec<(usize, usize, usize, f64)> =
        pairs.flat_map(|((i, j, k), v)| [(i, j, k, v), (j, i, k, -v)]).collect();
    let mut structure = Vec::new();
    for a in 0..n {
        for b in 0..n {
            for c in 0..n {
                let sum: f64 =
                    old.iter().map(|&(i, j, k, v)| rows[a][i] * rows[b][j] * v * back[k][c]).sum();
                if sum != 0.0 {
                    structure.push((a, b, c, sum));
                }
            }
        }
    }
    MatrixGroup::from_structure_constants(n, &structure).expect("a Lie algebra")
}

pub(super) fn families(only: &str) -> Vec<Family> {
    let mut all = Vec::new();
    for (kind, edges) in [("edge", true), ("steep", false)] {
        for nodes in 1..=5 {
            let name = format!("{kind}-{nodes}");
            let steps = move |seed: u64, tally: &mut Tally| match nodes {
                1 => instance::<1>(edges, seed, tally),
                2 => instance::<2>(edges, seed, tally),
                3 => instance::<3>(edges, seed, tally),
                4 => instance::<4>(edges, seed, tally),
                _ => instance::<5>(edges, seed, tally),
            };
            if name.contains(only) {
                all.push(Family::alone(name, steps));
            }
        }
    }
    all
}
