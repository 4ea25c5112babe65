//! Families of steps by collocation, compared with the flow: of Hamiltonians with a root, a quadratic form and a linear one, by the
//! runtime and by the programs of a kernel; and of Hamiltonians that make steps hard, with a pole, a tangent or the edge of a root
//! that the motion comes to within three steps, or with steep flanks and short waves.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::{Coordinates, MatrixGroup, Power, SE2, SL2, SU2};
use coadjoint::{LieGroup, SE3, SO3};
use coadjoint_codegen::smooth::{Hamiltonian, Smooth};
use coadjoint_codegen::step::Origin;
use coadjoint_codegen::system::{Options, Parameters, read_either};
use coadjoint_program::Precision;
use nalgebra::DVector;

use super::family::{Family, algebra};
use super::flow::Trial;
use super::kernels::{self, Subject};
use super::random::Random;
use super::runtime::{Snapshot, Steps, Transition, Way, phase, snapshot};
use super::verdict::Tally;
use crate::backends::Backend;
use crate::bridge::named;
use crate::kernels::TextEnergy;

/// Systems and momenta drawn of one seed.
const DRAWS: usize = 32;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Draw {
    /// √(1 + Σ wᵢ μᵢ²) + ½ Σ qᵢⱼ μᵢ μⱼ + Σ bᵢ μᵢ
    Root,
    /// ½ Σ qᵢⱼ μᵢ μⱼ and a term of [`EDGES`], whose edge the motion comes to within three steps.
    Edge,
    /// ½ Σ qᵢⱼ μᵢ μⱼ and up to three terms of [`FLANKS`].
    Flank,
}

impl Draw {
    /// How far, relatively, a step with this number of nodes may be from the flow. Another branch is farther away than any.
    fn farthest(self, nodes: usize) -> f64 {
        match (self, nodes) {
            (Self::Root, 3) => 2e-2,
            (Self::Root, 4..) => 5e-3,
            _ => 0.2,
        }
    }
}

/// Functions f of terms `height`·f(u), u = `width`·(Σ `slope`ᵢ μᵢ − `offset`).
const EDGES: [&str; 3] = ["1/(u)", "tan(u)", "sqrt(u)"];
const FLANKS: [&str; 3] = ["sin(u)", "tanh(u)", "exp(4*tanh(u))"];

#[derive(Clone, Debug)]
struct Term {
    f: &'static str,
    height: f64,
    width: f64,
    slope: Vec<f64>,
    offset: f64,
}

impl Term {
    fn along(&self, m: &[f64]) -> f64 {
        self.slope.iter().zip(m).map(|(slope, m)| slope * m).sum()
    }

    /// Between which of its poles or edges a momentum is.
    fn side(&self, m: &[f64]) -> f64 {
        let u = self.width * (self.along(m) - self.offset);
        match EDGES.iter().position(|f| *f == self.f) {
            Some(1) => (u / core::f64::consts::PI + 0.5).floor(),
            Some(_) => u.signum(),
            None => 0.0,
        }
    }
}

/// A Hamiltonian for any values of its numbers, and the programs of a kernel where they are asked for.
struct Routine {
    smooth: Smooth,
    kernel: Option<Arc<Subject>>,
}

