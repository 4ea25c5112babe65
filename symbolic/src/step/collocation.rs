//! A step by collocation as a kernel: the equations, the solution and the acceptance of the runtime's `collocation`, in which a
//! sweep is a correction.
//!
//! The numbers solved for are hẋᵢ of all nodes, then hṗᵢ of all, with a torque its impulse, then the residual of the sweep before and the
//! sweeps made. A solution is read as x, two measures of how well the nodes resolve the step and the sweeps made, each as a share of its
//! limit, the rates with the impulse, the momenta at the nodes, the impulse as the start sees it, and the work h Σ bᵢ ⟨τᵢ, ωᵢ⟩. Steps leave
//! differences of their rates to the next one, and the sum of the work, beside the group element. Steps that are not ordinary ones are refused: the runtime makes them in parts.
//!
//! A velocity η adds to ∂H/∂μ at the nodes, and a torque τ adds (d^R exp_{−xᵢ})ᵀ τᵢ to ṗᵢ. Its impulse K = h Σ bᵢ Ad\*_{exp(xᵢ)} τᵢ, as
//! the middle of the step sees it, adds Ad\*_{exp(x/2)} K to the momentum at the start, with the x of the sweep that gave K, before the group
//! acts on it; the momentum in the middle is then that of the mean of both ends. So a component of the spatial momentum along which τ
//! does not act is kept to rounding, whatever the sweeps.

use coadjoint_program::collocation::{
    KEPT, KEPT_LONG, LARGEST_FORCE, LARGEST_MODEL, LARGEST_REACH, LARGEST_TAIL, LONG, MAX_SWEEPS,
    NEAR_LIMIT, Nodes, ROUNDING, SLOW, SOLVED, degree, ordinary_sweeps,
};
use coadjoint_program::{Kernel, KernelParts, Programs};

use super::product::{Moved, Part, Product};
use super::programs::{Acting, kicked, matrix, sound, watch};
use super::solving::{inputs, largest_in_units};
use super::tables::{Structure, structure_of};
use super::vector::{all_at_most, finite, largest};
use crate::drive::Drive;
use crate::graph::{Graph, Id, Program};
use crate::integrator::Kicks;
use crate::potential::{Force, along};
use crate::smooth::Smooth;
use crate::step::StepError;

/// The measures of how well the nodes resolve a step, and its sweeps.
const MEASURES: usize = 3;

/// The numbers solved for beside the rates.
pub(super) const OTHERS: usize = 2;

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
/// rates; then the work of a torque so far. A flow between kicks goes on from none, and leaves none.
pub(super) fn memory(smooth: &Smooth) -> usize {
    match smooth.kicks {
        Some(_) => 0,
        None => {
            1 + KEPT * (2 * smooth.algebra.dim() * smooth.nodes() + impulse(smooth)) + work(smooth)
        }
    }
}

/// The numbers of the impulse of a torque: none where there is none.
fn impulse(smooth: &Smooth) -> usize {
    let torque = smooth.drive.as_ref().and_then(|drive| drive.torque.as_ref());
    torque.map_or(0, |_| smooth.algebra.dim())
}

/// The numbers of a torque's work: none where there is none.
pub(super) fn work(smooth: &Smooth) -> usize {
    let works = smooth.drive.as_ref().is_some_and(|drive| drive.works());
    usize::from(works && smooth.kicks.is_none())
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
    let drive = smooth.drive.as_ref().map_or(0, |drive| drive.program.operations());
    let node = gradient.operations().saturating_add(brackets).saturating_add(drive);
    smooth.nodes().saturating_mul(node)
}

