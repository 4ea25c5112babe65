//! The values of a function's variables while it is read.

use std::cmp::Ordering;
use std::rc::Rc;

use syn::{BinOp, Expr, ExprBinary, ExprMethodCall, ExprRange, RangeLimits, Type};

use crate::diagnostic::{Mistake, Span, nearest};
use crate::expr::{ExprId, Function, Node};
use crate::number::{Rational, integer};
use crate::parse::rust::evaluate::{Callable, Evaluator, NoValue};
use crate::parse::rust::signature::sizes;

/// A value of the function's world. Copies of lists and matrices share their entries.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Number(ExprId),
    /// An integer, known.
    Integer(i128),
    /// A truth value, known.
    Bool(bool),
    /// An array, a tuple or an iterator.
    List(Rc<Vec<Value>>),
    /// A matrix of nalgebra; one of a single column is a vector.
    Matrix(Matrix),
    /// A closure or a function of the body.
    Function(Rc<Callable>),
    Unit,
    /// Something wrong that has been reported.
    Wrong,
}

/// A matrix of nalgebra, row by row.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    pub rows: usize,
    pub columns: usize,
    pub entries: Rc<Vec<Value>>,
}

impl Matrix {
    pub(super) fn new(rows: usize, columns: usize, entries: impl Iterator<Item = Value>) -> Self {
        Self { rows, columns, entries: Rc::new(entries.collect()) }
    }

    pub(super) fn vector(entries: &[Value]) -> Self {
        Self::new(entries.len(), 1, entries.iter().cloned())
    }

    pub(super) fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// The matrix of the same shape with these entries.
    pub(super) fn with(&self, entries: impl Iterator<Item = Value>) -> Self {
        Self::new(self.rows, self.columns, entries)
    }

    pub(super) fn transposed(&self) -> Self {
        let entry =
            |at: usize| self.entries[at % self.rows * self.columns + at / self.rows].clone();
        Self::new(self.columns, self.rows, (0..self.entries.len()).map(entry))
    }
}

impl Value {
    pub(super) fn list(entries: impl IntoIterator<Item = Value>) -> Self {
        Self::List(Rc::new(entries.into_iter().collect()))
    }

    /// A description for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Integer(_) => "an integer",
            Self::Bool(_) => "a truth value",
            Self::List(_) => "an array",
            Self::Matrix(Matrix { columns: 1, .. }) => "a vector",
            Self::Matrix(_) => "a matrix",
            Self::Function(_) => "a function",
            Self::Unit => "nothing",
            Self::Wrong => "a mistake",
        }
    }

    /// The entries in the order in which Rust iterates over them: those of a matrix column by column.
    pub(super) fn iterated(&self) -> Option<Rc<Vec<Value>>> {
        match self {
            Self::List(list) => Some(list.clone()),
            Self::Matrix(matrix) => Some(matrix.transposed().entries),
            _ => None,
        }
    }

    /// The place of the entry named by an index, or the length where there is none such.
    fn position(&self, index: &[usize]) -> Result<usize, usize> {
        let below = |i: usize, length: usize| if i < length { Ok(i) } else { Err(length) };
        match (self, index) {
            (Self::List(list), &[i]) => below(i, list.len()),
            (Self::Matrix(Matrix { rows, columns, .. }), &[i, j]) => {
                Ok(below(i, *rows)? * columns + below(j, *columns)?)
            }
            // nalgebra counts a matrix column by column.
            (Self::Matrix(Matrix { rows, columns, .. }), &[k]) => {
                let k = below(k, rows * columns)?;
                Ok(k % rows * columns + k / rows)
            }
            _ => Err(0),
        }
    }

    /// The entry named by an index, or the length where there is none such.
    pub(super) fn entry(&self, index: &[usize]) -> Result<Value, usize> {
        let at = self.position(index)?;
        match self {
            Self::List(entries) | Self::Matrix(Matrix { entries, .. }) => Ok(entries[at].clone()),
            _ => Err(0),
        }
    }

    /// As [`Value::entry`], for assignment.
    pub(super) fn entry_mut(&mut self, index: &[usize]) -> Result<&mut Value, usize> {
        let at = self.position(index)?;
        match self {
            Self::List(entries) | Self::Matrix(Matrix { entries, .. }) => {
                Ok(&mut Rc::make_mut(entries)[at])
            }
            _ => Err(0),
        }
    }
}

type Combine = fn(ExprId, ExprId) -> Node;

