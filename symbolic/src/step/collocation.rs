//! A step by collocation as a kernel: the equations, the solution and the acceptance of the runtime's `collocation`, in which a
//! sweep is a correction.
//!
//! The numbers solved for are hẋᵢ of all nodes, then hṗᵢ of all, then the residual of the sweep before and the sweeps made. A solution is
//! read as x, two measures of how well the nodes resolve the step and the sweeps made, each as a share of its limit, the rates, and the momenta at the nodes. Steps leave differences of
//! their rates to the next one, beside the group element. Steps that are not ordinary ones are refused: the runtime makes them in parts.

use coadjoint_program::collocation::{
    KEPT, KEPT_LONG, LARGEST_FORCE, LARGEST_MODEL, LARGEST_REACH, LARGEST_TAIL, LONG, MAX_SWEEPS,
    NEAR_LIMIT, Nodes, ROUNDING, SOLVED, degree, ordinary_sweeps,
};
use coadjoint_program::{Kernel, KernelParts, Programs};

use super::product::{Moved, Part, Product};
use super::programs::{kicked, matrix, sound, watch};
use super::solving::{inputs, largest_in_units};
use super::tables::{Structure, structure_of};
use super::vector::{all_at_most, finite, largest};
use crate::graph::{Graph, Id, Program};
use crate::integrator::Kicks;
use crate::smooth::Smooth;
use crate::step::StepError;

/// The measures of how well the nodes resolve a step, and its sweeps.
const MEASURES: usize = 3;

/// The numbers solved for beside the rates.
const OTHERS: usize = 2;

/// The coefficients of the nodes of a step, for a number of nodes known at run time.
struct Gauss {
    times: Vec<f64>,
    weights: Vec<f64>,
    /// By the node from which the weight is, then by the node to which it leads.
    matrix: Vec<Vec<f64>>,
    highest: Vec<f64>,
}

impl Gauss {
    fn new(nodes: usize) -> Self {
        fn of<const M: usize>() -> Gauss {
            let Nodes { times, weights, matrix, highest } = Nodes::<M>::new();
            Gauss {
                times: times.to_vec(),
                weights: weights.to_vec(),
                matrix: matrix.iter().map(|row| row.to_vec()).collect(),
                highest: highest.to_vec(),
            }
        }
        match nodes {
            1 => of::<1>(),
            2 => of::<2>(),
            3 => of::<3>(),
            4 => of::<4>(),
            5 => of::<5>(),
            6 => of::<6>(),
            7 => of::<7>(),
            _ => of::<8>(),
        }
    }
}

/// The times of a step at which the Hamiltonian is asked for, from its beginning on and in its lengths: the beginning, the
/// middle, the nodes.
pub(super) fn times(nodes: usize) -> Vec<f64> {
    let nodes = Gauss::new(nodes).times;
    [0.0, 0.5].into_iter().chain(nodes.into_iter().map(|time| 0.5 + time)).collect()
}

/// Numbers that a step leaves to the next one: the count of steps, as far as they matter, and differences of their
/// rates. A flow between kicks goes on from none, and leaves none.
pub(super) fn memory(smooth: &Smooth) -> usize {
    match smooth.kicks {
        Some(_) => 0,
        None => 1 + KEPT * 2 * smooth.algebra.dim() * smooth.nodes(),
    }
}

/// The place of the radius among the coefficients: after the symbols, h, and the coefficients of kicks.
pub(super) fn radius_at(smooth: &Smooth) -> usize {
    let of_kicks = |kicks: &Kicks| kicks.kick.coefficients.slots().len();
    smooth.symbols.len() + 1 + smooth.kicks.as_ref().map_or(0, of_kicks)
}

/// The place of the first time: after the radius, and the length of a kick where there are kicks.
pub(super) fn first_time(smooth: &Smooth) -> usize {
    radius_at(smooth) + 1 + usize::from(smooth.kicks.is_some())
}

