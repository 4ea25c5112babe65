//! The values of a function's variables while it is read, and what can be computed with them.

use std::cmp::Ordering;
use std::rc::Rc;

use syn::{BinOp, ExprMethodCall, GenericArgument};

use crate::diagnostic::{Mistake, Span, nearest};
use crate::expr::{ExprId, Function, Node};
use crate::number::{Rational, integer};
use crate::parse::rust::evaluate::{Callable, Evaluator, NoValue};
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

    /// The place of the entry named by an index, or the length where there is none such.
    pub(super) fn position(&self, index: &[usize]) -> Result<usize, usize> {
        let below = |i: usize, length: usize| if i < length { Ok(i) } else { Err(length) };
        match (self.shape, index) {
            (_, &[at]) => below(at, self.entries.len()),
            (Some((rows, columns)), &[i, j]) => Ok(below(i, rows)? + below(j, columns)? * rows),
            _ => Err(0),
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
    /// A binary operation, or that of a compound assignment.
    pub(super) fn operate(&mut self, op: &BinOp, a: Value, b: Value, span: Span) -> Value {
        let order: fn(Ordering) -> bool = match op {
            BinOp::Add(_) | BinOp::AddAssign(_) => return self.arithmetic('+', a, b, span),
            BinOp::Sub(_) | BinOp::SubAssign(_) => return self.arithmetic('-', a, b, span),
            BinOp::Mul(_) | BinOp::MulAssign(_) => return self.arithmetic('*', a, b, span),
            BinOp::Div(_) | BinOp::DivAssign(_) => return self.arithmetic('/', a, b, span),
            BinOp::Rem(_) | BinOp::RemAssign(_) => return self.arithmetic('%', a, b, span),
            BinOp::Eq(_) => Ordering::is_eq,
            BinOp::Ne(_) => Ordering::is_ne,
            BinOp::Lt(_) => Ordering::is_lt,
            BinOp::Le(_) => Ordering::is_le,
            BinOp::Gt(_) => Ordering::is_gt,
            BinOp::Ge(_) => Ordering::is_ge,
            _ => return self.unread("operator", op),
        };
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => Value::Bool(order(a.cmp(&b))),
            (Value::Wrong, _) | (_, Value::Wrong) => Value::Wrong,
            _ => self.undecided("a comparison", span),
        }
    }

    /// An operation named by its sign.
    fn arithmetic(&mut self, sign: char, a: Value, b: Value, span: Span) -> Value {
        match (a, b) {
            (Value::Wrong, _) | (_, Value::Wrong) => Value::Wrong,
            (Value::Integer(a), Value::Integer(b)) => {
                let value = match sign {
                    '+' => a.checked_add(b),
                    '-' => a.checked_sub(b),
                    '*' => a.checked_mul(b),
                    '/' => a.checked_div(b),
                    _ => a.checked_rem(b),
                };
                self.checked_integer(value, span)
            }
            (Value::Number(a), Value::Number(b)) if sign != '%' => {
                let node = match sign {
                    '+' => Node::Add,
                    '-' => Node::Sub,
                    '*' => Node::Mul,
                    _ => Node::Div,
                };
                self.push(node(a, b), span)
            }
            (s @ Value::Number(_), Value::List(v)) if v.shape.is_some() && sign == '*' => {
                v.map(|x| self.arithmetic(sign, s.clone(), x, span))
            }
            (Value::List(v), s @ Value::Number(_))
                if v.shape.is_some() && matches!(sign, '*' | '/') =>
            {
                v.map(|x| self.arithmetic(sign, x, s.clone(), span))
            }
            (Value::List(Aggregate { entries: a, shape: Some((rows, inner)) }), Value::List(b))
                if sign == '*' && b.shape.is_some_and(|(other, _)| inner == other) =>
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
                if a.shape.is_some() && a.shape == b.shape && matches!(sign, '+' | '-') =>
            {
                self.entrywise(sign, &a, &b, span)
            }
            (a, b) => {
                let message = format!("`{sign}` of {} and {} is not read", a.kind(), b.kind());
                self.unsupported(span, &message, "write it out in coordinates")
            }
        }
    }

    fn entrywise(&mut self, sign: char, a: &Aggregate, b: &Aggregate, span: Span) -> Value {
        let mut others = b.entries.iter().cloned();
        a.map(|x| self.arithmetic(sign, x, others.next().unwrap_or(Value::Wrong), span))
    }

    fn checked_integer(&mut self, value: Option<i128>, span: Span) -> Value {
        match value {
            Some(value) => Value::Integer(value),
            None => self.unsupported(span, "this integer operation overflows", ""),
        }
    }

    pub(super) fn negate(&mut self, value: Value, span: Span) -> Value {
        match value {
            Value::Number(a) => self.push(Node::Neg(a), span),
            Value::Integer(n) => self.checked_integer(n.checked_neg(), span),
            Value::List(v) if v.shape.is_some() => v.map(|entry| self.negate(entry, span)),
            Value::Wrong => Value::Wrong,
            other => {
                let message = format!("`-` of {} is not read", other.kind());
                self.unsupported(span, &message, "write it out in coordinates")
            }
        }
    }

    fn sum(&mut self, items: Vec<Value>, span: Span) -> Value {
        let sum = items.into_iter().reduce(|sum, item| self.arithmetic('+', sum, item, span));
        sum.unwrap_or_else(|| self.constant(integer(0), span))
    }

    /// The operations on values, for [`vectors`].
    fn operations(&mut self, span: Span) -> impl FnMut(char, &Value, &Value) -> Value {
        move |sign, a, b| self.arithmetic(sign, a.clone(), b.clone(), span)
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

    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Result<Value, NoValue> {
        let span = Span::of(call);
        self.tick(span)?;
        let receiver = self.expression(&call.receiver)?;
        let arguments = self.expressions(&call.args)?;
        let name = call.method.to_string();
        let value = match &receiver {
            Value::Number(x) => self.number_method(&name, *x, &arguments, span),
            Value::List(list) => self.list_method(&name, list, call, &arguments)?,
            _ => None,
        };
        let mut all = arguments.iter().chain([&receiver]);
        Ok(match value {
            Some(value) => value,
            None if all.any(|value| matches!(value, Value::Wrong)) => Value::Wrong,
            None => {
                let kind = receiver.kind();
                let message = format!("`{name}` of {kind} with these arguments is not read");
                let near = nearest(&name, KNOWN.split(", ")).filter(|known| *known != name);
                let help = near.map(|known| format!("did you mean `{known}`?"));
                let help = help.unwrap_or_else(|| format!("methods read: {KNOWN}"));
                self.unsupported(Span::of(&call.method), &message, &help)
            }
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
        let node = match (name, arguments) {
            ("powi", [Value::Integer(n)]) => {
                Node::Pow(x, self.number(Rational::from_integer((*n).into()), span))
            }
            ("powf", [Value::Number(n)]) => Node::Pow(x, *n),
            ("mul_add", [a, b]) => {
                let product = self.arithmetic('*', Value::Number(x), a.clone(), span);
                return Some(self.arithmetic('+', product, b.clone(), span));
            }
            ("recip", []) => Node::Div(self.number(integer(1), span), x),
            ("min" | "max" | "clamp" | "floor" | "ceil" | "round" | "signum" | "trunc", _) => {
                let message =
                    format!("`{name}` has kinks or jumps: the Hamiltonian must be smooth");
                let help = "write it with functions that are smooth, such as tanh";
                return Some(self.unsupported(span, &message, help));
            }
            (_, []) => Node::Call(Function::lookup(name)?, x),
            _ => return None,
        };
        Some(self.push(node, span))
    }

    /// Methods of arrays, iterators, vectors and matrices; `None` if there is no such method.
    fn list_method(
        &mut self,
        name: &str,
        list: &Aggregate,
        call: &ExprMethodCall,
        arguments: &[Value],
    ) -> Result<Option<Value>, NoValue> {
        let (items, span) = (&list.entries, Span::of(call));
        let pair = |(a, b): (Value, &Value)| Value::list([a, b.clone()]);
        Ok(Some(match (name, arguments) {
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
                let values: Result<Vec<Value>, NoValue> = items
                    .iter()
                    .map(|item| self.apply(function, vec![item.clone()], span))
                    .collect();
                Value::list(values?)
            }
            ("fold", [start, Value::Function(function)]) => {
                items.iter().try_fold(start.clone(), |value, item| {
                    self.apply(function, vec![value, item.clone()], span)
                })?
            }
            ("sum", []) => {
                items.iter().try_for_each(|_| self.tick(span))?;
                self.sum(items.to_vec(), span)
            }
            _ if list.shape.is_none() => return Ok(None),
            ("dot", [Value::List(other)]) if items.len() == other.entries.len() => {
                self.dot(items, &other.entries, span)
            }
            ("norm_squared", []) => self.dot(items, items, span),
            ("norm", []) => match self.dot(items, items, span) {
                Value::Number(square) => self.push(Node::Call(Function::Sqrt, square), span),
                other => other,
            },
            ("component_mul", [Value::List(other)]) if list.shape == other.shape => {
                self.entrywise('*', list, other, span)
            }
            ("component_div", [Value::List(other)]) if list.shape == other.shape => {
                self.entrywise('/', list, other, span)
            }
            ("cross", [Value::List(other)]) if items.len() == 3 && other.entries.len() == 3 => {
                let product = vectors::cross(items, &other.entries, &mut self.operations(span));
                Value::matrix(3, 1, product.to_vec())
            }
            ("fixed_rows", [Value::Integer(start)]) => {
                let sizes = call.turbofish.as_ref().and_then(|sizes| sizes.args.first());
                let Some(GenericArgument::Const(count)) = sizes else { return Ok(None) };
                let Some(count) = length(count) else { return Ok(None) };
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
            _ => return Ok(None),
        }))
    }
}