impl Evaluator<'_> {
    /// A binary operation or a compound assignment.
    pub(super) fn binary(&mut self, binary: &ExprBinary) -> Result<Value, NoValue> {
        // a + b + c + … nests to the left; a loop keeps long sums off the stack.
        let mut chain = vec![binary];
        while let Some(Expr::Binary(left)) = chain.last().map(|b| &*b.left) {
            if is_assignment(&left.op) {
                break;
            }
            chain.push(left);
        }
        let mut value = match chain.last() {
            Some(first) => self.expression(&first.left)?,
            None => Value::Wrong,
        };
        for operation in chain.into_iter().rev() {
            let span = Span::of(&operation.op);
            self.tick(span)?;
            let right = self.expression(&operation.right)?;
            let whole = Span::of(&operation.left).to(Span::of(&operation.right));
            let result = self.operate(&operation.op, value, right, whole);
            value = if is_assignment(&operation.op) {
                self.assign(&operation.left, result)?;
                Value::Unit
            } else {
                result
            };
        }
        Ok(value)
    }

    fn operate(&mut self, op: &BinOp, a: Value, b: Value, span: Span) -> Value {
        match op {
            BinOp::Add(_) | BinOp::AddAssign(_) => self.add(a, b, span),
            BinOp::Sub(_) | BinOp::SubAssign(_) => self.subtract(a, b, span),
            BinOp::Mul(_) | BinOp::MulAssign(_) => self.multiply(a, b, span),
            BinOp::Div(_) | BinOp::DivAssign(_) => self.divide(a, b, span),
            BinOp::Rem(_) | BinOp::RemAssign(_) => match (&a, &b) {
                (Value::Integer(a), Value::Integer(b)) => {
                    self.checked_integer(a.checked_rem(*b), span)
                }
                _ => self.no_operation("%", &a, &b, span),
            },
            BinOp::Eq(_) => self.compare(&a, &b, span, Ordering::is_eq),
            BinOp::Ne(_) => self.compare(&a, &b, span, Ordering::is_ne),
            BinOp::Lt(_) => self.compare(&a, &b, span, Ordering::is_lt),
            BinOp::Le(_) => self.compare(&a, &b, span, Ordering::is_le),
            BinOp::Gt(_) => self.compare(&a, &b, span, Ordering::is_gt),
            BinOp::Ge(_) => self.compare(&a, &b, span, Ordering::is_ge),
            _ => self.unsupported(
                span,
                "this operator is not read",
                "use + - * / and, of integers, %",
            ),
        }
    }

    fn no_operation(&mut self, operator: &str, a: &Value, b: &Value, span: Span) -> Value {
        if matches!(a, Value::Wrong) || matches!(b, Value::Wrong) {
            return Value::Wrong;
        }
        let message = format!("`{operator}` of {} and {} is not read", a.kind(), b.kind());
        self.unsupported(span, &message, "write it out in coordinates")
    }

    pub(super) fn checked_integer(&mut self, value: Option<i128>, span: Span) -> Value {
        match value {
            Some(value) => Value::Integer(value),
            None => self.unsupported(span, "this integer operation overflows", ""),
        }
    }

    fn compare(&mut self, a: &Value, b: &Value, span: Span, op: fn(Ordering) -> bool) -> Value {
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => Value::Bool(op(a.cmp(b))),
            (Value::Wrong, _) | (_, Value::Wrong) => Value::Wrong,
            _ => self.undecided("a comparison", span),
        }
    }

    /// A matrix whose entries are those of another after an operation.
    fn map(&mut self, matrix: &Matrix, mut of: impl FnMut(&mut Self, Value) -> Value) -> Value {
        let entries = matrix.entries.iter().map(|entry| of(self, entry.clone()));
        Value::Matrix(matrix.with(entries))
    }

    pub(super) fn negate(&mut self, value: Value, span: Span) -> Value {
        match value {
            Value::Number(a) => self.push(Node::Neg(a), span),
            Value::Integer(n) => self.checked_integer(n.checked_neg(), span),
            Value::Matrix(matrix) => self.map(&matrix, |this, entry| this.negate(entry, span)),
            other => self.no_operation("-", &other, &other, span),
        }
    }

    pub(super) fn zip(
        &mut self,
        a: Value,
        b: Value,
        span: Span,
        name: &str,
        node: Combine,
    ) -> Value {
        match (a, b) {
            (Value::Number(a), Value::Number(b)) => self.push(node(a, b), span),
            (Value::Matrix(a), Value::Matrix(b)) if a.shape() == b.shape() => {
                let entries = a.entries.iter().cloned().zip(b.entries.iter().cloned());
                let entries = entries.map(|(a, b)| self.zip(a, b, span, name, node));
                Value::Matrix(a.with(entries))
            }
            (a, b) => self.no_operation(name, &a, &b, span),
        }
    }

    pub(super) fn add(&mut self, a: Value, b: Value, span: Span) -> Value {
        match (&a, &b) {
            (Value::Integer(a), Value::Integer(b)) => self.checked_integer(a.checked_add(*b), span),
            _ => self.zip(a, b, span, "+", Node::Add),
        }
    }

    pub(super) fn subtract(&mut self, a: Value, b: Value, span: Span) -> Value {
        match (&a, &b) {
            (Value::Integer(a), Value::Integer(b)) => self.checked_integer(a.checked_sub(*b), span),
            _ => self.zip(a, b, span, "-", Node::Sub),
        }
    }

    pub(super) fn multiply(&mut self, a: Value, b: Value, span: Span) -> Value {
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => self.checked_integer(a.checked_mul(b), span),
            (Value::Number(a), Value::Number(b)) => self.push(Node::Mul(a, b), span),
            (Value::Number(s), Value::Matrix(matrix))
            | (Value::Matrix(matrix), Value::Number(s)) => {
                self.map(&matrix, |this, entry| this.multiply(Value::Number(s), entry, span))
            }
            (Value::Matrix(a), Value::Matrix(b)) if a.columns == b.rows => {
                let transposed = b.transposed();
                let entry = |at: usize| {
                    let (i, j) = (at / b.columns, at % b.columns);
                    let row = &a.entries[i * a.columns..][..a.columns];
                    self.dot(row, &transposed.entries[j * b.rows..][..b.rows], span)
                };
                Value::Matrix(Matrix::new(a.rows, b.columns, (0..a.rows * b.columns).map(entry)))
            }
            (a, b) => self.no_operation("*", &a, &b, span),
        }
    }

    fn divide(&mut self, a: Value, b: Value, span: Span) -> Value {
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => self.checked_integer(a.checked_div(b), span),
            (Value::Number(a), Value::Number(b)) => self.push(Node::Div(a, b), span),
            (Value::Matrix(matrix), Value::Number(s)) => {
                self.map(&matrix, |this, entry| this.divide(entry, Value::Number(s), span))
            }
            (a, b) => self.no_operation("/", &a, &b, span),
        }
    }

    pub(super) fn dot(&mut self, a: &[Value], b: &[Value], span: Span) -> Value {
        let mut sum: Option<Value> = None;
        for (a, b) in a.iter().zip(b) {
            let product = self.multiply(a.clone(), b.clone(), span);
            sum = Some(match sum {
                Some(sum) => self.add(sum, product, span),
                None => product,
            });
        }
        sum.unwrap_or_else(|| self.constant(integer(0), span))
    }

    pub(super) fn cast(&mut self, value: Value, ty: &Type, span: Span) -> Value {
        let to_float =
            matches!(ty, Type::Path(p) if p.path.is_ident("f64") || p.path.is_ident("f32"));
        match value {
            Value::Integer(n) if to_float => self.constant(Rational::from_integer(n.into()), span),
            Value::Integer(n) => Value::Integer(n),
            Value::Number(id) if to_float => Value::Number(id),
            Value::Wrong => Value::Wrong,
            _ => self.wrong(span, Mistake::NotConstant("a number cast to an integer")),
        }
    }
}

