//! From an expression to programs, for Hamiltonians that are no polynomials: nothing is expanded.

use std::collections::BTreeMap;

use coadjoint_program::{Function as Elementary, Graph, Id, Program};
use num_traits::{One, ToPrimitive};

use super::coefficient::{Coefficient, Table};
use crate::cancel;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::{Arena, ExprId, Function, Node};
use crate::problem::Symbol;

/// The largest numerator and denominator of a power.
const LARGEST_POWER: u32 = 1000;
/// Expressions with longer texts are told apart by their ends.
const LONGEST_TEXT: usize = 80;

/// The programs of a Hamiltonian of n coordinates; [`Smooth`](crate::smooth::Smooth) says their inputs and outputs.
#[derive(Default)]
pub(super) struct Lowered {
    pub value: Program,
    pub gradient: Program,
    pub watched: Program,
    pub expressions: Vec<String>,
    pub symbols: Vec<Symbol>,
}

/// A value on the way.
#[derive(Clone)]
enum Value {
    /// One that follows from numbers and parameters alone.
    Constant(Coefficient),
    Number(Id),
}

/// Lowers the expressions `roots` in coordinates, scalar parameters and inputs with these names, with the gradient of their
/// sum; `None` if something was wrong, which is then reported.
pub(super) fn lower(
    arena: &Arena,
    roots: &[ExprId],
    names: [&[String]; 3],
    table: &mut Table,
    diagnostics: &Diagnostics,
) -> Option<Lowered> {
    let needed = needed(arena, roots);
    let [coordinates, scalars, signals] = names;
    let mut pass = Pass {
        time: coordinates.len(),
        table,
        diagnostics,
        graph: Graph::new(),
        slots: BTreeMap::new(),
        watched: Vec::new(),
        values: Vec::new(),
        texts: texts(arena, names),
    };
    for (id, node, span) in arena.iter() {
        let value = if needed[id.index()] { pass.node(id, node, span) } else { None };
        pass.values.push(value);
    }
    let roots: Option<Vec<Id>> =
        roots.iter().map(|&root| Some(pass.take(root)?).map(|root| pass.number(&root))).collect();
    let roots = roots?;
    let Pass { graph, table, slots, watched, texts, .. } = pass;
    let n = coordinates.len();
    let inputs: Vec<Id> = (0..n).map(|i| graph.input(i)).collect();
    let one = graph.constant(1.0);
    let weighted: Vec<_> = roots.iter().map(|&root| (root, one)).collect();
    let gradient = graph.pull_back(&weighted, &inputs);
    let finish = |outputs: &[Id]| graph.finish(n + 1 + signals.len(), outputs);
    let pairs: Vec<Id> = watched.iter().flat_map(|&(_, argument, test)| [argument, test]).collect();
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
        expressions: watched.iter().map(|&(id, ..)| texts[id.index()].0.clone()).collect(),
        symbols: symbols.collect(),
    })
}

/// Which nodes these are made of.
fn needed(arena: &Arena, roots: &[ExprId]) -> Vec<bool> {
    let mut needed = vec![false; arena.len()];
    roots.iter().for_each(|root| needed[root.index()] = true);
    let nodes: Vec<_> = arena.iter().collect();
    for (id, node, _) in nodes.into_iter().rev() {
        if needed[id.index()] {
            node.operands().into_iter().flatten().for_each(|id| needed[id.index()] = true);
        }
    }
    needed
}

struct Pass<'a> {
    /// The number of the input that is the time.
    time: usize,
    table: &'a mut Table,
    diagnostics: &'a Diagnostics,
    graph: Graph,
    /// The slots of constants with parameters in them.
    slots: BTreeMap<Coefficient, usize>,
    /// Expressions that may leave their domains: each with its argument, and a number that is not finite where it has.
    watched: Vec<(ExprId, Id, Id)>,
    values: Vec<Option<Value>>,
    texts: Vec<(String, u8)>,
}

