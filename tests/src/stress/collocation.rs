//! Families of steps by collocation: Hamiltonians with a root, a quadratic form and a linear one, drawn at random, in steps
//! h|Ω| up to 3. They are made by the runtime, and by the programs of a kernel.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::{Coordinates, Power, SE2, SL2, SU2};
use coadjoint::{LieGroup, SE3, SO3};
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::step::{Observation, Origin, Step};
use coadjoint_codegen::system::{Options, Parameters, read_either};
use coadjoint_program::{Precision, Stepper};

use super::family::{Family, algebra};
use super::flow::{DRAWS, Generic, Mover, Trial};
use super::random::Random;
use super::verdict::Tally;
use crate::backends::entries_of;

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
    pub(super) fn new(dim: usize, random: &mut Random) -> Self {
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

/// The programs of a kernel, for any values of the numbers of a [`Drawn`].
struct Routine {
    step: Step,
    observation: Observation,
}

/// By the name of the group and the number of nodes.
type Known = BTreeMap<(&'static str, usize), Arc<Routine>>;

/// Those on a group of the catalogue, by its name and a number of nodes, once they were asked for.
fn programs(group: &'static str, nodes: usize) -> Arc<Routine> {
    static KNOWN: LazyLock<Mutex<Known>> = LazyLock::new(Mutex::default);
    let mut known = KNOWN.lock().expect("a whole map");
    let build = || {
        let n = algebra(group).dim();
        let names: Vec<String> = (0..n).map(|i| format!("m{i}")).collect();
        let (ones, rows) = (vec![1; n], vec![vec![1; n]; n]);
        let text = format!(
            "group = {group:?}\ncoordinates = {names:?}\nhamiltonian = \"sqrt(1 + sum(i, 0..{n}, w[i]*mu[i]^2)) + \
             sum(i, 0..{n}, sum(j, 0..{n}, q[i][j]*mu[i]*mu[j]))/2 + sum(i, 0..{n}, b[i]*mu[i])\"\n\
             [parameters]\nw = {ones:?}\nq = {rows:?}\nb = {ones:?}\n"
        );
        let truncation = Some(2 * nodes - 1);
        let options = Options { truncation, parameters: Parameters::Kept, ..Options::default() };
        let Hamiltonian::Smooth(smooth) =
            read_either(&text, options, &[]).expect("a system").problem
        else {
            panic!("a root is no polynomial")
        };
        let step = Origin::Collocation(smooth).step(Precision::Double).expect("a kernel");
        Arc::new(Routine { observation: Observation::new(&step), step })
    };
    Arc::clone(known.entry((group, nodes)).or_insert_with(build))
}

/// A kernel's steps, by the interpreter.
struct Interpreted {
    programs: Arc<Routine>,
    slots: Vec<f64>,
    element: Vec<f64>,
}

impl<V: Coordinates<f64>> Mover<V> for Interpreted {
    fn advance(&mut self, mu: &mut V) -> bool {
        let kernel = self.programs.step.kernel();
        let mut numbers: Vec<f64> = (0..mu.dim()).map(|i| mu[i]).collect();
        let made = kernel.advance(&self.slots, &mut self.element, &mut numbers, 1).steps == 1;
        *mu = V::from_entries(numbers.len(), |i| numbers[i]);
        made
    }

    fn spatial(&self, mu: &V) -> V {
        let numbers: Vec<f64> = (0..mu.dim()).map(|i| mu[i]).collect();
        let spatial = self.programs.observation.spatial_momentum(&self.element, &numbers);
        V::from_entries(mu.dim(), |i| spatial[i])
    }
}

/// Steps of one system with `M` nodes; by programs where the group has this name in the catalogue.
fn steps<G, const M: usize>(
    group: &G,
    by_programs: Option<&'static str>,
    random: &mut Random,
    tally: &mut Tally,
) where
    G: LieGroup<Scalar = f64> + 'static,
{
    let n = group.dim();
    let energy = Drawn::new(n, random);
    let size = random.between(0.2, 3.0);
    let direction = random.direction(n);
    let mu = G::Vector::from_entries(n, |i| size * direction[i]);
    let velocity = energy.gradient(0.0, &mu);
    let longest = if random.one_in(2) { 3.0 } else { 0.8 };
    let h = random.between(0.05, longest) / velocity.pairing(&velocity).sqrt();
    let h = if random.one_in(8) { -h } else { h };
    let turn = G::Vector::from_entries(n, |_| random.between(-1.0, 1.0));
    let element = group.exp(&turn);
    let mut mover: Box<dyn Mover<G::Vector>> = match by_programs {
        None => {
            let step = Collocation::<_, _, M>::new(group.clone(), energy.clone(), h);
            let Ok(step) = step else { return };
            Box::new(Generic { group: group.clone(), step, element })
        }
        Some(name) => {
            let programs = programs(name, M);
            let form = energy.form.iter().flatten();
            let values: Vec<f64> =
                energy.root.iter().chain(form).chain(&energy.linear).copied().collect();
            let Ok(slots) = programs.step.fold(h, &values) else { return };
            let element = programs.step.element_of(&entries_of(group, &element));
            Box::new(Interpreted { programs, slots, element })
        }
    };
    let farthest = FARTHEST[M.min(FARTHEST.len()) - 1];
    let about = format!("M = {M}, {energy:?}");
    let trial = Trial { group, energy: &energy, h, farthest, sides: &|_| Vec::new(), about };
    trial.follow(mover.as_mut(), mu, |_| false, tally);
}

/// Steps of the systems of a seed, with any number of nodes.
fn instance<G: LieGroup<Scalar = f64> + 'static>(
    group: &G,
    by: Option<&'static str>,
    seed: u64,
    tally: &mut Tally,
) {
    let mut random = Random::new(seed);
    for _ in 0..DRAWS {
        match random.below(6) {
            0 => steps::<G, 1>(group, by, &mut random, tally),
            1 => steps::<G, 2>(group, by, &mut random, tally),
            2 => steps::<G, 3>(group, by, &mut random, tally),
            3 => steps::<G, 4>(group, by, &mut random, tally),
            4 => steps::<G, 5>(group, by, &mut random, tally),
            _ => steps::<G, 6>(group, by, &mut random, tally),
        }
    }
}

pub(super) fn families(only: &str) -> Vec<Family> {
    let mut all = Vec::new();
    for (place, name, known) in [
        (0, "so3", "SO3"),
        (1, "su2", "SU2"),
        (2, "se2", "SE2"),
        (3, "se3", "SE3"),
        (4, "sl2", "SL2"),
        (5, "power", "SO3^2"),
    ] {
        for by in [None, Some(known)] {
            let name = format!("collocation-{name}{}", if by.is_some() { "-kernel" } else { "" });
            let steps = move |seed: u64, tally: &mut Tally| match place {
                0 => instance(&SO3::<f64>::new(), by, seed, tally),
                1 => instance(&SU2::<f64>::new(), by, seed, tally),
                2 => instance(&SE2::<f64>::new(), by, seed, tally),
                3 => instance(&SE3::<f64>::new(), by, seed, tally),
                4 => instance(&SL2::<f64>::new(), by, seed, tally),
                _ => instance(&Power::<SO3, 2, 6>::new(), by, seed, tally),
            };
            if name.contains(only) {
                all.push(Family::alone(name, steps));
            }
        }
    }
    all
}
