//! Running a function's expressions with symbols.

use std::ops::Range;
use std::rc::Rc;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{
    BinOp, Block, Expr, ExprBinary, ExprCall, ExprRange, FnArg, Item, Lit, LocalInit, Member, Pat,
    Path, PathSegment, RangeLimits, Stmt, Token, UnOp,
};

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::{Arena, ExprId, Node};
use crate::number::{Rational, integer};
use crate::parse::decimal;
use crate::parse::rust::signature::{bare, is_f64, of_segment};
use crate::parse::rust::value::{Aggregate, Value};
use crate::problem::Shape;

/// The most operations a function may run through.
const MOST_OPERATIONS: usize = 200_000;
/// The most calls of closures and functions inside each other.
const DEEPEST_CALL: usize = 24;

/// Reasons for which an expression has no value.
pub(super) enum NoValue {
    Return(Value),
    /// A limit was passed, which has been reported; nothing more is read.
    Stop,
}

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
    operations: usize,
    /// True if a statement was wrong, which might have assigned anything.
    lost: bool,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(diagnostics: &'a Diagnostics) -> Self {
        Self {
            variables: Vec::new(),
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

    /// Reports something that is not of the subset of Rust that is read, and stands for it.
    pub(super) fn unread(&mut self, what: &str, place: &impl ToTokens) -> Value {
        let help = "use arithmetic, let, `for` over ranges and arrays, closures, iterators and functions of numbers";
        self.unsupported(Span::of(place), &format!("this {what} is not read"), help)
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

    /// Begins with the items among statements, which a function beside them sees.
    pub(super) fn begin<'s>(&mut self, statements: impl Iterator<Item = &'s Stmt>) {
        self.variables.clear();
        // A limit that is passed is reported, and passed again in the body.
        let _ = self.items(statements);
    }

    /// The value that the body of a function returns, of which the arguments are bound.
    pub(super) fn returned(&mut self, block: &Block) -> Value {
        match self.block(block) {
            Ok(value) | Err(NoValue::Return(value)) if !self.lost => value,
            _ => Value::Wrong,
        }
    }

    /// The Hamiltonian the body of a function computes, and where.
    pub(super) fn body(&mut self, block: &Block) -> Option<(ExprId, Span)> {
        let result = block.stmts.last().map_or(Span::of(block), Span::of);
        match self.returned(block) {
            Value::Number(id) => Some((id, result)),
            Value::Wrong => None,
            other => {
                let message = format!("the function must end with a number, not {}", other.kind());
                self.unsupported(result, &message, "end it with the energy, without a semicolon");
                None
            }
        }
    }

    pub(super) fn number(&mut self, value: Rational, span: Span) -> ExprId {
        self.arena.push(Node::Number(value), span)
    }

    pub(super) fn constant(&mut self, value: Rational, span: Span) -> Value {
        Value::Number(self.number(value, span))
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
    ) -> Result<Vec<Value>, NoValue> {
        list.into_iter().map(|expression| self.expression(expression)).collect()
    }

    pub(super) fn expression(&mut self, expression: &Expr) -> Result<Value, NoValue> {
        let expression = bare(expression);
        let span = || Span::of(expression);
        match expression {
            Expr::Lit(literal) => Ok(self.literal(&literal.lit)),
            Expr::Block(block) if block.label.is_none() => self.block(&block.block),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(syn::ExprUnary { op: UnOp::Neg(_), expr, .. }) => {
                let value = self.expression(expr)?;
                self.tick(span())?;
                Ok(self.negate(value, span()))
            }
            Expr::Cast(cast) => {
                let value = self.expression(&cast.expr)?;
                Ok(self.cast(value, is_f64(&cast.ty), span()))
            }
            Expr::Array(syn::ExprArray { elems, .. })
            | Expr::Tuple(syn::ExprTuple { elems, .. }) => {
                Ok(Value::list(self.expressions(elems)?))
            }
            Expr::Repeat(repeat) => {
                let value = self.expression(&repeat.expr)?;
                let count = self.expression(&repeat.len)?;
                let place = Span::of(&repeat.len);
                match self.integer(&count, "the length of an array", place) {
                    Some(count) => self.counted(0..count, place, |_| value.clone()),
                    None => Ok(Value::Wrong),
                }
            }
            Expr::Range(range) => self.range(range),
            Expr::Index(_) | Expr::Field(_) => {
                let found = self.entry(expression)?;
                Ok(found.map_or(Value::Wrong, |(_, list, at)| list.entries[at].clone()))
            }
            Expr::Assign(assign) => {
                let value = self.expression(&assign.right)?;
                self.assign(&assign.left, value)
            }
            Expr::If(branch) => match (self.condition(&branch.cond)?, &branch.else_branch) {
                (Some(true), _) => self.block(&branch.then_branch),
                (Some(false), Some((_, otherwise))) => self.expression(otherwise),
                (Some(false), None) => Ok(Value::Unit),
                (None, _) => Ok(Value::Wrong),
            },
            Expr::ForLoop(for_loop) => self.for_loop(for_loop),
            Expr::While(while_loop) => loop {
                self.tick(Span::of(&while_loop.cond))?;
                match self.condition(&while_loop.cond)? {
                    Some(true) => self.block(&while_loop.body)?,
                    Some(false) => return Ok(Value::Unit),
                    None => return Ok(Value::Wrong),
                };
            },
            Expr::Return(end) => {
                let value = end.expr.as_ref().map_or(Ok(Value::Unit), |e| self.expression(e))?;
                Err(NoValue::Return(value))
            }
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Closure(closure) => {
                Ok(self.callable(closure.inputs.iter().cloned().collect(), &closure.body))
            }
            Expr::Path(path) => Ok(self.path(&path.path)),
            _ => Ok(self.unread("kind of expression", expression)),
        }
    }

    fn literal(&mut self, literal: &Lit) -> Value {
        let span = Span::of(literal);
        let digits = match literal {
            Lit::Float(number) => number.base10_digits(),
            Lit::Int(number) if number.suffix() == "f64" => number.base10_digits(),
            Lit::Int(number) => {
                let digits = number.base10_digits();
                return match digits.parse() {
                    Ok(value) => Value::Integer(value),
                    Err(_) => self.wrong(span, Mistake::NumberSize(digits.to_owned())),
                };
            }
            _ => return self.unread("literal", literal),
        };
        match decimal(digits) {
            Ok(value) => self.constant(value, span),
            Err(mistake) => self.wrong(span, mistake),
        }
    }

    /// A binary operation or a compound assignment.
    fn binary(&mut self, binary: &ExprBinary) -> Result<Value, NoValue> {
        // a + b + c + … nests to the left; a loop keeps long sums off the stack.
        let (mut chain, mut first) = (vec![binary], &*binary.left);
        while let Expr::Binary(left) = first
            && !is_assignment(&left.op)
        {
            chain.push(left);
            first = &left.left;
        }
        let mut value = self.expression(first)?;
        for operation in chain.into_iter().rev() {
            self.tick(Span::of(&operation.op))?;
            let right = self.expression(&operation.right)?;
            let whole = Span::of(&operation.left).to(Span::of(&operation.right));
            value = self.operate(&operation.op, value, right, whole);
            if is_assignment(&operation.op) {
                value = self.assign(&operation.left, value)?;
            }
        }
        Ok(value)
    }

    /// A list with an entry for each of some integers.
    fn counted(
        &mut self,
        range: Range<i128>,
        span: Span,
        entry: impl Fn(i128) -> Value,
    ) -> Result<Value, NoValue> {
        let entries: Result<Vec<Value>, NoValue> =
            range.map(|i| self.tick(span).map(|()| entry(i))).collect();
        Ok(Value::list(entries?))
    }

    /// A range whose ends are known.
    fn range(&mut self, range: &ExprRange) -> Result<Value, NoValue> {
        let span = Span::of(range);
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return Ok(self.wrong(span, Mistake::NotConstant("the end of a range")));
        };
        let mut bound = |bound: &Expr| {
            let value = self.expression(bound)?;
            Ok(self.integer(&value, "the bound of a range", Span::of(bound)))
        };
        let (Some(start), Some(end)) = (bound(start)?, bound(end)?) else {
            return Ok(Value::Wrong);
        };
        let inclusive = matches!(range.limits, RangeLimits::Closed(_));
        self.counted(start..end.saturating_add(i128::from(inclusive)), span, Value::Integer)
    }

    fn for_loop(&mut self, for_loop: &syn::ExprForLoop) -> Result<Value, NoValue> {
        let span = Span::of(&for_loop.expr);
        let items = match self.expression(&for_loop.expr)? {
            Value::List(list) => list.entries,
            Value::Wrong => return Ok(Value::Wrong),
            _ => return Ok(self.unread("loop", &for_loop.expr)),
        };
        let outside = self.variables.len();
        for item in items.iter() {
            self.tick(span)?;
            self.bind(&for_loop.pat, item.clone());
            self.block(&for_loop.body)?;
            self.variables.truncate(outside);
        }
        Ok(Value::Unit)
    }

    /// Runs a block in a scope of its own.
    fn block(&mut self, block: &Block) -> Result<Value, NoValue> {
        let outside = self.variables.len();
        let value = self.statements(block);
        self.variables.truncate(outside);
        value
    }

    fn statements(&mut self, block: &Block) -> Result<Value, NoValue> {
        // Items are visible in the whole block, before their line too.
        self.items(block.stmts.iter())?;
        let mut last = Value::Unit;
        for statement in &block.stmts {
            last = Value::Unit;
            match statement {
                Stmt::Local(local) => {
                    let value = match &local.init {
                        Some(LocalInit { expr, diverge: None, .. }) => self.expression(expr)?,
                        _ => self.unread("`let`", local),
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
                    self.unread("macro", &call.mac);
                }
            }
        }
        Ok(last)
    }

    fn items<'s>(&mut self, statements: impl Iterator<Item = &'s Stmt>) -> Result<(), NoValue> {
        for statement in statements {
            if let Stmt::Item(item) = statement {
                self.item(item)?;
            }
        }
        Ok(())
    }

    fn item(&mut self, item: &Item) -> Result<(), NoValue> {
        let (name, value) = match item {
            Item::Const(constant) => (&constant.ident, self.expression(&constant.expr)?),
            Item::Fn(function) => {
                let pattern = |input: &FnArg| match input {
                    FnArg::Typed(typed) => Some((*typed.pat).clone()),
                    FnArg::Receiver(_) => None,
                };
                let parameters = function.sig.inputs.iter().filter_map(pattern).collect();
                let block = (*function.block).clone();
                let body = syn::ExprBlock { attrs: Vec::new(), label: None, block };
                (&function.sig.ident, self.callable(parameters, &Expr::Block(body)))
            }
            Item::Use(_) => return Ok(()),
            _ => {
                self.unread("item", item);
                return Ok(());
            }
        };
        self.variables.push((name.to_string(), value));
        Ok(())
    }

    /// A condition that does not depend on the momentum or the parameters.
    fn condition(&mut self, condition: &Expr) -> Result<Option<bool>, NoValue> {
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
        let entries = match value {
            Value::List(list) => list.entries,
            other => {
                if !matches!(other, Value::Wrong) {
                    let message = format!("{} cannot be taken apart like this", other.kind());
                    self.unsupported(span, &message, "index it instead");
                }
                Rc::new(vec![Value::Wrong; patterns.len()])
            }
        };
        // `..` stands for all entries that no other pattern takes.
        let (count, length) = (patterns.len(), entries.len());
        let is_rest = |pattern: &Pat| matches!(pattern, Pat::Rest(_));
        if count != length && (count > length + 1 || !patterns.iter().any(is_rest)) {
            let message = format!("the pattern has {count} names for {length} entries");
            self.unsupported(span, &message, "give as many");
        }
        let mut at = 0;
        for pattern in patterns {
            if is_rest(pattern) {
                at += (length + 1).saturating_sub(count);
                continue;
            }
            self.bind(pattern, entries.get(at).cloned().unwrap_or(Value::Wrong));
            at += 1;
        }
    }

    /// The last variable of this name.
    fn variable(&mut self, path: &Path) -> Option<&mut Value> {
        let name = path.get_ident()?;
        let mut known = self.variables.iter_mut().rev();
        known.find(|(known, _)| name == known).map(|(_, value)| value)
    }

    /// Gives `value` to the variable, or the entry of one, that `expression` names.
    fn assign(&mut self, expression: &Expr, value: Value) -> Result<Value, NoValue> {
        let expression = bare(expression);
        if let Expr::Path(path) = expression
            && let Some(variable) = self.variable(&path.path)
        {
            *variable = value;
        } else if let Some((base, mut list, at)) = self.entry(expression)? {
            // The variable lets go of the list, which is then changed in place.
            self.assign(base, Value::Unit)?;
            Rc::make_mut(&mut list.entries)[at] = value;
            return self.assign(base, Value::List(list));
        }
        Ok(Value::Unit)
    }

    /// The list of which an expression names an entry, as written and as it is, and the place of the entry in it; `None` where
    /// there is no such entry, which is reported.
    fn entry<'e>(
        &mut self,
        expression: &'e Expr,
    ) -> Result<Option<(&'e Expr, Aggregate, usize)>, NoValue> {
        let span = Span::of(expression);
        let (base, index) = match expression {
            Expr::Index(index) => (&*index.expr, self.index(&index.index)?),
            Expr::Field(field) => {
                let index = member(&field.member).map(|at| vec![at]);
                if index.is_none() {
                    self.unread("field", expression);
                }
                (&*field.base, index)
            }
            _ => {
                self.unread("assignment", expression);
                return Ok(None);
            }
        };
        let whole = self.expression(base)?;
        let Some(index) = index else { return Ok(None) };
        let length = match &whole {
            Value::Wrong => return Ok(None),
            Value::List(list) => match list.position(&index) {
                Ok(at) => return Ok(Some((base, list.clone(), at))),
                Err(length) => length,
            },
            _ => 0,
        };
        if length == 0 {
            let message = format!("{} has no entries to choose from", whole.kind());
            self.unsupported(span, &message, "index arrays, vectors or matrices only");
        } else {
            let shown = index.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
            self.wrong(span, Mistake::IndexRange(shown, length));
        }
        Ok(None)
    }

    /// `i` or `(i, j)`, known.
    fn index(&mut self, expression: &Expr) -> Result<Option<Vec<usize>>, NoValue> {
        let parts = match self.expression(expression)? {
            Value::List(parts) => parts.entries.to_vec(),
            single => vec![single],
        };
        let part = |part: &Value| {
            let known = self.integer(part, "an index", Span::of(expression))?;
            Some(usize::try_from(known).unwrap_or(usize::MAX))
        };
        Ok(parts.iter().map(part).collect())
    }

    fn callable(&self, parameters: Vec<Pat>, body: &Expr) -> Value {
        let variables = self.variables.clone();
        Value::Function(Rc::new(Callable { parameters, body: body.clone(), variables }))
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
        let outside = std::mem::replace(&mut self.variables, function.variables.clone());
        self.calls += 1;
        for (pattern, argument) in function.parameters.iter().zip(arguments) {
            self.bind(pattern, argument);
        }
        let value = self.expression(&function.body);
        self.calls -= 1;
        self.variables = outside;
        match value {
            Err(NoValue::Return(value)) => Ok(value),
            other => other,
        }
    }

    /// The value of a variable or a known constant; other names are reported.
    fn path(&mut self, path: &Path) -> Value {
        if let Some(value) = self.variable(path) {
            return value.clone();
        }
        let span = Span::of(path);
        let name = written(path);
        if let Some((module, constant)) = name.rsplit_once("::") {
            if let Some(value) = float_constant(constant).filter(|_| module.ends_with("consts")) {
                return self.constant(value, span);
            }
            let message = format!("`{name}` is not read");
            return self.unsupported(span, &message, "write its value, or pass it as a parameter");
        }
        let mut names: Vec<String> = Vec::new();
        for (known, _) in &self.variables {
            if !names.contains(known) {
                names.push(known.clone());
            }
        }
        let near = nearest(&name, names.iter().map(String::as_str)).map(str::to_owned);
        let constant = name.chars().all(|c| c.is_uppercase() || c == '_' || c.is_numeric());
        if constant && near.is_none() {
            let message = format!("the constant `{name}` is not visible here");
            let help = "define it with `const` inside the function, or pass it as a parameter";
            return self.unsupported(span, &message, help);
        }
        self.wrong(span, Mistake::UnknownVariable(name, near, names))
    }

    fn call(&mut self, call: &ExprCall) -> Result<Value, NoValue> {
        let span = Span::of(call);
        let arguments = self.expressions(&call.args)?;
        let Expr::Path(path) = &*call.func else { return Ok(self.unread("call", call)) };
        if let Some(Value::Function(function)) = self.variable(&path.path) {
            let function = function.clone();
            return self.apply(&function, arguments, span);
        }
        let segments: Vec<&PathSegment> = path.path.segments.iter().collect();
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
        Ok(match value {
            Some(value) => value,
            None if arguments.iter().any(|a| matches!(a, Value::Wrong)) => Value::Wrong,
            None => {
                let message = format!("the function `{}` is not read", written(&path.path));
                let help = "define it inside the body, or write out what it computes";
                self.unsupported(Span::of(&call.func), &message, help)
            }
        })
    }

    /// `Vector3::new(a, b, c)`, `Vector3::z()`, and the like.
    fn constructor(
        &mut self,
        ty: &PathSegment,
        name: &str,
        arguments: &[Value],
        span: Span,
    ) -> Option<Value> {
        let (rows, columns) = match of_segment(ty)? {
            Shape::Vector(n) => (n, 1),
            Shape::Matrix(rows, columns) => (rows, columns),
            _ => return None,
        };
        let entries: Vec<Value> = match (name, arguments) {
            ("new", entries) if entries.len() == rows * columns => entries.to_vec(),
            ("x" | "y" | "z", []) if columns == 1 => {
                let axis = ["x", "y", "z"].iter().position(|axis| name == *axis);
                let mut entry = |i| self.constant(integer(i64::from(Some(i) == axis)), span);
                (0..rows).map(&mut entry).collect()
            }
            ("from", [Value::List(list)]) if columns == 1 && list.entries.len() == rows => {
                list.entries.to_vec()
            }
            _ => return None,
        };
        Some(Value::matrix(rows, columns, entries))
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

/// A path as it is written, without generic arguments.
fn written(path: &Path) -> String {
    let names: Vec<String> = path.segments.iter().map(|one| one.ident.to_string()).collect();
    names.join("::")
}

fn is_assignment(op: &BinOp) -> bool {
    matches!(
        op,
        BinOp::AddAssign(_)
            | BinOp::SubAssign(_)
            | BinOp::MulAssign(_)
            | BinOp::DivAssign(_)
            | BinOp::RemAssign(_)
    )
}

/// `.x`, `.y`, … of a vector, `.0`, `.1`, … of a tuple, as positions.
fn member(member: &Member) -> Option<usize> {
    match member {
        Member::Unnamed(index) => Some(index.index as usize),
        Member::Named(name) => ["x", "y", "z", "w"].iter().position(|n| name == n),
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
