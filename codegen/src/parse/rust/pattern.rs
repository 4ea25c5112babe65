//! Patterns: `let [x, y, z] = mu`.

use syn::Pat;

use super::evaluate::Evaluator;
use super::value::Value;
use crate::diagnostic::{Mistake, Span};

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
            Pat::Type(typed) => {
                // `let x: f64 = …`: the compiler checks the type.
                self.bind(&typed.pat, value);
            }
            Pat::Reference(inner) => self.bind(&inner.pat, value),
            Pat::Paren(inner) => self.bind(&inner.pat, value),
            Pat::Slice(slice) => self.bind_list(slice.elems.iter().collect(), value, pattern),
            Pat::Tuple(tuple) => self.bind_list(tuple.elems.iter().collect(), value, pattern),
            _ => {
                self.unsupported(
                    Span::of(pattern),
                    "this pattern is not read",
                    "use names, [a, b, c] or (a, b, c)",
                );
            }
        }
    }

    fn bind_list(&mut self, patterns: Vec<&Pat>, value: Value, whole: &Pat) {
        let values = match value {
            Value::List(values) => values,
            Value::Wrong => {
                for pattern in patterns {
                    self.bind(pattern, Value::Wrong);
                }
                return;
            }
            other => {
                let message = format!("{} cannot be taken apart like this", other.kind());
                self.unsupported(Span::of(whole), &message, "index it instead");
                for pattern in patterns {
                    self.bind(pattern, Value::Wrong);
                }
                return;
            }
        };
        // `..` stands for all entries that no other pattern takes.
        let rest = patterns.iter().position(|p| match p {
            Pat::Rest(_) => true,
            Pat::Ident(ident) => {
                ident.subpat.as_ref().is_some_and(|(_, inner)| matches!(**inner, Pat::Rest(_)))
            }
            _ => false,
        });
        let fits = match rest {
            Some(_) => patterns.len() - 1 <= values.len(),
            None => patterns.len() == values.len(),
        };
        if !fits {
            let message =
                format!("the pattern has {} names for {} entries", patterns.len(), values.len());
            self.report(Span::of(whole), Mistake::Unsupported(message, "give as many".to_owned()));
        }
        let count = patterns.len();
        let before = rest.unwrap_or(count);
        for (i, pattern) in patterns.into_iter().enumerate() {
            if Some(i) == rest {
                if let Pat::Ident(ident) = pattern {
                    let taken = values.len().saturating_sub(count - 1);
                    let middle = values.iter().skip(i).take(taken).cloned().collect();
                    self.scopes.bind(ident.ident.to_string(), Value::List(middle));
                }
                continue;
            }
            let position = if i < before { Some(i) } else { (values.len() + i).checked_sub(count) };
            let value = position.and_then(|at| values.get(at)).cloned().unwrap_or(Value::Wrong);
            self.bind(pattern, value);
        }
    }
}
