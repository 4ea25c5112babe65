//! The values of a function's variables while it is read, and what can be computed with them.

use std::rc::Rc;

use syn::{ExprMethodCall, GenericArgument};

use crate::diagnostic::{Mistake, Span, nearest};
use crate::expr::{ExprId, Function, Node};
use crate::number::{Rational, integer};
use crate::parse::rust::evaluate::{Callable, Evaluator};
use crate::parse::rust::signature::length;
use crate::parse::vectors;

/// A value of the function's world.
#[derive(Clone)]
pub(super) enum Value {
    Number(ExprId),
    /// An integer, known.
    Integer(i128),
    /// A truth value, known.
    Bool(bool),
    List(Aggregate),
    /// A closure or a function of the body.
    Function(Rc<Callable>),
    Unit,
    /// Something wrong that has been reported.
    Wrong,
}

/// An array, a tuple, an iterator, or a matrix of nalgebra. Copies share their entries.
#[derive(Clone)]
pub(super) struct Aggregate {
    /// Those of a matrix column by column, as nalgebra has them.
    pub entries: Rc<Vec<Value>>,
    /// The rows and columns of a matrix; one of a single column is a vector.
    pub shape: Option<(usize, usize)>,
}

impl Aggregate {
    /// What becomes of the entries, in the same shape.
    fn map(&self, of: impl FnMut(Value) -> Value) -> Value {
        let entries = Rc::new(self.entries.iter().cloned().map(of).collect());
        Value::List(Self { entries, shape: self.shape })
    }

    /// The place of the entry named by an index.
    pub(super) fn position(&self, index: &[usize]) -> Option<usize> {
        match (self.shape, index) {
            (_, &[at]) => (at < self.entries.len()).then_some(at),
            (Some((rows, columns)), &[i, j]) => (i < rows && j < columns).then_some(i + j * rows),
            _ => None,
        }
    }
}

impl Value {
    pub(super) fn list(entries: impl IntoIterator<Item = Value>) -> Self {
        Self::List(Aggregate { entries: Rc::new(entries.into_iter().collect()), shape: None })
    }

    /// A matrix with these entries, row by row.
    pub(super) fn matrix(rows: usize, columns: usize, entries: Vec<Value>) -> Self {
        let by_columns = (0..columns).flat_map(|j| entries.iter().skip(j).step_by(columns));
        let entries = Rc::new(by_columns.cloned().collect());
        Self::List(Aggregate { entries, shape: Some((rows, columns)) })
    }

    /// True if something of it is wrong.
    pub(super) fn is_wrong(&self) -> bool {
        match self {
            Self::List(list) => list.entries.iter().any(Self::is_wrong),
            value => matches!(value, Self::Wrong),
        }
    }

    /// The numbers of a list of nothing else.
    pub(super) fn numbers(&self) -> Option<Vec<ExprId>> {
        let Self::List(list) = self else { return None };
        let number = |entry: &Self| match entry {
            Self::Number(id) => Some(*id),
            _ => None,
        };
        list.entries.iter().map(number).collect()
    }

    /// A description for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Integer(_) => "an integer",
            Self::Bool(_) => "a truth value",
            Self::List(Aggregate { shape: None, .. }) => "an array",
            Self::List(Aggregate { shape: Some((_, 1)), .. }) => "a vector",
            Self::List(_) => "a matrix",
            Self::Function(_) => "a function",
            Self::Unit => "nothing",
            Self::Wrong => "a mistake",
        }
    }
}

const KNOWN: &str = "powi, powf, mul_add, sqrt, sin, cos, tan, atan, tanh, exp, ln, abs, recip, dot, cross, norm_squared, norm, \
    component_mul, component_div, fixed_rows, sum, len, iter, map, zip, enumerate, rev, fold";