/// About the operations of a sweep.
pub(super) fn operations(smooth: &Smooth) -> usize {
    let Smooth { algebra, gradient, .. } = smooth;
    let brackets = 3 * (degree(smooth.nodes()) + 2) * structure_of(algebra).len();
    smooth.nodes().saturating_mul(gradient.operations().saturating_add(brackets))
}

/// The kernel of a step; the values of the symbols come first among the coefficients, after them h, with kicks the coefficients of their
/// torque, a radius that is not read, with kicks the length of one, and, where the system moves, for each of the [`times`] the
/// time and the signals then. Without kicks the last part of the group is the memory of its steps.
pub(super) fn kernel(smooth: &Smooth, group: &Product) -> Result<Kernel, StepError> {
    let step = Assembly::new(smooth, group);
    let rates = step.rates();
    let programs = Programs {
        guess: step.guess(),
        correct: step.correct(),
        accept: step.accept(),
        transport: step.transport(),
        frame: None,
        sound: sound(group),
        watch: step.watch(),
        matrix: matrix(group),
    };
    let kernel = Kernel::new(KernelParts {
        dim: step.n,
        element: group.element(),
        unknowns: rates + OTHERS,
        solution: step.n + MEASURES + rates + step.n * step.nodes(),
        tolerance: SOLVED,
        near: 0.0,
        corrections: MAX_SWEEPS,
        programs,
    })?;
    kicked(kernel, smooth.kicks.as_ref(), group, radius_at(smooth) + 1)
}

struct Assembly<'a> {
    smooth: &'a Smooth,
    group: &'a Product,
    /// The dimension, and the numbers of a group element without the memory.
    n: usize,
    element: usize,
    gauss: Gauss,
    structure: Structure,
}

/// Vectors at nodes.
type Rows = Vec<Vec<Id>>;

/// Vectors from the numbers of all nodes, coordinate by coordinate: so rows of a program stand side by side.
fn by_node(n: usize, numbers: &[Id]) -> Rows {
    let nodes = numbers.len() / n.max(1);
    (0..nodes).map(|node| numbers.iter().skip(node).step_by(nodes).copied().collect()).collect()
}

/// The numbers of vectors, coordinate by coordinate.
fn by_coordinate(rows: &Rows) -> Vec<Id> {
    let n = rows.first().map_or(0, Vec::len);
    (0..n).flat_map(|k| rows.iter().map(move |row| row[k])).collect()
}

/// A sweep: the momenta at the nodes, and the change of the rates.
struct Sweep {
    momenta: Rows,
    change: Rates,
    /// The largest changes of those of x and of p, in units.
    sizes: [Id; 2],
    /// 0 or, where a change is not finite, no number.
    defect: Id,
}

/// hẋᵢ and hṗᵢ at the nodes.
#[derive(Clone)]
struct Rates {
    x: Rows,
    p: Rows,
}

impl Rates {
    /// From all numbers, those of x first.
    fn new(n: usize, numbers: &[Id]) -> Self {
        let (x, p) = numbers.split_at(numbers.len() / 2);
        Self { x: by_node(n, x), p: by_node(n, p) }
    }

    fn numbers(&self) -> Vec<Id> {
        [&self.x, &self.p].map(by_coordinate).concat()
    }

    /// Each number made of its own and that of other rates.
    fn with(&self, other: &Self, of: impl Fn(Id, Id) -> Id) -> Self {
        let rows = |a: &Rows, b: &Rows| -> Rows {
            a.iter()
                .zip(b)
                .map(|(a, b)| a.iter().zip(b).map(|(&a, &b)| of(a, b)).collect())
                .collect()
        };
        Self { x: rows(&self.x, &other.x), p: rows(&self.p, &other.p) }
    }
}

/// start + Σⱼ weightsⱼ rowsⱼ
fn mixed(graph: &Graph, start: &[Id], weights: &[Id], rows: &Rows) -> Vec<Id> {
    let entry = |(k, &start): (usize, &Id)| {
        let add = |sum, (&weight, row): (&Id, &Vec<Id>)| graph.times_plus(weight, row[k], sum);
        weights.iter().zip(rows).fold(start, add)
    };
    start.iter().enumerate().map(entry).collect()
}

