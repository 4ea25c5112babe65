//! Names and places that take values: patterns, `let [x, y, z] = mu`, and assignments.

use syn::{Expr, Member, Pat};

use super::evaluate::{Evaluator, Flow};
use super::value::Value;
use crate::diagnostic::{Mistake, Span};

/// The name of a variable, and the indices that lead to one of its entries.
type Place = (String, Vec<Vec<usize>>);

impl Evaluator<'_> {
    /// Binds the names of a pattern to a value.
    pub(super) fn bind(&mut self, pattern: &Pat, value: Value) {
        match pattern {
            Pat::Ident(ident) => {
                if let Some((_, inner)) = &ident.subpat {
                    self.bind(inner, value.clone());
                }
                self.scopes.bind(ident.ident.to_string(), value);
            }
            Pat::Wild(_) => {}
            // `let x: f64 = …`: the compiler checks the type.
            Pat::Type(typed) => self.bind(&typed.pat, value),
            Pat::Reference(inner) => self.bind(&inner.pat, value),
            Pat::Paren(inner) => self.bind(&inner.pat, value),
            Pat::Slice(slice) => self.bind_list(slice.elems.iter().collect(), value, pattern),
            Pat::Tuple(tuple) => self.bind_list(tuple.elems.iter().collect(), value, pattern),
            _ => {
                let help = "use names, [a, b, c] or (a, b, c)";
                self.unsupported(Span::of(pattern), "this pattern is not read", help);
            }
        }
    }

    fn bind_list(&mut self, patterns: Vec<&Pat>, value: Value, whole: &Pat) {
        let values = match value {
            Value::List(values) => values,
            other => {
                if !matches!(other, Value::Wrong) {
                    let message = format!("{} cannot be taken apart like this", other.kind());
                    self.unsupported(Span::of(whole), &message, "index it instead");
                }
                return patterns.into_iter().for_each(|one| self.bind(one, Value::Wrong));
            }
        };
        // `..` stands for all entries that no other pattern takes.
        let rest = patterns.iter().position(|pattern| match pattern {
            Pat::Ident(ident) => {
                ident.subpat.as_ref().is_some_and(|(_, inner)| matches!(**inner, Pat::Rest(_)))
            }
            pattern => matches!(pattern, Pat::Rest(_)),
        });
        let count = patterns.len();
        let fits = match rest {
            Some(_) => count - 1 <= values.len(),
            None => count == values.len(),
        };
        if !fits {
            let message = format!("the pattern has {count} names for {} entries", values.len());
            self.unsupported(Span::of(whole), &message, "give as many");
        }
        for (i, pattern) in patterns.into_iter().enumerate() {
            if Some(i) == rest {
                if let Pat::Ident(ident) = pattern {
                    let taken = values.len().saturating_sub(count - 1);
                    let middle = values.iter().skip(i).take(taken).cloned();
                    self.scopes.bind(ident.ident.to_string(), Value::list(middle));
                }
                continue;
            }
            let behind = rest.is_some_and(|rest| i > rest);
            let position = if behind { (values.len() + i).checked_sub(count) } else { Some(i) };
            let value = position.and_then(|at| values.get(at)).cloned().unwrap_or(Value::Wrong);
            self.bind(pattern, value);
        }
    }

    /// Gives `value` to the place that `expression` names.
    pub(super) fn assign(&mut self, expression: &Expr, value: Value) -> Result<(), Flow> {
        let span = Span::of(expression);
        let (name, path) = match self.place(expression) {
            Err(Flow::Wrong) => return Ok(()),
            Err(flow) => return Err(flow),
            Ok(Some(place)) => place,
            Ok(None) => {
                // `(a, b) = (b, a)` and the like.
                if let Expr::Tuple(syn::ExprTuple { elems, .. })
                | Expr::Array(syn::ExprArray { elems, .. }) = expression
                    && let Value::List(values) = &value
                    && elems.len() == values.len()
                {
                    for (target, value) in elems.iter().zip(values.iter()) {
                        self.assign(target, value.clone())?;
                    }
                } else if !matches!(expression, Expr::Infer(_)) {
                    self.unsupported(span, "this cannot be assigned to", "assign to a variable");
                }
                return Ok(());
            }
        };
        let Some(mut target) = self.scopes.get_mut(&name) else { return Ok(()) };
        for index in &path {
            let kind = target.kind();
            if matches!(target, Value::Wrong) {
                return Ok(());
            }
            match target.entry_mut(index) {
                Ok(entry) => target = entry,
                Err(length) => {
                    self.bad_index(span, index, length, kind);
                    return Ok(());
                }
            }
        }
        *target = value;
        Ok(())
    }

    /// The variable of which an expression names an entry, and the indices that lead to it; `None` for other expressions.
    fn place(&mut self, expression: &Expr) -> Result<Option<Place>, Flow> {
        match expression {
            Expr::Path(path) => {
                let name = path.path.get_ident().map(ToString::to_string);
                let known = name.filter(|name| self.scopes.get(name).is_some());
                Ok(known.map(|name| (name, Vec::new())))
            }
            Expr::Paren(inner) => self.place(&inner.expr),
            Expr::Group(inner) => self.place(&inner.expr),
            Expr::Reference(inner) => self.place(&inner.expr),
            Expr::Unary(syn::ExprUnary { op: syn::UnOp::Deref(_), expr, .. }) => self.place(expr),
            Expr::Field(field) => {
                let place = self.place(&field.base)?.zip(member(&field.member));
                Ok(place.map(|((name, path), index)| (name, [path, vec![vec![index]]].concat())))
            }
            Expr::Index(index) if !matches!(*index.index, Expr::Range(_)) => {
                let Some((name, mut path)) = self.place(&index.expr)? else { return Ok(None) };
                path.push(self.index(&index.index)?);
                Ok(Some((name, path)))
            }
            _ => Ok(None),
        }
    }

    /// `i` or `(i, j)`, known.
    ///
    /// # Errors
    /// [`Flow::Wrong`] where it is not.
    pub(super) fn index(&mut self, expression: &Expr) -> Result<Vec<usize>, Flow> {
        let parts = match self.expression(expression)? {
            Value::List(parts) => parts.to_vec(),
            single => vec![single],
        };
        let mut index = Vec::new();
        for part in parts {
            let known = self.integer(&part, "an index", Span::of(expression)).ok_or(Flow::Wrong)?;
            index.push(usize::try_from(known).unwrap_or(usize::MAX));
        }
        Ok(index)
    }

    /// An entry of a value.
    pub(super) fn entry(&mut self, base: &Value, index: &[usize], span: Span) -> Value {
        match base.entry(index) {
            Ok(value) => value,
            Err(_) if matches!(base, Value::Wrong) => Value::Wrong,
            Err(length) => self.bad_index(span, index, length, base.kind()),
        }
    }

    fn bad_index(&mut self, span: Span, index: &[usize], length: usize, kind: &str) -> Value {
        if length == 0 {
            let message = format!("{kind} has no entries to choose from");
            return self.unsupported(span, &message, "index arrays, vectors or matrices only");
        }
        let shown = index.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        self.wrong(span, Mistake::IndexRange(shown, length))
    }
}

/// `.x`, `.y`, … of a vector, `.0`, `.1`, … of a tuple, as positions.
pub(super) fn member(member: &Member) -> Option<usize> {
    match member {
        Member::Unnamed(index) => Some(index.index as usize),
        Member::Named(name) => ["x", "y", "z", "w", "a", "b"].iter().position(|n| name == n),
    }
}
