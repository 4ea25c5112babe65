//! Derivatives: from programs to programs.
//!
//! The passes work on the nodes of a graph, so a derivative shares what the value computes already. A function that is a
//! straight-line program is differentiated by its rule, not through the polynomials that compute it. Whole numbers (the
//! nearest one, an exponent) and comparisons have the derivative 0.

use alloc::vec;
use alloc::vec::Vec;

use crate::graph::{Function, Graph, Id, Node, Program};

/// A number that a program is differentiated in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Argument {
    /// Input number i.
    Input(usize),
    /// Folded coefficient number i.
    Slot(usize),
}

impl Graph {
    /// Marks the nodes that depend on one of these.
    fn dependent(&self, on: impl Iterator<Item = Id>) -> Vec<bool> {
        let mut dependent = vec![false; self.mark()];
        on.for_each(|id| dependent[id.index()] = true);
        for index in 0..dependent.len() {
            let node = self.node(Id(index as u32));
            dependent[index] |= node.operands().any(|operand| dependent[operand.index()]);
        }
        dependent
    }

    /// The derivative of the node `y` in its operands, as many as it has, each as a factor of what is on its side: 0
    /// where there is none.
    fn slopes(&self, y: Id) -> Vec<(Id, Slope)> {
        if let Some((function, a)) = self.called(y) {
            return vec![(a, Slope::Times(self.slope(function, a, y)))];
        }
        match self.node(y) {
            Node::Add(a, b) => vec![(a, Slope::One), (b, Slope::One)],
            Node::Sub(a, b) => vec![(a, Slope::One), (b, Slope::Less)],
            Node::Mul(a, b) => vec![(a, Slope::Times(b)), (b, Slope::Times(a))],
            Node::TimesPlus(a, b, c) => {
                vec![(a, Slope::Times(b)), (b, Slope::Times(a)), (c, Slope::One)]
            }
            Node::Div(a, b) => {
                let less = self.neg(y);
                vec![(a, Slope::Over(b)), (b, Slope::TimesOver(less, b))]
            }
            Node::Neg(a) => vec![(a, Slope::Less)],
            Node::Sqrt(a) => {
                vec![(a, Slope::TimesOver(self.constant(0.5), y))]
            }
            Node::Abs(a) => vec![(a, Slope::Sign(a))],
            Node::Scale(a, k) => vec![(a, Slope::Scaled(k))],
            Node::Select(a, b, c, d) => vec![(c, Slope::Where(a, b)), (d, Slope::Unless(a, b))],
            Node::Zero
            | Node::Constant(_)
            | Node::Epsilon
            | Node::Input(_)
            | Node::Slot(_)
            | Node::Round(_)
            | Node::Exponent(_) => Vec::new(),
        }
    }

    /// The derivative of a function whose value at a is y.
    fn slope(&self, function: Function, a: Id, y: Id) -> Id {
        let one = self.constant(1.0);
        match function {
            Function::Exp => y,
            // Not a number where the logarithm is none.
            Function::Ln => self.div(one, self.positive(a)),
            Function::Sin => self.function(Function::Cos, a),
            Function::Cos => self.neg(self.function(Function::Sin, a)),
            Function::Tan => self.times_plus(y, y, one),
            Function::Atan => self.div(one, self.times_plus(a, a, one)),
            Function::Tanh => self.times_plus(self.neg(y), y, one),
            Function::Power(m, n) => {
                let exponent = self.constant(f64::from(m) / f64::from(n));
                let lower = m.saturating_sub_unsigned(n);
                self.mul(exponent, self.function(Function::Power(lower, n), a))
            }
        }
    }

    /// v times a slope, and that added to `sum`.
    fn along(&self, v: Id, slope: Slope, sum: Option<Id>) -> Id {
        let zero = self.zero();
        let term = match slope {
            Slope::One => v,
            Slope::Less => self.neg(v),
            Slope::Times(factor) => {
                return self.times_plus(v, factor, sum.unwrap_or(zero));
            }
            Slope::Over(divisor) => self.div(v, divisor),
            Slope::TimesOver(factor, divisor) => {
                return self.times_plus(self.div(v, divisor), factor, sum.unwrap_or(zero));
            }
            Slope::Sign(of) => self.select(zero, of, v, self.neg(v)),
            Slope::Scaled(exponent) => self.scale(v, exponent),
            Slope::Where(a, b) => self.select(a, b, v, zero),
            Slope::Unless(a, b) => self.select(a, b, zero, v),
        };
        sum.map_or(term, |sum| self.add(sum, term))
    }