impl Pass<'_> {
    fn take(&self, id: ExprId) -> Option<Value> {
        self.values[id.index()].clone()
    }

    fn constant(&self, span: Span, result: Result<Coefficient, Mistake>) -> Option<Value> {
        self.diagnostics.check(span, result).map(Value::Constant)
    }

    /// A value as a node of the graph.
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

    fn numbers(&mut self, a: &Value, b: &Value) -> [Id; 2] {
        [self.number(a), self.number(b)]
    }

    fn node(&mut self, id: ExprId, node: &Node, span: Span) -> Option<Value> {
        use Value::{Constant, Number};
        cancel::check();
        Some(match *node {
            Node::Wrong => return None,
            Node::Number(ref value) => Constant(Coefficient::number(value.clone())),
            Node::Coordinate(i) => Number(self.graph.input(i)),
            Node::Parameter(i) => {
                let value = self.table.parameter(i);
                return self.constant(span, value);
            }
            Node::Time => Number(self.graph.input(self.time)),
            Node::Signal(i) => {
                // Outside its table it is not finite.
                let time = self.graph.input(self.time);
                let value = self.graph.input(self.time + 1 + i);
                self.watched.push((id, time, value));
                Number(value)
            }
            Node::Neg(a) => match self.take(a)? {
                Constant(mut a) => {
                    a.negate();
                    Constant(a)
                }
                Number(a) => Number(self.graph.neg(a)),
            },
            Node::Add(a, b) => match (self.take(a)?, self.take(b)?) {
                (Constant(a), Constant(b)) => {
                    let sum = self.table.add(&a, &b);
                    return self.constant(span, sum);
                }
                (a, b) => {
                    let [a, b] = self.numbers(&a, &b);
                    Number(self.graph.add(a, b))
                }
            },
            Node::Sub(a, b) => match (self.take(a)?, self.take(b)?) {
                (Constant(a), Constant(mut b)) => {
                    b.negate();
                    let sum = self.table.add(&a, &b);
                    return self.constant(span, sum);
                }
                (a, b) => {
                    let [a, b] = self.numbers(&a, &b);
                    Number(self.graph.sub(a, b))
                }
            },
            Node::Mul(a, b) => match (self.take(a)?, self.take(b)?) {
                (Constant(a), Constant(b)) => {
                    let product = self.table.multiply(&a, &b);
                    return self.constant(span, product);
                }
                (a, b) => {
                    let [a, b] = self.numbers(&a, &b);
                    Number(self.graph.mul(a, b))
                }
            },
            Node::Div(a, b) => {
                let (a, b) = (self.take(a)?, self.take(b)?);
                let Constant(divisor) = b else {
                    let [a, b] = self.numbers(&a, &b);
                    let quotient = self.graph.div(a, b);
                    let test = self.graph.div(quotient, b);
                    self.watched.push((id, b, test));
                    return Some(Number(quotient));
                };
                let inverse = self.table.power(&divisor, -1);
                let inverse = self.diagnostics.check(span, inverse)?;
                match a {
                    Constant(a) => {
                        let product = self.table.multiply(&a, &inverse);
                        return self.constant(span, product);
                    }
                    Number(a) => {
                        let inverse = self.number(&Constant(inverse));
                        Number(self.graph.mul(a, inverse))
                    }
                }
            }
            Node::Pow(a, b) => {
                let (a, b) = (self.take(a)?, self.take(b)?);
                return self.power(id, &a, &b, span);
            }
            Node::Call(function, a) => match self.take(a)? {
                Constant(a) => {
                    let value = self.table.call(function, &a);
                    return self.constant(span, value);
                }
                Number(a) => Number(self.call(id, function, a, span)?),
            },
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
                return Some(root);
            }
            Function::Abs => {
                let help = "write sqrt(a^2 + b^2) with a small b, or powers of what it is of";
                let message = "`abs` of the momentum has a kink: the Hamiltonian must be smooth";
                self.diagnostics.report_other(span, message, help);
                return None;
            }
            Function::Sin => Elementary::Sin,
            Function::Cos => Elementary::Cos,
            Function::Tan => Elementary::Tan,
            Function::Atan => Elementary::Atan,
            Function::Tanh => Elementary::Tanh,
            Function::Exp => Elementary::Exp,
            Function::Ln => Elementary::Ln,
        };
        let value = self.graph.function(elementary, a);
        if !matches!(elementary, Elementary::Atan | Elementary::Tanh) {
            self.watched.push((id, a, value));
        }
        Some(value)
    }

    fn power(&mut self, id: ExprId, a: &Value, b: &Value, span: Span) -> Option<Value> {
        let known = match b {
            Value::Constant(power) => power.as_number().cloned(),
            Value::Number(_) => None,
        };
        match (a, b, known) {
            (Value::Constant(a), Value::Constant(power), known) => {
                let whole = known.filter(|known| known.is_integer());
                let value = match whole.as_ref().map(|whole| whole.numer().to_i64()) {
                    Some(Some(n)) => self.table.power(a, n),
                    Some(None) => Err(Mistake::LargePower("…".to_owned(), LARGEST_POWER)),
                    None => self.table.root(a, power),
                };
                self.constant(span, value)
            }
            (Value::Number(a), _, Some(power)) => {
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
                        value
                    }
                };
                let b = self.number(b);
                let product = self.graph.mul(b, logarithm);
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
