//! Turns an expression into programs, for Hamiltonians that are not polynomials; nothing is expanded.

use std::collections::BTreeMap;

use coadjoint_program::{Function as Elementary, Graph, Id, Program};
use num_traits::{One, ToPrimitive};

use super::coefficient::{Coefficient, Interner};
use crate::cancel;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::{Arena, ExprId, Function, Node};
use crate::problem::Symbol;

/// The largest numerator and denominator of a power.
const LARGEST_POWER: u32 = 1000;
/// The size of its argument beyond which tanh is constant to 3e-8; a large factor before it may make up for that.
const SATURATED: f64 = 9.0;
/// The scale of the exponential, which is 0 or infinite outside of these arguments.
const EXPONENTIAL: Scale = Scale::Between(-745.2, 709.8);
/// Expressions with longer texts are told apart by their ends.
const LONGEST_TEXT: usize = 80;

/// The programs of a Hamiltonian of n coordinates; [`Smooth`](crate::smooth::Smooth) says their inputs and outputs.
#[derive(Default)]
pub(super) struct Lowered {
    pub value: Program,
    pub gradient: Program,
    pub watched: Program,
    pub reach: Program,
    pub expressions: Vec<String>,
    /// The texts of expressions that have a kink, which only files may have.
    #[cfg_attr(not(feature = "system"), allow(dead_code))]
    pub kinks: Vec<String>,
    pub symbols: Vec<Symbol>,
}

/// The scale on which a function of an argument varies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    /// It varies by about itself when the argument changes by 1: waves.
    Unit,
    /// As a unit, and it is constant outside of these arguments.
    Between(f64, f64),
    /// It varies as the argument does beyond a size of about 1.
    Beyond,
    /// It varies as the argument does, with a pole or an edge where that is 0.
    Ratio,
    /// It varies as a product of this many copies of the argument.
    Products(f64),
}

impl Scale {
    /// The square of the way from an argument a to b, in these units; negative, infinite or no number where there is 0 between them.
    /// Products below a floor are as small as they vary.
    fn square(self, graph: &Graph, [a, b]: [Id; 2], floor: Id) -> Id {
        let squared = |a| graph.mul(a, a);
        let one = graph.constant(1.0);
        let way = squared(graph.sub(a, b));
        match self {
            Self::Unit => way,
            Self::Between(low, high) => {
                let [low, high] = [low, high].map(|limit| graph.constant(limit));
                let [a, b] = [a, b].map(|u| graph.max(graph.min(u, high), low));
                squared(graph.sub(a, b))
            }
            Self::Beyond => graph.div(way, graph.add(one, graph.abs(graph.mul(a, b)))),
            Self::Ratio => graph.div(way, graph.mul(a, b)),
            Self::Products(count) => {
                let size = graph.max(graph.max(squared(a), squared(b)), squared(floor));
                let share = graph.div(way, size);
                let share = graph.select(way, graph.zero(), graph.zero(), share);
                graph.mul(graph.constant(0.25 * count * count), share)
            }
        }
    }
}

/// The expressions that may have kinks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kinked {
    Nowhere,
    /// Those of the time alone, at whose kinks steps end.
    InTime,
    Anywhere,
}

/// A value on the way.
#[derive(Clone)]
enum Value {
    /// One that follows from numbers and parameters alone.
    Constant(Coefficient),
    Number(Id),
}

impl Value {
    fn as_constant(&self) -> Option<&Coefficient> {
        match self {
            Self::Constant(value) => Some(value),
            Self::Number(_) => None,
        }
    }
}