    /// Σⱼ wⱼ ∂yⱼ/∂xᵢ for each xᵢ, by reverse mode: `outputs` are the (yⱼ, wⱼ), `variables` the xᵢ.
    pub fn pull_back(&self, outputs: &[(Id, Id)], variables: &[Id]) -> Vec<Id> {
        let dependent = self.dependent(variables.iter().copied());
        let mut sums: Vec<Option<Id>> = vec![None; dependent.len()];
        for &(output, weight) in outputs {
            let sum = &mut sums[output.index()];
            *sum = Some(sum.map_or(weight, |sum| self.add(sum, weight)));
        }
        for index in (0..dependent.len()).rev() {
            let id = Id(index as u32);
            let Some(sum) = sums[index].filter(|_| !variables.contains(&id)) else { continue };
            if dependent[index] {
                for (operand, slope) in self.slopes(id) {
                    if dependent[operand.index()] {
                        let before = sums[operand.index()];
                        sums[operand.index()] = Some(self.along(sum, slope, before));
                    }
                }
            }
        }
        let zero = self.zero();
        variables.iter().map(|variable| sums[variable.index()].unwrap_or(zero)).collect()
    }

    /// Σᵢ ∂yⱼ/∂xᵢ vᵢ for each yⱼ, by forward mode: `variables` are the (xᵢ, vᵢ), `outputs` the yⱼ.
    fn push_forward(&self, outputs: &[Id], variables: &[(Id, Id)]) -> Vec<Id> {
        let dependent = self.dependent(variables.iter().map(|&(variable, _)| variable));
        let mut tangents: Vec<Option<Id>> = vec![None; dependent.len()];
        for &(variable, direction) in variables {
            tangents[variable.index()] = Some(direction);
        }
        let last = outputs.iter().map(|output| output.index() + 1).max().unwrap_or(0);
        let needed = self.needed(outputs);
        for index in 0..last {
            if !dependent[index] || !needed[index] || tangents[index].is_some() {
                continue;
            }
            let mut tangent = None;
            for (operand, slope) in self.slopes(Id(index as u32)) {
                if let Some(direction) = tangents[operand.index()] {
                    tangent = Some(self.along(direction, slope, tangent));
                }
            }
            tangents[index] = tangent;
        }
        let zero = self.zero();
        outputs.iter().map(|output| tangents[output.index()].unwrap_or(zero)).collect()
    }

    fn arguments(&self, of: &[Argument]) -> Vec<Id> {
        let argument = |argument: &Argument| match *argument {
            Argument::Input(i) => self.input(i),
            Argument::Slot(i) => self.slot(i),
        };
        of.iter().map(argument).collect()
    }
}

/// The factor beside a derivative: x̄ = ȳ·∂y/∂x backwards, ẏ = ∂y/∂x·ẋ forwards.
#[derive(Clone, Copy)]
enum Slope {
    /// 1
    One,
    /// −1
    Less,
    Times(Id),
    /// 1 over this.
    Over(Id),
    /// The first over the second.
    TimesOver(Id, Id),
    /// The sign of this.
    Sign(Id),
    /// 2 to the power of this.
    Scaled(Id),
    /// 1 where the first is at most the second, else 0.
    Where(Id, Id),
    /// 0 where the first is at most the second, else 1.
    Unless(Id, Id),
}

impl Program {
    /// The gradient of the first output in these arguments, by reverse mode: a program of the same inputs and slots.
    pub fn gradient(&self, of: &[Argument]) -> Self {
        let graph = Graph::new();
        let inputs: Vec<Id> = (0..self.inputs()).map(|i| graph.input(i)).collect();
        let (arguments, outputs) = (graph.arguments(of), graph.call(self, &inputs));
        let one = graph.constant(1.0);
        let weights: Vec<_> = outputs.first().map(|&output| (output, one)).into_iter().collect();
        graph.finish(self.inputs(), &graph.pull_back(&weights, &arguments))
    }

    /// J·v by forward mode, J being the derivative of all outputs in these arguments: a program whose inputs are those
    /// of this one and v, a number for each argument. Of the [gradient](Self::gradient) it is the Hessian's product with
    /// v.
    pub fn push_forward(&self, of: &[Argument]) -> Self {
        let graph = Graph::new();
        let inputs: Vec<Id> = (0..self.inputs()).map(|i| graph.input(i)).collect();
        let arguments = graph.arguments(of);
        let outputs = graph.call(self, &inputs);
        let directions = (0..of.len()).map(|i| graph.input(self.inputs() + i));
        let variables: Vec<_> = arguments.into_iter().zip(directions.collect::<Vec<_>>()).collect();
        let results = graph.push_forward(&outputs, &variables);
        graph.finish(self.inputs() + of.len(), &results)
    }
}
