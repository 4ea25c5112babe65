//! Loops, ranges and iterator chains: everything whose length is known.

use syn::{Expr, ExprRange, RangeLimits};

use super::evaluate::{Evaluator, Flow};
use super::value::Value;
use crate::diagnostic::{Mistake, Span};

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
        Ok(Value::List(list))
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
                    this.report(Span::of(range), Mistake::NotConstant("the end of a range"));
                }
                return Ok(default);
            };
            let value = this.expression(bound)?;
            Ok(this.integer(&value, "the bound of a range", Span::of(bound)))
        };
        let start = bound(self, &range.start, open.map(|_| 0))?;
        let end = bound(self, &range.end, open.map(|n| n as i128))?;
        let inclusive = matches!(range.limits, RangeLimits::Closed(_)) && range.end.is_some();
        Ok(start
            .zip(end)
            .map(|(start, end)| (start, if inclusive { end.saturating_add(1) } else { end })))
    }

    /// `base[start..end]`.
    pub(super) fn slice(&mut self, base: Value, range: &ExprRange) -> Result<Value, Flow> {
        let (Value::List(list) | Value::Vector(list)) = base else { return Ok(Value::Wrong) };
        let Some((start, end)) = self.bounds(range, Some(list.len()))? else {
            return Ok(Value::Wrong);
        };
        let bound = |i: i128| usize::try_from(i).ok().filter(|&i| i <= list.len());
        Ok(match (bound(start), bound(end)) {
            (Some(start), Some(end)) if start <= end => Value::List(list[start..end].to_vec()),
            _ => {
                let shown = format!("{start}..{end}");
                self.report(Span::of(range), Mistake::IndexRange(shown, list.len()));
                Value::Wrong
            }
        })
    }

    /// `for pattern in list { … }`.
    pub(super) fn for_loop(&mut self, for_loop: &syn::ExprForLoop) -> Result<Value, Flow> {
        let span = Span::of(&for_loop.expr);
        let items = match self.expression(&for_loop.expr)? {
            Value::List(items) | Value::Vector(items) => items,
            Value::Matrix { entries, .. } => entries,
            Value::Wrong => return Ok(Value::Wrong),
            _ => {
                let help = "loop over a range such as 0..3, or over an array";
                return Ok(self.unsupported(span, "this cannot be looped over", help));
            }
        };
        for item in items {
            self.tick(span)?;
            self.scopes.enter();
            self.bind(&for_loop.pat, item);
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
    ) -> Option<Result<Value, Flow>> {
        let span = Span::of(call);
        let count = |this: &mut Self| {
            let value = arguments.first()?;
            let n = this.integer(value, "this number", Span::of(&call.args))?;
            usize::try_from(n).ok()
        };
        let list = match (call.method.to_string().as_str(), arguments) {
            (
                "iter" | "iter_mut" | "into_iter" | "copied" | "cloned" | "clone" | "to_vec"
                | "as_slice" | "as_ref" | "collect" | "to_owned" | "by_ref",
                [],
            ) => items.to_vec(),
            ("len" | "count", []) => return Some(Ok(Value::Integer(items.len() as i128))),
            ("rev", []) => items.iter().rev().cloned().collect(),
            ("enumerate", []) => {
                let pair = |(i, v): (usize, &Value)| {
                    Value::List(vec![Value::Integer(i as i128), v.clone()])
                };
                items.iter().enumerate().map(pair).collect()
            }
            ("zip" | "chain", [Value::List(other) | Value::Vector(other)]) => {
                if call.method == "chain" {
                    items.iter().chain(other).cloned().collect()
                } else {
                    let pair = |(a, b): (&Value, &Value)| Value::List(vec![a.clone(), b.clone()]);
                    items.iter().zip(other).map(pair).collect()
                }
            }
            ("take", [_]) => items.iter().take(count(self)?).cloned().collect(),
            ("skip", [_]) => items.iter().skip(count(self)?).cloned().collect(),
            ("step_by", [_]) => items.iter().step_by(count(self)?.max(1)).cloned().collect(),
            ("windows", [_]) => {
                items.windows(count(self)?.max(1)).map(|w| Value::List(w.to_vec())).collect()
            }
            ("map", [Value::Function(function)]) => {
                let mut mapped = Vec::new();
                for item in items {
                    match self.apply(function, vec![item.clone()], span) {
                        Ok(value) => mapped.push(value),
                        Err(flow) => return Some(Err(flow)),
                    }
                }
                mapped
            }
            ("flat_map", [Value::Function(function)]) => {
                let mut mapped = Vec::new();
                for item in items {
                    match self.apply(function, vec![item.clone()], span) {
                        Ok(Value::List(values)) => mapped.extend(values),
                        Ok(other) => mapped.push(other),
                        Err(flow) => return Some(Err(flow)),
                    }
                }
                mapped
            }
            ("filter", [Value::Function(function)]) => {
                let mut kept = Vec::new();
                for item in items {
                    match self.apply(function, vec![item.clone()], span) {
                        Ok(Value::Bool(true)) => kept.push(item.clone()),
                        Ok(Value::Bool(false) | Value::Wrong) => {}
                        Ok(_) => {
                            self.report(span, Mistake::NotConstant("the condition of a filter"));
                            return Some(Ok(Value::Wrong));
                        }
                        Err(flow) => return Some(Err(flow)),
                    }
                }
                kept
            }
            ("fold", [start, Value::Function(function)]) => {
                let mut value = start.clone();
                for item in items {
                    match self.apply(function, vec![value, item.clone()], span) {
                        Ok(next) => value = next,
                        Err(flow) => return Some(Err(flow)),
                    }
                }
                return Some(Ok(value));
            }
            ("sum" | "product", []) => {
                let sum = call.method == "sum";
                return Some(self.accumulate(items, sum, span));
            }
            _ => return None,
        };
        Some(Ok(Value::List(list)))
    }

    fn accumulate(&mut self, items: &[Value], sum: bool, span: Span) -> Result<Value, Flow> {
        let mut items = items.iter().cloned();
        let Some(mut value) = items.next() else {
            let neutral = crate::number::integer(i64::from(!sum));
            return Ok(self.constant(neutral, span));
        };
        for item in items {
            self.tick(span)?;
            value =
                if sum { self.add(value, item, span) } else { self.multiply(value, item, span) };
        }
        Ok(value)
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