/// That with these functions in its terms, or a root if there are none, on a group of the catalogue; made once.
fn routine(group: &str, nodes: usize, terms: &[&str], with_kernel: bool) -> Arc<Routine> {
    static KNOWN: LazyLock<Mutex<BTreeMap<String, Arc<Routine>>>> = LazyLock::new(Mutex::default);
    let (n, count) = (algebra(group).dim(), terms.len());
    let argument = |k: usize| format!("(c[{k}]*(sum(i, 0..{n}, s[{k}][i]*mu[i]) - o[{k}]))");
    let each = terms.iter().enumerate();
    let each = each.map(|(k, f)| format!("h[{k}]*{}", f.replace("(u)", &argument(k))));
    let (rest, own) = match count {
        0 => {
            let root = format!("sqrt(1 + sum(i, 0..{n}, w[i]*mu[i]^2))");
            (
                root + &format!(" + sum(i, 0..{n}, b[i]*mu[i])"),
                format!("w = {0:?}\nb = {0:?}", vec![1; n]),
            )
        }
        _ => {
            let (ones, slopes) = (vec![1; count], vec![vec![1; n]; count]);
            (
                each.collect::<Vec<_>>().join(" + "),
                format!("h = {ones:?}\nc = {ones:?}\ns = {slopes:?}\no = {ones:?}"),
            )
        }
    };
    let text = format!(
        "group = {group:?}\nhamiltonian = \"sum(i, 0..{n}, sum(j, 0..{n}, q[i][j]*mu[i]*mu[j]))/2 + {rest}\"\n\
         [parameters]\nq = {:?}\n{own}\n",
        vec![vec![1; n]; n]
    );
    let build = || {
        let truncation = Some(2 * nodes - 1);
        let options = Options { truncation, parameters: Parameters::Kept, ..Options::default() };
        let read = read_either(&text, options, &[]).expect("a system").problem;
        let Hamiltonian::Smooth(smooth) = read else { panic!("a polynomial: {text}") };
        let kernel = with_kernel.then(|| {
            let step = Origin::Collocation(smooth.clone()).step(Precision::Double);
            Arc::new(Subject::new(step.expect("a kernel"), named(group), Backend::Interpreter))
        });
        Arc::new(Routine { smooth: *smooth, kernel })
    };
    let mut known = KNOWN.lock().expect("a whole map");
    Arc::clone(known.entry(format!("{nodes}, {with_kernel}, {text}")).or_insert_with(build))
}

/// The numbers of a Hamiltonian.
#[derive(Clone, Debug)]
struct Drawn {
    form: Vec<Vec<f64>>,
    root: Vec<f64>,
    linear: Vec<f64>,
    terms: Vec<Term>,
}

impl Drawn {
    fn new(draw: Draw, n: usize, random: &mut Random) -> Self {
        let mut form = vec![vec![0.0; n]; n];
        for i in 0..n {
            if draw != Draw::Root {
                form[i][i] = random.between(0.2, 1.5) * random.sign_one_in(4);
            }
            for j in 0..i {
                let entry = random.between(-0.25, 0.25);
                (form[i][j], form[j][i]) = (entry, entry);
            }
        }
        let mut list = |low, high| (0..n).map(|_| random.between(low, high)).collect();
        let (root, linear) = match draw {
            Draw::Root => (list(0.2, 1.5), list(-0.35, 0.35)),
            _ => (Vec::new(), Vec::new()),
        };
        let count = match draw {
            Draw::Root => 0,
            Draw::Edge => 1,
            Draw::Flank => 1 + random.below(3),
        };
        let terms = (0..count).map(|_| {
            let slope = (0..n).map(|_| random.between(-2.0, 2.0)).collect();
            let f = if draw == Draw::Edge { EDGES } else { FLANKS }[random.below(3)];
            let height = 10_f64.powf(random.between(-3.0, 0.0)) * random.sign_one_in(2);
            let width =
                if draw == Draw::Edge { 1.0 } else { 10_f64.powf(random.between(-0.5, 1.5)) };
            Term { f, height, width, slope, offset: 0.0 }
        });
        Self { form, root, linear, terms: terms.collect() }
    }

    /// The values of the parameters of its [`Routine`].
    fn values(&self) -> Vec<f64> {
        let of = |number: fn(&Term) -> f64| self.terms.iter().map(number).collect::<Vec<_>>();
        let slopes = self.terms.iter().flat_map(|term| term.slope.clone()).collect();
        let own = [of(|term| term.height), of(|term| term.width), slopes, of(|term| term.offset)];
        [self.form.concat(), self.root.clone(), self.linear.clone(), own.concat()].concat()
    }

    /// The gradient of the form.
    fn turning(&self, m: &[f64]) -> Vec<f64> {
        self.form.iter().map(|row| row.iter().zip(m).map(|(q, m)| q * m).sum()).collect()
    }