fn constants(graph: &Graph, values: &[f64]) -> Vec<Id> {
    values.iter().map(|&value| graph.constant(value)).collect()
}

/// The largest of numbers that are not negative.
fn greatest(graph: &Graph, sizes: impl IntoIterator<Item = Id>) -> Id {
    sizes.into_iter().reduce(|all, size| graph.max(all, size)).unwrap_or_else(|| graph.zero())
}

/// Inputs of a program, one list after the other.
struct Inputs<'g>(&'g Graph, usize);

impl Inputs<'_> {
    fn take(&mut self, count: usize) -> Vec<Id> {
        self.1 += count;
        inputs(self.0, self.1 - count, count)
    }

    fn rates(&mut self, n: usize, nodes: usize) -> Rates {
        Rates::new(n, &self.take(2 * n * nodes))
    }
}

/// a + s·b
fn plus(graph: &Graph, a: &[Id], s: f64, b: &[Id]) -> Vec<Id> {
    let s = graph.constant(s);
    a.iter().zip(b).map(|(&a, &b)| graph.times_plus(s, b, a)).collect()
}

/// part/whole, 0 where the part is 0.
fn share(graph: &Graph, part: Id, whole: Id) -> Id {
    let zero = graph.zero();
    graph.select(part, zero, zero, graph.div(part, whole))
}

impl<'a> Assembly<'a> {
    fn new(smooth: &'a Smooth, group: &'a Product) -> Self {
        let (n, structure) = (group.dim(), structure_of(&smooth.algebra));
        let element = group.element() - memory(smooth);
        Self { smooth, group, n, element, gauss: Gauss::new(smooth.nodes()), structure }
    }

    fn nodes(&self) -> usize {
        self.smooth.nodes()
    }

    /// The number of rates.
    fn rates(&self) -> usize {
        2 * self.n * self.nodes()
    }

    /// True if sweeps are corrected by the linear model.
    fn models(&self) -> bool {
        self.n <= LARGEST_MODEL
    }

    /// h.
    fn step(&self, graph: &Graph) -> Id {
        graph.slot(self.smooth.symbols.len())
    }

    /// A program of the Hamiltonian's at μ, at this one of the [`times`].
    fn at(&self, graph: &Graph, program: &Program, mu: &[Id], time: usize) -> Vec<Id> {
        graph.call(program, &[mu, &self.time(graph, time)].concat())
    }

    /// The inputs of the Hamiltonian's programs after μ at this one of the [`times`].
    fn time(&self, graph: &Graph, time: usize) -> Vec<Id> {
        if !self.smooth.depends_on_time() {
            return vec![graph.zero()];
        }
        let each = 1 + self.smooth.signals.len();
        let first = first_time(self.smooth) + time * each;
        (first..first + each).map(|slot| graph.slot(slot)).collect()
    }

    /// The increment of the step, and the momentum in its middle.
    fn whole(&self, graph: &Graph, rates: &Rates, mu: &[Id]) -> (Vec<Id>, Vec<Id>) {
        let zeros = vec![graph.zero(); self.n];
        let x = mixed(graph, &zeros, &constants(graph, &self.gauss.weights), &rates.x);
        let p = self.group.pull_back(graph, &x, mu);
        (x, p)
    }

    /// The weights from the middle of the step to a node.
    fn weights(&self, graph: &Graph, node: usize) -> Vec<Id> {
        self.gauss.matrix.iter().map(|row| graph.constant(row[node])).collect()
    }

    /// ad\*_x μ
    fn ad_star(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let mut sum = vec![graph.zero(); self.n];
        for &(i, j, k, c) in &self.structure {
            let product = graph.mul(graph.constant(c), x[i]);
            sum[j] = graph.times_plus(product, mu[k], sum[j]);
        }
        sum
    }

