//! Running a function's expressions with symbols.

use syn::{Block, Expr, Lit, UnOp};

use super::assign::member;
use super::scope::Scopes;
use super::value::Value;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::{Arena, ExprId, Node};
use crate::number::Rational;
use crate::parse::decimal;

/// The most operations a function may run through.
const MOST_OPERATIONS: usize = 200_000;
/// The most calls of closures and functions inside each other.
pub(super) const DEEPEST_CALL: usize = 24;

/// Why an expression has no value.
#[derive(Debug)]
pub(super) enum Flow {
    /// `return`.
    Return(Value),
    /// `break`.
    Break,
    /// `continue`.
    Continue,
    /// An operand was wrong, which has been reported.
    Wrong,
    /// A limit was passed, which has been reported; nothing more is read.
    Stop,
}

/// The state of reading one function.
pub(super) struct Evaluator<'a> {
    pub(super) scopes: Scopes,
    pub(super) calls: usize,
    arena: Arena,
    diagnostics: &'a Diagnostics,
    operations: usize,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(diagnostics: &'a Diagnostics) -> Self {
        Self {
            scopes: Scopes::default(),
            calls: 0,
            arena: Arena::new(),
            diagnostics,
            operations: 0,
        }
    }

    pub(super) fn into_arena(self) -> Arena {
        self.arena
    }

    /// Reports a mistake, and stands for it.
    pub(super) fn wrong(&mut self, span: Span, mistake: Mistake) -> Value {
        self.diagnostics.report(span, mistake);
        Value::Wrong
    }

    /// Reports something that is not read, and stands for it.
    pub(super) fn unsupported(&mut self, span: Span, what: &str, help: &str) -> Value {
        self.diagnostics.report_other(span, what, help);
        Value::Wrong
    }

    pub(super) fn push(&mut self, node: Node, span: Span) -> Value {
        Value::Number(self.arena.push(node, span))
    }

    /// Counts an operation.
    pub(super) fn tick(&mut self, span: Span) -> Result<(), Flow> {
        self.operations += 1;
        if self.operations <= MOST_OPERATIONS {
            return Ok(());
        }
        self.wrong(span, Mistake::LongLoop(MOST_OPERATIONS));
        Err(Flow::Stop)
    }

    /// The Hamiltonian the body of a function computes, and where.
    pub(super) fn body(&mut self, block: &Block) -> Option<(ExprId, Span)> {
        let value = match self.block(block) {
            Ok(value) | Err(Flow::Return(value)) => value,
            Err(_) => return None,
        };
        let result = block.stmts.last().map_or(Span::of(block), Span::of);
        match value {
            Value::Number(id) => Some((id, result)),
            Value::Wrong => None,
            other => {
                let message = format!("the function must end with a number, not {}", other.kind());
                self.unsupported(result, &message, "end it with the energy, without a semicolon");
                None
            }
        }
    }

    pub(super) fn constant(&mut self, value: Rational, span: Span) -> Value {
        self.push(Node::Number(value), span)
    }

    /// The integer a value is, known.
    pub(super) fn integer(
        &mut self,
        value: &Value,
        what: &'static str,
        span: Span,
    ) -> Option<i128> {
        match value {
            Value::Integer(n) => Some(*n),
            Value::Wrong => None,
            _ => {
                self.wrong(span, Mistake::NotConstant(what));
                None
            }
        }
    }

    /// The value of an expression.
    pub(super) fn expression(&mut self, expression: &Expr) -> Result<Value, Flow> {
        let span = || Span::of(expression);
        match expression {
            Expr::Lit(literal) => Ok(self.literal(&literal.lit)),
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Reference(inner) => self.expression(&inner.expr),
            Expr::Unary(syn::ExprUnary { op: UnOp::Deref(_), expr, .. }) => self.expression(expr),
            Expr::Block(block) if block.label.is_none() => self.block(&block.block),
            Expr::Unsafe(block) => self.block(&block.block),
            Expr::Const(block) => self.block(&block.block),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(unary) => {
                let value = self.expression(&unary.expr)?;
                self.tick(span())?;
                Ok(match (unary.op, value) {
                    (UnOp::Neg(_), value) => self.negate(value, span()),
                    (_, Value::Bool(truth)) => Value::Bool(!truth),
                    (_, Value::Wrong) => Value::Wrong,
                    _ => self.unsupported(span(), "`!` of this is not known", ""),
                })
            }
            Expr::Cast(cast) => {
                let value = self.expression(&cast.expr)?;
                Ok(self.cast(value, &cast.ty, span()))
            }
            Expr::Tuple(tuple) if tuple.elems.is_empty() => Ok(Value::Unit),
            Expr::Array(syn::ExprArray { elems, .. })
            | Expr::Tuple(syn::ExprTuple { elems, .. }) => {
                let values: Result<Vec<Value>, Flow> =
                    elems.iter().map(|entry| self.expression(entry)).collect();
                Ok(Value::list(values?))
            }
            Expr::Repeat(repeat) => {
                let value = self.expression(&repeat.expr)?;
                let count = self.expression(&repeat.len)?;
                let place = Span::of(&repeat.len);
                let Some(count) = self.integer(&count, "the length of an array", place) else {
                    return Ok(Value::Wrong);
                };
                let count = usize::try_from(count).unwrap_or(0);
                if count > MOST_OPERATIONS {
                    self.operations = MOST_OPERATIONS;
                    self.tick(place)?;
                }
                Ok(Value::list(vec![value; count]))
            }
            Expr::Range(range) => self.range(range),
            Expr::Index(index) => {
                let base = self.expression(&index.expr)?;
                if let Expr::Range(range) = &*index.index {
                    return self.slice(&base, range);
                }
                match self.index(&index.index) {
                    Ok(index) => Ok(self.entry(&base, &index, span())),
                    Err(Flow::Wrong) => Ok(Value::Wrong),
                    Err(flow) => Err(flow),
                }
            }
            Expr::Field(field) => {
                let base = self.expression(&field.base)?;
                Ok(match member(&field.member) {
                    Some(index) => self.entry(&base, &[index], span()),
                    None => self.unsupported(span(), "this field is not known", ""),
                })
            }
            Expr::Assign(assign) => {
                let value = self.expression(&assign.right)?;
                self.assign(&assign.left, value)?;
                Ok(Value::Unit)
            }
            Expr::If(branch) => self.branch(branch),
            Expr::ForLoop(for_loop) => self.for_loop(for_loop),
            Expr::While(while_loop) => self.while_loop(while_loop),
            Expr::Loop(forever) => self.forever(forever),
            Expr::Break(end) if end.label.is_none() && end.expr.is_none() => Err(Flow::Break),
            Expr::Continue(next) if next.label.is_none() => Err(Flow::Continue),
            Expr::Return(end) => {
                let value = end.expr.as_ref().map_or(Ok(Value::Unit), |e| self.expression(e))?;
                Err(Flow::Return(value))
            }
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Closure(closure) => Ok(self.closure(closure)),
            Expr::Path(path) => Ok(self.path(&path.path)),
            _ => Ok(self.unsupported(
                span(),
                "this kind of expression is not read",
                "use arithmetic, let, literal loops, closures and functions of parameters",
            )),
        }
    }

    fn literal(&mut self, literal: &Lit) -> Value {
        let span = Span::of(literal);
        let digits = match literal {
            Lit::Float(number) => number.base10_digits(),
            Lit::Int(number) if matches!(number.suffix(), "f64" | "f32") => number.base10_digits(),
            Lit::Int(number) => {
                let digits = number.base10_digits();
                return match digits.parse() {
                    Ok(value) => Value::Integer(value),
                    Err(_) => self.wrong(span, Mistake::NumberSize(digits.to_owned())),
                };
            }
            Lit::Bool(truth) => return Value::Bool(truth.value),
            _ => return self.unsupported(span, "only numbers make sense here", ""),
        };
        match decimal(digits) {
            Ok(value) => self.constant(value, span),
            Err(mistake) => self.wrong(span, mistake),
        }
    }
}
