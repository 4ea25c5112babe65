//! Loops, ranges and iterator chains: everything whose length is known.

use std::rc::Rc;

use syn::{Expr, ExprRange, RangeLimits};

use super::evaluate::{Evaluator, Flow};
use super::function::Callable;
use super::value::Value;
use crate::diagnostic::{Mistake, Span};
use crate::number::integer;

impl Evaluator<'_> {
    /// The integers of a range.
    pub(super) fn range(&mut self, range: &ExprRange) -> Result<Value, Flow> {
        let span = Span::of(range);
        let Some((start, end)) = self.bounds(range, None)? else { return Ok(Value::Wrong) };
        let mut list = Vec::new();
        for i in start..end {
            self.tick(span)?;
            list.push(Value::Integer(i));
        }
        Ok(Value::list(list))
    }

    /// Start and end (excluded) of a range; an open end is `open`.
    fn bounds(
        &mut self,
        range: &ExprRange,
        open: Option<usize>,
    ) -> Result<Option<(i128, i128)>, Flow> {
        let bound = |this: &mut Self, bound: &Option<Box<Expr>>, default: Option<i128>| {
            let Some(bound) = bound else {
                if default.is_none() {
                    this.wrong(Span::of(range), Mistake::NotConstant("the end of a range"));
                }
                return Ok(default);
            };
            let value = this.expression(bound)?;
            Ok(this.integer(&value, "the bound of a range", Span::of(bound)))
        };
        let start = bound(self, &range.start, open.map(|_| 0))?;
        let end = bound(self, &range.end, open.map(|n| n as i128))?;
        let inclusive = matches!(range.limits, RangeLimits::Closed(_)) && range.end.is_some();
        let end = end.map(|end| if inclusive { end.saturating_add(1) } else { end });
        Ok(start.zip(end))
    }

    /// `base[start..end]`.
    pub(super) fn slice(&mut self, base: &Value, range: &ExprRange) -> Result<Value, Flow> {
        let Some(list) = base.iterated() else { return Ok(Value::Wrong) };
        let Some((start, end)) = self.bounds(range, Some(list.len()))? else {
            return Ok(Value::Wrong);
        };
        let slice = usize::try_from(start).ok().zip(usize::try_from(end).ok());
        Ok(match slice.and_then(|(start, end)| list.get(start..end)) {
            Some(slice) => Value::list(slice.to_vec()),
            None => {
                let shown = format!("{start}..{end}");
                self.wrong(Span::of(range), Mistake::IndexRange(shown, list.len()))
            }
        })
    }

    /// `for pattern in list { … }`.
    pub(super) fn for_loop(&mut self, for_loop: &syn::ExprForLoop) -> Result<Value, Flow> {
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
            if ends(flow)? {
                break;
            }
        }
        Ok(Value::Unit)
    }

    /// `while condition { … }`, as long as the condition is known.
    pub(super) fn while_loop(&mut self, while_loop: &syn::ExprWhile) -> Result<Value, Flow> {
        loop {
            self.tick(Span::of(&while_loop.cond))?;
            match self.condition(&while_loop.cond)? {
                Some(true) => {}
                Some(false) => return Ok(Value::Unit),
                None => return Ok(Value::Wrong),
            }
            if ends(self.block(&while_loop.body))? {
                return Ok(Value::Unit);
            }
        }
    }

    /// `loop { … }`.
    pub(super) fn forever(&mut self, forever: &syn::ExprLoop) -> Result<Value, Flow> {
        loop {
            self.tick(Span::of(&forever.loop_token))?;
            if ends(self.block(&forever.body))? {
                return Ok(Value::Unit);
            }
        }
    }

    /// Methods of arrays and iterators; `None` if there is no such method.
    pub(super) fn list_method(
        &mut self,
        items: &[Value],
        call: &syn::ExprMethodCall,
        arguments: &[Value],
    ) -> Result<Option<Value>, Flow> {
        let span = Span::of(call);
        let pair = |(a, b): (Value, &Value)| Value::list([a, b.clone()]);
        let list = match (call.method.to_string().as_str(), arguments) {
            (
                "iter" | "iter_mut" | "into_iter" | "copied" | "cloned" | "clone" | "to_vec"
                | "as_slice" | "as_ref" | "collect" | "to_owned" | "by_ref",
                [],
            ) => items.to_vec(),
            ("len" | "count", []) => return Ok(Some(Value::Integer(items.len() as i128))),
            ("rev", []) => items.iter().rev().cloned().collect(),
            ("enumerate", []) => (0..).map(Value::Integer).zip(items).map(pair).collect(),
            ("zip", [other]) => match other.iterated() {
                Some(other) => items.iter().cloned().zip(other.iter()).map(pair).collect(),
                None => return Ok(None),
            },
            ("chain", [other]) => match other.iterated() {
                Some(other) => items.iter().chain(other.iter()).cloned().collect(),
                None => return Ok(None),
            },
            (name @ ("take" | "skip" | "step_by" | "windows"), [count]) => {
                let count = self.integer(count, "this number", Span::of(&call.args));
                let Some(n) = count.and_then(|n| usize::try_from(n).ok()) else { return Ok(None) };
                match name {
                    "take" => items.iter().take(n).cloned().collect(),
                    "skip" => items.iter().skip(n).cloned().collect(),
                    "step_by" => items.iter().step_by(n.max(1)).cloned().collect(),
                    _ => items.windows(n.max(1)).map(|w| Value::list(w.to_vec())).collect(),
                }
            }
            ("map", [Value::Function(function)]) => self.mapped(items, function, span)?,
            ("flat_map", [Value::Function(function)]) => {
                let mapped = self.mapped(items, function, span)?.into_iter();
                let flat = mapped.flat_map(|value| match value {
                    Value::List(values) => values.to_vec(),
                    other => vec![other],
                });
                flat.collect()
            }
            ("filter", [Value::Function(function)]) => {
                let mut kept = Vec::new();
                for (item, keep) in items.iter().zip(self.mapped(items, function, span)?) {
                    match keep {
                        Value::Bool(true) => kept.push(item.clone()),
                        Value::Bool(false) | Value::Wrong => {}
                        _ => {
                            let unknown = Mistake::NotConstant("the condition of a filter");
                            return Ok(Some(self.wrong(span, unknown)));
                        }
                    }
                }
                kept
            }
            ("fold", [start, Value::Function(function)]) => {
                let mut value = start.clone();
                for item in items {
                    value = self.apply(function, vec![value, item.clone()], span)?;
                }
                return Ok(Some(value));
            }
            (name @ ("sum" | "product"), []) => {
                let operation = if name == "sum" { Self::add } else { Self::multiply };
                let Some((first, items)) = items.split_first() else {
                    let neutral = integer(i64::from(name == "product"));
                    return Ok(Some(self.constant(neutral, span)));
                };
                let mut value = first.clone();
                for item in items {
                    self.tick(span)?;
                    value = operation(self, value, item.clone(), span);
                }
                return Ok(Some(value));
            }
            _ => return Ok(None),
        };
        Ok(Some(Value::list(list)))
    }

    /// The values of a function at items.
    fn mapped(
        &mut self,
        items: &[Value],
        function: &Rc<Callable>,
        span: Span,
    ) -> Result<Vec<Value>, Flow> {
        items.iter().map(|item| self.apply(function, vec![item.clone()], span)).collect()
    }
}

/// Whether the body of a loop ended the loop.
fn ends(flow: Result<Value, Flow>) -> Result<bool, Flow> {
    match flow {
        Ok(_) | Err(Flow::Continue | Flow::Wrong) => Ok(false),
        Err(Flow::Break) => Ok(true),
        Err(flow) => Err(flow),
    }
}