    /// [x, y]
    fn bracket(&self, graph: &Graph, x: &[Id], y: &[Id]) -> Vec<Id> {
        let mut sum = vec![graph.zero(); self.n];
        for &(i, j, k, c) in &self.structure {
            let product = graph.mul(graph.constant(c), x[i]);
            sum[k] = graph.times_plus(product, y[j], sum[k]);
        }
        sum
    }

    /// g, μ ↦ the rates of the steps before, extrapolated by the polynomial through them, or none; the momentum in the middle
    /// and h times the Hessian there, which the linear model is made of.
    fn guess(&self) -> Program {
        let graph = Graph::new();
        let memory = inputs(&graph, self.element, memory(self.smooth));
        let mu = inputs(&graph, self.element + memory.len(), self.n);
        let zero = graph.zero();
        let guess = match memory.split_first() {
            Some((&count, differences)) => self.extrapolated(&graph, count, differences),
            None => vec![zero; self.rates()],
        };
        let mut outputs = guess.clone();
        outputs.extend([zero; OTHERS]);
        if self.models() {
            let (_, p) = self.whole(&graph, &Rates::new(self.n, &guess), &mu);
            let hessian = self.hessian(&graph, &p);
            let step = self.step(&graph);
            outputs.extend(p);
            outputs.extend(hessian.into_iter().map(|entry| graph.mul(step, entry)));
        }
        graph.finish(self.element + memory.len() + self.n, &outputs)
    }

    /// The rates of the next step from the number of steps before it and the differences of their rates.
    fn extrapolated(&self, graph: &Graph, count: Id, differences: &[Id]) -> Vec<Id> {
        let rates = self.rates();
        let last = Rates::new(self.n, &differences[..rates]);
        let [zero, one] = [0.0, 1.0].map(|value| graph.constant(value));
        let size = largest(graph, &last.x.concat());
        let [long, many, few] =
            [LONG, KEPT as f64, KEPT_LONG as f64].map(|value| graph.constant(value));
        let count = graph.min(count, graph.select(size, long, many, few));
        let used = |order| graph.select(graph.constant((order + 1) as f64), count, one, zero);
        let weights: Vec<Id> = (0..KEPT).map(used).collect();
        let own = Graph::new();
        let (kept, shares) = (inputs(&own, 0, KEPT), inputs(&own, KEPT, KEPT));
        let terms = shares.iter().zip(&kept);
        let sum = terms.fold(own.zero(), |sum, (&share, &kept)| own.times_plus(share, kept, sum));
        let program = own.finish(2 * KEPT, &[sum]);
        let row = |rate: usize| {
            let kept = differences.iter().skip(rate).step_by(rates);
            kept.chain(&weights).copied().collect()
        };
        graph.call_each(&program, &(0..rates).map(row).collect::<Vec<_>>()).concat()
    }

    /// ∂²H/∂μ² in the middle of the step, the entries (i, j) with j ≤ i, row by row.
    fn hessian(&self, graph: &Graph, mu: &[Id]) -> Vec<Id> {
        let own = Graph::new();
        let variables = inputs(&own, 0, self.n);
        let all = inputs(&own, 0, self.smooth.gradient.inputs());
        let gradient = own.call(&self.smooth.gradient, &all);
        let one = own.constant(1.0);
        let row = |i: usize| own.pull_back(&[(gradient[i], one)], &variables[..=i]);
        let entries: Vec<Id> = (0..self.n).flat_map(row).collect();
        let program = own.finish(all.len(), &entries);
        self.at(graph, &program, mu, 1)
    }