/// The kernel of a step; the values of the symbols come first among the coefficients, after them h, with kicks the coefficients of their
/// torque, a radius that is not read, with kicks the length of one, and, where the system moves, for each of the [`times`] the
/// time and the signals then. Without kicks the last part of the group is the memory of its steps.
pub(super) fn kernel(smooth: &Smooth, group: &Product) -> Result<Kernel, StepError> {
    let step = Assembly::new(smooth, group);
    let solved = step.solved();
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
        unknowns: solved + OTHERS,
        solution: step.n + MEASURES + solved + step.n * step.nodes() + step.impulse + step.work,
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
    /// The drive, and if its programs read the group element.
    drive: Option<(&'a Drive, bool)>,
    /// The numbers of an impulse, and of its work.
    impulse: usize,
    work: usize,
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
    /// The impulse of the torque, and as the start sees it; empty without one.
    impulse: [Vec<Id>; 2],
    /// The work of the torque, where there is one.
    work: Vec<Id>,
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
        let drive = smooth.drive.as_deref();
        let drive = drive.map(|drive| (drive, drive.reads_element()));
        let (gauss, impulse, work) = (Gauss::new(smooth.nodes()), impulse(smooth), work(smooth));
        Self { smooth, group, n, element, gauss, structure, drive, impulse, work }
    }

    /// The rates, and the impulse.
    fn solved(&self) -> usize {
        self.rates() + self.impulse
    }

    /// The numbers of the group element that the programs of a sweep read.
    fn seen(&self) -> usize {
        if self.drive.is_some_and(|(_, reads)| reads) { self.element } else { 0 }
    }

    /// The numbers of an element moved by x, without memory.
    fn moved(&self, graph: &Graph, g: &[Id], x: &[Id]) -> Vec<Id> {
        let zeros = vec![graph.zero(); self.n + self.group.element() - g.len()];
        let g = [g, &zeros[self.n..]].concat();
        let mut moved = self.group.transport(graph, &g, x, &zeros[..self.n]).g;
        moved.truncate(self.element);
        moved
    }

    /// Ad\*_{exp(x)} μ
    fn turned_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let back: Vec<Id> = x.iter().map(|&x| graph.neg(x)).collect();
        let anywhere = vec![graph.zero(); self.group.element()];
        self.group.transport(graph, &anywhere, &back, mu).mu
    }

    /// The momentum at the start with the impulse, as the start sees it.
    fn pushed(&self, graph: &Graph, mu: &[Id], impulse: &[Id]) -> Vec<Id> {
        if impulse.is_empty() { mu.to_vec() } else { plus(graph, mu, 1.0, impulse) }
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

    /// The increment of the step, and the momentum in its middle, with this impulse there.
    fn whole(
        &self,
        graph: &Graph,
        rates: &Rates,
        (mu, impulse): (&[Id], &[Id]),
    ) -> (Vec<Id>, Vec<Id>) {
        let zeros = vec![graph.zero(); self.n];
        let x = mixed(graph, &zeros, &constants(graph, &self.gauss.weights), &rates.x);
        let p = self.group.pull_back(graph, &x, mu);
        if impulse.is_empty() {
            return (x, p);
        }
        // ½[(d^R exp_{x/2})ᵀ μ + (d^R exp_{−x/2})ᵀ μ″]
        let half = plus(graph, &zeros, 0.5, &x);
        let p = plus(graph, &p, 0.5, &self.group.pull_back(graph, &half, impulse));
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

    /// g, μ ↦ the rates of the steps before, extrapolated by the polynomial through them, or zeros; the momentum in the middle
    /// and h times the slope there, which the linear model is made of; g, where a drive reads it.
    fn guess(&self) -> Program {
        let graph = Graph::new();
        let memory = inputs(&graph, self.element, memory(self.smooth));
        let mu = inputs(&graph, self.element + memory.len(), self.n);
        let zero = graph.zero();
        let guess = match memory.split_first() {
            Some((&count, rest)) => {
                self.extrapolated(&graph, count, &rest[..rest.len() - self.work])
            }
            None => vec![zero; self.solved()],
        };
        let (rates, impulse) = guess.split_at(self.rates());
        let mut outputs = guess.clone();
        outputs.extend([zero; OTHERS]);
        if self.models() {
            let (x, p) = self.whole(&graph, &Rates::new(self.n, rates), (&mu, impulse));
            let half = plus(&graph, &vec![zero; self.n], 0.5, &x);
            let middle = match self.seen() {
                0 => Vec::new(),
                numbers => self.moved(&graph, &inputs(&graph, 0, numbers), &half),
            };
            let slopes = self.slopes(&graph, &p, &middle);
            let step = self.step(&graph);
            outputs.extend(p);
            outputs.extend(slopes.into_iter().map(|entry| graph.mul(step, entry)));
        }
        outputs.extend(inputs(&graph, 0, self.seen()));
        graph.finish(self.element + memory.len() + self.n, &outputs)
    }

    /// The rates of the next step from the number of steps before it and the differences of their rates.
    fn extrapolated(&self, graph: &Graph, count: Id, differences: &[Id]) -> Vec<Id> {
        let rates = self.solved();
        let last = Rates::new(self.n, &differences[..self.rates()]);
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

    /// The derivatives that the linear model has of the velocity and the torque in the middle of the step, one after the other, row by
    /// row: of the velocity by the momentum, ∂²H/∂μ², of which there are the entries (i, j) with j ≤ i, all with ∂η/∂μ; then those
    /// that [`Assembly::bends`] says.
    fn slopes(&self, graph: &Graph, mu: &[Id], middle: &[Id]) -> Vec<Id> {
        let (n, own) = (self.n, Graph::new());
        let variables = inputs(&own, 0, n);
        let all = inputs(&own, 0, self.smooth.gradient.inputs());
        let omega = own.call(&self.smooth.gradient, &all);
        let entries = self.drive.map_or(0, |(drive, _)| drive.entries);
        let matrix = inputs(&own, all.len(), entries);
        let acting = self.drive.map_or_else(Vec::new, |(drive, _)| {
            self.driven(&own, drive, [&matrix, &variables, &omega, &all[n..]])
        });
        let velocity = if self.full() { plus(&own, &omega, 1.0, &acting[..n]) } else { omega };
        let one = own.constant(1.0);
        let by_momentum = |output: Id| own.pull_back(&[(output, one)], &variables);
        let by_element = |output: Id| self.along(&own, &matrix, output);
        let mut outputs = Vec::new();
        for (i, &output) in velocity.iter().enumerate() {
            let columns = if self.full() { n } else { i + 1 };
            outputs.extend(own.pull_back(&[(output, one)], &variables[..columns]));
        }
        let [of_velocity, of_torque, of_place] = self.bends();
        let rows = |list: &[Id], row: &dyn Fn(Id) -> Vec<Id>| -> Vec<Id> {
            list.iter().flat_map(|&output| row(output)).collect()
        };
        if of_velocity {
            outputs.extend(rows(&acting[..n], &by_element));
        }
        if of_torque {
            outputs.extend(rows(&acting[n..2 * n], &by_momentum));
        }
        if of_place {
            outputs.extend(rows(&acting[n..2 * n], &by_element));
        }
        let program = own.finish(all.len() + entries, &outputs);
        let mut arguments = [mu, &self.time(graph, 1)].concat();
        arguments.resize(all.len(), graph.zero());
        arguments.extend(self.matrix(graph, middle, entries));
        graph.call(&program, &arguments)
    }

    /// The derivatives of an output by ε in g exp(ε), the matrix of g being given.
    fn along(&self, graph: &Graph, g: &[Id], output: Id) -> Vec<Id> {
        let slopes = graph.pull_back(&[(output, graph.constant(1.0))], g);
        along(graph, &self.smooth.algebra, 1.0, [g, &slopes])
    }

    /// True if a velocity is a part of the linear model.
    fn full(&self) -> bool {
        self.drive.is_some_and(|(drive, _)| drive.velocity)
    }

    /// The derivatives that the linear model has besides: of η by the element, of τ by the momentum, and by the element.
    fn bends(&self) -> [bool; 3] {
        let reads = self.drive.is_some_and(|(_, reads)| reads);
        let torque = self.impulse > 0;
        [reads && self.full(), torque, torque && reads]
    }

    /// The numbers of the linear model: the momentum in the middle and the [slopes](Self::slopes) there.
    fn model(&self) -> usize {
        let n = self.n;
        let velocity = if self.full() { n * n } else { n * (n + 1) / 2 };
        let others = self.bends().into_iter().filter(|bends| *bends).count();
        if self.models() { n + velocity + others * n * n } else { 0 }
    }

    /// Row i of the slope times v.
    fn row(&self, graph: &Graph, slope: &[Id], i: usize, v: &[Id]) -> Id {
        let entry = |j: usize| match self.full() {
            true => slope[i * self.n + j],
            false => slope[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)],
        };
        v.iter().enumerate().fold(graph.zero(), |sum, (j, &v)| graph.times_plus(entry(j), v, sum))
    }

    /// The rates, the residual of the sweep before, the sweeps made, μ, the momentum in the middle, the slope, g where a drive reads it ↦
    /// the next rates, this sweep's residual, the sweeps made; the solution; the error that is left, about; 0 or, where a number is not
    /// finite, none.
    fn correct(&self) -> Program {
        let (graph, n, count) = (Graph::new(), self.n, self.solved());
        let rates = Rates::new(n, &inputs(&graph, 0, self.rates()));
        let impulse = inputs(&graph, self.rates(), self.impulse);
        let [before, sweeps] = [count, count + 1].map(|i| graph.input(i));
        let mu = inputs(&graph, count + OTHERS, n);
        let constants = self.model();
        let model = inputs(&graph, count + OTHERS + n, constants);
        let g = inputs(&graph, count + OTHERS + n + constants, self.seen());
        let [zero, one, half] = [0.0, 1.0, 0.5].map(|value| graph.constant(value));

        let in_units = |numbers: &[Id]| largest_in_units(&graph, numbers, &self.smooth.units, 1);
        let mut scale = in_units(&mu);
        let sweep = self.sweep(&graph, &rates, (&mu, &impulse), &g);
        let Sweep { momenta, change, sizes: [of_x, mut of_p], defect, impulse: pushes, work } =
            sweep;
        if self.impulse > 0 {
            scale = graph.max(scale, in_units(&impulse));
            of_p = graph.max(of_p, in_units(&plus(&graph, &pushes[0], -1.0, &impulse)));
        }
        let scale = graph.select(scale, zero, one, scale);
        let residual = graph.max(of_x, graph.div(of_p, scale));
        let pushed = match self.impulse {
            0 => Vec::new(),
            _ => plus(&graph, &pushes[0], -1.0, &impulse),
        };
        let (next, sizes, bent) = self.corrected(&graph, &rates, (&change, &pushed), &model);
        // Before the first sweep there was none.
        let shrinks = graph.min(graph.div(residual, before), half);
        let left = graph.mul(residual, graph.select(before, zero, one, shrinks));
        let rounding = graph.constant(ROUNDING / f64::EPSILON);
        let rounding = graph.mul(rounding, graph.epsilon());
        let stays = graph.select(residual, rounding, zero, left);
        let stays = graph.select(before, residual, stays, left);
        let left = graph.select(before, zero, left, stays);

        let (x, _) = self.whole(&graph, &next, (&mu, &[]));
        let size = pushes[1].iter().chain(&mu).copied().collect::<Vec<_>>();
        let measures = self.measures(&graph, (&next, sizes), largest(&graph, &size), &model);
        let solved = [&next.numbers()[..], &plus(&graph, &pushes[0], 1.0, &bent)].concat();
        let mut outputs = solved.clone();
        let sweeps = graph.add(sweeps, one);
        outputs.extend([residual, sweeps]);
        // Sweeps of a stiff drive converge slowly; their number says nothing of H.
        let model = if self.drive.is_some() { usize::MAX } else { n };
        let most = graph.constant(1.0 / ordinary_sweeps(model));
        let measures = measures.into_iter().chain([graph.mul(sweeps, most)]);
        outputs.extend(x.into_iter().chain(measures).chain(solved));
        outputs.extend(by_coordinate(&momenta));
        outputs.extend_from_slice(&pushes[1]);
        outputs.extend(work);
        outputs.extend([left, defect]);
        graph.finish(count + OTHERS + n + constants + g.len(), &outputs)
    }

    /// The change of the rates to those that follow from them.
    fn sweep(
        &self,
        graph: &Graph,
        rates: &Rates,
        (mu, impulse): (&[Id], &[Id]),
        g: &[Id],
    ) -> Sweep {
        let n = self.n;
        let (x, p) = self.whole(graph, rates, (mu, impulse));
        let half = plus(graph, &vec![graph.zero(); n], 0.5, &x);
        let middle = if g.is_empty() { Vec::new() } else { self.moved(graph, g, &half) };
        let row = |node: usize| {
            let (weights, time) = (self.weights(graph, node), self.time(graph, 2 + node));
            let own = [&weights[..], &time, &rates.x[node], &rates.p[node]].concat();
            [&own[..], &rates.numbers(), &p, &middle].concat()
        };
        let rows: Vec<Vec<Id>> = (0..self.nodes()).map(row).collect();
        let results = graph.call_each(&self.sweep_at_node(), &rows);
        let part = |from: usize| results.iter().map(|row| row[from..from + n].to_vec()).collect();
        let each = |at: usize| results.iter().map(move |row| row[at]);
        let defects = each(3 * n + 2);
        let impulse = match self.impulse {
            0 => [const { Vec::new() }; 2],
            _ => {
                let weights = constants(graph, &self.gauss.weights);
                let middle = mixed(graph, &vec![graph.zero(); n], &weights, &part(3 * n + 3));
                let start = self.turned_back(graph, &half, &middle);
                [middle, start]
            }
        };
        let work = match self.work {
            0 => Vec::new(),
            _ => {
                let weights = constants(graph, &self.gauss.weights);
                let works: Rows = each(4 * n + 3).map(|work| vec![work]).collect();
                mixed(graph, &[graph.zero()], &weights, &works)
            }
        };
        Sweep {
            impulse,
            work,
            momenta: part(0),
            change: Rates { x: part(n), p: part(2 * n) },
            sizes: [0, 1].map(|at| greatest(graph, each(3 * n + at))),
            defect: defects.reduce(|sum, one| graph.add(sum, one)).unwrap_or_else(|| graph.zero()),
        }
    }

    /// The weights of a node, its time, its rates, all rates, the momentum in the middle, the element there where a drive reads it ↦ the
    /// momentum at the node, the changes of its rates, their sizes, 0 or, where a number is not finite, none; with a torque h times
    /// that, as the middle of the step sees it, and h times its power.
    fn sweep_at_node(&self) -> Program {
        let (graph, n, m) = (Graph::new(), self.n, self.nodes());
        let mut inputs = Inputs(&graph, 0);
        let (weights, time) = (inputs.take(m), inputs.take(self.time(&graph, 0).len()));
        let (own, all, middle) = (inputs.rates(n, 1), inputs.rates(n, m), inputs.take(n));
        let g = inputs.take(self.seen());
        let count = inputs.1;
        let x = mixed(&graph, &vec![graph.zero(); n], &weights, &all.x);
        let p = mixed(&graph, &middle, &weights, &all.p);
        let momentum = self.group.node_momentum(&graph, &x, &p, degree(m));
        let gradient = graph.call(&self.smooth.gradient, &[&momentum[..], &time].concat());
        let step = self.step(&graph);
        let (mut velocity, mut torque, mut work) = (gradient.clone(), Vec::new(), Vec::new());
        if let Some((drive, _)) = self.drive {
            let g = if g.is_empty() { g } else { self.moved(&graph, &g, &x) };
            let matrix = self.matrix(&graph, &g, drive.entries);
            let acting = self.driven(&graph, drive, [&matrix, &momentum, &gradient, &time]);
            velocity = plus(&graph, &velocity, 1.0, &acting[..n]);
            let times_step = |list: &[Id]| list.iter().map(|&it| graph.mul(step, it)).collect();
            torque = times_step(&acting[n..n + self.impulse]);
            work = times_step(&acting[2 * n..]);
        }
        let omega: Vec<Id> = velocity.iter().map(|&entry| graph.mul(step, entry)).collect();
        let mut x_rates = graph.call(&self.equations(), &[&x[..], &p, &omega].concat());
        let mut p_rates = x_rates.split_off(n);
        let mut pushed = Vec::new();
        if !torque.is_empty() {
            let back: Vec<Id> = x.iter().map(|&x| graph.neg(x)).collect();
            let force = self.group.pull_back(&graph, &back, &torque);
            p_rates = plus(&graph, &p_rates, 1.0, &force);
            pushed = self.turned_back(&graph, &x, &torque);
        }
        let next = Rates { x: vec![x_rates], p: vec![p_rates] };
        let change = next.with(&own, |a, b| graph.sub(a, b));
        let size =
            |rows: &Rows, power| largest_in_units(&graph, &rows[0], &self.smooth.units, power);
        let sizes = [size(&change.x, -1), size(&change.p, 1)];
        let change = change.numbers();
        let defect = finite(&graph, &change);
        graph.finish(count, &[&momentum[..], &change, &sizes, &[defect], &pushed, &work].concat())
    }

    /// The entries of the matrix of an element, as many zeros where it is not read.
    fn matrix(&self, graph: &Graph, g: &[Id], entries: usize) -> Vec<Id> {
        if g.is_empty() {
            return vec![graph.zero(); entries];
        }
        let mut g = g.to_vec();
        g.resize(self.group.element(), graph.zero());
        self.group.matrix(graph, &g).entries().to_vec()
    }

    /// η and τ, and the power of τ where it works, by the entries of the matrix, the momentum, ∂H/∂μ and the time.
    fn driven(&self, graph: &Graph, drive: &Drive, state: [&[Id]; 4]) -> Vec<Id> {
        let mut inputs = state.concat();
        inputs.resize(drive.program.inputs(), graph.zero());
        graph.call_from(&drive.program, &inputs, drive.first)
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
    /// the end, as a share of its limit.
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
        (change, pushed): (&Rates, &[Id]),
        model: &[Id],
    ) -> (Rates, [Id; 2], Vec<Id>) {
        let n = self.n;
        let mut shared = change.numbers();
        if self.models() {
            let (half, zeros) = (graph.constant(0.5), vec![graph.zero(); n]);
            let x = mixed(graph, &zeros, &constants(graph, &self.gauss.weights), &change.x);
            let mut turned = self.ad_star(graph, &x, &model[..n]);
            if !pushed.is_empty() {
                turned = plus(graph, &turned, 1.0, pushed);
            }
            shared.extend(turned.iter().map(|&entry| graph.mul(half, entry)));
            if self.bends().contains(&true) {
                shared.extend(plus(graph, &zeros, 0.5, &x));
            }
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
        let bent = match self.impulse > 0 && self.models() {
            false => vec![graph.zero(); self.impulse],
            true => {
                let weights = constants(graph, &self.gauss.weights);
                mixed(graph, &vec![graph.zero(); n], &weights, &part(2 * n + 2))
            }
        };
        (Rates { x: part(0), p: part(n) }, [0, 1].map(size), bent)
    }

    /// The weights of a node, its rates, their changes, all changes; where there is a linear model the change of the momentum in the
    /// middle, half of that of x where derivatives by the element are known, that momentum and the slopes ↦ the next rates, the largest
    /// of those of x and of p; h times the change of the torque.
    fn corrected_at_node(&self) -> Program {
        let (graph, n, m) = (Graph::new(), self.n, self.nodes());
        let mut inputs = Inputs(&graph, 0);
        let weights = inputs.take(m);
        let (own, changed, all) = (inputs.rates(n, 1), inputs.rates(n, 1), inputs.rates(n, m));
        let mut next = own.clone();
        let mut torque = Vec::new();
        if self.models() {
            let middle = inputs.take(n);
            let bends = self.bends();
            let half = inputs.take(if bends.contains(&true) { n } else { 0 });
            let (p, slope) = (inputs.take(n), inputs.take(self.model() - n));
            let zeros = vec![graph.zero(); n];
            let x = mixed(&graph, &zeros, &weights, &all.x);
            let moved = mixed(&graph, &middle, &weights, &all.p);
            let mu = plus(&graph, &moved, 0.5, &self.ad_star(&graph, &x, &p));
            let mut velocity: Vec<Id> = (0..n).map(|i| self.row(&graph, &slope, i, &mu)).collect();
            let mut blocks = slope
                [slope.len() - n * n * bends.iter().filter(|own| **own).count()..]
                .chunks(n * n)
                .map(|block| block.chunks(n).collect::<Vec<_>>());
            let mut add = |sum: &mut Vec<Id>, v: &[Id]| {
                for (sum, row) in sum.iter_mut().zip(blocks.next().unwrap_or_default()) {
                    let terms = row.iter().zip(v);
                    *sum = terms.fold(*sum, |sum, (&entry, &v)| graph.times_plus(entry, v, sum));
                }
            };
            // The element at the node moves with the middle, and from it.
            let moved_by = |half: &[Id]| plus(&graph, half, 1.0, &x);
            if bends[0] {
                add(&mut velocity, &moved_by(&half));
            }
            if bends[1] {
                torque.clone_from(&zeros);
                add(&mut torque, &mu);
            }
            if bends[2] {
                add(&mut torque, &moved_by(&half));
            }
            let force = plus(&graph, &zeros, 0.5, &self.ad_star(&graph, &velocity, &p));
            let mut force = plus(&graph, &force, 0.5, &self.ad_star(&graph, &own.x[0], &moved));
            if !torque.is_empty() {
                force = plus(&graph, &force, 1.0, &torque);
            }
            let bent = self.bracket(&graph, &x, &own.x[0]);
            let velocity = plus(&graph, &velocity, 0.5, &bent);
            let linear = Rates { x: vec![velocity], p: vec![force] };
            next = next.with(&linear, |a, b| graph.add(a, b));
        }
        let next = next.with(&changed, |a, b| graph.add(a, b));
        let sizes = [&next.x, &next.p].map(|rows| largest(&graph, &rows[0]));
        graph.finish(inputs.1, &[&next.numbers()[..], &sizes, &torque].concat())
    }

    /// The resolution of the step by its nodes, as shares of the limits: the highest polynomials through two nodes and more, of
    /// the velocity and of the force, for momenta of this scale; with one node the product of velocity, force, and what that changes.
    fn measures(
        &self,
        graph: &Graph,
        (rates, [velocity, force]): (&Rates, [Id; 2]),
        scale: Id,
        model: &[Id],
    ) -> [Id; 2] {
        // The gain is that at the guess.
        let near = if self.nodes() == 1 { NEAR_LIMIT } else { 1.0 };
        let limits = [near * LARGEST_TAIL[self.nodes() - 1], LARGEST_FORCE];
        let [tail, steep] = limits.map(|limit| graph.constant(1.0 / limit));
        if self.nodes() == 1 {
            let f = share(graph, force, scale);
            let gain = graph.add(self.gain(graph, model), f);
            let product = graph.mul(graph.mul(f, velocity), gain);
            return [graph.mul(tail, product), graph.zero()];
        }
        let zeros = vec![graph.zero(); self.n];
        let weights = constants(graph, &self.gauss.highest);
        let highest = |rows| largest(graph, &mixed(graph, &zeros, &weights, rows));
        // Two nodes see the acceleration alone.
        let velocity = match self.nodes() {
            2 => graph.max(velocity, graph.constant(SLOW)),
            _ => velocity,
        };
        let of_velocity = share(graph, highest(&rates.x), velocity);
        let of_force = share(graph, highest(&rates.p), scale);
        [graph.mul(tail, of_velocity), graph.mul(steep, of_force)]
    }

    /// The largest sum of a row of h·H″·∂P/∂x, where P = μ + ½ad\*_x μ to first order; 1 where there is no model.
    fn gain(&self, graph: &Graph, model: &[Id]) -> Id {
        if !self.models() {
            return graph.constant(1.0);
        }
        let ((p, slope), half) = (model.split_at(self.n), graph.constant(0.5));
        let mut sums = vec![graph.zero(); self.n];
        for j in 0..self.n {
            let unit: Vec<Id> =
                (0..self.n).map(|i| graph.constant(f64::from(u8::from(i == j)))).collect();
            let turned = self.ad_star(graph, &unit, p);
            for (i, sum) in sums.iter_mut().enumerate() {
                let entry = graph.abs(self.row(graph, slope, i, &turned));
                *sum = graph.times_plus(half, entry, *sum);
            }
        }
        largest(graph, &sums)
    }

    /// μ, the solution, the error left, 0 or, where a number is not finite, NaN ↦ 1 where the step is solved, in the chart, and resolved by its nodes.
    fn accept(&self) -> Program {
        let (graph, n) = (Graph::new(), self.n);
        let momenta = n + MEASURES + self.solved();
        let impulse = momenta + n * self.nodes();
        let solution = inputs(&graph, n, impulse + self.impulse + self.work);
        let last = n + solution.len();
        let [left, distance] = [last, last + 1].map(|i| graph.input(i));
        let tolerance = graph.constant(SOLVED / f64::EPSILON);
        let tolerance = graph.mul(tolerance, graph.epsilon());
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        // The formulas hold up to a quarter turn.
        let extent = graph.mul(graph.constant(4.0), self.group.extent(&graph, &solution[..n]));
        let measures = solution[n..n + MEASURES].iter().map(|&measure| (measure, one));
        let tests = [(left, tolerance), (distance, zero), (extent, one)].into_iter();
        let nodes = by_node(n, &solution[momenta..impulse]);
        let (mu, anywhere) = (inputs(&graph, 0, n), vec![zero; self.group.element()]);
        let pushed = self.pushed(&graph, &mu, &solution[impulse..][..self.impulse]);
        let end = self.group.transport(&graph, &anywhere, &solution[..n], &pushed).mu;
        let reach = self.reach(&graph, &mu, &nodes, &end);
        let tests: Vec<_> = tests.chain(measures).chain([(reach, one)]).collect();
        graph.finish(last + 2, &[all_at_most(&graph, &tests)])
    }

    /// g, μ, the solution ↦ the state moved by the increment, with the differences of the rates for the next step, and the work.
    fn transport(&self) -> Program {
        let (graph, n, rates) = (Graph::new(), self.n, self.solved());
        let g = inputs(&graph, 0, self.group.element());
        let mu = inputs(&graph, g.len(), n);
        let impulse = n + MEASURES + rates + n * self.nodes();
        let solution = inputs(&graph, g.len() + n, impulse + self.impulse + self.work);
        let (impulse, work) = solution[impulse..].split_at(self.impulse);
        let mu = self.pushed(&graph, &mu, impulse);
        let Moved { g: mut outputs, mu } = self.group.transport(&graph, &g, &solution[..n], &mu);
        outputs.truncate(self.element);
        if let Some((&count, rest)) = g[self.element..].split_first() {
            let (differences, before) = rest.split_at(rest.len() - self.work);
            let [one, most] = [1.0, KEPT as f64].map(|value| graph.constant(value));
            outputs.push(graph.min(graph.add(count, one), most));
            let program = differences_after();
            let row = |rate: usize| {
                let old = differences.iter().skip(rate).step_by(rates).take(KEPT - 1);
                [solution[n + MEASURES + rate]].into_iter().chain(old.copied()).collect()
            };
            let rows = graph.call_each(&program, &(0..rates).map(row).collect::<Vec<_>>());
            outputs.extend((0..KEPT).flat_map(|order| rows.iter().map(move |row| row[order])));
            outputs.extend(before.iter().zip(work).map(|(&before, &work)| graph.add(before, work)));
        }
        outputs.extend(mu);
        graph.finish(g.len() + n + solution.len(), &outputs)
    }

    /// g, μ ↦ the energy, at the time at which the step begins, and the Casimirs of low degree that are conserved.
    fn watch(&self) -> Program {
        let Smooth { algebra, kicks, value, .. } = self.smooth;
        let energy = |graph: &Graph, mu: &[Id]| self.at(graph, value, mu, 0);
        let of_drive = self.drive.map(|(drive, _)| {
            let potential = drive.potential.as_ref();
            let value = potential.and_then(|(potential, first)| match &potential.force {
                Force::Smooth(programs) => Some((programs.value.as_ref()?, drive.first + first)),
                Force::Polynomial(_) => None,
            });
            Acting { energy: value, torque: drive.torque.as_ref() }
        });
        let acting = of_drive.or_else(|| kicks.as_ref().map(Acting::of_kicks));
        watch(energy, algebra, acting, self.group)
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
