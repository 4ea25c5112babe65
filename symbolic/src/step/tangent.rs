//! The step of a state with a tangent beside it, as a kernel: by differentiating the programs of the step.
//!
//! A tangent to a state (g, μ) is (ξ, ν), ξ = g⁻¹δg in 𝔤 and ν = δμ, and changes θ̇ of numbers that coefficients depend on. The solution of a
//! step is a fixed point z = C(z, μ) of its correction, so its tangent is the fixed point of ż = ∂C/∂z ż + ∂C/∂μ ν + …, and is
//! corrected with it. A motion by τ(x) moves, with L = d^L τ_x,
//!
//! ```text
//! ξ″ = Ad_{τ(x)⁻¹} ξ + L ẋ
//! ```
//!
//! and ν as the derivative of the moved momentum says.

use coadjoint_program::fold::FoldError;
use coadjoint_program::{Argument, Kernel, KernelParts, Node, Programs};

use super::product::Part;
use super::solving::inputs;
use super::tables::structure_of;
use super::transposed::{back, transposed};
use super::vector::largest;
use super::{Moving, Origin, Step, StepError};
use super::{collocation, programs};
use crate::graph::{Graph, Id, Program};

/// The change of the solution by a correction, relative to its largest number, up to which tangents are as right as it is.
const SETTLED: f64 = 1e-14;

/// The distance of a tangent of the solution from where corrections lead it, relative to its largest number, at which it is solved for.
const FOUND: f64 = 1e-13;

/// Corrections of a solution that has settled after which a tangent whose changes do not shrink has only rounding left: of numbers that
/// cancel each other.
const LEFT_TO_ROUNDING: u32 = 6;

/// The share of a change that the next one has at least where they do not shrink.
const LASTING: f64 = 0.9;

/// Corrections more than those of the step.
const MORE: u32 = 30;

/// Numbers of a solve that tell how a tangent of the solution is found: how often it was corrected since the solution has settled, and its
/// last change.
const OF_TANGENT: usize = 2;

/// The step of a state with a tangent. n is the dimension, m how many numbers make a group element.
#[derive(Debug)]
pub struct Tangent {
    /// Its programs, of g (m) as the step has it and, in place of μ, of μ (n), ξ (n), ν (n) and θ̇. After the coefficients of a flow they read
    /// the [slopes](Tangent::slopes).
    pub kernel: Kernel,
    /// The derivatives of coefficients that are not 0: the place of the coefficient in a flow, the number of the θ.
    pub slopes: Vec<(usize, usize)>,
    /// The number of the θ.
    directions: usize,
}

/// A state with a tangent, as nodes.
struct State {
    mu: Vec<Id>,
    xi: Vec<Id>,
    nu: Vec<Id>,
    theta: Vec<Id>,
}

impl State {
    fn numbers(self) -> Vec<Id> {
        [self.mu, self.xi, self.nu, self.theta].concat()
    }
}

/// The programs of a step on their way to those with a tangent.
struct Differentiation<'a> {
    step: &'a Step,
    origin: &'a Origin,
    slopes: &'a [(usize, usize)],
    /// The number of the θ.
    directions: usize,
    /// The numbers that are solved for, those whose equation has a derivative; others tell how the solve goes.
    solved: usize,
    /// The program that moves a state without a frame.
    moved: Program,
    /// The numbers of a solution by which the momentum and the element move.
    moving: Vec<usize>,
    /// g, y, v ↦ the change of g·τ(y) with y along v.
    turned: Program,
}