/// Lowers the expressions `roots` in coordinates, scalar parameters and inputs with these names, with the gradient of their
/// sum; `None` if something was wrong, which is then reported.
pub(super) fn lower(
    arena: &Arena,
    (roots, kinked): (&[ExprId], Kinked),
    names: [&[String]; 3],
    table: &mut Interner,
    diagnostics: &Diagnostics,
) -> Option<Lowered> {
    let uses = arena.uses(roots);
    let [coordinates, scalars, signals] = names;
    let mut pass = Pass {
        time: coordinates.len(),
        table,
        diagnostics,
        graph: Graph::new(),
        slots: BTreeMap::new(),
        watched: Vec::new(),
        scales: Vec::new(),
        kinked,
        kinks: Vec::new(),
        values: Vec::new(),
        placed: Vec::new(),
        texts: texts(arena, names),
    };
    for (id, node, span) in arena.iter() {
        let of = |id: ExprId| pass.placed[id.index()];
        let placed =
            matches!(node, Node::Coordinate(_)) || node.operands().into_iter().flatten().any(of);
        pass.placed.push(placed);
        let value = if uses[id.index()] > 0 { pass.node(id, node, span) } else { None };
        pass.values.push(value);
    }
    let roots: Option<Vec<Id>> =
        roots.iter().map(|&root| Some(pass.take(root)?).map(|root| pass.number(&root))).collect();
    let roots = roots?;
    let Pass { graph, table, slots, watched, scales, kinks, texts, .. } = pass;
    let n = coordinates.len();
    let inputs: Vec<Id> = (0..n).map(|i| graph.input(i)).collect();
    let one = graph.constant(1.0);
    let weighted: Vec<_> = roots.iter().map(|&root| (root, one)).collect();
    let gradient = graph.pull_back(&weighted, &inputs);
    let finish = |outputs: &[Id]| graph.finish(n + 1 + signals.len(), outputs);
    let pairs: Vec<Id> = watched.iter().flat_map(|&(_, argument, test)| [argument, test]).collect();
    let floors = scales.iter().map(|&(scale, u)| match scale {
        Scale::Products(_) => floor(&graph, u, &inputs),
        _ => graph.zero(),
    });
    let arguments = scales.iter().map(|&(_, u)| u).chain(floors).collect::<Vec<_>>();
    let reach = reach(&scales, &finish(&arguments));
    let mut numbered: Vec<_> = slots.into_iter().collect();
    numbered.sort_by_key(|(_, slot)| *slot);
    let symbols = numbered.into_iter().map(|(coefficient, _)| {
        let expr = table.scaled(&coefficient.factor, coefficient.product);
        let text = expr.text(scalars);
        Symbol { expr, text }
    });
    Some(Lowered {
        value: finish(&roots),
        gradient: finish(&gradient),
        watched: finish(&pairs),
        reach,
        expressions: watched.iter().map(|&(id, ..)| texts[id.index()].0.clone()).collect(),
        kinks: kinks.into_iter().map(|id| texts[id.index()].0.clone()).collect(),
        symbols: symbols.collect(),
    })
}

/// The share of the coordinates' size below which the argument of a power is small: what passes through zero has no size of its own.
const SMALL: f64 = 0.25;

/// The size below which an argument u of coordinates is small: by how much it varies when each of them does by a share of the
/// largest.
fn floor(graph: &Graph, u: Id, coordinates: &[Id]) -> Id {
    let slopes = graph.pull_back(&[(u, graph.constant(1.0))], coordinates);
    let sum = slopes.iter().fold(graph.zero(), |sum, &slope| graph.add(sum, graph.abs(slope)));
    let sizes = coordinates.iter().map(|&x| graph.abs(x));
    let largest = sizes.reduce(|a, b| graph.max(a, b)).unwrap_or_else(|| graph.zero());
    graph.mul(graph.constant(SMALL), graph.mul(sum, largest))
}

