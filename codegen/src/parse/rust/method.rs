//! Methods of numbers, vectors and matrices.

use syn::ExprMethodCall;

use super::evaluate::{Evaluator, Flow};
use super::value::Value;
use crate::diagnostic::{Mistake, Span, nearest};
use crate::expr::{Function, Node};
use crate::number::{Rational, ratio};

const KNOWN: [&str; 24] = [
    "powi",
    "powf",
    "mul_add",
    "sqrt",
    "sin",
    "cos",
    "tan",
    "exp",
    "ln",
    "abs",
    "recip",
    "dot",
    "cross",
    "norm_squared",
    "norm",
    "component_mul",
    "component_div",
    "sum",
    "iter",
    "map",
    "zip",
    "enumerate",
    "fold",
    "transpose",
];

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
            Value::List(items) => match self.list_method(items, call, &arguments) {
                Some(value) => return value,
                None => None,
            },
            Value::Vector(items) => match self.vector_method(&name, items, call, &arguments) {
                Some(value) => Some(value),
                None => match self.list_method(items, call, &arguments) {
                    // Maps of vectors are vectors; their iterators are lists.
                    Some(Ok(Value::List(list))) if name == "map" || name == "clone" => {
                        Some(Value::Vector(list))
                    }
                    Some(value) => return value,
                    None => None,
                },
            },
            Value::Matrix { rows, columns, entries } => {
                self.matrix_method(&name, (*rows, *columns, entries), call, &arguments)
            }
            _ => None,
        };
        Ok(match value {
            Some(value) => value,
            None if arguments.iter().any(|a| matches!(a, Value::Wrong)) => Value::Wrong,
            None => {
                let suggestion = nearest(&name, KNOWN)
                    .filter(|known| *known != name)
                    .map(|known| format!("did you mean `{known}`?"));
                let message =
                    format!("`{name}` of {} with these arguments is not read", receiver.kind());
                let help =
                    suggestion.unwrap_or_else(|| format!("methods read: {}", KNOWN.join(", ")));
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
        let one = |this: &mut Self| this.constant(ratio(1, 1), span);
        Some(match (name, arguments) {
            ("powi", [power @ (Value::Integer(_) | Value::Wrong)]) => {
                let n = self.integer(power, "the power", span)?;
                let Value::Number(n) = self.constant(Rational::from_integer(n.into()), span) else {
                    return None;
                };
                self.push(Node::Pow(x, n), span)
            }
            ("powf", [Value::Number(n)]) => self.push(Node::Pow(x, *n), span),
            ("mul_add", [a, b]) => {
                let product = self.multiply(receiver.clone(), a.clone(), span);
                self.add(product, b.clone(), span)
            }
            ("recip", []) => match one(self) {
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
                    &format!("`{name}` has kinks or jumps: the Hamiltonian must be a polynomial"),
                    "expand the Hamiltonian in powers of the momentum",
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
        Some(match value {
            Some(value) => Value::Integer(value),
            None => self.unsupported(span, "this integer operation overflows", ""),
        })
    }

    fn vector_method(
        &mut self,
        name: &str,
        items: &[Value],
        call: &ExprMethodCall,
        arguments: &[Value],
    ) -> Option<Value> {
        let span = Span::of(call);
        Some(match (name, arguments) {
            ("dot", [Value::Vector(other)]) => {
                if items.len() != other.len() {
                    let message = format!("dot of {} and {} entries", items.len(), other.len());
                    return Some(self.unsupported(span, &message, "both must have as many"));
                }
                self.dot(items.to_vec(), other.clone(), span)
            }
            ("norm_squared" | "magnitude_squared", []) => {
                self.dot(items.to_vec(), items.to_vec(), span)
            }
            ("norm" | "magnitude", []) => {
                let square = self.dot(items.to_vec(), items.to_vec(), span);
                self.root(square, span)
            }
            ("cross", [Value::Vector(other)]) if items.len() == 3 && other.len() == 3 => {
                let entries = (0..3).map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    let a = self.multiply(items[j].clone(), other[k].clone(), span);
                    let b = self.multiply(items[k].clone(), other[j].clone(), span);
                    self.subtract(a, b, span)
                });
                Value::Vector(entries.collect())
            }
            ("component_mul", [other @ Value::Vector(_)]) => {
                self.entrywise_product(Value::Vector(items.to_vec()), other.clone(), span)
            }
            ("component_div", [other @ Value::Vector(_)]) => {
                self.entrywise_quotient(Value::Vector(items.to_vec()), other.clone(), span)
            }
            ("scale", [factor]) => {
                self.multiply(Value::Vector(items.to_vec()), factor.clone(), span)
            }
            ("clone" | "into_owned" | "clone_owned" | "to_owned", []) => {
                Value::Vector(items.to_vec())
            }
            ("transpose", []) => {
                Value::Matrix { rows: 1, columns: items.len(), entries: items.to_vec() }
            }
            ("fixed_rows", [start]) => {
                let start = usize::try_from(self.integer(start, "the first row", span)?).ok()?;
                let count = turbofish(call)?;
                match items.get(start..start.checked_add(count)?) {
                    Some(rows) => Value::Vector(rows.to_vec()),
                    None => {
                        let shown = format!("{start}..{}", start + count);
                        self.report(span, Mistake::IndexRange(shown, items.len()));
                        Value::Wrong
                    }
                }
            }
            ("xyz", []) if items.len() >= 3 => Value::Vector(items[..3].to_vec()),
            ("xy", []) if items.len() >= 2 => Value::Vector(items[..2].to_vec()),
            _ => return None,
        })
    }

    fn matrix_method(
        &mut self,
        name: &str,
        (rows, columns, entries): (usize, usize, &[Value]),
        call: &ExprMethodCall,
        arguments: &[Value],
    ) -> Option<Value> {
        let span = Span::of(call);
        let transposed = || Value::Matrix {
            rows: columns,
            columns: rows,
            entries: (0..columns)
                .flat_map(|j| (0..rows).map(move |i| entries[i * columns + j].clone()))
                .collect(),
        };
        Some(match (name, arguments) {
            ("transpose", []) => transposed(),
            ("tr_mul", [other]) => self.multiply(transposed(), other.clone(), span),
            ("clone" | "into_owned" | "clone_owned", []) => {
                Value::Matrix { rows, columns, entries: entries.to_vec() }
            }
            ("diagonal", []) => {
                let diagonal = (0..rows.min(columns)).map(|i| entries[i * columns + i].clone());
                Value::Vector(diagonal.collect())
            }
            ("column", [j]) => {
                let j = usize::try_from(self.integer(j, "the column", span)?).ok()?;
                let column = (0..rows).map(|i| entries.get(i * columns + j).cloned());
                Value::Vector(column.collect::<Option<_>>()?)
            }
            ("trace", []) => {
                let diagonal = (0..rows.min(columns)).map(|i| entries[i * columns + i].clone());
                let ones: Vec<Value> =
                    (0..rows.min(columns)).map(|_| self.constant(ratio(1, 1), span)).collect();
                self.dot(diagonal.collect(), ones, span)
            }
            _ => return None,
        })
    }
}

/// N of `method::<N>(…)`.
fn turbofish(call: &ExprMethodCall) -> Option<usize> {
    let generics = call.turbofish.as_ref()?;
    match generics.args.first()? {
        syn::GenericArgument::Const(syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Int(n), ..
        })) => n.base10_parse().ok(),
        _ => None,
    }
}