impl<'a> Differentiation<'a> {
    fn new(
        step: &'a Step,
        origin: &'a Origin,
        slopes: &'a [(usize, usize)],
        directions: usize,
    ) -> Self {
        let (kernel, group, graph) = (&step.kernel, &step.group, Graph::new());
        let (n, m) = (group.dim(), group.element());
        let [g, y] = [(0, m), (m, n)].map(|(from, count)| inputs(&graph, from, count));
        let turned = group.transport(&graph, &g, &y, &vec![graph.zero(); n]).g;
        let of: Vec<_> = (m..m + n).map(Argument::Input).collect();
        let turned = graph.finish(m + n, &turned).push_forward(&of);
        let (solved, moved) = match origin {
            Origin::Series(_) => (kernel.unknowns, programs::transport(group)),
            Origin::Collocation(_) => {
                (kernel.unknowns - collocation::OTHERS, kernel.programs.transport.clone())
            }
        };
        let graph = Graph::new();
        let outputs = graph.call(&moved, &inputs(&graph, 0, moved.inputs()));
        let read = graph.finish(moved.inputs(), &outputs[m..]);
        let mut moving: Vec<usize> = (0..n).collect();
        moving.extend(read.nodes().iter().filter_map(|node| match *node {
            Node::Input(i) => (i as usize).checked_sub(m + n),
            _ => None,
        }));
        moving.sort_unstable();
        moving.dedup();
        Self { step, origin, slopes, directions, solved, moved, moving, turned }
    }

    /// n.
    fn dim(&self) -> usize {
        self.step.kernel.dim
    }

    /// The numbers in place of a momentum.
    fn momentum(&self) -> usize {
        3 * self.dim() + self.directions
    }

    /// Those of a state from this input on.
    fn state(&self, graph: &Graph, from: usize) -> State {
        let n = self.dim();
        let [mu, xi, nu] = [0, n, 2 * n].map(|at| inputs(graph, from + at, n));
        State { mu, xi, nu, theta: inputs(graph, from + 3 * n, self.directions) }
    }

    /// The change of g along ξ.
    fn turned(&self, graph: &Graph, g: &[Id], xi: &[Id]) -> Vec<Id> {
        let nothing = vec![graph.zero(); xi.len()];
        graph.call(&self.turned, &[g, &nothing, xi].concat())
    }

    /// Coefficients and their changes.
    fn coefficients(&self, graph: &Graph, theta: &[Id]) -> Vec<(usize, Id)> {
        let first = self.step.kernel.slots_of_flow();
        let mut changes: Vec<(usize, Id)> = Vec::new();
        for (at, &(place, number)) in self.slopes.iter().enumerate() {
            let slope = graph.slot(first + at);
            match changes.last_mut().filter(|(last, _)| *last == place) {
                Some((_, sum)) => *sum = graph.times_plus(slope, theta[number], *sum),
                None => changes.push((place, graph.mul(slope, theta[number]))),
            }
        }
        changes
    }

    /// The results of a program, and their changes with those of its inputs and of coefficients.
    fn along(
        &self,
        graph: &Graph,
        program: &Program,
        (at, change): (&[Id], &[Id]),
        theta: &[Id],
    ) -> [Vec<Id>; 2] {
        let mut coefficients = self.coefficients(graph, theta);
        coefficients.retain(|(place, _)| *place < program.slots());
        let places = coefficients.iter().map(|(place, _)| Argument::Slot(*place));
        // Inputs that do not change need no derivatives.
        let moves: Vec<usize> = (0..at.len()).filter(|&i| !graph.is_zero(change[i])).collect();
        let of: Vec<_> = moves.iter().map(|&i| Argument::Input(i)).chain(places).collect();
        let changes = moves.iter().map(|&i| change[i]);
        let changes: Vec<Id> =
            changes.chain(coefficients.iter().map(|(_, change)| *change)).collect();
        let changed = graph.call(&program.push_forward(&of), &[at, &changes].concat());
        [graph.call(program, at), changed]
    }

    /// μ, or g and μ, ↦ a first guess with its change, and the constants, with their changes where they hold numbers of g.
    fn guess(&self) -> Program {
        let (graph, kernel, solved) = (Graph::new(), &self.step.kernel, self.solved);
        let m = if kernel.guesses_from_element() { kernel.element } else { 0 };
        let (mut g, state) = (inputs(&graph, 0, m), self.state(&graph, m));
        let turned = if m > 0 { self.turned(&graph, &g, &state.xi) } else { Vec::new() };
        // From what earlier steps have left, the solution would be guessed better than its change.
        let own = m - self.step.memory.min(m);
        g[own..].fill(graph.zero());
        let (at, change) = ([&g[..], &state.mu].concat(), [&turned[..], &state.nu].concat());
        let [value, change] =
            self.along(&graph, &kernel.programs.guess, (&at, &change), &state.theta);
        let (unknowns, constants) = value.split_at(kernel.unknowns);
        let changed = if m > 0 { &change[kernel.unknowns..] } else { &[] };
        let before = [graph.zero(); OF_TANGENT];
        let outputs = [unknowns, &change[..solved], &before, constants, changed].concat();
        graph.finish(m + self.momentum(), &outputs)
    }