    /// The rates, the residual of the sweep before, the sweeps made, μ, the momentum in the middle, the Hessian ↦ the next rates, this sweep's
    /// residual, the sweeps made; the solution; the error that is left, about; 0 or, where a number is not finite, none.
    fn correct(&self) -> Program {
        let (graph, n, count) = (Graph::new(), self.n, self.rates());
        let rates = Rates::new(n, &inputs(&graph, 0, count));
        let [before, sweeps] = [count, count + 1].map(|i| graph.input(i));
        let mu = inputs(&graph, count + OTHERS, n);
        let constants = if self.models() { n + n * (n + 1) / 2 } else { 0 };
        let model = inputs(&graph, count + OTHERS + n, constants);
        let [zero, one, half] = [0.0, 1.0, 0.5].map(|value| graph.constant(value));

        let scale = largest_in_units(&graph, &mu, &self.smooth.units, 1);
        let scale = graph.select(scale, zero, one, scale);
        let Sweep { momenta, change, sizes, defect } = self.sweep(&graph, &rates, &mu);
        let residual = graph.max(sizes[0], graph.div(sizes[1], scale));
        let (next, sizes) = self.corrected(&graph, &rates, &change, &model);
        // Before the first sweep there was none.
        let shrinks = graph.min(graph.div(residual, before), half);
        let left = graph.mul(residual, graph.select(before, zero, one, shrinks));
        let rounding = graph.constant(ROUNDING / f64::EPSILON);
        let rounding = graph.mul(rounding, graph.epsilon());
        let stays = graph.select(residual, rounding, zero, left);
        let stays = graph.select(before, residual, stays, left);
        let left = graph.select(before, zero, left, stays);

        let (x, _) = self.whole(&graph, &next, &mu);
        let measures = self.measures(&graph, (&next, sizes), &mu, &model);
        let mut outputs = next.numbers();
        let sweeps = graph.add(sweeps, one);
        outputs.extend([residual, sweeps]);
        let most = graph.constant(1.0 / ordinary_sweeps(self.n));
        let measures = measures.into_iter().chain([graph.mul(sweeps, most)]);
        outputs.extend(x.into_iter().chain(measures).chain(next.numbers()));
        outputs.extend(by_coordinate(&momenta));
        outputs.extend([left, defect]);
        graph.finish(count + OTHERS + n + constants, &outputs)
    }

    /// The change of the rates to those that follow from them.
    fn sweep(&self, graph: &Graph, rates: &Rates, mu: &[Id]) -> Sweep {
        let n = self.n;
        let (_, p) = self.whole(graph, rates, mu);
        let row = |node: usize| {
            let (weights, time) = (self.weights(graph, node), self.time(graph, 2 + node));
            [&weights[..], &time, &rates.x[node], &rates.p[node], &rates.numbers(), &p].concat()
        };
        let rows: Vec<Vec<Id>> = (0..self.nodes()).map(row).collect();
        let results = graph.call_each(&self.sweep_at_node(), &rows);
        let part = |from: usize| results.iter().map(|row| row[from..from + n].to_vec()).collect();
        let each = |at: usize| results.iter().map(move |row| row[at]);
        let defects = each(3 * n + 2);
        Sweep {
            momenta: part(0),
            change: Rates { x: part(n), p: part(2 * n) },
            sizes: [0, 1].map(|at| greatest(graph, each(3 * n + at))),
            defect: defects.reduce(|sum, one| graph.add(sum, one)).unwrap_or_else(|| graph.zero()),
        }
    }

    /// The weights of a node, its time, its rates, all rates, the momentum in the middle ↦ the momentum there, the changes of its
    /// rates, their sizes, and 0 or, where a number is not finite, none.
    fn sweep_at_node(&self) -> Program {
        let (graph, n, m) = (Graph::new(), self.n, self.nodes());
        let mut inputs = Inputs(&graph, 0);
        let (weights, time) = (inputs.take(m), inputs.take(self.time(&graph, 0).len()));
        let (own, all, middle) = (inputs.rates(n, 1), inputs.rates(n, m), inputs.take(n));
        let count = inputs.1;
        let x = mixed(&graph, &vec![graph.zero(); n], &weights, &all.x);
        let p = mixed(&graph, &middle, &weights, &all.p);
        let momentum = self.group.node_momentum(&graph, &x, &p, degree(m));
        let gradient = graph.call(&self.smooth.gradient, &[&momentum[..], &time].concat());
        let step = self.step(&graph);
        let omega: Vec<Id> = gradient.iter().map(|&entry| graph.mul(step, entry)).collect();
        let mut x_rates = graph.call(&self.equations(), &[&x[..], &p, &omega].concat());
        let p_rates = x_rates.split_off(n);
        let next = Rates { x: vec![x_rates], p: vec![p_rates] };
        let change = next.with(&own, |a, b| graph.sub(a, b));
        let size =
            |rows: &Rows, power| largest_in_units(&graph, &rows[0], &self.smooth.units, power);
        let sizes = [size(&change.x, -1), size(&change.p, 1)];
        let change = change.numbers();
        let defect = finite(&graph, &change);
        graph.finish(count, &[&momentum[..], &change, &sizes, &[defect]].concat())
    }