/// The largest [`Scale::square`] of arguments, by the program that computes them and then their floors, from one state to another,
/// whose inputs come one after the other. What is not positive where it is not 0 becomes infinite.
fn reach(scales: &[(Scale, Id)], arguments: &Program) -> Program {
    let graph = Graph::new();
    let count = arguments.inputs();
    let [from, to] = [0, count].map(|first| {
        let inputs: Vec<Id> = (first..first + count).map(|i| graph.input(i)).collect();
        graph.call(arguments, &inputs)
    });
    let zero = graph.zero();
    // Single precision has a place for it.
    let infinite = graph.constant(f64::from(f32::MAX));
    let mut largest = zero;
    for (i, &(scale, _)) in scales.iter().enumerate() {
        let at = |state: &[Id]| [state[i], state[scales.len() + i]];
        let ([a, floor_a], [b, floor_b]) = (at(&from), at(&to));
        let square = scale.square(&graph, [a, b], graph.max(floor_a, floor_b));
        // Not a number, too.
        let square = graph.select(zero, square, square, infinite);
        let square = graph.select(graph.abs(graph.sub(a, b)), zero, zero, square);
        largest = graph.max(largest, square);
    }
    graph.finish(2 * count, &[largest])
}

struct Pass<'a> {
    /// The number of the input that is the time.
    time: usize,
    table: &'a mut Interner,
    diagnostics: &'a Diagnostics,
    graph: Graph,
    /// The slots of constants with parameters in them.
    slots: BTreeMap<Coefficient, usize>,
    /// Expressions that may leave their domains: each with its argument, and a number that is not finite where it has.
    watched: Vec<(ExprId, Id, Id)>,
    /// The arguments of functions that vary faster than their arguments.
    scales: Vec<(Scale, Id)>,
    /// The expressions that may have kinks, and those that have one which no step ends at.
    kinked: Kinked,
    kinks: Vec<ExprId>,
    values: Vec<Option<Value>>,
    /// True for an expression that depends on coordinates, and not on the time alone.
    placed: Vec<bool>,
    texts: Vec<(String, u8)>,
}