    /// As the correction of the step, with the changes of what is solved for and of what moves.
    fn correct(&self) -> Program {
        let (graph, kernel, solved) = (Graph::new(), &self.step.kernel, self.solved);
        let (u, v) = (kernel.unknowns, kernel.solution);
        let mut count = 0;
        let mut take = |more: usize| {
            count += more;
            inputs(&graph, count - more, more)
        };
        let (z, known, before) = (take(u), take(solved), take(OF_TANGENT));
        let mut moved = known.clone();
        moved.resize(u, graph.zero());
        let state = self.state(&graph, u + solved + OF_TANGENT);
        take(self.momentum());
        let constants = take(kernel.programs.guess.outputs().len() - u);
        let changed = match kernel.guesses_from_element() {
            true => take(constants.len()),
            // At a solution they do not matter.
            false => vec![graph.zero(); constants.len()],
        };
        let at = [&z[..], &state.mu, &constants].concat();
        let change = [&moved[..], &state.nu, &changed].concat();
        let correct = &kernel.programs.correct;
        let [value, change] = self.along(&graph, correct, (&at, &change), &state.theta);
        let next = &change[..solved];
        let (settled, length) = self.settled(&graph, &z, &value);
        let (after, settled) = self.followed(&graph, settled, (&known, next), &before);
        let mut outputs = [&value[..u], next, &after, &value[u..u + v]].concat();
        outputs.extend(self.moving.iter().map(|&at| change[u + at]));
        outputs.extend([settled, length]);
        graph.finish(count, &outputs)
    }

    /// The bound on the residual that a correction of z to these values leaves, which is no solution before it has settled, and the length of
    /// the correction, as far as the step without tangents makes it.
    fn settled(&self, graph: &Graph, z: &[Id], value: &[Id]) -> (Id, Id) {
        let kernel = &self.step.kernel;
        let pairs = z.iter().zip(value).take(self.solved);
        let less: Vec<Id> = pairs.map(|(&z, &next)| graph.sub(next, z)).collect();
        let smallest = graph.constant(f64::MIN_POSITIVE);
        let size = graph.add(largest(graph, &value[..self.solved]), smallest);
        let moved = graph.div(largest(graph, &less), size);
        let (bound, length) =
            (value[z.len() + kernel.solution], value[z.len() + kernel.solution + 1]);
        let settled = graph.select(moved, graph.constant(SETTLED), bound, graph.max(bound, moved));
        let tolerance = graph.constant(kernel.tolerance);
        (settled, graph.select(bound, tolerance, graph.zero(), length))
    }

    /// The numbers that tell how a tangent of the solution is found, after a correction of it to the next one, and the bound on the residual
    /// (that of the solution being known), which is 1 before it is found. Corrections take it to its solution as they do with z, by which
    /// it is not judged: z may have been guessed better.
    fn followed(
        &self,
        graph: &Graph,
        settled: Id,
        (last, next): (&[Id], &[Id]),
        before: &[Id],
    ) -> ([Id; OF_TANGENT], Id) {
        let number = |value: f64| graph.constant(value);
        let (one, half, zero) = (number(1.0), number(0.5), graph.zero());
        let less = last.iter().zip(next).map(|(&last, &next)| graph.sub(next, last));
        let moved = largest(graph, &less.collect::<Vec<_>>());
        let (count, change) = (before[0], before[1]);
        let tolerance = number(self.step.kernel.tolerance);
        let count = graph.select(settled, tolerance, graph.add(count, one), zero);
        let share = graph.select(change, zero, half, graph.min(graph.div(moved, change), half));
        let most = graph.mul(largest(graph, next), number(FOUND));
        let lasts = graph.select(graph.mul(change, number(LASTING)), moved, settled, one);
        let many = number(f64::from(LEFT_TO_ROUNDING));
        let open = graph.select(many, count, lasts, one);
        let bound = graph.select(graph.mul(moved, share), most, settled, open);
        ([count, moved], bound)
    }