    /// x, p, ω ↦ ẋ = (∂J_R/∂p)ᵀ ω, ṗ = −(∂J_R/∂x)ᵀ ω.
    fn equations(&self) -> Program {
        let (graph, n) = (Graph::new(), self.n);
        let [x, p, omega] = [0, n, 2 * n].map(|from| inputs(&graph, from, n));
        let momentum = self.group.node_momentum(&graph, &x, &p, degree(self.nodes()));
        let outputs: Vec<(Id, Id)> = momentum.into_iter().zip(omega).collect();
        let slopes = graph.pull_back(&outputs, &[&x[..], &p[..]].concat());
        let (of_x, of_p) = slopes.split_at(n);
        let forces = of_x.iter().map(|&slope| graph.neg(slope));
        let rates: Vec<Id> = of_p.iter().copied().chain(forces).collect();
        graph.finish(3 * n, &rates)
    }

    /// The square of the farthest way that an argument of H's functions goes from the start to a node, from node to node, and to
    /// the end.
    fn reach(&self, graph: &Graph, mu: &[Id], momenta: &Rows, end: &[Id]) -> Id {
        let nodes = self.nodes();
        // The time of the last node stands for that of the end.
        let stops = [(mu, 0)].into_iter().chain(momenta.iter().map(Vec::as_slice).zip(2..));
        let stops = stops.chain([(end, 1 + nodes)]);
        let stops: Vec<Vec<Id>> =
            stops.map(|(mu, time)| [mu, &self.time(graph, time)].concat()).collect();
        let rows: Vec<Vec<Id>> = stops.windows(2).map(<[_]>::concat).collect();
        let squares = graph.call_each(&self.smooth.reach, &rows).concat();
        let limit = graph.constant(1.0 / LARGEST_REACH[nodes - 1]);
        graph.mul(limit, largest(graph, &squares))
    }

    /// The rates after a sweep that changes them, and the largest of those of x and of p; with the change in the next sweep that
    /// follows from this one, to first order in it and in the step, where there is a linear model.
    fn corrected(
        &self,
        graph: &Graph,
        rates: &Rates,
        change: &Rates,
        model: &[Id],
    ) -> (Rates, [Id; 2]) {
        let n = self.n;
        let mut shared = change.numbers();
        if self.models() {
            let (half, zeros) = (graph.constant(0.5), vec![graph.zero(); n]);
            let x = mixed(graph, &zeros, &constants(graph, &self.gauss.weights), &change.x);
            let turned = self.ad_star(graph, &x, &model[..n]);
            shared.extend(turned.iter().map(|&entry| graph.mul(half, entry)));
            shared.extend(model);
        }
        let row = |node: usize| {
            let weights = self.weights(graph, node);
            let own = [&rates.x[node][..], &rates.p[node], &change.x[node], &change.p[node]];
            [weights, own.concat(), shared.clone()].concat()
        };
        let rows: Vec<Vec<Id>> = (0..self.nodes()).map(row).collect();
        let results = graph.call_each(&self.corrected_at_node(), &rows);
        let part = |from: usize| results.iter().map(|row| row[from..from + n].to_vec()).collect();
        let size = |at: usize| greatest(graph, results.iter().map(|row| row[2 * n + at]));
        (Rates { x: part(0), p: part(n) }, [0, 1].map(size))
    }

