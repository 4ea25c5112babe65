//! Hamiltonians as text: `x^2/(2*I1) + m*g*l*z`.
//!
//! Precedence as in mathematics: `^` (or `**`) binds tightest and to the right, then the sign,
//! then `*` and `/`, then `+` and `-`; so `-x^2` is −(x²) and `x^-2^2` is x^(−(2²)). Two explicit
//! stacks instead of recursion, so that nesting is limited by memory only; but sums over sites,
//! `sum(i, 0..64, x[i]*x[(i + 1) % 64])`, nest by recursion.

use std::ops::Range;
use std::rc::Rc;

use crate::cancel;
use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::{Arena, ExprId, Function, Node};
use crate::number::integer;
use crate::parse::composite::Composite;
use crate::parse::names::{Name, Names, is_word};
use crate::parse::sum::{self, Scope};
use crate::parse::token::{Token, Tokens};
use crate::parse::vectors;

/// The most operations an expression with sums may have.
const MOST_OPERATIONS: usize = 1_000_000;
/// After this many mistakes in one expression the rest is not read.
const MOST_MISTAKES: usize = 20;

/// Reads `text` into `arena`, where `indices` stand for integers. Every mistake goes to `diagnostics`, at its bytes in
/// `text` moved right by `offset`; where there was one, the result stands for something [`Node::Wrong`].
pub(crate) fn parse(
    text: &str,
    offset: usize,
    indices: &[(&str, i64)],
    names: &Names,
    arena: &mut Arena,
    diagnostics: &Diagnostics,
) -> ExprId {
    let indices = indices.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
    parse_in(text, offset, &Scope { names, indices, parts: Rc::default() }, arena, diagnostics)
}

fn parse_in(
    text: &str,
    offset: usize,
    scope: &Scope<'_>,
    arena: &mut Arena,
    diagnostics: &Diagnostics,
) -> ExprId {
    let before = diagnostics.len();
    let mut parser =
        Parser { scope, arena, diagnostics, offset, operands: Vec::new(), operators: Vec::new() };
    let mut expects_operand = true;
    let mut tokens = Tokens::new(text, 0).peekable();
    while let Some((token, range)) = tokens.next() {
        if parser.diagnostics.len() > before + MOST_MISTAKES {
            let end = parser.span(text.len()..text.len());
            return parser.arena.push(Node::Wrong, end);
        }
        let call = match tokens.peek() {
            Some((Token::Open, open)) => Some(open.start),
            _ => None,
        };
        if let (Some(open), true, true) =
            (call, expects_operand, token == Token::Name("sum".into()))
        {
            let end = parser.sum(text, range.start, open);
            tokens = Tokens::new(text, end).peekable();
            expects_operand = false;
            continue;
        }
        let of_vectors =
            ["dot", "norm"].into_iter().find(|name| token == Token::Name((*name).into()));
        if let (Some(open), true, Some(name)) = (call, expects_operand, of_vectors) {
            let end = parser.of_vectors(name, text, range.start, open);
            tokens = Tokens::new(text, end).peekable();
            expects_operand = false;
            continue;
        }
        let call = call.is_some();
        expects_operand = parser.token(token, range, text, expects_operand, call);
    }
    parser.finish(text.len(), expects_operand)
}

#[derive(Clone, Debug)]
enum Operator {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
    Neg,
    /// A parenthesis, of a call if there is a function, with the number of arguments so far.
    Open {
        call: Option<Callee>,
        arguments: usize,
    },
}

#[derive(Clone, Debug)]
struct Callee {
    name: String,
    /// `None` if it was unknown, which has been reported.
    function: Option<Callable>,
}

/// A function that a text may call.
#[derive(Clone, Copy, Debug)]
enum Callable {
    Elementary(Function),
    Composite(Composite),
}

impl Callable {
    fn lookup(name: &str) -> Option<Self> {
        let elementary = Function::lookup(name).map(Self::Elementary);
        elementary.or_else(|| Composite::lookup(name).map(Self::Composite))
    }

    fn arguments(self) -> usize {
        match self {
            Self::Elementary(_) => 1,
            Self::Composite(function) => function.arguments(),
        }
    }
}