impl Pass<'_> {
    fn take(&self, id: ExprId) -> Option<Value> {
        self.values[id.index()].clone()
    }

    fn constant(&self, span: Span, result: Result<Coefficient, Mistake>) -> Option<Value> {
        self.diagnostics.check(span, result).map(Value::Constant)
    }

    fn number(&mut self, value: &Value) -> Id {
        match value {
            Value::Number(id) => *id,
            Value::Constant(constant) => match constant.as_number() {
                Some(number) => self.graph.constant(number.to_f64().unwrap_or(f64::NAN)),
                None => {
                    let next = self.slots.len();
                    let slot = *self.slots.entry(constant.clone()).or_insert(next);
                    self.graph.slot(slot)
                }
            },
        }
    }

    fn node(&mut self, id: ExprId, node: &Node, span: Span) -> Option<Value> {
        cancel::check();
        let [Some(a), b] = node.operands() else { return self.leaf(id, node, span) };
        let a = self.take(a)?;
        let b = match b {
            Some(b) => Some(self.take(b)?),
            None => None,
        };
        let known = b.as_ref().map(Value::as_constant);
        if let (Some(a), None | Some(Some(_))) = (a.as_constant(), known) {
            let value = self.table.apply(node, a, known.flatten());
            return self.constant(span, value);
        }
        let by_constant = known.flatten().is_some();
        let b = match (node, b) {
            (Node::Pow(..), Some(b)) => return self.power(id, &a, &b, span),
            (Node::Div(..), Some(Value::Constant(b))) => {
                let inverse = self.table.power(&b, -1);
                Some(self.constant(span, inverse)?)
            }
            (_, b) => b,
        };
        let (a, b) = (self.number(&a), b.map(|b| self.number(&b)));
        Some(Value::Number(match (node, b) {
            (Node::Call(function, _), _) => self.call(id, *function, a, span)?,
            (Node::Add(..), Some(b)) => self.graph.add(a, b),
            (Node::Sub(..), Some(b)) => self.graph.sub(a, b),
            (Node::Mul(..), Some(b)) => self.graph.mul(a, b),
            (Node::Div(..), Some(b)) if by_constant => self.graph.mul(a, b),
            (Node::Div(..), Some(b)) => {
                let quotient = self.graph.div(a, b);
                let test = self.graph.div(quotient, b);
                self.watched.push((id, b, test));
                self.scales.push((Scale::Ratio, b));
                quotient
            }
            _ => self.graph.neg(a),
        }))
    }

    fn leaf(&mut self, id: ExprId, node: &Node, span: Span) -> Option<Value> {
        Some(match *node {
            Node::Number(ref value) => Value::Constant(Coefficient::number(value.clone())),
            Node::Coordinate(i) => Value::Number(self.graph.input(i)),
            Node::Parameter(i) => {
                let value = self.table.parameter(i);
                return self.constant(span, value);
            }
            Node::Time => Value::Number(self.graph.input(self.time)),
            Node::Signal(i) => {
                // Outside its table it is not finite.
                let time = self.graph.input(self.time);
                let value = self.graph.input(self.time + 1 + i);
                self.watched.push((id, time, value));
                Value::Number(value)
            }
            _ => return None,
        })
    }

    /// A function of what is no constant.
    fn call(&mut self, id: ExprId, function: Function, a: Id, span: Span) -> Option<Id> {
        let elementary = match function {
            Function::Sqrt => {
                let root = self.graph.sqrt(a);
                let one = self.graph.constant(1.0);
                let slope = self.graph.div(one, root);
                self.watched.push((id, a, slope));
                self.scales.push((Scale::Ratio, a));
                return Some(root);
            }
            Function::Abs | Function::Sign => return self.kink(id, function, a, span),
            Function::Sin => Elementary::Sin,
            Function::Cos => Elementary::Cos,
            Function::Tan => Elementary::Tan,
            Function::Atan => Elementary::Atan,
            Function::Tanh => Elementary::Tanh,
            Function::Exp => Elementary::Exp,
            Function::Ln => Elementary::Ln,
        };
        let scale = match elementary {
            Elementary::Ln => Scale::Ratio,
            Elementary::Atan => Scale::Beyond,
            Elementary::Tanh => Scale::Between(-SATURATED, SATURATED),
            Elementary::Exp => EXPONENTIAL,
            _ => Scale::Unit,
        };
        self.scales.push((scale, a));
        if elementary == Elementary::Tan {
            self.scales.push((Scale::Ratio, self.graph.function(Elementary::Cos, a)));
        }
        let value = self.graph.function(elementary, a);
        if !matches!(elementary, Elementary::Atan | Elementary::Tanh) {
            self.watched.push((id, a, value));
        }
        Some(value)
    }

    /// |a| or the sign of a, where it may have a kink.
    fn kink(&mut self, id: ExprId, function: Function, a: Id, span: Span) -> Option<Id> {
        let placed = self.placed[id.index()];
        if self.kinked == Kinked::Nowhere || self.kinked == Kinked::InTime && placed {
            let (of, help) = match placed {
                true => {
                    ("momentum", "write sqrt(a^2 + b^2) with a small b, or powers of what it is of")
                }
                false => (
                    "time",
                    "name the times of its kinks, breaks = [0.5, 1.25], so that steps end there; or give a function of the time by its \
                     values under [inputs], with hold = \"previous\" where it jumps",
                ),
            };
            let name = if function == Function::Abs { "`abs`" } else { "`sign`, `min` or `max`" };
            let message = format!("{name} of the {of} has a kink: the Hamiltonian must be smooth");
            self.diagnostics.report_other(span, &message, help);
            return None;
        }
        if self.kinked == Kinked::Anywhere {
            self.kinks.push(id);
        }
        let graph = &self.graph;
        if function == Function::Abs {
            return Some(graph.abs(a));
        }
        let [zero, one, minus] = [0.0, 1.0, -1.0].map(|value| graph.constant(value));
        let low = graph.select(zero, a, zero, minus);
        Some(graph.select(a, zero, low, one))
    }

    fn power(&mut self, id: ExprId, a: &Value, b: &Value, span: Span) -> Option<Value> {
        match (a, b.as_constant().and_then(Coefficient::as_number)) {
            (Value::Number(a), Some(power)) => {
                let within = |size: Option<u32>| size.filter(|size| *size <= LARGEST_POWER);
                let m = power.numer().to_i32().filter(|m| within(Some(m.unsigned_abs())).is_some());
                let (Some(m), Some(n)) = (m, within(power.denom().to_u32())) else {
                    let mistake = Mistake::LargePower(power.to_string(), LARGEST_POWER);
                    self.diagnostics.report(span, mistake);
                    return None;
                };
                let value = self.graph.function(Elementary::Power(m, n), *a);
                if m < 0 || !power.denom().is_one() {
                    let lower = m.saturating_sub_unsigned(n);
                    let test = self.graph.function(Elementary::Power(lower, n), *a);
                    self.watched.push((id, *a, test));
                    self.scales.push((Scale::Ratio, *a));
                } else if m > 2 {
                    self.scales.push((Scale::Products(f64::from(m - 1)), *a));
                }
                Some(Value::Number(value))
            }
            // a^b = exp(b·ln a)
            _ => {
                let logarithm = match a {
                    Value::Constant(a) => {
                        let value = self.table.call(Function::Ln, a);
                        let value = self.constant(span, value)?;
                        self.number(&value)
                    }
                    Value::Number(a) => {
                        let value = self.graph.function(Elementary::Ln, *a);
                        self.watched.push((id, *a, value));
                        self.scales.push((Scale::Ratio, *a));
                        value
                    }
                };
                let b = self.number(b);
                let product = self.graph.mul(b, logarithm);
                self.scales.push((EXPONENTIAL, product));
                Some(Value::Number(self.graph.function(Elementary::Exp, product)))
            }
        }
    }
}