    /// The weights of a node, its rates, their changes, all changes; where there is a linear model the change of the momentum in the
    /// middle, that momentum and the Hessian ↦ the next rates, the largest of those of x and of p.
    fn corrected_at_node(&self) -> Program {
        let (graph, n, m) = (Graph::new(), self.n, self.nodes());
        let mut inputs = Inputs(&graph, 0);
        let weights = inputs.take(m);
        let (own, changed, all) = (inputs.rates(n, 1), inputs.rates(n, 1), inputs.rates(n, m));
        let mut next = own.clone();
        if self.models() {
            let (middle, p, hessian) =
                (inputs.take(n), inputs.take(n), inputs.take(n * (n + 1) / 2));
            let zeros = vec![graph.zero(); n];
            let x = mixed(&graph, &zeros, &weights, &all.x);
            let moved = mixed(&graph, &middle, &weights, &all.p);
            let mu = plus(&graph, &moved, 0.5, &self.ad_star(&graph, &x, &p));
            let velocity: Vec<Id> = (0..n).map(|i| row(&graph, &hessian, i, &mu)).collect();
            let force = plus(&graph, &zeros, 0.5, &self.ad_star(&graph, &velocity, &p));
            let force = plus(&graph, &force, 0.5, &self.ad_star(&graph, &own.x[0], &moved));
            let bent = self.bracket(&graph, &x, &own.x[0]);
            let velocity = plus(&graph, &velocity, 0.5, &bent);
            let linear = Rates { x: vec![velocity], p: vec![force] };
            next = next.with(&linear, |a, b| graph.add(a, b));
        }
        let next = next.with(&changed, |a, b| graph.add(a, b));
        let sizes = [&next.x, &next.p].map(|rows| largest(&graph, &rows[0]));
        graph.finish(inputs.1, &[&next.numbers()[..], &sizes].concat())
    }

    /// The resolution of the step by its nodes, as shares of the limits: the highest polynomials through two nodes and more, of
    /// the velocity and of the force; with one node the product of velocity, force, and what that changes.
    fn measures(
        &self,
        graph: &Graph,
        (rates, [velocity, force]): (&Rates, [Id; 2]),
        mu: &[Id],
        model: &[Id],
    ) -> [Id; 2] {
        // The gain is that at the guess.
        let near = if self.nodes() == 1 { NEAR_LIMIT } else { 1.0 };
        let limits = [near * LARGEST_TAIL[self.nodes() - 1], LARGEST_FORCE];
        let [tail, steep] = limits.map(|limit| graph.constant(1.0 / limit));
        let scale = largest(graph, mu);
        if self.nodes() == 1 {
            let f = share(graph, force, scale);
            let gain = graph.add(self.gain(graph, model), f);
            let product = graph.mul(graph.mul(f, velocity), gain);
            return [graph.mul(tail, product), graph.zero()];
        }
        let zeros = vec![graph.zero(); self.n];
        let weights = constants(graph, &self.gauss.highest);
        let highest = |rows| largest(graph, &mixed(graph, &zeros, &weights, rows));
        let of_velocity = share(graph, highest(&rates.x), velocity);
        let of_force = share(graph, highest(&rates.p), scale);
        [graph.mul(tail, of_velocity), graph.mul(steep, of_force)]
    }

    /// The largest sum of a row of h·H″·∂P/∂x, where P = μ + ½ad\*_x μ to first order; 1 where there is no model.
    fn gain(&self, graph: &Graph, model: &[Id]) -> Id {
        if !self.models() {
            return graph.constant(1.0);
        }
        let ((p, hessian), half) = (model.split_at(self.n), graph.constant(0.5));
        let mut sums = vec![graph.zero(); self.n];
        for j in 0..self.n {
            let unit: Vec<Id> =
                (0..self.n).map(|i| graph.constant(f64::from(u8::from(i == j)))).collect();
            let turned = self.ad_star(graph, &unit, p);
            for (i, sum) in sums.iter_mut().enumerate() {
                let entry = graph.abs(row(graph, hessian, i, &turned));
                *sum = graph.times_plus(half, entry, *sum);
            }
        }
        largest(graph, &sums)
    }

