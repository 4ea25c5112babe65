//! Operators on values.

use std::cmp::Ordering;

use syn::{BinOp, Expr, ExprBinary, Type};

use super::evaluate::{Evaluator, Flow};
use super::value::{Matrix, Value};
use crate::diagnostic::{Mistake, Span};
use crate::expr::{ExprId, Node};
use crate::number::{Rational, integer};

type Combine = fn(ExprId, ExprId) -> Node;

impl Evaluator<'_> {
    /// A binary operation or a compound assignment.
    pub(super) fn binary(&mut self, binary: &ExprBinary) -> Result<Value, Flow> {
        // a + b + c + … nests to the left; a loop keeps long sums off the stack.
        let mut chain = vec![binary];
        while let Some(Expr::Binary(left)) = chain.last().map(|b| &*b.left) {
            if is_assignment(&left.op) || matches!(left.op, BinOp::And(_) | BinOp::Or(_)) {
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
            // `&&` and `||` look at the right side only where they need it.
            match (&operation.op, &value) {
                (BinOp::And(_), Value::Bool(false)) | (BinOp::Or(_), Value::Bool(true)) => continue,
                _ => {}
            }
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
            BinOp::And(_) | BinOp::BitAnd(_) => self.logic(a, b, span, |a, b| a && b),
            BinOp::Or(_) | BinOp::BitOr(_) => self.logic(a, b, span, |a, b| a || b),
            BinOp::Eq(_) => self.compare(&a, &b, span, Ordering::is_eq),
            BinOp::Ne(_) => self.compare(&a, &b, span, Ordering::is_ne),
            BinOp::Lt(_) => self.compare(&a, &b, span, Ordering::is_lt),
            BinOp::Le(_) => self.compare(&a, &b, span, Ordering::is_le),
            BinOp::Gt(_) => self.compare(&a, &b, span, Ordering::is_gt),
            BinOp::Ge(_) => self.compare(&a, &b, span, Ordering::is_ge),
            _ => self.unsupported(span, "this operator is not read", "use + - * /"),
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

    fn logic(&mut self, a: Value, b: Value, span: Span, op: fn(bool, bool) -> bool) -> Value {
        match (&a, &b) {
            (Value::Bool(a), Value::Bool(b)) => Value::Bool(op(*a, *b)),
            _ => self.no_operation("&&", &a, &b, span),
        }
    }

    fn compare(&mut self, a: &Value, b: &Value, span: Span, op: fn(Ordering) -> bool) -> Value {
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => Value::Bool(op(a.cmp(b))),
            (Value::Bool(a), Value::Bool(b)) => Value::Bool(op(a.cmp(b))),
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

    /// Entry by entry.
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

    /// Σ aᵢ bᵢ.
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

    /// `value as type`.
    pub(super) fn cast(&mut self, value: Value, ty: &Type, span: Span) -> Value {
        let to_float =
            matches!(ty, Type::Path(p) if p.path.is_ident("f64") || p.path.is_ident("f32"));
        match value {
            Value::Integer(n) if to_float => self.constant(Rational::from_integer(n.into()), span),
            Value::Integer(n) => Value::Integer(n),
            Value::Number(id) if to_float => Value::Number(id),
            Value::Bool(truth) if !to_float => Value::Integer(i128::from(truth)),
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
            | BinOp::BitXorAssign(_)
            | BinOp::BitAndAssign(_)
            | BinOp::BitOrAssign(_)
            | BinOp::ShlAssign(_)
            | BinOp::ShrAssign(_)
    )
}