impl Operator {
    fn strength(&self) -> u8 {
        match self {
            Self::Open { .. } => 0,
            Self::Add | Self::Sub => 1,
            Self::Mul | Self::Div => 2,
            Self::Neg => 3,
            Self::Pow => 4,
        }
    }
}

struct Parser<'a> {
    scope: &'a Scope<'a>,
    arena: &'a mut Arena,
    diagnostics: &'a Diagnostics,
    offset: usize,
    operands: Vec<(ExprId, Span)>,
    operators: Vec<(Operator, Span)>,
}

impl Parser<'_> {
    fn span(&self, range: Range<usize>) -> Span {
        Span::text(range).shifted(self.offset)
    }

    fn operand(&mut self, node: Node, span: Span) {
        let id = self.arena.push(node, span);
        self.operands.push((id, span));
    }

    fn wrong(&mut self, span: Span, mistake: Mistake) {
        self.diagnostics.report(span, mistake);
        self.operand(Node::Wrong, span);
    }

    /// Reads one token; returns whether an operand is expected after it.
    fn token(
        &mut self,
        token: Token,
        range: Range<usize>,
        text: &str,
        expects_operand: bool,
        before_open: bool,
    ) -> bool {
        cancel::check();
        let span = self.span(range.clone());
        let shown = &text[range.clone()];
        if expects_operand {
            match token {
                Token::Number(value) => self.operand(Node::Number(value), span),
                Token::Name(name) if before_open => {
                    self.callee(name, span);
                    // Its parenthesis comes next.
                    return true;
                }
                Token::Name(name) => self.name(&name, span),
                Token::Wrong(mistake) => self.wrong(span, mistake),
                Token::Plus => return true,
                Token::Minus => {
                    self.operators.push((Operator::Neg, span));
                    return true;
                }
                Token::Open => {
                    self.open(span);
                    return true;
                }
                _ => {
                    self.wrong(span, Mistake::Unexpected(shown.to_owned()));
                    return self.token(token, range, text, false, before_open);
                }
            }
            return false;
        }
        match token {
            Token::Number(_) | Token::Name(_) | Token::Open => {
                self.diagnostics.report(span, Mistake::MissingOperator(shown.to_owned()));
                self.binary(Operator::Mul, span);
                return self.token(token, range, text, true, before_open);
            }
            Token::Wrong(mistake) => {
                self.diagnostics.report(span, mistake);
                return false;
            }
            Token::Plus => self.binary(Operator::Add, span),
            Token::Minus => self.binary(Operator::Sub, span),
            Token::Times => self.binary(Operator::Mul, span),
            Token::Over => self.binary(Operator::Div, span),
            Token::Power => self.binary(Operator::Pow, span),
            Token::Close => {
                self.close(span);
                return false;
            }
            Token::Comma => {
                self.reduce(1);
                match self.operators.last_mut() {
                    Some((Operator::Open { call: Some(_), arguments }, _)) => *arguments += 1,
                    _ => self.diagnostics.report(span, Mistake::Unexpected(shown.to_owned())),
                }
            }
        }
        true
    }

    fn name(&mut self, name: &str, span: Span) {
        let node = match self.scope.get(name) {
            Ok(Name::Coordinate(i)) => Node::Coordinate(i),
            Ok(Name::Parameter(i)) => Node::Parameter(i),
            Ok(Name::Number(value)) => Node::Number(value),
            Ok(Name::Time) => Node::Time,
            Ok(Name::Signal(i)) => Node::Signal(i),
            Ok(Name::Part { text, offset }) => return self.part(name, &text, offset, span),
            Err(_) if Callable::lookup(name).is_some() => {
                return self.wrong(span, Mistake::FunctionWithoutArgument(name.to_owned()));
            }
            Err(_) if self.scope.names.excuses(name) => Node::Wrong,
            Err(mistake) => return self.wrong(span, mistake),
        };
        self.operand(node, span);
    }

    /// A part of formulas that has a name of its own, which is read once.
    fn part(&mut self, name: &str, text: &str, offset: usize, span: Span) {
        let known = self.scope.parts.borrow().get(name).copied();
        let found = match known {
            Some(Some(found)) => found,
            Some(None) => {
                let what = format!("`{name}` under [let] is made of itself");
                let help = "a part may be made of parts that are not made of it".to_owned();
                return self.wrong(span, Mistake::Other(what, Some(help)));
            }
            None => {
                self.scope.parts.borrow_mut().insert(name.to_owned(), None);
                let scope = Scope { indices: Vec::new(), ..self.scope.clone() };
                let found = parse_in(text, offset, &scope, self.arena, self.diagnostics);
                self.scope.parts.borrow_mut().insert(name.to_owned(), Some(found));
                found
            }
        };
        self.operands.push((found, span));
    }

    fn callee(&mut self, name: String, span: Span) {
        let function = Callable::lookup(&name);
        if function.is_none() {
            if self.scope.get(&name).is_ok() {
                // `x (y + 1)`: a product without its operator.
                self.name(&name, span);
                self.diagnostics.report(span, Mistake::MissingOperator("(".to_owned()));
                self.binary(Operator::Mul, span);
                return;
            }
            let composite = Composite::ALL.map(Composite::name).into_iter();
            let known = Function::ALL.map(Function::name).into_iter().chain(composite);
            let suggestion = match name.as_str() {
                "log" => Some("ln"),
                "fabs" => Some("abs"),
                name => nearest(name, known),
            };
            let suggestion = suggestion.map(str::to_owned);
            self.diagnostics.report(span, Mistake::UnknownFunction(name.clone(), suggestion));
        }
        let call = Some(Callee { name, function });
        // The parenthesis itself follows and completes this entry.
        self.operators.push((Operator::Open { call, arguments: 0 }, span));
    }

    /// Reads `dot` or `norm`, which begins at `start`, its parenthesis at `open`; returns where it ends.
    fn of_vectors(&mut self, name: &str, text: &str, start: usize, open: usize) -> usize {
        let (sum, end) = match vectors::number(name, text, open, self.scope.names) {
            Ok(found) => found,
            Err(end) => {
                let what = "dot(a, b) and norm(a) are of vectors: names of three numbers each, cross(a, b), their sums and multiples";
                let help = Some("write for example dot(d, cross(a, b)), with d = [0, 0, 1]".into());
                let mistake = Mistake::Other(what.to_owned(), help);
                let excused = self.scope.names.excuses(&text[start..end]);
                match excused {
                    true => self.operand(Node::Wrong, self.span(start..end)),
                    false => self.wrong(self.span(start..end), mistake),
                }
                return end;
            }
        };
        let offset = self.offset + start;
        let product = parse_in(&sum, offset, self.scope, self.arena, self.diagnostics);
        self.operands.push((product, self.span(start..end)));
        end
    }

    /// Reads a sum that begins at `start`, its parenthesis at `open`; returns where it ends.
    fn sum(&mut self, text: &str, start: usize, open: usize) -> usize {
        let form = match sum::form(text, open) {
            Ok(form) => form,
            Err(end) => {
                self.wrong(self.span(start..end), Mistake::Sum("it needs three arguments".into()));
                return end;
            }
        };
        let whole = self.span(start..form.end);
        let bounds = match text[form.values.clone()].split_once("..") {
            Some((first, last)) => {
                let first = self.scope.integer(first);
                let bounds = first.and_then(|first| Ok((first, self.scope.integer(last)?)));
                bounds.map_err(|mistake| format!("its range is none of integers: {mistake}"))
            }
            None => Err("its range is none of integers".to_owned()),
        };
        let known = self.scope.get(&form.index);
        let taken = known.is_ok_and(|meaning| meaning != Name::Time)
            || Callable::lookup(&form.index).is_some();
        let reason = match &bounds {
            _ if !is_word(&form.index) => "its index is no name",
            _ if self.scope.indices.len() >= sum::MOST_NESTED => "more than 64 sums are nested",
            _ if taken => "the name of its index is already in use",
            Err(reason) => reason,
            Ok((first, last)) if last.saturating_sub(*first) > sum::MOST_TERMS => {
                "it has more than 10000 terms"
            }
            Ok(_) => "",
        };
        let (Ok((first, last)), "") = (&bounds, reason) else {
            if self.scope.names.excuses(&text[start..form.end]) {
                self.operand(Node::Wrong, whole);
            } else {
                self.wrong(whole, Mistake::Sum(reason.to_owned()));
            }
            return form.end;
        };
        let (body, offset) = (&text[form.body.clone()], self.offset + form.body.start);
        let before = self.diagnostics.len();
        let mut scope = self.scope.clone();
        scope.indices.push((form.index, *first));
        let mut total = None;
        for value in *first..*last {
            if let Some(index) = scope.indices.last_mut() {
                index.1 = value;
            }
            let term = parse_in(body, offset, &scope, self.arena, self.diagnostics);
            total = Some(match total {
                Some(sum) => self.arena.push(Node::Add(sum, term), whole),
                None => term,
            });
            // A mistake in one term is a mistake in all.
            if self.diagnostics.len() > before {
                break;
            }
            if self.arena.len() > MOST_OPERATIONS {
                let reason = "it grows beyond a million operations".to_owned();
                self.wrong(whole, Mistake::Sum(reason));
                return form.end;
            }
        }
        // Over nothing it is 0: inner ranges may depend on outer indices.
        let total = total.unwrap_or_else(|| self.arena.push(Node::Number(integer(0)), whole));
        self.operands.push((total, whole));
        form.end
    }

    fn open(&mut self, span: Span) {
        if let Some((Operator::Open { call: Some(_), arguments }, _)) = self.operators.last_mut()
            && *arguments == 0
        {
            *arguments = 1;
            return;
        }
        self.operators.push((Operator::Open { call: None, arguments: 1 }, span));
    }

    fn close(&mut self, span: Span) {
        self.reduce(1);
        match self.operators.pop() {
            Some((Operator::Open { call, arguments }, open)) => {
                let whole = open.to(span);
                let Some(callee) = call else {
                    let Some((argument, _)) = self.operands.pop() else { return };
                    // The operand now spans its parentheses.
                    self.operands.push((argument, whole));
                    return;
                };
                let first = self.operands.len().saturating_sub(arguments);
                let found: Vec<ExprId> = self.operands.drain(first..).map(|(id, _)| id).collect();
                match (callee.function, &found[..]) {
                    (None, _) => self.operand(Node::Wrong, whole),
                    (Some(known), _) if known.arguments() != arguments => {
                        let wanted =
                            if known.arguments() == 1 { "one argument" } else { "two arguments" };
                        let mistake = Mistake::ArgumentCount(callee.name, wanted, arguments);
                        self.wrong(whole, mistake);
                    }
                    (Some(Callable::Elementary(function)), &[argument]) => {
                        self.operand(Node::Call(function, argument), whole);
                    }
                    (Some(Callable::Composite(function)), found) => {
                        if let Some(made) = function.build(self.arena, found, whole) {
                            self.operands.push((made, whole));
                        }
                    }
                    _ => {}
                }
            }
            _ => self.diagnostics.report(span, Mistake::Unexpected(")".to_owned())),
        }
    }

    /// Applies the operators on the stack that bind at least as tight as `strength`.
    fn reduce(&mut self, strength: u8) {
        while let Some((operator, span)) =
            self.operators.pop_if(|(operator, _)| operator.strength() >= strength)
        {
            let Some((b, b_span)) = self.operands.pop() else { return };
            if matches!(operator, Operator::Neg) {
                self.operand(Node::Neg(b), span.to(b_span));
                continue;
            }
            let Some((a, a_span)) = self.operands.pop() else { return };
            let node = match operator {
                Operator::Add => Node::Add(a, b),
                Operator::Sub => Node::Sub(a, b),
                Operator::Mul => Node::Mul(a, b),
                Operator::Div => Node::Div(a, b),
                _ => Node::Pow(a, b),
            };
            self.operand(node, a_span.to(b_span));
        }
    }

    fn binary(&mut self, operator: Operator, span: Span) {
        // Powers group to the right: only what binds tighter is applied first.
        let right = u8::from(matches!(operator, Operator::Pow));
        self.reduce(operator.strength() + right);
        self.operators.push((operator, span));
    }

    fn finish(mut self, end: usize, expects_operand: bool) -> ExprId {
        let end = self.span(end..end);
        if expects_operand {
            self.wrong(end, Mistake::Unfinished);
        }
        loop {
            self.reduce(1);
            match self.operators.pop() {
                Some((_, open)) => self.diagnostics.report(open, Mistake::Unclosed),
                None => break,
            }
        }
        match self.operands.last() {
            Some(&(id, _)) => id,
            None => self.arena.push(Node::Wrong, end),
        }
    }
}
