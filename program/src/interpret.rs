//! The interpreter: a walk through the loop of a kernel, which is the reference for all targets.

use alloc::vec;
use alloc::vec::Vec;
use core::array::from_fn;

use crate::bits::{exponent, power_of_two};
use crate::graph::{Node, Program};
use crate::kernel::{Kernel, Outcome, Stepper, WIDTH};
use crate::number::{Lanes, fused, nearest, root};
use crate::schedule::{Block, Kept, Kind, Part, Places, Statement, Test, Variable};

impl Stepper for Kernel {
    fn advance(&self, slots: &[f64], g: &mut [f64], mu: &mut [f64], steps: u64) -> Outcome {
        if self.lacks(slots, g, mu, 1) {
            return Outcome::default();
        }
        let mut walk = Walk::<1>::new(self, slots, g, mu);
        let [done] = walk.run(steps, [true]);
        walk.store(g, mu);
        Outcome { steps: done, ..walk.outcome }
    }

    fn advance_lanes(
        &self,
        slots: &[f64],
        g: &mut [f64],
        mu: &mut [f64],
        steps: u64,
        live: [bool; WIDTH],
    ) -> [u64; WIDTH] {
        if self.lacks(slots, g, mu, WIDTH) {
            return [0; WIDTH];
        }
        let mut walk = Walk::<WIDTH>::new(self, slots, g, mu);
        let done = walk.run(steps, live);
        walk.store(g, mu);
        done
    }
}

/// A step as it was solved for, accepted or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempt {
    /// p, the numbers that were solved for.
    pub unknowns: Vec<f64>,
    /// x, the increment.
    pub increment: Vec<f64>,
    /// A bound on the residual of the equation, relative to the largest coordinate of μ.
    pub residual_bound: f64,
    /// The distance of the solution from the first guess, relative to the largest coordinate of μ.
    pub distance: f64,
    /// True if the step is accepted.
    pub accepted: bool,
}

impl Kernel {
    /// The solution of the equation of the step from μ, by the interpreter; refused where numbers are missing.
    pub fn attempt(&self, slots: &[f64], mu: &[f64]) -> Attempt {
        self.attempt_at(slots, &vec![0.0; self.element], mu)
    }

    /// As [`Kernel::attempt`], from (g, μ).
    pub fn attempt_at(&self, slots: &[f64], g: &[f64], mu: &[f64]) -> Attempt {
        let mut walk = Walk::<1>::new(self, slots, g, mu);
        walk.run(1, [true]);
        let list = |variable| {
            let numbers = walk.numbers[walk.places.range(variable)].iter();
            numbers.map(|number| number.0[0]).collect()
        };
        Attempt {
            unknowns: list(Variable::Guess),
            increment: list(Variable::Increment),
            residual_bound: walk.number(Variable::ResidualBound).0[0],
            distance: walk.number(Variable::Distance).0[0],
            accepted: !walk.refused,
        }
    }

    /// The numbers of `watch` at a state.
    pub fn watch(&self, slots: &[f64], g: &[f64], mu: &[f64]) -> Vec<f64> {
        self.programs.watch.run(&[g, mu].concat(), slots)
    }
}

/// A walk through the loop by L trajectories side by side.
struct Walk<'k, const L: usize> {
    kernel: &'k Kernel,
    slots: Vec<Lanes<L>>,
    places: Places,
    /// The numbers of all variables.
    numbers: Vec<Lanes<L>>,
    /// The counts, by the number of their variables.
    counts: [[u64; L]; Variable::ALL.len()],
    /// g and μ where they are kept: at the start of the block, and of a step with kicks.
    kept: [Vec<Lanes<L>>; 2],
    /// Which trajectories move on.
    live: [bool; L],
    /// True if a step was refused.
    refused: bool,
    steps: u64,
    outcome: Outcome,
    inputs: Vec<Lanes<L>>,
    nodes: Vec<Lanes<L>>,
}

impl<'k, const L: usize> Walk<'k, L> {
    fn new(kernel: &'k Kernel, slots: &[f64], g: &[f64], mu: &[f64]) -> Self {
        let places = Places::of(kernel);
        let mut numbers = vec![Lanes::of(0.0); places.len()];
        for (variable, list) in [(Variable::Element, g), (Variable::Momentum, mu)] {
            for (i, place) in places.range(variable).enumerate() {
                numbers[place] = Lanes::load(list, i);
            }
        }
        let slot = |i: usize| Lanes::of(slots.get(i).copied().unwrap_or(f64::NAN));
        Self {
            kernel,
            slots: (0..kernel.slots()).map(slot).collect(),
            places,
            numbers,
            counts: [[0; L]; Variable::ALL.len()],
            kept: [Vec::new(), Vec::new()],
            live: [false; L],
            refused: false,
            steps: 0,
            outcome: Outcome::default(),
            inputs: Vec::new(),
            nodes: Vec::new(),
        }
    }

