//! Paths, calls, closures and functions of the body.

use std::rc::Rc;

use syn::{Expr, ExprCall, Pat, Path};

use super::evaluate::{DEEPEST_CALL, Evaluator, Flow};
use super::scope::Scopes;
use super::signature::{sized, sizes};
use super::value::{Matrix, Value};
use crate::diagnostic::{Mistake, Span, nearest};
use crate::number::{Rational, integer};
use crate::problem::Shape;

/// A closure, or a function defined in the body.
pub(super) struct Callable {
    parameters: Vec<Pat>,
    body: Expr,
    /// The names visible where it was written. (A function sees items only; the compiler checks.)
    scopes: Scopes,
}

impl std::fmt::Debug for Callable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "function of {} arguments", self.parameters.len())
    }
}

impl Evaluator<'_> {
    pub(super) fn closure(&mut self, closure: &syn::ExprClosure) -> Value {
        Value::Function(Rc::new(Callable {
            parameters: closure.inputs.iter().cloned().collect(),
            body: (*closure.body).clone(),
            scopes: self.scopes.clone(),
        }))
    }

    pub(super) fn function_item(&mut self, function: &syn::ItemFn) -> Value {
        let mut parameters = Vec::new();
        for input in &function.sig.inputs {
            match input {
                syn::FnArg::Typed(typed) => parameters.push((*typed.pat).clone()),
                syn::FnArg::Receiver(_) => return Value::Wrong,
            }
        }
        let block =
            syn::ExprBlock { attrs: Vec::new(), label: None, block: (*function.block).clone() };
        Value::Function(Rc::new(Callable {
            parameters,
            body: Expr::Block(block),
            scopes: self.scopes.clone(),
        }))
    }

    /// Calls a closure or a function of the body.
    pub(super) fn apply(
        &mut self,
        function: &Rc<Callable>,
        arguments: Vec<Value>,
        span: Span,
    ) -> Result<Value, Flow> {
        self.tick(span)?;
        if self.calls >= DEEPEST_CALL {
            self.unsupported(span, "functions call each other too deeply", "unroll the recursion");
            return Err(Flow::Stop);
        }
        let outside = std::mem::replace(&mut self.scopes, function.scopes.clone());
        self.calls += 1;
        self.scopes.enter();
        for (pattern, argument) in function.parameters.iter().zip(arguments) {
            self.bind(pattern, argument);
        }
        let value = self.expression(&function.body);
        self.calls -= 1;
        self.scopes = outside;
        match value {
            Err(Flow::Return(value)) => Ok(value),
            other => other,
        }
    }

    /// The value of a variable or a known constant; other names are reported.
    pub(super) fn path(&mut self, path: &Path) -> Value {
        let variable = path.get_ident().and_then(|name| self.scopes.get(&name.to_string()));
        if let Some(value) = variable {
            return value.clone();
        }
        let span = Span::of(path);
        let segments: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        let last = segments.last().map(String::as_str).unwrap_or_default();
        if segments.iter().any(|s| s == "consts")
            && let Some(value) = float_constant(last)
        {
            return self.constant(value, span);
        }
        if let [name] = &segments[..] {
            let names = self.scopes.names();
            let suggestion = nearest(name, names.iter().map(String::as_str)).map(str::to_owned);
            let constant = name.chars().all(|c| c.is_uppercase() || c == '_' || c.is_numeric());
            if constant && suggestion.is_none() {
                let message = format!("the constant `{name}` is not visible here");
                let help = "define it with `const` inside the function, or pass it as a parameter";
                return self.unsupported(span, &message, help);
            }
            return self.wrong(span, Mistake::UnknownVariable(name.clone(), suggestion, names));
        }
        let message = format!("`{}` is not read", segments.join("::"));
        self.unsupported(span, &message, "write its value, or pass it as a parameter")
    }

    /// `function(arguments)`.
    pub(super) fn call(&mut self, call: &ExprCall) -> Result<Value, Flow> {
        let span = Span::of(call);
        let mut arguments = Vec::new();
        for argument in &call.args {
            arguments.push(self.expression(argument)?);
        }
        let function = match &*call.func {
            Expr::Path(path) => {
                let name = path.path.get_ident().map(ToString::to_string);
                name.and_then(|name| self.scopes.get(&name)).cloned()
            }
            expression => Some(self.expression(expression)?),
        };
        if let Some(Value::Function(function)) = function {
            return self.apply(&function, arguments, span);
        }
        let Expr::Path(path) = &*call.func else {
            return Ok(self.unsupported(span, "this call is not read", ""));
        };
        let segments: Vec<String> =
            path.path.segments.iter().map(|s| s.ident.to_string()).collect();
        let value = match &segments[..] {
            [.., ty, name] if ty == "f64" => self.float_function(name, &arguments, span),
            [.., ty, name] => self.constructor(&path.path, ty, name, &arguments, span),
            _ => None,
        };
        Ok(match value {
            Some(value) => value,
            None if arguments.iter().any(|a| matches!(a, Value::Wrong)) => Value::Wrong,
            None => {
                let message = format!("the function `{}` is not read", segments.join("::"));
                let help = "define it inside the body, or write out what it computes";
                self.unsupported(Span::of(&call.func), &message, help)
            }
        })
    }

    fn float_function(&mut self, name: &str, arguments: &[Value], span: Span) -> Option<Value> {
        match (name, arguments) {
            ("from", [Value::Integer(n)]) => {
                Some(self.constant(Rational::from_integer((*n).into()), span))
            }
            ("from", [value @ Value::Number(_)]) => Some(value.clone()),
            (_, [receiver, rest @ ..]) => self.number_method(name, receiver, rest, span),
            _ => None,
        }
    }

    /// `Vector3::new(a, b, c)`, `Matrix3::identity()`, and the like.
    fn constructor(
        &mut self,
        path: &Path,
        ty: &str,
        name: &str,
        arguments: &[Value],
        span: Span,
    ) -> Option<Value> {
        // `SVector::<f64, 3>::new`.
        let sizes = path.segments.iter().flat_map(|segment| match &segment.arguments {
            syn::PathArguments::AngleBracketed(arguments) => sizes(arguments),
            _ => Vec::new(),
        });
        let shape = sized(ty, &sizes.collect::<Vec<_>>())?;
        let (rows, columns) = match shape {
            Shape::Vector(n) => (n, 1),
            Shape::Matrix(rows, columns) => (rows, columns),
            _ => return None,
        };
        let mut number = |n: i64| self.constant(integer(n), span);
        let all = 0..rows * columns;
        let entries: Vec<Value> = match (name, arguments) {
            ("new", entries) if entries.len() == rows * columns => entries.to_vec(),
            ("zeros", []) => all.map(|_| number(0)).collect(),
            ("repeat" | "from_element", [value]) => vec![value.clone(); rows * columns],
            ("identity", []) => {
                all.map(|k| number(i64::from(k / columns == k % columns))).collect()
            }
            ("from_diagonal", [Value::Matrix(diagonal)]) if diagonal.entries.len() == rows => {
                let entry = |k: usize| match k / columns == k % columns {
                    true => diagonal.entries[k / columns].clone(),
                    false => number(0),
                };
                all.map(entry).collect()
            }
            ("x" | "y" | "z" | "x_axis" | "y_axis" | "z_axis", []) if columns == 1 => {
                let axis = ["x", "y", "z"].iter().position(|a| name.starts_with(a))?;
                all.map(|i| number(i64::from(i == axis))).collect()
            }
            ("from" | "from_column_slice", [Value::List(list)])
                if columns == 1 && list.len() == rows =>
            {
                list.to_vec()
            }
            ("from_row_slice", [Value::List(list)]) if list.len() == rows * columns => {
                list.to_vec()
            }
            // nalgebra reads nested arrays column by column.
            ("from", [list @ Value::List(_)]) => {
                let entry = |k: usize| list.entry(&[k % columns])?.entry(&[k / columns]);
                all.map(entry).collect::<Result<_, _>>().ok()?
            }
            _ => return None,
        };
        Some(Value::Matrix(Matrix::new(rows, columns, entries.into_iter())))
    }
}

/// Constants of `std::f64::consts`, with exactly the value of the `f64`.
fn float_constant(name: &str) -> Option<Rational> {
    use std::f64::consts;
    Rational::from_float(match name {
        "PI" => consts::PI,
        "TAU" => consts::TAU,
        "E" => consts::E,
        "SQRT_2" => consts::SQRT_2,
        "FRAC_1_SQRT_2" => consts::FRAC_1_SQRT_2,
        "FRAC_PI_2" => consts::FRAC_PI_2,
        "FRAC_PI_3" => consts::FRAC_PI_3,
        "FRAC_PI_4" => consts::FRAC_PI_4,
        "FRAC_PI_6" => consts::FRAC_PI_6,
        "FRAC_PI_8" => consts::FRAC_PI_8,
        "FRAC_1_PI" => consts::FRAC_1_PI,
        "FRAC_2_PI" => consts::FRAC_2_PI,
        "LN_2" => consts::LN_2,
        "LN_10" => consts::LN_10,
        _ => return None,
    })
}
