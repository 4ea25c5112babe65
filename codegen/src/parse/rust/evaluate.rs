//! Running a function's expressions with symbols.

use std::rc::Rc;

use syn::{Block, Expr, ExprCall, Item, Lit, LocalInit, Member, Pat, Path, Stmt, UnOp};

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::{Arena, ExprId, Node};
use crate::number::{Rational, integer};
use crate::parse::decimal;
use crate::parse::rust::signature::{sized, sizes};
use crate::parse::rust::value::{Matrix, Value};
use crate::problem::Shape;

/// The most operations a function may run through.
const MOST_OPERATIONS: usize = 200_000;
/// The most calls of closures and functions inside each other.
pub(super) const DEEPEST_CALL: usize = 24;

/// Reasons for which an expression has no value.
#[derive(Debug)]
pub(super) enum NoValue {
    Return(Value),
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
    /// True if a statement was wrong, which might have assigned anything.
    lost: bool,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(diagnostics: &'a Diagnostics) -> Self {
        Self {
            scopes: Scopes::default(),
            calls: 0,
            arena: Arena::new(),
            diagnostics,
            operations: 0,
            lost: false,
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
    pub(super) fn tick(&mut self, span: Span) -> Result<(), NoValue> {
        self.operations += 1;
        if self.operations <= MOST_OPERATIONS {
            return Ok(());
        }
        self.wrong(span, Mistake::LongLoop(MOST_OPERATIONS));
        Err(NoValue::Stop)
    }

    /// The Hamiltonian the body of a function computes, and where.
    pub(super) fn body(&mut self, block: &Block) -> Option<(ExprId, Span)> {
        let value = match self.block(block) {
            Ok(value) | Err(NoValue::Return(value)) => value,
            Err(_) => return None,
        };
        let result = block.stmts.last().map_or(Span::of(block), Span::of);
        match value {
            Value::Number(id) if !self.lost => Some((id, result)),
            Value::Number(_) | Value::Wrong => None,
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

    pub(super) fn expression(&mut self, expression: &Expr) -> Result<Value, NoValue> {
        let span = || Span::of(expression);
        match expression {
            Expr::Lit(literal) => Ok(self.literal(&literal.lit)),
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Reference(inner) => self.expression(&inner.expr),
            Expr::Unary(syn::ExprUnary { op: UnOp::Deref(_), expr, .. }) => self.expression(expr),
            Expr::Block(block) if block.label.is_none() => self.block(&block.block),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(syn::ExprUnary { op: UnOp::Neg(_), expr, .. }) => {
                let value = self.expression(expr)?;
                self.tick(span())?;
                Ok(self.negate(value, span()))
            }
            Expr::Cast(cast) => {
                let value = self.expression(&cast.expr)?;
                Ok(self.cast(value, &cast.ty, span()))
            }
            Expr::Tuple(tuple) if tuple.elems.is_empty() => Ok(Value::Unit),
            Expr::Array(syn::ExprArray { elems, .. })
            | Expr::Tuple(syn::ExprTuple { elems, .. }) => {
                let values: Result<Vec<Value>, NoValue> =
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
                match self.index(&index.index) {
                    Ok(index) => Ok(self.entry(&base, &index, span())),
                    Err(NoValue::Wrong) => Ok(Value::Wrong),
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
            Expr::Return(end) => {
                let value = end.expr.as_ref().map_or(Ok(Value::Unit), |e| self.expression(e))?;
                Err(NoValue::Return(value))
            }
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Closure(closure) => Ok(self.closure(closure)),
            Expr::Path(path) => Ok(self.path(&path.path)),
            _ => Ok(self.unsupported(
                span(),
                "this kind of expression is not read",
                "use arithmetic, let, `for` over ranges and arrays, closures, iterators and functions of numbers",
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

#[derive(Clone, Debug, Default)]
pub(super) struct Scopes {
    variables: Vec<(String, Value)>,
    /// For each open block, the index of its first variable.
    marks: Vec<usize>,
}

impl Scopes {
    pub(super) fn enter(&mut self) {
        self.marks.push(self.variables.len());
    }

    pub(super) fn leave(&mut self) {
        if let Some(mark) = self.marks.pop() {
            self.variables.truncate(mark);
        }
    }

    /// Binds a name; one bound before under it is shadowed.
    pub(super) fn bind(&mut self, name: String, value: Value) {
        self.variables.push((name, value));
    }

    pub(super) fn get(&self, name: &str) -> Option<&Value> {
        self.variables.iter().rev().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    pub(super) fn get_mut(&mut self, name: &str) -> Option<&mut Value> {
        self.variables.iter_mut().rev().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    pub(super) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (name, _) in &self.variables {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        names
    }
}

impl Evaluator<'_> {
    /// Runs a block in a scope of its own.
    pub(super) fn block(&mut self, block: &Block) -> Result<Value, NoValue> {
        self.scopes.enter();
        let value = self.statements(block);
        self.scopes.leave();
        value
    }

    fn statements(&mut self, block: &Block) -> Result<Value, NoValue> {
        // Items are visible in the whole block, before their line too.
        for statement in &block.stmts {
            if let Stmt::Item(item) = statement {
                self.item(item)?;
            }
        }
        let mut last = Value::Unit;
        for statement in &block.stmts {
            last = Value::Unit;
            match statement {
                Stmt::Local(local) => {
                    let value = match &local.init {
                        Some(LocalInit { expr, diverge: None, .. }) => self.expression(expr)?,
                        _ => {
                            let help = "write let with a name and a value";
                            self.unsupported(Span::of(local), "this `let` is not read", help)
                        }
                    };
                    self.bind(&local.pat, value);
                }
                Stmt::Item(_) => {}
                Stmt::Expr(expression, semicolon) => {
                    let value = self.expression(expression)?;
                    self.lost |= matches!(value, Value::Wrong);
                    if semicolon.is_none() {
                        last = value;
                    }
                }
                Stmt::Macro(call) => {
                    let help = "remove it, or write out what it computes";
                    self.unsupported(Span::of(&call.mac), "macros are not read", help);
                }
            }
        }
        Ok(last)
    }

    fn item(&mut self, item: &Item) -> Result<(), NoValue> {
        let (name, value) = match item {
            Item::Const(constant) => (&constant.ident, self.expression(&constant.expr)?),
            Item::Fn(function) => (&function.sig.ident, self.function_item(function)),
            Item::Use(_) => return Ok(()),
            _ => {
                let help = "only const, fn and use are read inside the body";
                self.unsupported(Span::of(item), "this item is not read", help);
                return Ok(());
            }
        };
        self.scopes.bind(name.to_string(), value);
        Ok(())
    }

    /// `if`, where the condition is known.
    pub(super) fn branch(&mut self, branch: &syn::ExprIf) -> Result<Value, NoValue> {
        match (self.condition(&branch.cond)?, &branch.else_branch) {
            (Some(true), _) => self.block(&branch.then_branch),
            (Some(false), Some((_, otherwise))) => self.expression(otherwise),
            (Some(false), None) => Ok(Value::Unit),
            (None, _) => Ok(Value::Wrong),
        }
    }

    /// A condition that does not depend on the momentum or the parameters.
    pub(super) fn condition(&mut self, condition: &Expr) -> Result<Option<bool>, NoValue> {
        let span = Span::of(condition);
        Ok(match self.expression(condition)? {
            Value::Bool(truth) => Some(truth),
            Value::Wrong => None,
            _ => {
                self.undecided("a condition", span);
                None
            }
        })
    }

    /// Reports a truth value that is not known.
    pub(super) fn undecided(&mut self, what: &str, span: Span) -> Value {
        let message = format!(
            "{what} must not depend on an argument: the function must be one expression, the same everywhere"
        );
        let help = "compare integers known beforehand only, such as loop variables";
        self.unsupported(span, &message, help)
    }
}

/// The name of a variable, and the indices that lead to one of its entries.
type Place = (String, Vec<Vec<usize>>);

impl Evaluator<'_> {
    /// Binds the names of a pattern to a value.
    pub(super) fn bind(&mut self, pattern: &Pat, value: Value) {
        match pattern {
            Pat::Ident(ident) if ident.subpat.is_none() => {
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
        let rest = patterns.iter().position(|pattern| matches!(pattern, Pat::Rest(_)));
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
                continue;
            }
            let behind = rest.is_some_and(|rest| i > rest);
            let position = if behind { (values.len() + i).checked_sub(count) } else { Some(i) };
            let value = position.and_then(|at| values.get(at)).cloned().unwrap_or(Value::Wrong);
            self.bind(pattern, value);
        }
    }

    /// Gives `value` to the place that `expression` names.
    pub(super) fn assign(&mut self, expression: &Expr, value: Value) -> Result<(), NoValue> {
        let span = Span::of(expression);
        let (name, path) = match self.place(expression) {
            Err(NoValue::Wrong) => return Ok(()),
            Err(flow) => return Err(flow),
            Ok(Some(place)) => place,
            Ok(None) => {
                self.unsupported(span, "this cannot be assigned to", "assign to a variable");
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
    fn place(&mut self, expression: &Expr) -> Result<Option<Place>, NoValue> {
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
            Expr::Index(index) => {
                let Some((name, mut path)) = self.place(&index.expr)? else { return Ok(None) };
                path.push(self.index(&index.index)?);
                Ok(Some((name, path)))
            }
            _ => Ok(None),
        }
    }

    /// `i` or `(i, j)`, known.
    pub(super) fn index(&mut self, expression: &Expr) -> Result<Vec<usize>, NoValue> {
        let parts = match self.expression(expression)? {
            Value::List(parts) => parts.to_vec(),
            single => vec![single],
        };
        let mut index = Vec::new();
        for part in parts {
            let known =
                self.integer(&part, "an index", Span::of(expression)).ok_or(NoValue::Wrong)?;
            index.push(usize::try_from(known).unwrap_or(usize::MAX));
        }
        Ok(index)
    }

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
        Member::Named(name) => ["x", "y", "z", "w"].iter().position(|n| name == n),
    }
}

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
    ) -> Result<Value, NoValue> {
        self.tick(span)?;
        if self.calls >= DEEPEST_CALL {
            self.unsupported(span, "functions call each other too deeply", "unroll the recursion");
            return Err(NoValue::Stop);
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
            Err(NoValue::Return(value)) => Ok(value),
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

    pub(super) fn call(&mut self, call: &ExprCall) -> Result<Value, NoValue> {
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
            ("x" | "y" | "z", []) if columns == 1 => {
                let axis = ["x", "y", "z"].iter().position(|a| name == *a)?;
                all.map(|i| number(i64::from(i == axis))).collect()
            }
            ("from", [Value::List(list)]) if columns == 1 && list.len() == rows => list.to_vec(),
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
        _ => return None,
    })
}