    fn store(&self, g: &mut [f64], mu: &mut [f64]) {
        for (variable, list) in [(Variable::Element, g), (Variable::Momentum, mu)] {
            for (i, place) in self.places.range(variable).enumerate() {
                self.numbers[place].store(list, i);
            }
        }
    }

    /// Up to `steps` steps of the trajectories that are live; the steps each made.
    fn run(&mut self, steps: u64, live: [bool; L]) -> [u64; L] {
        (self.steps, self.live) = (steps, live);
        self.block(self.kernel.schedule(), [true; L]);
        self.counts[Variable::Done as usize]
    }

    /// Runs a block in the lanes of a mask.
    fn block(&mut self, block: &Block, mask: [bool; L]) {
        for &(variable, initial) in &block.variables {
            match (variable.kind(self.kernel), initial) {
                (Kind::Count, initial) => {
                    self.counts[variable as usize] = [u64::from(initial.unwrap_or(0)); L];
                }
                (_, Some(initial)) => {
                    self.numbers[self.places.range(variable)].fill(Lanes::of(f64::from(initial)));
                }
                (_, None) => {}
            }
        }
        for statement in &block.body {
            self.statement(statement, block, mask);
        }
    }

    fn statement(&mut self, statement: &Statement, within: &Block, mask: [bool; L]) {
        match statement {
            Statement::Clock => {}
            Statement::Call(part) => self.call(*part, within, mask),
            Statement::Lengthen => {
                let both = [Variable::Distance, Variable::Moved].map(|part| self.number(part));
                let sum = Lanes::each(both, |[a, b]| a + b);
                let place = self.places.range(Variable::Distance).start;
                self.numbers[place] = self.numbers[place].update(mask, sum);
            }
            Statement::Next(count) => {
                for (count, holds) in self.counts[*count as usize].iter_mut().zip(mask) {
                    *count += u64::from(holds);
                }
            }
            Statement::Keep(which) => {
                let kept = &mut self.kept[*which as usize];
                kept.clear();
                kept.extend_from_slice(&self.numbers[self.places.state()]);
            }
            Statement::Restore(which) => {
                let state = &mut self.numbers[self.places.state()];
                for (now, &kept) in state.iter_mut().zip(&self.kept[*which as usize]) {
                    *now = now.update(mask, kept);
                }
                let count = self.counts[Variable::Count as usize];
                for lane in (0..L).filter(|&lane| *which == Kept::Block && mask[lane]) {
                    self.counts[Variable::Done as usize][lane] -= count[lane];
                }
            }
            Statement::Note => {
                let (tried, bound) =
                    (self.counts[Variable::Tried as usize], self.number(Variable::ResidualBound));
                let Outcome { corrections, residual, .. } = &mut self.outcome;
                for lane in (0..L).filter(|&lane| mask[lane]) {
                    *corrections = (*corrections).max(tried[lane] as u32);
                    if *residual < bound.0[lane] {
                        *residual = bound.0[lane];
                    }
                }
            }
            Statement::RefuseStep | Statement::RefuseState => {
                for (live, stopped) in self.live.iter_mut().zip(mask) {
                    *live &= !stopped;
                }
                self.refused |= *statement == Statement::RefuseStep;
            }
            Statement::While(condition, block) => {
                let mut lanes = self.holds(condition, mask);
                while lanes.contains(&true) {
                    self.block(block, lanes);
                    lanes = self.holds(condition, lanes);
                }
            }
            Statement::If(condition, block) => {
                let lanes = self.holds(condition, mask);
                if lanes.contains(&true) {
                    self.block(block, lanes);
                }
            }
        }
    }