    /// Moves the edge of the term to where the motion would be, were it not for the term, after 0.02 to 3 steps.
    fn meet(&mut self, group: &MatrixGroup, (h, mu): (f64, &[f64]), random: &mut Random) {
        let turning = DVector::from_vec(self.turning(mu));
        let rate = group.ad_star(&turning, &DVector::from_column_slice(mu));
        let term = &mut self.terms[0];
        let along = term.along(rate.as_slice());
        let (now, away) = (term.along(mu), along * h * random.between(0.02, 3.0));
        term.offset = now + away;
        match EDGES.iter().position(|f| *f == term.f) {
            Some(1) => {
                term.width = random.between(0.3, 3.0);
                term.offset -= away.signum() * core::f64::consts::FRAC_PI_2 / term.width;
            }
            Some(2) if away > 0.0 => {
                term.slope.iter_mut().for_each(|slope| *slope = -*slope);
                term.offset = -term.offset;
            }
            _ => {}
        }
    }
}

/// An energy, with the way that its arguments go as its steps see it.
struct Seen<'a> {
    energy: TextEnergy<'a>,
    /// As if they went nowhere.
    still: bool,
}

impl<V: Coordinates<f64>> Energy<V> for Seen<'_> {
    fn value(&self, time: f64, m: &V) -> f64 {
        self.energy.value(time, m)
    }

    fn gradient(&self, time: f64, m: &V) -> V {
        self.energy.gradient(time, m)
    }

    fn reach(&self, from: (f64, &V), to: (f64, &V)) -> Option<f64> {
        if self.still { Some(0.0) } else { self.energy.reach(from, to) }
    }
}

/// Steps with `M` nodes, by the runtime.
struct Generic<'a, G, const M: usize> {
    group: &'a G,
    energy: Seen<'a>,
    h: f64,
}

impl<G: LieGroup<Scalar = f64>, const M: usize> Steps for Generic<'_, G, M> {
    fn go(&self, way: Way, at: &[f64], mu: &[f64]) -> Option<Transition> {
        let mut step =
            Collocation::<_, _, M>::new(self.group.clone(), &self.energy, self.h).ok()?;
        let mut state = phase(self.group, at, mu);
        let before: Snapshot = snapshot(self.group, &state);
        let made = step.advance_by(&mut state, 0.0, way.steps());
        let error = made.err().map(|stopped| stopped.error.to_string());
        Some(Transition { before, after: snapshot(self.group, &state), error })
    }
}

/// The systems of a family: how they are drawn, and whether by programs.
type Of = (Draw, bool);

/// Draws and judges steps of one system with `M` nodes, on a group of the runtime and the same one by tables.
fn steps<G, const M: usize>(
    (group, name, tables): (&G, &str, &MatrixGroup),
    (draw, by_programs): Of,
    random: &mut Random,
    tally: &mut Tally,
) where
    G: LieGroup<Scalar = f64>,
{
    let n = group.dim();
    let mut drawn = Drawn::new(draw, n, random);
    let functions: Vec<&str> = drawn.terms.iter().map(|term| term.f).collect();
    // A formula knows no more of a group than its dimension.
    let name = if by_programs { name.to_owned() } else { format!("R{n}") };
    let routine = routine(&name, M, &functions, by_programs);
    let gradient_of = |drawn: &Drawn, mu: &[f64]| {
        routine.smooth.gradient(&routine.smooth.symbols_at(&drawn.values()), 0.0, mu)
    };
    let size = random.between(0.2, 3.0);
    let mu: Vec<f64> = random.direction(n).into_iter().map(|entry| size * entry).collect();
    let turning = drawn.turning(&mu);
    let velocity = match draw {
        Draw::Edge => turning.clone(),
        _ => gradient_of(&drawn, &mu),
    };
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let speed = length(&velocity).max(1e-3);
    let (shortest, longest) = match (draw, random.one_in(2)) {
        (Draw::Root, true) => (0.05, 3.0),
        (Draw::Root, false) => (0.05, 0.8),
        (_, true) => (0.02, 2.0),
        (_, false) => (0.02, 0.7),
    };
    let h = random.between(shortest, longest) / speed * random.sign_one_in(8);
    if draw == Draw::Edge {
        drawn.meet(tables, (h, &mu), random);
        let whole = gradient_of(&drawn, &mu);
        let own = length(&whole.iter().zip(&turning).map(|(a, b)| a - b).collect::<Vec<_>>());
        // As large a velocity as a share of the other.
        if random.one_in(3) && own > 0.0 && own.is_finite() {
            drawn.terms[0].height *= speed * random.between(0.01, 1.0) / own;
        }
    }
    let at: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
    let generic = |still| {
        let (smooth, tells) = (&routine.smooth, draw != Draw::Root);
        let energy = TextEnergy { smooth, symbols: smooth.symbols_at(&drawn.values()), tells };
        Generic::<G, M> { group, energy: Seen { energy, still }, h }
    };
    let (own, still) = (generic(false), generic(true));
    let kernel =
        routine.kernel.as_ref().map(|subject| kernels::Runner::new(subject, h, &drawn.values()));
    let own: &dyn Steps = match &kernel {
        None => &own,
        Some(Some(kernel)) => kernel,
        Some(None) => return,
    };
    let trial = Trial {
        steps: own,
        still: (draw != Draw::Root).then_some(&still as &dyn Steps),
        group: tables,
        gradient: &|mu| gradient_of(&drawn, mu),
        h,
        farthest: draw.farthest(M),
        sides: &|m| drawn.terms.iter().map(|term| term.side(m)).collect(),
        about: format!("M = {M}, {drawn:?}"),
    };
    trial.follow(&at, &mu, tally);
}