    /// A test of the step: of g where it has one, of μ, and of other numbers.
    fn test(&self, program: &Program, before: usize, skipped: usize, after: usize) -> Program {
        let graph = Graph::new();
        let (first, n) = (inputs(&graph, 0, before), self.dim());
        let mu = inputs(&graph, before, n);
        let from = before + self.momentum();
        let own = program.inputs() - before - n - after;
        let x = inputs(&graph, from, own);
        let last = inputs(&graph, from + own + skipped, after);
        let outputs = graph.call(program, &[first, mu, x, last].concat());
        graph.finish(from + own + skipped + after, &outputs)
    }

    /// Moves by x, after it by the frame where there is one.
    fn transport(&self) -> Result<Program, StepError> {
        let (graph, kernel, group) = (Graph::new(), &self.step.kernel, &self.step.group);
        let (m, n, v) = (kernel.element, kernel.dim, kernel.solution);
        let (g, state) = (inputs(&graph, 0, m), self.state(&graph, m));
        let from = m + self.momentum();
        let (x, known) = (inputs(&graph, from, v), inputs(&graph, from + v, self.moving.len()));
        let mut moved = vec![graph.zero(); v];
        self.moving.iter().zip(known).for_each(|(&at, change)| moved[at] = change);
        let at = [&g[..], &state.mu, &x].concat();
        let change = [&vec![graph.zero(); m][..], &state.nu, &moved].concat();
        let [mut g, mut nu] = self.along(&graph, &self.moved, (&at, &change), &state.theta);
        let (mut mu, nothing) = (g.split_off(m), vec![graph.zero(); n]);
        nu.drain(..m);
        // Ad_{τ⁻¹} is the transpose of Ad*_τ, and d^L τ_x = d^R τ_{−x}.
        let back = transposed(n, |graph, x, w| {
            let back: Vec<Id> = x.iter().map(|&x| graph.neg(x)).collect();
            let anywhere = vec![graph.zero(); m];
            let moved = group.transport(graph, &anywhere, &back, w).mu;
            [moved, group.pull_back(graph, &back, w)]
        });
        let mut xi = graph.call(&back, &[&x[..n], &state.xi, &moved[..n], &nothing].concat());
        let algebra = self.origin.facts().algebra;
        for motion in self.origin.series().map_or(&[][..], |integrator| &integrator.frame) {
            let [y, change] = self.along(&graph, motion, (&mu, &nu), &state.theta);
            let unknown = || StepError::Frame { group: algebra.name().to_owned() };
            let moved = group.move_frame(&graph, &g, &y, &mu).ok_or_else(unknown)?;
            nu = group.move_frame(&graph, &g, &y, &nu).ok_or_else(unknown)?.mu;
            let eta = group.trail(&graph, &y, &nothing, &change);
            xi = group.trail(&graph, &y, &xi, &change);
            (g, mu) = (moved.g, moved.mu);
            for (i, j, k, c) in structure_of(algebra) {
                let factor = graph.mul(graph.constant(c), eta[i]);
                nu[j] = graph.times_plus(factor, mu[k], nu[j]);
            }
        }
        let state = State { mu, xi, nu, theta: state.theta }.numbers();
        Ok(graph.finish(from + v + self.moving.len(), &[g, state].concat()))
    }

