//! Running a function's expressions with symbols.

use std::f64::consts;
use std::rc::Rc;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{
    BinOp, Block, Expr, ExprBinary, ExprCall, ExprField, ExprRange, FnArg, Item, ItemFn, Lit,
    LocalInit, Member, Pat, Path, PathSegment, RangeLimits, Stmt, Token, UnOp,
};

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::{Arena, Node};
use crate::number::{Rational, integer};
use crate::parse::decimal;
use crate::parse::rust::algebra::text;
use crate::parse::rust::signature::{bare, is_f64, of_segment, shaped};
use crate::parse::rust::value::{Aggregate, Value};
use crate::problem::Shape;

/// The most operations a function may run through.
const MOST_OPERATIONS: usize = 200_000;
/// The most calls of closures and functions inside each other.
const DEEPEST_CALL: usize = 24;

/// A closure, or a function defined in the body.
pub(super) struct Callable {
    parameters: Vec<Pat>,
    body: Expr,
    /// The variables visible where it was written. (A function sees items only; the compiler checks.)
    variables: Vec<(String, Value)>,
}

/// The state of reading one function.
pub(super) struct Evaluator<'a> {
    /// Those that are visible; a later one shadows one before it of the same name.
    variables: Vec<(String, Value)>,
    calls: usize,
    arena: Arena,
    diagnostics: &'a Diagnostics,
    /// Beyond the most, nothing more is read.
    operations: usize,
    /// The value of a `return`, behind which nothing is read.
    returned: Option<Value>,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(diagnostics: &'a Diagnostics) -> Self {
        Self {
            variables: Vec::new(),
            calls: 0,
            arena: Arena::new(),
            diagnostics,
            operations: 0,
            returned: None,
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

    /// Reports something that is not of the subset of Rust that is read, and stands for it.
    pub(super) fn unread(&mut self, what: &str, place: &impl ToTokens) -> Value {
        let help = "use arithmetic, let, `for` over ranges and arrays, closures, iterators and functions of numbers";
        self.unsupported(Span::of(place), &format!("this {what} is not read"), help)
    }

    pub(super) fn push(&mut self, node: Node, span: Span) -> Value {
        Value::Number(self.arena.push(node, span))
    }

    pub(super) fn constant(&mut self, value: Rational, span: Span) -> Value {
        self.push(Node::Number(value), span)
    }

    /// Counts operations; false where there are too many.
    pub(super) fn count(&mut self, operations: usize, span: Span) -> bool {
        let before = self.operations;
        self.operations = before.saturating_add(operations);
        if before <= MOST_OPERATIONS && self.operations > MOST_OPERATIONS {
            self.wrong(span, Mistake::LongLoop(MOST_OPERATIONS));
        }
        self.operations <= MOST_OPERATIONS
    }

    /// True if nothing more is read.
    fn ended(&self) -> bool {
        self.returned.is_some() || self.operations > MOST_OPERATIONS
    }

    /// Begins with the items among statements, which a function beside them sees.
    pub(super) fn begin<'s>(&mut self, statements: impl Iterator<Item = &'s Stmt>) {
        self.variables.clear();
        self.operations = 0;
        self.items(statements);
    }

    /// The result of a body of which the arguments are bound, made of the value that it returns, and its place; reported where
    /// it cannot be made, unless something is wrong already.
    pub(super) fn result<T>(
        &mut self,
        block: &Block,
        made: impl Fn(&Value) -> Result<T, String>,
        help: &str,
    ) -> Option<(T, Span)> {
        let before = self.diagnostics.len();
        let value = self.block(block);
        let value = self.returned.take().unwrap_or(value);
        let place = block.stmts.last().map_or_else(|| Span::of(block), Span::of);
        // A statement that was wrong might have assigned anything.
        if self.diagnostics.len() > before || value.is_wrong() {
            return None;
        }
        match made(&value) {
            Ok(made) => Some((made, place)),
            Err(message) => {
                self.unsupported(place, &message, help);
                None
            }
        }
    }

    /// The integer a value is, known.
    fn integer(&mut self, value: &Value, what: &'static str, span: Span) -> Option<i128> {
        match value {
            Value::Integer(n) => return Some(*n),
            Value::Wrong => {}
            _ => self.diagnostics.report(span, Mistake::NotConstant(what)),
        }
        None
    }

    pub(super) fn expressions<'e>(
        &mut self,
        list: impl IntoIterator<Item = &'e Expr>,
    ) -> Vec<Value> {
        list.into_iter().map(|expression| self.expression(expression)).collect()
    }

    pub(super) fn expression(&mut self, expression: &Expr) -> Value {
        let expression = bare(expression);
        let span = || Span::of(expression);
        if self.ended() {
            return Value::Wrong;
        }
        match expression {
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Block(block) if block.label.is_none() => self.block(&block.block),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(syn::ExprUnary { op: UnOp::Neg(_), expr, .. }) => {
                let value = self.expression(expr);
                self.count(1, span());
                self.negate(value, span())
            }
            Expr::Cast(cast) => {
                let value = self.expression(&cast.expr);
                self.cast(value, is_f64(&cast.ty), span())
            }
            Expr::Array(syn::ExprArray { elems, .. })
            | Expr::Tuple(syn::ExprTuple { elems, .. }) => Value::list(self.expressions(elems)),
            Expr::Repeat(repeat) => {
                let value = self.expression(&repeat.expr);
                let count = self.expression(&repeat.len);
                let place = Span::of(&repeat.len);
                let count = self.integer(&count, "the length of an array", place);
                self.counted(Some(0), count, place, |_| value.clone())
            }
            Expr::Range(range) => self.range(range),
            Expr::Index(_) | Expr::Field(_) => {
                let found = self.entry(expression);
                found.map_or(Value::Wrong, |(_, list, at)| list.entries[at].clone())
            }
            Expr::Assign(assign) => {
                let value = self.expression(&assign.right);
                self.assign(&assign.left, value)
            }
            Expr::If(branch) => match (self.condition(&branch.cond), &branch.else_branch) {
                (Some(true), _) => self.block(&branch.then_branch),
                (Some(false), Some((_, otherwise))) => self.expression(otherwise),
                (Some(false), None) => Value::Unit,
                (None, _) => Value::Wrong,
            },
            Expr::ForLoop(for_loop) => self.for_loop(for_loop),
            Expr::While(while_loop) => {
                let place = Span::of(&while_loop.cond);
                while self.count(1, place) && self.condition(&while_loop.cond) == Some(true) {
                    self.block(&while_loop.body);
                }
                Value::Unit
            }
            Expr::Return(end) => {
                let value = end.expr.as_ref().map_or(Value::Unit, |value| self.expression(value));
                self.returned.get_or_insert(value);
                Value::Wrong
            }
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Closure(closure) => self.callable(closure.inputs.iter().cloned(), &closure.body),
            Expr::Path(path) => self.path(&path.path),
            _ => self.unread("kind of expression", expression),
        }
    }

    fn literal(&mut self, literal: &Lit) -> Value {
        let span = Span::of(literal);
        let value = match literal {
            Lit::Float(number) => decimal(number.base10_digits()),
            Lit::Int(number) if number.suffix() == "f64" => decimal(number.base10_digits()),
            Lit::Int(number) => match number.base10_parse() {
                Ok(value) => return Value::Integer(value),
                Err(_) => Err(Mistake::NumberSize(number.base10_digits().to_owned())),
            },
            _ => return self.unread("literal", literal),
        };
        match value {
            Ok(value) => self.constant(value, span),
            Err(mistake) => self.wrong(span, mistake),
        }
    }

    /// A binary operation or a compound assignment.
    fn binary(&mut self, binary: &ExprBinary) -> Value {
        // a + b + c + … nests to the left; a loop keeps long sums off the stack.
        let (mut chain, mut first) = (vec![binary], &*binary.left);
        while let Expr::Binary(left) = first
            && !sign(&left.op).1
        {
            chain.push(left);
            first = &left.left;
        }
        let mut value = self.expression(first);
        for operation in chain.into_iter().rev() {
            self.count(1, Span::of(&operation.op));
            let right = self.expression(&operation.right);
            let whole = Span::of(&operation.left).to(Span::of(&operation.right));
            let (sign, assigns) = sign(&operation.op);
            value = self.operate(&sign, value, right, whole);
            if assigns {
                value = self.assign(&operation.left, value);
            }
        }
        value
    }

    /// A list with an entry for each of some integers, where their bounds are known.
    fn counted(
        &mut self,
        start: Option<i128>,
        end: Option<i128>,
        span: Span,
        entry: impl Fn(i128) -> Value,
    ) -> Value {
        let (Some(start), Some(end)) = (start, end) else { return Value::Wrong };
        let length = usize::try_from(end.saturating_sub(start).max(0)).unwrap_or(usize::MAX);
        match self.count(length, span) {
            true => Value::list((start..end).map(entry)),
            false => Value::Wrong,
        }
    }

    /// A range whose ends are known.
    fn range(&mut self, range: &ExprRange) -> Value {
        let span = Span::of(range);
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return self.wrong(span, Mistake::NotConstant("the end of a range"));
        };
        let [start, end] = [start, end].map(|bound| {
            let value = self.expression(bound);
            self.integer(&value, "the bound of a range", Span::of(bound))
        });
        let inclusive = i128::from(matches!(range.limits, RangeLimits::Closed(_)));
        let end = end.map(|end| end.saturating_add(inclusive));
        self.counted(start, end, span, Value::Integer)
    }

    fn for_loop(&mut self, for_loop: &syn::ExprForLoop) -> Value {
        let items = match self.expression(&for_loop.expr) {
            Value::List(list) => list.entries,
            Value::Wrong => return Value::Wrong,
            _ => return self.unread("loop", &for_loop.expr),
        };
        let outside = self.variables.len();
        for item in items.iter() {
            if self.ended() || !self.count(1, Span::of(&for_loop.expr)) {
                break;
            }
            self.bind(&for_loop.pat, item.clone());
            self.block(&for_loop.body);
            self.variables.truncate(outside);
        }
        Value::Unit
    }

    /// Runs a block in a scope of its own.
    fn block(&mut self, block: &Block) -> Value {
        let outside = self.variables.len();
        // Items are visible in the whole block, before their line too.
        self.items(block.stmts.iter());
        let mut last = Value::Unit;
        for statement in &block.stmts {
            if self.ended() {
                break;
            }
            last = self.statement(statement);
        }
        self.variables.truncate(outside);
        last
    }

    /// Runs a statement; its value is that of an expression without a semicolon.
    fn statement(&mut self, statement: &Stmt) -> Value {
        match statement {
            Stmt::Local(local) => {
                let value = match &local.init {
                    Some(LocalInit { expr, diverge: None, .. }) => self.expression(expr),
                    _ => self.unread("`let`", local),
                };
                self.bind(&local.pat, value);
            }
            Stmt::Item(_) => {}
            Stmt::Expr(expression, None) => return self.expression(expression),
            Stmt::Expr(expression, Some(_)) => _ = self.expression(expression),
            Stmt::Macro(call) => _ = self.unread("macro", &call.mac),
        }
        Value::Unit
    }

    fn items<'s>(&mut self, statements: impl Iterator<Item = &'s Stmt>) {
        for statement in statements {
            let Stmt::Item(item) = statement else { continue };
            let (name, value) = match item {
                Item::Const(constant) => (&constant.ident, self.expression(&constant.expr)),
                Item::Fn(ItemFn { sig, block, .. }) => {
                    let pattern = |input: &FnArg| match input {
                        FnArg::Typed(typed) => Some((*typed.pat).clone()),
                        FnArg::Receiver(_) => None,
                    };
                    let parameters = sig.inputs.iter().filter_map(pattern);
                    (&sig.ident, self.callable(parameters, &syn::parse_quote!(#block)))
                }
                Item::Use(_) => continue,
                _ => {
                    self.unread("item", item);
                    continue;
                }
            };
            self.variables.push((name.to_string(), value));
        }
    }

    /// A condition that does not depend on the momentum or the parameters.
    fn condition(&mut self, condition: &Expr) -> Option<bool> {
        match self.expression(condition) {
            Value::Bool(truth) => return Some(truth),
            Value::Wrong => {}
            _ => _ = self.unread("condition", condition),
        }
        None
    }

    /// Binds the names of a pattern to a value.
    pub(super) fn bind(&mut self, pattern: &Pat, value: Value) {
        match pattern {
            Pat::Ident(ident) if ident.subpat.is_none() => {
                self.variables.push((ident.ident.to_string(), value));
            }
            Pat::Wild(_) => {}
            // `let x: f64 = …`: the compiler checks the type.
            Pat::Type(typed) => self.bind(&typed.pat, value),
            Pat::Reference(inner) => self.bind(&inner.pat, value),
            Pat::Slice(syn::PatSlice { elems, .. }) | Pat::Tuple(syn::PatTuple { elems, .. }) => {
                self.bind_list(elems, value, Span::of(pattern));
            }
            _ => _ = self.unread("pattern", pattern),
        }
    }

    fn bind_list(&mut self, patterns: &Punctuated<Pat, Token![,]>, value: Value, span: Span) {
        let is_rest = |pattern: &&Pat| matches!(pattern, Pat::Rest(_));
        let rest = patterns.iter().position(|pattern| is_rest(&pattern));
        let count = patterns.len() - usize::from(rest.is_some());
        let mut entries = match value {
            Value::List(list) => list.entries.to_vec(),
            Value::Wrong => vec![Value::Wrong; count],
            other => {
                let message = format!("{} cannot be taken apart like this", other.kind());
                vec![self.unsupported(span, &message, "index it instead"); count]
            }
        };
        let length = entries.len();
        if count > length || count < length && rest.is_none() {
            let message = format!("the pattern has {} names for {length} entries", patterns.len());
            entries = vec![self.unsupported(span, &message, "give as many"); count];
        }
        // `..` stands for all entries that no other pattern takes.
        if let Some(rest) = rest {
            entries.drain(rest..rest + entries.len() - count);
        }
        for (pattern, value) in patterns.iter().filter(|pattern| !is_rest(pattern)).zip(entries) {
            self.bind(pattern, value);
        }
    }

    /// The last variable of this name.
    fn variable(&mut self, path: &Path) -> Option<&mut Value> {
        let name = path.get_ident()?;
        let mut known = self.variables.iter_mut().rev();
        known.find(|(known, _)| name == known).map(|(_, value)| value)
    }

    /// Gives `value` to the variable, or the entry of one, that `expression` names.
    fn assign(&mut self, expression: &Expr, value: Value) -> Value {
        let expression = bare(expression);
        if let Expr::Path(path) = expression
            && let Some(variable) = self.variable(&path.path)
        {
            *variable = value;
        } else if let Some((base, mut list, at)) = self.entry(expression) {
            // The variable lets go of the list, which is then changed in place.
            self.assign(base, Value::Unit);
            Rc::make_mut(&mut list.entries)[at] = value;
            self.assign(base, Value::List(list));
        }
        Value::Unit
    }

    /// The list of which an expression names an entry, as written and as it is, and the place of the entry in it; `None` where
    /// there is no such entry, which is reported.
    fn entry<'e>(&mut self, expression: &'e Expr) -> Option<(&'e Expr, Aggregate, usize)> {
        let span = Span::of(expression);
        let (base, index) = match expression {
            Expr::Index(index) => (&*index.expr, self.index(&index.index)),
            Expr::Field(field) => (&*field.base, self.member(field)),
            _ => {
                self.unread("assignment", expression);
                return None;
            }
        };
        match (self.expression(base), index?) {
            (Value::List(list), index) => match list.position(&index) {
                Some(at) => return Some((base, list, at)),
                None => {
                    let shown = index.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
                    self.wrong(span, Mistake::IndexRange(shown, list.entries.len()));
                }
            },
            (Value::Wrong, _) => {}
            (other, _) => {
                let message = format!("{} has no entries to choose from", other.kind());
                self.unsupported(span, &message, "index arrays, vectors or matrices only");
            }
        }
        None
    }

    /// `i` or `(i, j)`, known.
    fn index(&mut self, expression: &Expr) -> Option<Vec<usize>> {
        let parts = match self.expression(expression) {
            Value::List(parts) => parts.entries.to_vec(),
            single => vec![single],
        };
        let part = |part: &Value| {
            let known = self.integer(part, "an index", Span::of(expression))?;
            Some(usize::try_from(known).unwrap_or(usize::MAX))
        };
        parts.iter().map(part).collect()
    }

    /// `.x`, `.y`, … of a vector, `.0`, `.1`, … of a tuple, as indices.
    fn member(&mut self, field: &ExprField) -> Option<Vec<usize>> {
        let found = match &field.member {
            Member::Unnamed(index) => Some(index.index as usize),
            Member::Named(name) => ["x", "y", "z", "w"].iter().position(|n| name == n),
        };
        if found.is_none() {
            self.unread("field", field);
        }
        Some(vec![found?])
    }

    fn callable(&self, parameters: impl Iterator<Item = Pat>, body: &Expr) -> Value {
        let (parameters, variables) = (parameters.collect(), self.variables.clone());
        Value::Function(Rc::new(Callable { parameters, body: body.clone(), variables }))
    }

    /// Calls a closure or a function of the body.
    pub(super) fn apply(
        &mut self,
        function: &Rc<Callable>,
        arguments: Vec<Value>,
        span: Span,
    ) -> Value {
        self.count(1, span);
        if self.calls >= DEEPEST_CALL {
            self.operations = usize::MAX;
            let message = "functions call each other too deeply";
            return self.unsupported(span, message, "unroll the recursion");
        }
        let outside = std::mem::replace(&mut self.variables, function.variables.clone());
        self.calls += 1;
        for (pattern, argument) in function.parameters.iter().zip(arguments) {
            self.bind(pattern, argument);
        }
        let value = self.expression(&function.body);
        self.calls -= 1;
        self.variables = outside;
        self.returned.take().unwrap_or(value)
    }

    /// The value of a variable or a known constant; other names are reported.
    fn path(&mut self, path: &Path) -> Value {
        if let Some(value) = self.variable(path) {
            return value.clone();
        }
        let (span, name) = (Span::of(path), text(path));
        if let Some((module, constant)) = name.rsplit_once("::") {
            // Constants of `std::f64::consts` have exactly the value of the `f64`.
            let value = match constant {
                "PI" => consts::PI,
                "TAU" => consts::TAU,
                "E" => consts::E,
                "SQRT_2" => consts::SQRT_2,
                _ => f64::NAN,
            };
            if let Some(value) = Rational::from_float(value).filter(|_| module.ends_with("consts"))
            {
                return self.constant(value, span);
            }
            let message = format!("`{name}` is not read");
            return self.unsupported(span, &message, "write its value, or pass it as a parameter");
        }
        let mut names: Vec<String> = self.variables.iter().map(|(name, _)| name.clone()).collect();
        names.dedup();
        let near = nearest(&name, names.iter().map(String::as_str)).map(str::to_owned);
        let constant = name.chars().all(|c| c.is_uppercase() || c == '_' || c.is_numeric());
        if constant && near.is_none() {
            let message = format!("the constant `{name}` is not visible here");
            let help = "define it with `const` inside the function, or pass it as a parameter";
            return self.unsupported(span, &message, help);
        }
        self.wrong(span, Mistake::UnknownVariable(name, near, names))
    }

    fn call(&mut self, call: &ExprCall) -> Value {
        let span = Span::of(call);
        let arguments = self.expressions(&call.args);
        let Expr::Path(syn::ExprPath { path, .. }) = &*call.func else {
            return self.unread("call", call);
        };
        if let Some(Value::Function(function)) = self.variable(path) {
            let function = function.clone();
            return self.apply(&function, arguments, span);
        }
        let segments: Vec<&PathSegment> = path.segments.iter().collect();
        let value = match (&segments[..], &arguments[..]) {
            ([.., ty, name], [value]) if ty.ident == "f64" && name.ident == "from" => {
                Some(self.cast(value.clone(), true, span))
            }
            ([.., ty, name], [Value::Number(x), rest @ ..]) if ty.ident == "f64" => {
                self.number_method(&name.ident.to_string(), *x, rest, span)
            }
            ([.., ty, name], _) => self.constructor(ty, &name.ident.to_string(), &arguments, span),
            _ => None,
        };
        self.known(value, &arguments, || {
            let message = format!("the function `{}` is not read", text(path));
            let help = "define it inside the body, or write out what it computes";
            (Span::of(&call.func), message, help.to_owned())
        })
    }

    /// The value of a call, where it is known; otherwise it is reported, unless that is due to what it is given.
    pub(super) fn known(
        &mut self,
        value: Option<Value>,
        given: &[Value],
        otherwise: impl FnOnce() -> (Span, String, String),
    ) -> Value {
        match value {
            Some(value) => value,
            None if given.iter().any(Value::is_wrong) => Value::Wrong,
            None => {
                let (place, message, help) = otherwise();
                self.unsupported(place, &message, &help)
            }
        }
    }

    /// `Vector3::new(a, b, c)`, `Vector3::z()`, and the like.
    fn constructor(
        &mut self,
        ty: &PathSegment,
        name: &str,
        arguments: &[Value],
        span: Span,
    ) -> Option<Value> {
        let shape = of_segment(ty)?;
        let axis = ["x", "y", "z"].iter().position(|axis| name == *axis);
        let entries: Vec<Value> = match (name, arguments, &shape) {
            ("new", entries, _) => entries.to_vec(),
            ("from", [Value::List(list)], Shape::Vector(_)) => list.entries.to_vec(),
            (_, [], Shape::Vector(n)) if axis.is_some() => {
                let mut entry = |i| self.constant(integer(i64::from(Some(i) == axis)), span);
                (0..*n).map(&mut entry).collect()
            }
            _ => return None,
        };
        (entries.len() == shape.len()).then(|| shaped(&shape, |i| entries[i].clone()))
    }
}

/// The user's text of the statements of a body, as far as the compiler tells.
pub(super) fn source(block: &Block) -> String {
    let text = |statement: &Stmt| {
        let text = match Span::of(statement) {
            Span::Tokens { first, last } => first.join(last).and_then(|whole| whole.source_text()),
            _ => None,
        };
        text.unwrap_or_else(|| statement.to_token_stream().to_string())
    };
    block.stmts.iter().map(text).collect::<Vec<_>>().join(" ")
}

/// The sign of an operation, without the `=` of one that assigns its result, which is said beside it.
fn sign(op: &BinOp) -> (String, bool) {
    let sign = op.to_token_stream().to_string();
    match sign.strip_suffix('=') {
        Some(own @ ("+" | "-" | "*" | "/" | "%")) => (own.to_owned(), true),
        _ => (sign, false),
    }
}