/// Steps with a number of nodes.
fn at<G: LieGroup<Scalar = f64>>(
    group: (&G, &str, &MatrixGroup),
    nodes: usize,
    of: Of,
    random: &mut Random,
    tally: &mut Tally,
) {
    match nodes {
        1 => steps::<G, 1>(group, of, random, tally),
        2 => steps::<G, 2>(group, of, random, tally),
        3 => steps::<G, 3>(group, of, random, tally),
        4 => steps::<G, 4>(group, of, random, tally),
        5 => steps::<G, 5>(group, of, random, tally),
        _ => steps::<G, 6>(group, of, random, tally),
    }
}

/// Steps on a group of the catalogue, or on one in another basis.
fn on(name: &str, nodes: usize, of: Of, random: &mut Random, tally: &mut Tally) {
    let signs = match name {
        "so(2, 1)" => SO21_SIGNS,
        _ => SO3_SIGNS,
    };
    if name.starts_with("so(") {
        let group = skew(signs, random);
        return at((&group, name, &group), nodes, of, random, tally);
    }
    let tables = &named(name);
    match name {
        "SO3" => at((&SO3::new(), name, tables), nodes, of, random, tally),
        "SU2" => at((&SU2::new(), name, tables), nodes, of, random, tally),
        "SE2" => at((&SE2::new(), name, tables), nodes, of, random, tally),
        "SE3" => at((&SE3::new(), name, tables), nodes, of, random, tally),
        "SL2" => at((&SL2::new(), name, tables), nodes, of, random, tally),
        _ => at((&Power::<SO3, 2, 6>::new(), name, tables), nodes, of, random, tally),
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

/// Families by the group, with any number of nodes, by the runtime and by programs; and by the number of nodes, on any group.
pub(super) fn families(only: &str) -> Vec<Family> {
    let mut all = Vec::new();
    let mut add = |name: String, groups: &'static [&str], most: Option<usize>, of: Of| {
        let steps = move |random: &mut Random, tally: &mut Tally| {
            for _ in 0..DRAWS {
                let nodes = most.unwrap_or_else(|| 1 + random.below(6));
                let group = groups[if groups.len() > 1 { random.below(groups.len()) } else { 0 }];
                on(group, nodes, of, random, tally);
            }
        };
        all.extend(name.contains(only).then(|| Family::new(name, 128, steps)));
    };
    let groups: [(&str, &'static [&str]); 6] = [
        ("so3", &["SO3"]),
        ("su2", &["SU2"]),
        ("se2", &["SE2"]),
        ("se3", &["SE3"]),
        ("sl2", &["SL2"]),
        ("power", &["SO3^2"]),
    ];
    for (name, group) in groups {
        add(format!("collocation-{name}"), group, None, (Draw::Root, false));
        add(format!("collocation-{name}-kernel"), group, None, (Draw::Root, true));
    }
    let groups = &["SO3", "SE3", "SL2", "so(2, 1)", "so(3)"];
    for (kind, draw) in [("edge", Draw::Edge), ("steep", Draw::Flank)] {
        for nodes in 1..=5 {
            add(format!("{kind}-{nodes}"), groups, Some(nodes), (draw, false));
        }
    }
    all
}
