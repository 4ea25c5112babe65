//! Methods of numbers, vectors and matrices.

use syn::ExprMethodCall;

use super::evaluate::{Evaluator, Flow};
use super::signature::sizes;
use super::value::{Matrix, Value};
use crate::diagnostic::{Mistake, Span, nearest};
use crate::expr::{Function, Node};
use crate::number::{Rational, integer};

const KNOWN: &str = "powi, powf, mul_add, sqrt, sin, cos, tan, atan, tanh, exp, ln, abs, recip, dot, cross, norm_squared, norm, \
    component_mul, component_div, sum, iter, map, zip, enumerate, fold, transpose";

impl Evaluator<'_> {
    /// `receiver.method(arguments)`.
    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Result<Value, Flow> {
        let span = Span::of(call);
        self.tick(span)?;
        let receiver = self.expression(&call.receiver)?;
        let arguments: Result<Vec<Value>, Flow> =
            call.args.iter().map(|argument| self.expression(argument)).collect();
        let arguments = arguments?;
        if matches!(receiver, Value::Wrong) {
            return Ok(Value::Wrong);
        }
        let name = call.method.to_string();
        let value = match &receiver {
            Value::Number(_) => self.number_method(&name, &receiver, &arguments, span),
            Value::Integer(n) => self.integer_method(&name, *n, &arguments, span),
            Value::List(items) => self.list_method(items, call, &arguments)?,
            Value::Matrix(matrix) => match self.matrix_method(&name, matrix, call, &arguments) {
                Some(value) => Some(value),
                // Maps of matrices are matrices; their iterators are lists.
                None => {
                    let found = self.list_method(&matrix.transposed().entries, call, &arguments)?;
                    found.map(|found| match found {
                        Value::List(list) if name == "map" => {
                            let (rows, columns) = matrix.shape();
                            let entries = list.iter().cloned();
                            Value::Matrix(Matrix::new(columns, rows, entries).transposed())
                        }
                        found => found,
                    })
                }
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
            ("clone" | "to_owned" | "into", []) => receiver.clone(),
            ("hypot", [other]) => {
                let a = self.multiply(receiver.clone(), receiver.clone(), span);
                let b = self.multiply(other.clone(), other.clone(), span);
                let sum = self.add(a, b, span);
                self.root(sum, span)
            }
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

    fn integer_method(
        &mut self,
        name: &str,
        n: i128,
        arguments: &[Value],
        span: Span,
    ) -> Option<Value> {
        let value = match (name, arguments) {
            ("pow", [Value::Integer(power)]) => {
                u32::try_from(*power).ok().and_then(|power| n.checked_pow(power))
            }
            ("abs", []) => n.checked_abs(),
            ("min", [Value::Integer(other)]) => Some(n.min(*other)),
            ("max", [Value::Integer(other)]) => Some(n.max(*other)),
            ("abs_diff", [Value::Integer(other)]) => {
                n.checked_sub(*other).and_then(i128::checked_abs)
            }
            ("clone" | "into", []) => Some(n),
            _ => return None,
        };
        Some(self.checked_integer(value, span))
    }

    fn matrix_method(
        &mut self,
        name: &str,
        matrix: &Matrix,
        call: &ExprMethodCall,
        arguments: &[Value],
    ) -> Option<Value> {
        let span = Span::of(call);
        let (rows, columns) = matrix.shape();
        let items = &matrix.entries;
        let whole = || Value::Matrix(matrix.clone());
        let diagonal = || (0..rows.min(columns)).map(|i| items[i * columns + i].clone());
        let found = match (name, arguments) {
            ("dot", [Value::Matrix(other)]) => {
                if items.len() != other.entries.len() {
                    let message =
                        format!("dot of {} and {} entries", items.len(), other.entries.len());
                    return Some(self.unsupported(span, &message, "both must have as many"));
                }
                return Some(self.dot(items, &other.entries, span));
            }
            ("norm_squared" | "magnitude_squared", []) => {
                return Some(self.dot(items, items, span));
            }
            ("norm" | "magnitude", []) => {
                let square = self.dot(items, items, span);
                return Some(self.root(square, span));
            }
            ("trace", []) => {
                let diagonal: Vec<Value> = diagonal().collect();
                let ones = vec![self.constant(integer(1), span); diagonal.len()];
                return Some(self.dot(&diagonal, &ones, span));
            }
            ("component_mul", [other @ Value::Matrix(_)]) => {
                return Some(self.zip(whole(), other.clone(), span, name, Node::Mul));
            }
            ("component_div", [other @ Value::Matrix(_)]) => {
                return Some(self.zip(whole(), other.clone(), span, name, Node::Div));
            }
            ("scale", [factor]) => return Some(self.multiply(whole(), factor.clone(), span)),
            ("tr_mul", [other]) => {
                let transposed = Value::Matrix(matrix.transposed());
                return Some(self.multiply(transposed, other.clone(), span));
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
            ("clone" | "into_owned" | "clone_owned" | "to_owned", []) => matrix.clone(),
            ("transpose", []) => matrix.transposed(),
            ("diagonal", []) => Matrix::new(rows.min(columns), 1, diagonal()),
            ("column", [j]) => {
                let j = usize::try_from(self.integer(j, "the column", span)?).ok()?;
                let column = (0..rows).map(|i| items.get(i * columns + j).cloned());
                Matrix::vector(&column.collect::<Option<Vec<_>>>()?)
            }
            ("fixed_rows", [start]) if columns == 1 => {
                let start = usize::try_from(self.integer(start, "the first row", span)?).ok()?;
                let count = *sizes(call.turbofish.as_ref()?).first()?;
                let end = start.checked_add(count)?;
                let Some(rows) = items.get(start..end) else {
                    let wrong = Mistake::IndexRange(format!("{start}..{end}"), items.len());
                    return Some(self.wrong(span, wrong));
                };
                Matrix::vector(rows)
            }
            ("xyz", []) if columns == 1 => Matrix::vector(items.get(..3)?),
            ("xy", []) if columns == 1 => Matrix::vector(items.get(..2)?),
            _ => return None,
        };
        Some(Value::Matrix(found))
    }
}