    /// Evaluates a program on its variables and assigns its results in the lanes of a mask.
    fn call(&mut self, part: Part, within: &Block, mask: [bool; L]) {
        let Some(program) = part.program(self.kernel) else { return };
        let (inputs, outputs) = part.variables(self.kernel);
        self.inputs.clear();
        for &input in inputs {
            match input.kind(self.kernel) {
                Kind::Count => {
                    let count = self.counts[input as usize].map(|count| count as f64);
                    self.inputs.push(Lanes(count));
                }
                _ => self.inputs.extend_from_slice(&self.numbers[self.places.range(input)]),
            }
        }
        // Trajectories that were refused are flows behind.
        let flow = self.counts[Variable::Flow as usize].into_iter().max();
        let flow = flow.filter(|_| part.is_of_flow()).unwrap_or(0);
        let slots = self.slots.get(flow as usize * self.kernel.slots_of_flow()..);
        let (inputs, slots) = (&self.inputs, slots.unwrap_or_default());
        evaluate(program, |i| inputs[i], |i| slots[i], &mut self.nodes);
        let mut results = program.outputs().iter().map(|id| self.nodes[id.index()]);
        for &output in outputs {
            let own = within.owns(output);
            for (number, new) in
                self.numbers[self.places.range(output)].iter_mut().zip(results.by_ref())
            {
                *number = if own { new } else { number.update(mask, new) };
            }
        }
    }

    /// The lanes of a mask in which a condition holds.
    fn holds(&self, condition: &[(bool, Test)], mask: [bool; L]) -> [bool; L] {
        let bound = self.number(Variable::ResidualBound);
        let distance = self.number(Variable::Distance);
        let right = self.number(Variable::Right);
        let done = self.counts[Variable::Done as usize];
        from_fn(|lane| {
            let test = |&(holds, test): &(bool, Test)| {
                holds
                    == match test {
                        Test::Live => self.live[lane],
                        Test::Remaining => done[lane] < self.steps,
                        Test::Below(count, most) => {
                            self.counts[count as usize][lane] < u64::from(most)
                        }
                        Test::Open => {
                            let solved = bound.0[lane] <= self.kernel.tolerance;
                            !solved && distance.0[lane] <= self.kernel.near
                        }
                        Test::Right => right.0[lane] == 1.0,
                    }
            };
            mask[lane] && condition.iter().all(test)
        })
    }

    fn number(&self, variable: Variable) -> Lanes<L> {
        self.numbers[self.places.range(variable).start]
    }
}

/// [`Program::evaluate`], compiled for this processor.
///
/// A fused product is one instruction on every processor of the last ten years, but on x86-64 a program compiled for
/// all of them calls a function for it. Here the evaluation is compiled once more with the instructions of AVX2
/// and FMA, and taken where the processor has them; the bits are the same.
fn evaluate<const L: usize>(
    program: &Program,
    input: impl Fn(usize) -> Lanes<L>,
    slot: impl Fn(usize) -> Lanes<L>,
    nodes: &mut Vec<Lanes<L>>,
) {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has both features, as was just asked.
        #[allow(unsafe_code)]
        return unsafe { evaluate_fma(program, input, slot, nodes) };
    }
    program.evaluate(input, slot, nodes);
}

/// Evaluates with fused products as instructions. Only a processor with AVX2 and FMA can run it.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn evaluate_fma<const L: usize>(
    program: &Program,
    input: impl Fn(usize) -> Lanes<L>,
    slot: impl Fn(usize) -> Lanes<L>,
    nodes: &mut Vec<Lanes<L>>,
) {
    program.evaluate(input, slot, nodes);
}

impl Program {
    /// Evaluates every node into `scratch`, where [`Program::outputs`] then point; `input` and `slot` give inputs and
    /// folded coefficients by number. `scratch` is reused between calls and does not shrink.
    ///
    /// Always inlined, so that lanes get the instruction set of the caller.
    #[inline(always)]
    fn evaluate<const L: usize>(
        &self,
        input: impl Fn(usize) -> Lanes<L>,
        slot: impl Fn(usize) -> Lanes<L>,
        scratch: &mut Vec<Lanes<L>>,
    ) {
        scratch.clear();
        scratch.reserve(self.nodes().len());
        for node in self.nodes() {
            let at = |id: crate::Id| scratch[id.index()];
            let value = match *node {
                Node::Zero => Lanes::of(0.0),
                Node::Constant(bits) => Lanes::of(f64::from_bits(bits)),
                Node::Epsilon => Lanes::of(f64::EPSILON),
                Node::Input(i) => input(i as usize),
                Node::Slot(i) => slot(i as usize),
                Node::Add(a, b) => Lanes::each([at(a), at(b)], |[a, b]| a + b),
                Node::Sub(a, b) => Lanes::each([at(a), at(b)], |[a, b]| a - b),
                Node::Mul(a, b) => Lanes::each([at(a), at(b)], |[a, b]| a * b),
                Node::TimesPlus(a, b, c) => {
                    Lanes::each([at(a), at(b), at(c)], |[a, b, c]| fused(a, b, c))
                }
                Node::Div(a, b) => Lanes::each([at(a), at(b)], |[a, b]| a / b),
                Node::Neg(a) => Lanes::each([at(a)], |[a]| -a),
                Node::Abs(a) => Lanes::each([at(a)], |[a]| a.abs()),
                Node::Sqrt(a) => Lanes::each([at(a)], |[a]| root(a)),
                Node::Round(a) => Lanes::each([at(a)], |[a]| nearest(a)),
                Node::Scale(a, k) => Lanes::each([at(a), at(k)], |[a, k]| a * power_of_two(k)),
                Node::Exponent(a) => Lanes::each([at(a)], |[a]| exponent(a)),
                Node::Select(a, b, c, d) => Lanes::each(
                    [at(a), at(b), at(c), at(d)],
                    |[a, b, c, d]| if a <= b { c } else { d },
                ),
            };
            scratch.push(value);
        }
    }