    /// μ, the solution, the error left, the distance ↦ 1 where the step is solved, in the chart, and resolved by its nodes.
    fn accept(&self) -> Program {
        let (graph, n) = (Graph::new(), self.n);
        let momenta = n + MEASURES + self.rates();
        let solution = inputs(&graph, n, momenta + n * self.nodes());
        let last = n + solution.len();
        let [left, distance] = [last, last + 1].map(|i| graph.input(i));
        let tolerance = graph.constant(SOLVED / f64::EPSILON);
        let tolerance = graph.mul(tolerance, graph.epsilon());
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        // The formulas hold up to half a half turn.
        let extent = graph.mul(graph.constant(4.0), self.group.extent(&graph, &solution[..n]));
        let measures = solution[n..n + MEASURES].iter().map(|&measure| (measure, one));
        let tests = [(left, tolerance), (distance, zero), (extent, one)].into_iter();
        let nodes = by_node(n, &solution[momenta..]);
        let (mu, anywhere) = (inputs(&graph, 0, n), vec![zero; self.group.element()]);
        let end = self.group.transport(&graph, &anywhere, &solution[..n], &mu).mu;
        let reach = self.reach(&graph, &mu, &nodes, &end);
        let tests: Vec<_> = tests.chain(measures).chain([(reach, one)]).collect();
        graph.finish(last + 2, &[all_at_most(&graph, &tests)])
    }

    /// g, μ, the solution ↦ the state moved by the increment, with the differences of the rates for the next step.
    fn transport(&self) -> Program {
        let (graph, n, rates) = (Graph::new(), self.n, self.rates());
        let g = inputs(&graph, 0, self.group.element());
        let mu = inputs(&graph, g.len(), n);
        let solution = inputs(&graph, g.len() + n, n + MEASURES + rates + n * self.nodes());
        let Moved { g: mut outputs, mu } = self.group.transport(&graph, &g, &solution[..n], &mu);
        outputs.truncate(self.element);
        if let Some((&count, differences)) = g[self.element..].split_first() {
            let [one, most] = [1.0, KEPT as f64].map(|value| graph.constant(value));
            outputs.push(graph.min(graph.add(count, one), most));
            let program = differences_after();
            let row = |rate: usize| {
                let old = differences.iter().skip(rate).step_by(rates).take(KEPT - 1);
                [solution[n + MEASURES + rate]].into_iter().chain(old.copied()).collect()
            };
            let rows = graph.call_each(&program, &(0..rates).map(row).collect::<Vec<_>>());
            outputs.extend((0..KEPT).flat_map(|order| rows.iter().map(move |row| row[order])));
        }
        outputs.extend(mu);
        graph.finish(g.len() + n + solution.len(), &outputs)
    }

    /// g, μ ↦ the energy, at the time at which the step begins, and the Casimirs of low degree that are conserved.
    fn watch(&self) -> Program {
        let Smooth { algebra, kicks, value, .. } = self.smooth;
        let energy = |graph: &Graph, mu: &[Id]| self.at(graph, value, mu, 0);
        watch(energy, (algebra, kicks.as_ref()), self.group)
    }
}

/// A rate, and the differences before it ↦ the differences with it.
fn differences_after() -> Program {
    let graph = Graph::new();
    let mut next = vec![graph.input(0)];
    for order in 1..KEPT {
        next.push(graph.sub(next[order - 1], graph.input(order)));
    }
    graph.finish(KEPT, &next)
}

/// Row i of a symmetric matrix, given by its entries (i, j) with j ≤ i, times v.
fn row(graph: &Graph, entries: &[Id], i: usize, v: &[Id]) -> Id {
    let entry = |j: usize| {
        let (row, column) = (i.max(j), i.min(j));
        entries[row * (row + 1) / 2 + column]
    };
    v.iter().enumerate().fold(graph.zero(), |sum, (j, &v)| graph.times_plus(entry(j), v, sum))
}