impl Evaluator<'_> {
    /// An operation named by its sign.
    pub(super) fn operate(&mut self, sign: &str, a: Value, b: Value, span: Span) -> Value {
        match (a, b) {
            (Value::Wrong, _) | (_, Value::Wrong) => Value::Wrong,
            (Value::Integer(a), Value::Integer(b)) => {
                let value = match sign {
                    "+" => a.checked_add(b),
                    "-" => a.checked_sub(b),
                    "*" => a.checked_mul(b),
                    "/" => a.checked_div(b),
                    "%" => a.checked_rem(b),
                    "==" => return Value::Bool(a == b),
                    "!=" => return Value::Bool(a != b),
                    "<" => return Value::Bool(a < b),
                    "<=" => return Value::Bool(a <= b),
                    ">" => return Value::Bool(a > b),
                    ">=" => return Value::Bool(a >= b),
                    _ => None,
                };
                let Some(value) = value else {
                    return self.unsupported(span, "this integer operation overflows", "");
                };
                Value::Integer(value)
            }
            _ if matches!(sign, "==" | "!=" | "<" | "<=" | ">" | ">=") => {
                let message = "a comparison must not depend on an argument: the function must be one expression, the same \
                               everywhere";
                let help = "compare integers known beforehand only, such as loop variables";
                self.unsupported(span, message, help)
            }
            (Value::Number(a), Value::Number(b)) if matches!(sign, "+" | "-" | "*" | "/") => {
                let node = match sign {
                    "+" => Node::Add,
                    "-" => Node::Sub,
                    "*" => Node::Mul,
                    _ => Node::Div,
                };
                self.push(node(a, b), span)
            }
            (s @ Value::Number(_), Value::List(v)) if v.shape.is_some() && sign == "*" => {
                v.map(|x| self.operate(sign, s.clone(), x, span))
            }
            (Value::List(v), s @ Value::Number(_))
                if v.shape.is_some() && matches!(sign, "*" | "/") =>
            {
                v.map(|x| self.operate(sign, x, s.clone(), span))
            }
            (Value::List(Aggregate { entries: a, shape: Some((rows, inner)) }), Value::List(b))
                if sign == "*" && b.shape.is_some_and(|(other, _)| inner == other) =>
            {
                let row = |i| a.iter().skip(i).step_by(rows).cloned().collect();
                let lines: Vec<Vec<Value>> = (0..rows).map(row).collect();
                let columns = b.entries.chunks(inner);
                let pairs = columns.flat_map(|column| lines.iter().map(move |row| (row, column)));
                let entries: Vec<Value> =
                    pairs.map(|(row, column)| self.dot(row, column, span)).collect();
                let shape = Some((rows, entries.len() / rows));
                Value::List(Aggregate { entries: Rc::new(entries), shape })
            }
            (Value::List(a), Value::List(b))
                if a.shape.is_some() && a.shape == b.shape && matches!(sign, "+" | "-") =>
            {
                self.entrywise(sign, &a, &b, span)
            }
            (a, b) => {
                let message = format!("`{sign}` of {} and {} is not read", a.kind(), b.kind());
                self.unsupported(span, &message, "write it out in coordinates")
            }
        }
    }

    fn entrywise(&mut self, sign: &str, a: &Aggregate, b: &Aggregate, span: Span) -> Value {
        let mut others = b.entries.iter().cloned();
        a.map(|x| self.operate(sign, x, others.next().unwrap_or(Value::Wrong), span))
    }

    pub(super) fn negate(&mut self, value: Value, span: Span) -> Value {
        match value {
            Value::Number(a) => self.push(Node::Neg(a), span),
            Value::List(v) if v.shape.is_some() => v.map(|entry| self.negate(entry, span)),
            // Integers are subtracted; other values have no negative, which is reported.
            other => self.operate("-", Value::Integer(0), other, span),
        }
    }

    fn sum(&mut self, items: &[Value], span: Span) -> Value {
        self.count(items.len(), span);
        let items = items.iter().cloned();
        let sum = items.reduce(|sum, item| self.operate("+", sum, item, span));
        sum.unwrap_or_else(|| self.constant(integer(0), span))
    }

    /// The operations on values, for [`vectors`].
    fn operations(&mut self, span: Span) -> impl FnMut(char, &Value, &Value) -> Value {
        move |sign, a, b| self.operate(sign.encode_utf8(&mut [0; 4]), a.clone(), b.clone(), span)
    }

    fn dot(&mut self, a: &[Value], b: &[Value], span: Span) -> Value {
        let found = vectors::dot(a, b, &mut self.operations(span));
        found.unwrap_or_else(|| self.constant(integer(0), span))
    }

    /// `value as f64`, or as an integer.
    pub(super) fn cast(&mut self, value: Value, to_float: bool, span: Span) -> Value {
        match value {
            Value::Integer(n) if to_float => self.constant(Rational::from_integer(n.into()), span),
            Value::Integer(_) | Value::Wrong => value,
            Value::Number(_) if to_float => value,
            _ => self.wrong(span, Mistake::NotConstant("a number cast to an integer")),
        }
    }

    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Value {
        let span = Span::of(call);
        self.count(1, span);
        let receiver = self.expression(&call.receiver);
        let mut given = self.expressions(&call.args);
        let name = call.method.to_string();
        let value = match &receiver {
            Value::Number(x) => self.number_method(&name, *x, &given, span),
            Value::List(list) => self.list_method(&name, list, call, &given),
            _ => None,
        };
        let kind = receiver.kind();
        given.push(receiver);
        self.known(value, &given, || {
            let message = format!("`{name}` of {kind} with these arguments is not read");
            let near = nearest(&name, KNOWN.split(", ")).filter(|known| *known != name);
            let help = near.map(|known| format!("did you mean `{known}`?"));
            let help = help.unwrap_or_else(|| format!("methods read: {KNOWN}"));
            (Span::of(&call.method), message, help)
        })
    }

    /// Methods of `f64`; also called as `f64::name(x, …)`.
    pub(super) fn number_method(
        &mut self,
        name: &str,
        x: ExprId,
        arguments: &[Value],
        span: Span,
    ) -> Option<Value> {
        let own = Value::Number(x);
        Some(match (name, arguments) {
            ("powi", [Value::Integer(n)]) => {
                let n = self.constant(Rational::from_integer((*n).into()), span);
                return self.number_method("powf", x, &[n], span);
            }
            ("powf", [Value::Number(n)]) => self.push(Node::Pow(x, *n), span),
            ("mul_add", [a, b]) => {
                let product = self.operate("*", own, a.clone(), span);
                self.operate("+", product, b.clone(), span)
            }
            ("recip", []) => {
                let one = self.constant(integer(1), span);
                self.operate("/", one, own, span)
            }
            ("min" | "max" | "clamp" | "floor" | "ceil" | "round" | "signum" | "trunc", _) => {
                let message =
                    format!("`{name}` has kinks or jumps: the Hamiltonian must be smooth");
                let help = "write it with functions that are smooth, such as tanh";
                self.unsupported(span, &message, help)
            }
            (_, []) => self.push(Node::Call(Function::lookup(name)?, x), span),
            _ => return None,
        })
    }

    /// Methods of arrays, iterators, vectors and matrices; `None` if there is no such method.
    fn list_method(
        &mut self,
        name: &str,
        list: &Aggregate,
        call: &ExprMethodCall,
        arguments: &[Value],
    ) -> Option<Value> {
        let (items, span) = (&list.entries, Span::of(call));
        let pair = |(a, b): (Value, &Value)| Value::list([a, b.clone()]);
        Some(match (name, arguments) {
            ("iter" | "into_iter" | "copied" | "cloned" | "into_owned", []) => {
                Value::List(list.clone())
            }
            ("len", []) => Value::Integer(items.len() as i128),
            ("rev", []) => Value::list(items.iter().rev().cloned()),
            ("enumerate", []) => Value::list((0..).map(Value::Integer).zip(items.iter()).map(pair)),
            ("zip", [Value::List(other)]) => {
                Value::list(items.iter().cloned().zip(other.entries.iter()).map(pair))
            }
            ("map", [Value::Function(function)]) => {
                Value::list(items.iter().map(|item| self.apply(function, vec![item.clone()], span)))
            }
            ("fold", [start, Value::Function(function)]) => {
                items.iter().fold(start.clone(), |value, item| {
                    self.apply(function, vec![value, item.clone()], span)
                })
            }
            ("sum", []) => self.sum(items, span),
            _ if list.shape.is_none() => return None,
            ("dot", [Value::List(other)]) if items.len() == other.entries.len() => {
                self.dot(items, &other.entries, span)
            }
            ("norm_squared", []) => self.dot(items, items, span),
            ("norm", []) => match self.dot(items, items, span) {
                Value::Number(square) => self.push(Node::Call(Function::Sqrt, square), span),
                other => other,
            },
            ("component_mul", [Value::List(other)]) if list.shape == other.shape => {
                self.entrywise("*", list, other, span)
            }
            ("component_div", [Value::List(other)]) if list.shape == other.shape => {
                self.entrywise("/", list, other, span)
            }
            ("cross", [Value::List(other)]) if items.len() == 3 && other.entries.len() == 3 => {
                let product = vectors::cross(items, &other.entries, &mut self.operations(span));
                Value::matrix(3, 1, product.to_vec())
            }
            ("fixed_rows", [Value::Integer(start)]) => {
                let sizes = call.turbofish.as_ref().and_then(|sizes| sizes.args.first());
                let Some(GenericArgument::Const(count)) = sizes else { return None };
                let count = length(count)?;
                let start = usize::try_from(*start).unwrap_or(usize::MAX);
                let end = start.saturating_add(count);
                match items.get(start..end) {
                    Some(rows) => Value::matrix(count, 1, rows.to_vec()),
                    None => {
                        let wrong = Mistake::IndexRange(format!("{start}..{end}"), items.len());
                        self.wrong(span, wrong)
                    }
                }
            }
            _ => return None,
        })
    }
}