    /// The step of these programs, in which a solution has `read` numbers more than the step's own.
    fn kernel(
        &self,
        [guess, correct, transport]: [Program; 3],
        read: usize,
    ) -> Result<Kernel, StepError> {
        let (own, nothing) = (&self.step.kernel, |inputs| Graph::new().finish(inputs, &[]));
        let programs = Programs {
            guess,
            correct,
            accept: self.test(&own.programs.accept, 0, read, 2),
            transport,
            frame: None,
            sound: self.test(&own.programs.sound, own.element, 0, 0),
            watch: nothing(own.element + self.momentum()),
            matrix: nothing(own.element),
        };
        Ok(Kernel::new(KernelParts {
            dim: self.momentum(),
            unknowns: own.unknowns + self.solved + OF_TANGENT,
            solution: own.solution + read,
            corrections: own.corrections + MORE,
            programs,
            ..(**own).clone()
        })?)
    }

    /// A kick.
    fn kick(&self, kick: &Program) -> Program {
        let (graph, m) = (Graph::new(), self.step.kernel.element);
        let (g, State { mu, xi, nu, theta }) = (inputs(&graph, 0, m), self.state(&graph, m));
        let change = [&self.turned(&graph, &g, &xi)[..], &nu].concat();
        let at = [&g[..], &mu].concat();
        let [mu, nu] = self.along(&graph, kick, (&at, &change), &theta);
        graph.finish(m + self.momentum(), &State { mu, xi, nu, theta }.numbers())
    }
}

/// The programs of a step with a tangent on their way to those with a cotangent (λ, κ), the factors of ξ and ν in a sum: a step takes
/// that after it to that before it, and adds the derivatives in θ.
struct Transposition<'a> {
    own: &'a Differentiation<'a>,
    guess: &'a Program,
    correct: &'a Program,
    transport: &'a Program,
}