fn is_assignment(op: &BinOp) -> bool {
    matches!(
        op,
        BinOp::AddAssign(_)
            | BinOp::SubAssign(_)
            | BinOp::MulAssign(_)
            | BinOp::DivAssign(_)
            | BinOp::RemAssign(_)
    )
}

impl Evaluator<'_> {
    /// A range whose ends are known.
    pub(super) fn range(&mut self, range: &ExprRange) -> Result<Value, NoValue> {
        let span = Span::of(range);
        let mut bound = |bound: &Option<Box<Expr>>| {
            let Some(bound) = bound else {
                self.wrong(span, Mistake::NotConstant("the end of a range"));
                return Ok(None);
            };
            let value = self.expression(bound)?;
            Ok(self.integer(&value, "the bound of a range", Span::of(bound)))
        };
        let Some((start, end)) = bound(&range.start)?.zip(bound(&range.end)?) else {
            return Ok(Value::Wrong);
        };
        let inclusive = matches!(range.limits, RangeLimits::Closed(_));
        let end = if inclusive { end.saturating_add(1) } else { end };
        let mut list = Vec::new();
        for i in start..end {
            self.tick(span)?;
            list.push(Value::Integer(i));
        }
        Ok(Value::list(list))
    }

    pub(super) fn for_loop(&mut self, for_loop: &syn::ExprForLoop) -> Result<Value, NoValue> {
        let span = Span::of(&for_loop.expr);
        let list = self.expression(&for_loop.expr)?;
        let Some(items) = list.iterated() else {
            return Ok(match list {
                Value::Wrong => Value::Wrong,
                _ => {
                    let help = "loop over a range such as 0..3, or over an array";
                    self.unsupported(span, "this cannot be looped over", help)
                }
            });
        };
        for item in items.iter() {
            self.tick(span)?;
            self.scopes.enter();
            self.bind(&for_loop.pat, item.clone());
            let flow = self.block(&for_loop.body);
            self.scopes.leave();
            goes_on(flow)?;
        }
        Ok(Value::Unit)
    }

    /// `while condition { … }`, as long as the condition is known.
    pub(super) fn while_loop(&mut self, while_loop: &syn::ExprWhile) -> Result<Value, NoValue> {
        loop {
            self.tick(Span::of(&while_loop.cond))?;
            match self.condition(&while_loop.cond)? {
                Some(true) => {}
                Some(false) => return Ok(Value::Unit),
                None => return Ok(Value::Wrong),
            }
            goes_on(self.block(&while_loop.body))?;
        }
    }

    /// Methods of arrays and iterators; `None` if there is no such method.
    pub(super) fn list_method(
        &mut self,
        items: &[Value],
        call: &syn::ExprMethodCall,
        arguments: &[Value],
    ) -> Result<Option<Value>, NoValue> {
        let span = Span::of(call);
        let pair = |(a, b): (Value, &Value)| Value::list([a, b.clone()]);
        let list = match (call.method.to_string().as_str(), arguments) {
            ("iter" | "into_iter" | "copied" | "cloned", []) => items.to_vec(),
            ("len", []) => return Ok(Some(Value::Integer(items.len() as i128))),
            ("rev", []) => items.iter().rev().cloned().collect(),
            ("enumerate", []) => (0..).map(Value::Integer).zip(items).map(pair).collect(),
            ("zip", [other]) => match other.iterated() {
                Some(other) => items.iter().cloned().zip(other.iter()).map(pair).collect(),
                None => return Ok(None),
            },
            ("map", [Value::Function(function)]) => self.mapped(items, function, span)?,
            ("fold", [start, Value::Function(function)]) => {
                let mut value = start.clone();
                for item in items {
                    value = self.apply(function, vec![value, item.clone()], span)?;
                }
                return Ok(Some(value));
            }
            ("sum", []) => {
                let Some((first, items)) = items.split_first() else {
                    return Ok(Some(self.constant(integer(0), span)));
                };
                let mut value = first.clone();
                for item in items {
                    self.tick(span)?;
                    value = self.add(value, item.clone(), span);
                }
                return Ok(Some(value));
            }
            _ => return Ok(None),
        };
        Ok(Some(Value::list(list)))
    }

    fn mapped(
        &mut self,
        items: &[Value],
        function: &Rc<Callable>,
        span: Span,
    ) -> Result<Vec<Value>, NoValue> {
        items.iter().map(|item| self.apply(function, vec![item.clone()], span)).collect()
    }
}