/// The texts of all nodes as a user would write them, with their binding strengths; those that are too long are cut.
fn texts(arena: &Arena, [coordinates, scalars, signals]: [&[String]; 3]) -> Vec<(String, u8)> {
    let mut texts: Vec<(String, u8)> = Vec::with_capacity(arena.len());
    for (_, node, _) in arena.iter() {
        let operand = |id: ExprId, least: u8| match &texts[id.index()] {
            (text, strength) if *strength < least => format!("({text})"),
            (text, _) => text.clone(),
        };
        let name = |names: &[String], i: usize| names.get(i).cloned().unwrap_or_default();
        let binary = |a, sign: &str, b, [left, right, own]: [u8; 3]| {
            (format!("{}{sign}{}", operand(a, left), operand(b, right)), own)
        };
        let (text, strength) = match *node {
            Node::Number(ref value) if value.is_integer() => (value.to_string(), 4),
            Node::Number(ref value) => (value.to_string(), 2),
            Node::Coordinate(i) => (name(coordinates, i), 4),
            Node::Parameter(i) => (name(scalars, i), 4),
            Node::Time => ("t".to_owned(), 4),
            Node::Signal(i) => (name(signals, i), 4),
            Node::Neg(a) => (format!("-{}", operand(a, 2)), 1),
            Node::Add(a, b) => binary(a, " + ", b, [1, 1, 1]),
            Node::Sub(a, b) => binary(a, " - ", b, [1, 2, 1]),
            Node::Mul(a, b) => binary(a, "*", b, [2, 2, 2]),
            Node::Div(a, b) => binary(a, "/", b, [2, 3, 2]),
            Node::Pow(a, b) => binary(a, "^", b, [4, 4, 3]),
            Node::Call(function, a) => (format!("{}({})", function.name(), operand(a, 0)), 4),
            Node::Wrong => (String::new(), 4),
        };
        if text.chars().count() <= LONGEST_TEXT {
            texts.push((text, strength));
            continue;
        }
        let letters: Vec<char> = text.chars().collect();
        let half = LONGEST_TEXT / 2 - 3;
        let [first, last] = [&letters[..half], &letters[letters.len() - half..]];
        let cut = first.iter().chain(&[' ', '…', ' ']).chain(last).collect();
        texts.push((cut, strength));
    }
    texts
}