impl Transposition<'_> {
    /// The numbers of the constants of a solve.
    fn constants(&self) -> usize {
        self.own.step.kernel.programs.guess.outputs().len() - self.own.step.kernel.unknowns
    }

    /// As that of the step with a tangent, a cotangent of the solution in place of the change, which begins with 0.
    fn guess(&self) -> Program {
        let Differentiation { step, solved, .. } = self.own;
        let (graph, u) = (Graph::new(), step.kernel.unknowns);
        let known = graph.call(self.guess, &inputs(&graph, 0, self.guess.inputs()));
        let constants = &known[u + solved + OF_TANGENT..][..self.constants()];
        let nothing = vec![graph.zero(); solved + OF_TANGENT];
        let outputs = [&known[..u], &nothing, constants].concat();
        graph.finish(self.guess.inputs(), &outputs)
    }

    /// g, μ, and a solution, as the transport has them, without changes.
    fn of_transport(&self, graph: &Graph, g: &[Id], mu: &[Id], x: &[Id]) -> Vec<Id> {
        let mut at = [g, mu].concat();
        at.resize(g.len() + self.own.momentum(), graph.zero());
        at.extend(x);
        at.resize(self.transport.inputs(), graph.zero());
        at
    }

    /// z, μ and constants, as the correction has them, without changes.
    fn of_correct(&self, graph: &Graph, z: &[Id], mu: &[Id], constants: &[Id]) -> Vec<Id> {
        let (mut at, from) = (z.to_vec(), z.len() + self.own.solved + OF_TANGENT);
        at.resize(from, graph.zero());
        at.extend(mu);
        at.resize(from + self.own.momentum(), graph.zero());
        at.extend(constants);
        at.resize(self.correct.inputs(), graph.zero());
        at
    }

    /// The weights of ξ and ν after the step.
    fn landed(&self, state: &State) -> Vec<(usize, Id)> {
        let from = self.own.step.kernel.element + self.own.dim();
        (from..).zip(state.xi.iter().chain(&state.nu).copied()).collect()
    }

    /// The weights of the changes that a correction makes: of the solution, and of what moves.
    fn corrected(&self, a: &[Id], moving: &[Id]) -> Vec<(usize, Id)> {
        let (u, v) = (self.own.step.kernel.unknowns, self.own.step.kernel.solution);
        let of_moving = (u + self.own.solved + OF_TANGENT + v..).zip(moving.iter().copied());
        (u..).zip(a.iter().copied()).chain(of_moving).collect()
    }

    /// A correction of the solution and of its cotangent. What is read of them is the solution as the step reads it, z, that
    /// cotangent, and the constants.
    fn correct(&self) -> Program {
        let (own, graph) = (self.own, Graph::new());
        let (kernel, solved) = (&own.step.kernel, own.solved);
        let (u, v, m) = (kernel.unknowns, kernel.solution, kernel.element);
        let [z, a, before] = [(0, u), (u, solved), (u + solved, OF_TANGENT)]
            .map(|(from, count)| inputs(&graph, from, count));
        let state = own.state(&graph, u + solved + OF_TANGENT);
        let from = u + solved + OF_TANGENT + own.momentum();
        let constants = inputs(&graph, from, self.constants());
        let at = [&z[..], &state.mu, &constants].concat();
        let value = graph.call(&kernel.programs.correct, &at);
        let at = self.of_transport(&graph, &vec![graph.zero(); m], &state.mu, &value[u..u + v]);
        let places = m + own.momentum() + v..self.transport.inputs();
        let moving = back(&graph, self.transport, &at, &self.landed(&state), places);
        let at = self.of_correct(&graph, &z, &state.mu, &constants);
        let weights = self.corrected(&a, &moving);
        let next = back(&graph, self.correct, &at, &weights, u..u + solved);
        let (settled, length) = own.settled(&graph, &z, &value);
        let (after, settled) = own.followed(&graph, settled, (&a, &next), &before);
        let read = [&value[u..u + v], &value[..u], &next, &constants].concat();
        let outputs = [&value[..u], &next, &after, &read, &[settled, length]].concat();
        graph.finish(from + constants.len(), &outputs)
    }

    /// g and μ after the step, λ and κ before it, the derivatives in θ.
    fn transport(&self) -> Program {
        let (own, graph) = (self.own, Graph::new());
        let (kernel, solved, n) = (&own.step.kernel, own.solved, own.dim());
        let (u, v, m) = (kernel.unknowns, kernel.solution, kernel.element);
        let mut count = m + own.momentum();
        let mut take = |more: usize| {
            count += more;
            inputs(&graph, count - more, more)
        };
        let (g, state) = (inputs(&graph, 0, m), own.state(&graph, m));
        let (x, z, a, constants) = (take(v), take(u), take(solved), take(self.constants()));
        let at = self.of_transport(&graph, &g, &state.mu, &x);
        let from = m + own.momentum();
        let changes = (m + n..from).chain(from + v..self.transport.inputs());
        let mut sums = back(&graph, self.transport, &at, &self.landed(&state), changes);
        let mut after = graph.call(self.transport, &at);
        after.truncate(m + n);
        let moving = sums.split_off(own.momentum() - n);
        let mut add = |first: usize, more: &[Id]| {
            for (sum, &more) in sums[first..].iter_mut().zip(more) {
                *sum = graph.add(*sum, more);
            }
        };
        let at = self.of_correct(&graph, &z, &state.mu, &constants);
        let first = u + solved + OF_TANGENT;
        let changes = first + 2 * n..first + own.momentum();
        let held = first + own.momentum() + constants.len()..self.correct.inputs();
        let weights = self.corrected(&a, &moving);
        let by = back(&graph, self.correct, &at, &weights, changes.clone().chain(held));
        let (by_state, by_constants) = by.split_at(changes.len());
        add(n, by_state);
        if kernel.guesses_from_element() {
            let mut at = [&g[..], &state.mu].concat();
            at.resize(self.guess.inputs(), graph.zero());
            let first = u + solved + OF_TANGENT + constants.len();
            let weights: Vec<_> = (first..).zip(by_constants.iter().copied()).collect();
            add(0, &back(&graph, self.guess, &at, &weights, m + n..self.guess.inputs()));
        }
        let (cotangent, theta) = sums.split_at(2 * n);
        let theta: Vec<Id> =
            theta.iter().zip(&state.theta).map(|(&own, &sum)| graph.add(own, sum)).collect();
        graph.finish(count, &[&after[..], cotangent, &theta].concat())
    }
}

impl Tangent {
    /// True if it has these slopes, and others perhaps, in the numbers θ, which are so many.
    pub fn is_for(&self, slopes: &[(usize, usize)], directions: usize) -> bool {
        let known = |slope| self.slopes.binary_search(slope).is_ok();
        self.directions == directions && slopes.iter().all(known)
    }

