//! A smooth Hamiltonian and its gradient, in double or doubled precision.
//!
//! Of the program that H was read to, its nodes alone are used, as the text of the formula: where a node is the value of a
//! function, the function of this folder takes the place of the operations that steps compute it by, and the gradient is
//! made by differentiation in reverse here. So neither the programs of gradients and functions nor their interpreter are
//! shared with the steps; the reading of H is, as it is with polynomials. So are the numbers that inputs u(t) have at
//! a time, by their spline.

use coadjoint_program::{Function, Id, Node};

use super::JudgeError;
use super::functions::elementary;
use super::linear::Real;
use crate::smooth::Smooth;

/// H(t, μ), its inputs included.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    smooth: Box<Smooth>,
    /// Marks the nodes that H needs, functions being single operations.
    needed: Vec<bool>,
    /// The functions and arguments of nodes that are functions' values.
    calls: Vec<Option<(Function, usize)>>,
}

/// A node's value, and its derivatives by other nodes.
type Entry<T> = (T, [(usize, T); 3]);

impl Expression {
    /// # Errors
    /// [`JudgeError::Given`] of a function that has no formula.
    pub(super) fn new(smooth: &Smooth) -> Result<Self, JudgeError> {
        if smooth.is_function() {
            return Err(JudgeError::Given);
        }
        let program = &smooth.value;
        let mut calls = vec![None; program.nodes().len()];
        for (value, function, a) in program.calls() {
            calls[value.index()] = Some((*function, a.index()));
        }
        let mut needed = vec![false; program.nodes().len()];
        program.outputs().iter().for_each(|output| needed[output.index()] = true);
        for (at, node) in program.nodes().iter().enumerate().rev() {
            if needed[at] {
                match calls[at] {
                    Some((_, a)) => needed[a] = true,
                    None => node.operands().for_each(|operand| needed[operand.index()] = true),
                }
            }
        }
        Ok(Self { smooth: Box::new(smooth.clone()), needed, calls })
    }

    /// ∂H/∂μ at (t, μ) for these values of the symbols; not a number where H is not defined.
    pub(super) fn gradient<T: Real>(&self, symbols: &[f64], time: T, mu: &[T]) -> Vec<T> {
        let signals = self.smooth.signals.iter().map(|u| T::from(u.at(time.double())));
        let inputs: Vec<T> = mu.iter().copied().chain([time]).chain(signals).collect();
        let nodes = self.smooth.value.nodes();
        let mut tape: Vec<Entry<T>> = Vec::with_capacity(nodes.len());
        for (at, node) in nodes.iter().enumerate() {
            let entry = match self.calls[at] {
                _ if !self.needed[at] => (T::zero(), [(0, T::zero()); 3]),
                Some((function, a)) => {
                    let [value, slope] = elementary(function, tape[a].0);
                    (value, by([(a, slope)]))
                }
                None => operation(node, &tape, &inputs, symbols),
            };
            tape.push(entry);
        }
        // ∂H/∂node for each node, from the last to the first.
        let mut change = vec![T::zero(); nodes.len()];
        for output in self.smooth.value.outputs() {
            change[output.index()] += T::one();
        }
        let mut gradient = vec![T::zero(); mu.len()];
        for (at, (value, derivatives)) in
            tape.iter().enumerate().rev().filter(|(at, _)| self.needed[*at])
        {
            let own = change[at];
            if let Node::Input(i) = nodes[at] {
                gradient.get_mut(i as usize).into_iter().for_each(|slope| *slope += own);
            }
            if value.double().is_nan() {
                return vec![*value; mu.len()];
            }
            derivatives.iter().for_each(|(operand, slope)| {
                if !slope.is_zero() {
                    change[*operand] += own * *slope;
                }
            });
        }
        gradient
    }
}

/// These derivatives and none by others.
fn by<T: Real, const N: usize>(some: [(usize, T); N]) -> [(usize, T); 3] {
    std::array::from_fn(|i| some.get(i).copied().unwrap_or((0, T::zero())))
}

/// The value and the derivatives of an operation that is no function's.
fn operation<T: Real>(node: &Node, tape: &[Entry<T>], inputs: &[T], symbols: &[f64]) -> Entry<T> {
    let at = |id: &Id| (id.index(), tape[id.index()].0);
    let one = T::one();
    match node {
        Node::Zero => (T::zero(), by([])),
        Node::Constant(bits) => (T::from(f64::from_bits(*bits)), by([])),
        Node::Input(i) => (inputs[*i as usize], by([])),
        Node::Slot(i) => (T::from(symbols[*i as usize]), by([])),
        Node::Add(a, b) => {
            let ((i, a), (j, b)) = (at(a), at(b));
            (a + b, by([(i, one), (j, one)]))
        }
        Node::Sub(a, b) => {
            let ((i, a), (j, b)) = (at(a), at(b));
            (a - b, by([(i, one), (j, -one)]))
        }
        Node::Mul(a, b) => {
            let ((i, a), (j, b)) = (at(a), at(b));
            (a * b, by([(i, b), (j, a)]))
        }
        Node::TimesPlus(a, b, c) => {
            let ((i, a), (j, b), (k, c)) = (at(a), at(b), at(c));
            (a * b + c, by([(i, b), (j, a), (k, one)]))
        }
        Node::Div(a, b) => {
            let ((i, a), (j, b)) = (at(a), at(b));
            (a / b, by([(i, one / b), (j, -(a / (b * b)))]))
        }
        Node::Neg(a) => {
            let (i, a) = at(a);
            (-a, by([(i, -one)]))
        }
        Node::Sqrt(a) => {
            let (i, a) = at(a);
            let root = a.sqrt();
            (root, by([(i, one / (root + root))]))
        }
        // Smooth formulas have no others outside functions.
        _ => (T::from(f64::NAN), by([])),
    }
}