    /// The results of the program on `inputs` with these folded coefficients. Missing inputs and slots read as NaN.
    pub fn run(&self, inputs: &[f64], slots: &[f64]) -> Vec<f64> {
        let input = |i: usize| [inputs.get(i).copied().unwrap_or(f64::NAN)];
        Evaluation::new(self, slots).run(input).results().map(|[result]| result).collect()
    }

    /// The results of [`Program::run`] for each of these lists of inputs, which are evaluated [`WIDTH`] side by side.
    pub fn run_rows(&self, rows: &[impl AsRef<[f64]>], slots: &[f64]) -> Vec<Vec<f64>> {
        let input = |row: usize, i: usize| rows[row].as_ref().get(i).copied().unwrap_or(f64::NAN);
        let results = self.run_each(rows.len(), input, slots);
        let width = self.outputs().len();
        (0..rows.len()).map(|row| results[row * width..][..width].to_vec()).collect()
    }

    /// The results for this number of rows, one after the other: `input` gives number i of a row.
    pub fn run_each(
        &self,
        rows: usize,
        input: impl Fn(usize, usize) -> f64,
        slots: &[f64],
    ) -> Vec<f64> {
        match rows {
            1 => self.run_beside::<1>(rows, input, slots),
            2 => self.run_beside::<2>(rows, input, slots),
            _ => self.run_beside::<WIDTH>(rows, input, slots),
        }
    }

    /// The results of [`Program::run_each`], L rows side by side.
    fn run_beside<const L: usize>(
        &self,
        rows: usize,
        input: impl Fn(usize, usize) -> f64,
        slots: &[f64],
    ) -> Vec<f64> {
        let (width, mut evaluation) = (self.outputs().len(), Evaluation::<L>::new(self, slots));
        let mut results = vec![0.0; rows * width];
        for first in (0..rows).step_by(L) {
            // Lanes without a row have the numbers of the last one.
            let number = |lane: usize, i| input((first + lane).min(rows - 1), i);
            let found = evaluation.run(|i| from_fn(|lane| number(lane, i)));
            for (at, own) in found.results().enumerate() {
                for (row, result) in (first..rows).zip(own) {
                    results[row * width + at] = result;
                }
            }
        }
        results
    }
}

/// Evaluates a program for many rows, L side by side, in memory that is used again.
#[derive(Debug)]
pub struct Evaluation<'p, const L: usize> {
    program: &'p Program,
    slots: &'p [f64],
    nodes: Vec<Lanes<L>>,
}

impl<'p, const L: usize> Evaluation<'p, L> {
    /// With these folded coefficients; missing ones read as NaN.
    pub fn new(program: &'p Program, slots: &'p [f64]) -> Self {
        Self { program, slots, nodes: Vec::new() }
    }

    /// Evaluates it for rows of which `input` gives number i.
    pub fn run(&mut self, input: impl Fn(usize) -> [f64; L]) -> &Self {
        let Self { program, slots, nodes } = self;
        let slot = |i: usize| Lanes::of(slots.get(i).copied().unwrap_or(f64::NAN));
        evaluate(program, |i| Lanes(input(i)), slot, nodes);
        self
    }

    /// The results of the rows that it was evaluated for last.
    pub fn results(&self) -> impl Iterator<Item = [f64; L]> {
        self.program.outputs().iter().map(|id| self.nodes[id.index()].0)
    }
}
