//! Places: variables, and entries of them, to be read without copying or to be assigned.

use syn::{Expr, Member};

use super::evaluate::{Evaluator, Flow};
use super::value::Value;
use crate::diagnostic::{Mistake, Span};

/// A variable, followed by indices.
struct Place {
    name: String,
    path: Vec<Vec<usize>>,
}

impl Evaluator<'_> {
    /// The value of an expression that names a variable or an entry of one; `None` for others.
    pub(super) fn read_place(&mut self, expression: &Expr) -> Option<Result<Value, Flow>> {
        let place = match self.place(expression)? {
            Ok(place) => place,
            Err(Flow::Wrong) => return Some(Ok(Value::Wrong)),
            Err(flow) => return Some(Err(flow)),
        };
        let mut value = self.scopes.get(&place.name)?;
        for index in &place.path {
            match value.entry(index) {
                Ok(entry) => value = entry,
                Err(_) if matches!(value, Value::Wrong) => return Some(Ok(Value::Wrong)),
                Err(length) => {
                    let kind = value.kind();
                    return Some(Ok(self.bad_index(Span::of(expression), index, length, kind)));
                }
            }
        }
        Some(Ok(value.clone()))
    }

    /// Gives `value` to the place that `expression` names.
    pub(super) fn assign(&mut self, expression: &Expr, value: Value) -> Result<(), Flow> {
        let span = Span::of(expression);
        let place = match self.place(expression) {
            Some(Err(Flow::Wrong)) => return Ok(()),
            place => place.transpose()?,
        };
        let Some(place) = place else {
            // `(a, b) = (b, a)` and the like.
            if let Expr::Tuple(syn::ExprTuple { elems, .. })
            | Expr::Array(syn::ExprArray { elems, .. }) = expression
                && let Value::List(values) = value
                && elems.len() == values.len()
            {
                for (target, value) in elems.iter().zip(values) {
                    self.assign(target, value)?;
                }
                return Ok(());
            }
            if !matches!(expression, Expr::Infer(_)) {
                self.unsupported(span, "this cannot be assigned to", "assign to a variable");
            }
            return Ok(());
        };
        let Some(mut target) = self.scopes.get_mut(&place.name) else { return Ok(()) };
        for index in &place.path {
            if matches!(target, Value::Wrong) {
                return Ok(());
            }
            let (kind, length) = (target.kind(), target.entry(index).err().unwrap_or(0));
            match target.entry_mut(index) {
                Some(entry) => target = entry,
                None => {
                    self.bad_index(span, index, length, kind);
                    return Ok(());
                }
            }
        }
        *target = value;
        Ok(())
    }

    fn place(&mut self, expression: &Expr) -> Option<Result<Place, Flow>> {
        match expression {
            Expr::Path(path) => {
                let name = path.path.get_ident()?.to_string();
                self.scopes.get(&name)?;
                Some(Ok(Place { name, path: Vec::new() }))
            }
            Expr::Paren(inner) => self.place(&inner.expr),
            Expr::Group(inner) => self.place(&inner.expr),
            Expr::Reference(inner) => self.place(&inner.expr),
            Expr::Unary(syn::ExprUnary { op: syn::UnOp::Deref(_), expr, .. }) => self.place(expr),
            Expr::Field(field) => {
                let index = member(&field.member)?;
                let base = self.place(&field.base)?;
                Some(base.map(|mut place| {
                    place.path.push(vec![index]);
                    place
                }))
            }
            Expr::Index(index) => {
                let mut place = match self.place(&index.expr)? {
                    Ok(place) => place,
                    Err(flow) => return Some(Err(flow)),
                };
                match self.index(&index.index)? {
                    Ok(position) => {
                        place.path.push(position);
                        Some(Ok(place))
                    }
                    Err(flow) => Some(Err(flow)),
                }
            }
            _ => None,
        }
    }

    /// `i` or `(i, j)`, known; `None` for anything else, such as a range.
    pub(super) fn index(&mut self, expression: &Expr) -> Option<Result<Vec<usize>, Flow>> {
        if matches!(expression, Expr::Range(_)) {
            return None;
        }
        let value = match self.expression(expression) {
            Ok(value) => value,
            Err(flow) => return Some(Err(flow)),
        };
        let span = Span::of(expression);
        let parts = match value {
            Value::List(parts) => parts,
            single => vec![single],
        };
        let mut index = Vec::new();
        for part in parts {
            match part {
                Value::Integer(i) => index.push(usize::try_from(i).unwrap_or(usize::MAX)),
                Value::Wrong => return Some(Err(Flow::Wrong)),
                _ => {
                    self.report(span, Mistake::NotConstant("an index"));
                    return Some(Err(Flow::Wrong));
                }
            }
        }
        Some(Ok(index))
    }

    pub(super) fn bad_index(
        &mut self,
        span: Span,
        index: &[usize],
        length: usize,
        kind: &'static str,
    ) -> Value {
        if length == 0 {
            let message = format!("{kind} has no entries to choose from");
            return self.unsupported(span, &message, "index arrays, vectors or matrices only");
        }
        let shown = index.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        self.report(span, Mistake::IndexRange(shown, length));
        Value::Wrong
    }
}

/// `.x`, `.y`, … of a vector, `.0`, `.1`, … of a tuple, as positions.
pub(super) fn member(member: &Member) -> Option<usize> {
    match member {
        Member::Unnamed(index) => Some(index.index as usize),
        Member::Named(name) => ["x", "y", "z", "w", "a", "b"].iter().position(|n| name == n),
    }
}
