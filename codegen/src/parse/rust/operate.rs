//! Operators on values.

use std::cmp::Ordering;

use syn::{BinOp, Expr, ExprBinary, Type};

use super::evaluate::{Evaluator, Flow};
use super::value::Value;
use crate::diagnostic::{Mistake, Span};
use crate::expr::{ExprId, Node};
use crate::number::Rational;

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

    fn checked_integer(&mut self, value: Option<i128>, span: Span) -> Value {
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
            _ => self.unsupported(
                span,
                "a comparison must not depend on the momentum or a parameter: the Hamiltonian must \
                 be one polynomial",
                "compare integers known beforehand only, such as loop variables",
            ),
        }
    }

    pub(super) fn negate(&mut self, value: Value, span: Span) -> Value {
        match value {
            Value::Number(a) => self.push(Node::Neg(a), span),
            Value::Integer(n) => self.checked_integer(n.checked_neg(), span),
            Value::Vector(list) => {
                Value::Vector(list.into_iter().map(|v| self.negate(v, span)).collect())
            }
            Value::Matrix { rows, columns, entries } => {
                let entries = entries.into_iter().map(|v| self.negate(v, span)).collect();
                Value::Matrix { rows, columns, entries }
            }
            Value::Wrong => Value::Wrong,
            other => self.no_operation("-", &other, &other, span),
        }
    }

    /// Entry by entry.
    fn zip(&mut self, a: Value, b: Value, span: Span, name: &str, node: Combine) -> Value {
        match (a, b) {
            (Value::Number(a), Value::Number(b)) => self.push(node(a, b), span),
            (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => Value::Vector(
                a.into_iter().zip(b).map(|(a, b)| self.zip(a, b, span, name, node)).collect(),
            ),
            (
                Value::Matrix { rows, columns, entries: a },
                Value::Matrix { rows: r, columns: c, entries: b },
            ) if (rows, columns) == (r, c) => {
                let entries = a.into_iter().zip(b);
                let entries = entries.map(|(a, b)| self.zip(a, b, span, name, node)).collect();
                Value::Matrix { rows, columns, entries }
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

    pub(super) fn entrywise_product(&mut self, a: Value, b: Value, span: Span) -> Value {
        self.zip(a, b, span, "component_mul", Node::Mul)
    }

    pub(super) fn entrywise_quotient(&mut self, a: Value, b: Value, span: Span) -> Value {
        self.zip(a, b, span, "component_div", Node::Div)
    }

    pub(super) fn multiply(&mut self, a: Value, b: Value, span: Span) -> Value {
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => self.checked_integer(a.checked_mul(b), span),
            (Value::Number(a), Value::Number(b)) => self.push(Node::Mul(a, b), span),
            (Value::Number(s), Value::Vector(list)) | (Value::Vector(list), Value::Number(s)) => {
                let scaled = list.into_iter().map(|v| self.multiply(Value::Number(s), v, span));
                Value::Vector(scaled.collect())
            }
            (Value::Number(s), Value::Matrix { rows, columns, entries })
            | (Value::Matrix { rows, columns, entries }, Value::Number(s)) => {
                let scaled = entries.into_iter().map(|v| self.multiply(Value::Number(s), v, span));
                Value::Matrix { rows, columns, entries: scaled.collect() }
            }
            (Value::Matrix { rows, columns, entries }, Value::Vector(vector))
                if columns == vector.len() =>
            {
                let row = |i: usize| entries[i * columns..(i + 1) * columns].to_vec();
                Value::Vector((0..rows).map(|i| self.dot(row(i), vector.clone(), span)).collect())
            }
            (
                Value::Matrix { rows, columns, entries: a },
                Value::Matrix { rows: inner, columns: width, entries: b },
            ) if columns == inner => {
                let mut entries = Vec::with_capacity(rows * width);
                for i in 0..rows {
                    for j in 0..width {
                        let row = a[i * columns..(i + 1) * columns].to_vec();
                        let column = (0..inner).map(|k| b[k * width + j].clone()).collect();
                        entries.push(self.dot(row, column, span));
                    }
                }
                Value::Matrix { rows, columns: width, entries }
            }
            (a, b) => self.no_operation("*", &a, &b, span),
        }
    }

    fn divide(&mut self, a: Value, b: Value, span: Span) -> Value {
        match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => self.checked_integer(a.checked_div(b), span),
            (Value::Number(a), Value::Number(b)) => self.push(Node::Div(a, b), span),
            (Value::Vector(list), Value::Number(s)) => Value::Vector(
                list.into_iter().map(|v| self.divide(v, Value::Number(s), span)).collect(),
            ),
            (Value::Matrix { rows, columns, entries }, Value::Number(s)) => {
                let entries = entries.into_iter();
                let entries = entries.map(|v| self.divide(v, Value::Number(s), span)).collect();
                Value::Matrix { rows, columns, entries }
            }
            (a, b) => self.no_operation("/", &a, &b, span),
        }
    }

    /// Σ aᵢ bᵢ.
    pub(super) fn dot(&mut self, a: Vec<Value>, b: Vec<Value>, span: Span) -> Value {
        let mut sum: Option<Value> = None;
        for (a, b) in a.into_iter().zip(b) {
            let product = self.multiply(a, b, span);
            sum = Some(match sum {
                Some(sum) => self.add(sum, product, span),
                None => product,
            });
        }
        sum.unwrap_or_else(|| self.constant(crate::number::integer(0), span))
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
            _ => {
                self.report(span, Mistake::NotConstant("a number cast to an integer"));
                Value::Wrong
            }
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