    /// Of the step of this origin, whose coefficients in these places of a flow depend on the θ of these numbers: see
    /// [`Tangent::slopes`].
    ///
    /// # Errors
    /// [`StepError`] where the group of a comoving frame has no formulas.
    pub fn new(
        step: &Step,
        origin: &Origin,
        mut slopes: Vec<(usize, usize)>,
        directions: usize,
    ) -> Result<Self, StepError> {
        slopes.sort_unstable();
        let own = Differentiation::new(step, origin, &slopes, directions);
        let programs = [own.guess(), own.correct(), own.transport()?];
        let kernel = own.kernel(programs, own.moving.len())?;
        let kernel = match (step.kernel.kick(), step.kernel.flows()) {
            (Some(kick), Some(flows)) => kernel.with_kicks(own.kick(kick), flows)?,
            _ => kernel,
        };
        Ok(Self { kernel, slopes, directions })
    }

    /// The transpose of this step: in place of (ξ, ν) a cotangent (λ, κ), of that after the step to that before it, g and μ being those before
    /// it; to the θ̇ the derivatives in θ are added. `None` with kicks, whose flows would have to be made backwards.
    ///
    /// # Errors
    /// Never, for a step of this origin.
    pub fn transpose(&self, step: &Step, origin: &Origin) -> Result<Option<Self>, StepError> {
        if step.kernel.flows().is_some() {
            return Ok(None);
        }
        let own = Differentiation::new(step, origin, &self.slopes, self.directions);
        let Programs { guess, correct, transport, .. } = &self.kernel.programs;
        let back = Transposition { own: &own, guess, correct, transport };
        let read = step.kernel.unknowns + own.solved + back.constants();
        let kernel = own.kernel([back.guess(), back.correct(), back.transport()], read)?;
        Ok(Some(Self { kernel, slopes: self.slopes.clone(), directions: self.directions }))
    }
}

impl Step {
    /// The derivatives of the coefficients of a step along a change of the parameters that are kept, in the order of
    /// [`Step::fold`].
    ///
    /// # Errors
    /// As [`Step::fold`].
    pub fn slope(
        &self,
        step: f64,
        parameters: &[f64],
        change: &[f64],
    ) -> Result<Vec<f64>, FoldError> {
        let symbols = self.symbols(parameters);
        let change: Vec<f64> =
            self.symbols.iter().map(|symbol| symbol.slope(parameters, change)).collect();
        let Some(splitting) = self.splitting else {
            let mut slots = self.fold.slope(step, &symbols, &change)?;
            slots.resize(slots.len().max(self.kernel.slots()), 0.0);
            return Ok(slots);
        };
        let flows = splitting.flows().chain(splitting.flows().next());
        let (mut all, each) = (Vec::new(), self.kernel.slots_of_flow());
        for (number, flow) in flows.enumerate() {
            all.extend(self.fold.slope(step * flow, &symbols, &change)?);
            all.resize((number + 1) * each, 0.0);
        }
        Ok(all)
    }

    /// The places among the coefficients at which a step of this size, which begins at this time, has the value of a signal: the place, the
    /// number of the signal, the time.
    pub fn sampled(&self, step: f64, time: f64) -> Vec<(usize, usize, f64)> {
        let Some(Moving { first, times, signals }) = &self.moving else { return Vec::new() };
        let flows: Vec<f64> = match self.splitting {
            Some(splitting) => splitting.flows().collect(),
            None => vec![1.0],
        };
        let (each, mut start, mut found) = (self.kernel.slots_of_flow(), time, Vec::new());
        for (flow, part) in flows.into_iter().enumerate() {
            for (at, share) in times.iter().enumerate() {
                let place = flow * each + first + at * (1 + signals.len());
                let time = share.mul_add(step * part, start);
                found.extend((0..signals.len()).map(|signal| (place + 1 + signal, signal, time)));
            }
            start += step * part;
        }
        // Of the places those that the programs read.
        found.retain(|(place, ..)| *place < self.kernel.slots());
        found
    }
}
