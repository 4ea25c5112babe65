//! Statements, blocks and branches.

use syn::{Block, Expr, Item, Stmt};

use super::evaluate::{Evaluator, Flow};
use super::value::Value;
use crate::diagnostic::Span;

impl Evaluator<'_> {
    /// Runs a block in a scope of its own.
    pub(super) fn block(&mut self, block: &Block) -> Result<Value, Flow> {
        self.scopes.enter();
        let value = self.statements(block);
        self.scopes.leave();
        value
    }

    fn statements(&mut self, block: &Block) -> Result<Value, Flow> {
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
                    let Some(init) = &local.init else {
                        // `let x;` is given its value later.
                        self.bind(&local.pat, Value::Unit);
                        continue;
                    };
                    if let Some((token, _)) = &init.diverge {
                        self.unsupported(Span::of(token), "let … else is not read", "use let");
                    }
                    let value = self.expression(&init.expr)?;
                    self.bind(&local.pat, value);
                }
                Stmt::Item(_) => {}
                Stmt::Expr(expression, semicolon) => {
                    let value = self.expression(expression)?;
                    if semicolon.is_none() {
                        last = value;
                    }
                }
                Stmt::Macro(call) => {
                    let name = call.mac.path.segments.last().map(|s| s.ident.to_string());
                    if !name.is_some_and(|name| name.contains("assert")) {
                        let help = "remove it, or write out what it computes";
                        self.unsupported(Span::of(&call.mac), "macros are not read", help);
                    }
                }
            }
        }
        Ok(last)
    }

    fn item(&mut self, item: &Item) -> Result<(), Flow> {
        let (name, value) = match item {
            Item::Const(constant) => (&constant.ident, self.expression(&constant.expr)?),
            Item::Static(constant) => (&constant.ident, self.expression(&constant.expr)?),
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
    pub(super) fn branch(&mut self, branch: &syn::ExprIf) -> Result<Value, Flow> {
        match (self.condition(&branch.cond)?, &branch.else_branch) {
            (Some(true), _) => self.block(&branch.then_branch),
            (Some(false), Some((_, otherwise))) => self.expression(otherwise),
            (Some(false), None) => Ok(Value::Unit),
            (None, _) => Ok(Value::Wrong),
        }
    }

    /// A condition that does not depend on the momentum or the parameters.
    pub(super) fn condition(&mut self, condition: &Expr) -> Result<Option<bool>, Flow> {
        let span = Span::of(condition);
        if matches!(condition, Expr::Let(_)) {
            self.unsupported(span, "patterns in conditions are not read", "use let before it");
            return Ok(None);
        }
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
            "{what} must not depend on the momentum or a parameter: the Hamiltonian must be one polynomial"
        );
        let help = "compare integers known beforehand only, such as loop variables";
        self.unsupported(span, &message, help)
    }
}