/// Lets a loop go on after a mistake in its body.
fn goes_on(flow: Result<Value, NoValue>) -> Result<(), NoValue> {
    match flow {
        Ok(_) | Err(NoValue::Wrong) => Ok(()),
        Err(flow) => Err(flow),
    }
}

const KNOWN: &str = "powi, powf, mul_add, sqrt, sin, cos, tan, atan, tanh, exp, ln, abs, recip, dot, cross, norm_squared, norm, \
    component_mul, component_div, fixed_rows, sum, len, iter, map, zip, enumerate, rev, fold";

impl Evaluator<'_> {
    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Result<Value, NoValue> {
        let span = Span::of(call);
        self.tick(span)?;
        let receiver = self.expression(&call.receiver)?;
        let arguments: Result<Vec<Value>, NoValue> =
            call.args.iter().map(|argument| self.expression(argument)).collect();
        let arguments = arguments?;
        if matches!(receiver, Value::Wrong) {
            return Ok(Value::Wrong);
        }
        let name = call.method.to_string();
        let value = match &receiver {
            Value::Number(_) => self.number_method(&name, &receiver, &arguments, span),
            Value::List(items) => self.list_method(items, call, &arguments)?,
            Value::Matrix(matrix) => match self.matrix_method(&name, matrix, call, &arguments) {
                Some(value) => Some(value),
                None => self.list_method(&matrix.transposed().entries, call, &arguments)?,
            },
            _ => None,
        };
        Ok(match value {
            Some(value) => value,
            None if arguments.iter().any(|a| matches!(a, Value::Wrong)) => Value::Wrong,
            None => {
                let suggestion = nearest(&name, KNOWN.split(", "))
                    .filter(|known| *known != name)
                    .map(|known| format!("did you mean `{known}`?"));
                let message =
                    format!("`{name}` of {} with these arguments is not read", receiver.kind());
                let help = suggestion.unwrap_or_else(|| format!("methods read: {KNOWN}"));
                self.unsupported(Span::of(&call.method), &message, &help)
            }
        })
    }

    /// Methods of `f64`; also called as `f64::name(x, …)`.
    pub(super) fn number_method(
        &mut self,
        name: &str,
        receiver: &Value,
        arguments: &[Value],
        span: Span,
    ) -> Option<Value> {
        let &Value::Number(x) = receiver else { return None };
        Some(match (name, arguments) {
            ("powi", [power @ (Value::Integer(_) | Value::Wrong)]) => {
                let n = self.integer(power, "the power", span)?;
                match self.constant(Rational::from_integer(n.into()), span) {
                    Value::Number(n) => self.push(Node::Pow(x, n), span),
                    other => other,
                }
            }
            ("powf", [Value::Number(n)]) => self.push(Node::Pow(x, *n), span),
            ("mul_add", [a, b]) => {
                let product = self.multiply(receiver.clone(), a.clone(), span);
                self.add(product, b.clone(), span)
            }
            ("recip", []) => match self.constant(integer(1), span) {
                Value::Number(one) => self.push(Node::Div(one, x), span),
                other => other,
            },
            ("min" | "max" | "clamp" | "floor" | "ceil" | "round" | "signum" | "trunc", _) => self
                .unsupported(
                    span,
                    &format!("`{name}` has kinks or jumps: the Hamiltonian must be smooth"),
                    "write it with functions that are smooth, such as tanh",
                ),
            (_, []) => {
                let function = Function::lookup(name)?;
                self.push(Node::Call(function, x), span)
            }
            _ => return None,
        })
    }

    fn root(&mut self, value: Value, span: Span) -> Value {
        match value {
            Value::Number(x) => self.push(Node::Call(Function::Sqrt, x), span),
            other => other,
        }
    }

    fn matrix_method(
        &mut self,
        name: &str,
        matrix: &Matrix,
        call: &ExprMethodCall,
        arguments: &[Value],
    ) -> Option<Value> {
        let span = Span::of(call);
        let items = &matrix.entries;
        let whole = || Value::Matrix(matrix.clone());
        let found = match (name, arguments) {
            ("dot", [Value::Matrix(other)]) => {
                if items.len() != other.entries.len() {
                    let message =
                        format!("dot of {} and {} entries", items.len(), other.entries.len());
                    return Some(self.unsupported(span, &message, "both must have as many"));
                }
                return Some(self.dot(items, &other.entries, span));
            }
            ("norm_squared", []) => {
                return Some(self.dot(items, items, span));
            }
            ("norm", []) => {
                let square = self.dot(items, items, span);
                return Some(self.root(square, span));
            }
            ("component_mul", [other @ Value::Matrix(_)]) => {
                return Some(self.zip(whole(), other.clone(), span, name, Node::Mul));
            }
            ("component_div", [other @ Value::Matrix(_)]) => {
                return Some(self.zip(whole(), other.clone(), span, name, Node::Div));
            }
            ("cross", [Value::Matrix(other)]) if items.len() == 3 && other.entries.len() == 3 => {
                let other = &other.entries;
                matrix.with((0..3).map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    let a = self.multiply(items[j].clone(), other[k].clone(), span);
                    let b = self.multiply(items[k].clone(), other[j].clone(), span);
                    self.subtract(a, b, span)
                }))
            }
            ("into_owned", []) => matrix.clone(),
            ("fixed_rows", [start]) if matrix.columns == 1 => {
                let start = usize::try_from(self.integer(start, "the first row", span)?).ok()?;
                let count = *sizes(call.turbofish.as_ref()?).first()?;
                let end = start.checked_add(count)?;
                let Some(rows) = items.get(start..end) else {
                    let wrong = Mistake::IndexRange(format!("{start}..{end}"), items.len());
                    return Some(self.wrong(span, wrong));
                };
                Matrix::vector(rows)
            }
            _ => return None,
        };
        Some(Value::Matrix(found))
    }
}
