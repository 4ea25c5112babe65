//! Expands an expression to a polynomial in the momentum with opaque coefficients.

use std::collections::BTreeMap;

use num_traits::{One, ToPrimitive, Zero};

use super::coefficient::{Coefficient, Interner};
use crate::cancel;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::{Arena, ExprId, Node};
use crate::number::Rational;
use crate::poly::monomial_product;

/// The highest degree of a Hamiltonian.
const HIGHEST_DEGREE: u32 = 100;
/// The most terms a polynomial may have on the way.
const MOST_TERMS: usize = 100_000;
/// The most products of terms in all multiplications together.
const MOST_PRODUCTS: usize = 200_000;

/// Exponents by coordinate, ascending, without zeros.
pub(super) type Monomial = Vec<(u32, u32)>;

/// Σ coefficient · monomial, without zero coefficients.
#[derive(Clone, Debug, Default)]
pub(super) struct Sum {
    pub terms: BTreeMap<Monomial, Coefficient>,
}

impl Sum {
    fn constant(value: Coefficient) -> Self {
        let mut terms = BTreeMap::new();
        if !value.is_zero() {
            terms.insert(Monomial::new(), value);
        }
        Self { terms }
    }

    pub(super) fn as_constant(&self) -> Option<Coefficient> {
        match self.terms.len() {
            0 => Some(Coefficient::number(Rational::zero())),
            1 => self.terms.get(&Monomial::new()).cloned(),
            _ => None,
        }
    }

    fn degree(&self) -> u32 {
        self.terms.keys().map(degree).max().unwrap_or(0)
    }
}

fn degree(monomial: &Monomial) -> u32 {
    monomial.iter().map(|&(_, power)| power).sum()
}

/// Evaluates the expression `root`; `None` if something was wrong, which is then reported.
///
/// Without a root, because the text has mistakes, everything is evaluated to report its own mistakes.
pub(super) fn polynomial(
    arena: &Arena,
    root: Option<ExprId>,
    table: &mut Interner,
    diagnostics: &Diagnostics,
) -> Option<Sum> {
    let uses = match root {
        Some(root) => arena.uses(&[root]),
        None => vec![u32::MAX; arena.len()],
    };
    let count = root.map_or(arena.len(), |root| root.index() + 1);
    let mut pass =
        Pass { table, diagnostics, values: Vec::new(), uses, products: 0, stopped: false };
    for (id, node, span) in arena.iter().take(count) {
        let used = pass.uses[id.index()] > 0;
        let value = if used && !pass.stopped { pass.node(node, span) } else { None };
        pass.values.push(value);
    }
    pass.values.pop().flatten()
}

struct Pass<'a> {
    table: &'a mut Interner,
    diagnostics: &'a Diagnostics,
    values: Vec<Option<Sum>>,
    /// Uses still to come.
    uses: Vec<u32>,
    products: usize,
    /// Set when a limit is passed: everything after would only repeat the message.
    stopped: bool,
}

impl Pass<'_> {
    /// The value of an operand; handed over, not copied, where this is its last use.
    fn take(&mut self, id: ExprId) -> Option<Sum> {
        let left = &mut self.uses[id.index()];
        *left = left.saturating_sub(1);
        let value = &mut self.values[id.index()];
        if *left == 0 { value.take() } else { value.clone() }
    }

    fn wrong<T>(&mut self, span: Span, mistake: Mistake) -> Option<T> {
        self.stopped |= matches!(mistake, Mistake::TooManyTerms(..));
        self.diagnostics.report(span, mistake);
        None
    }

    fn checked<T>(&mut self, span: Span, result: Result<T, Mistake>) -> Option<T> {
        result.map_err(|mistake| self.wrong::<T>(span, mistake)).ok()
    }

    fn node(&mut self, node: &Node, span: Span) -> Option<Sum> {
        cancel::check();
        match *node {
            Node::Wrong => None,
            Node::Number(ref value) => Some(Sum::constant(Coefficient::number(value.clone()))),
            Node::Coordinate(i) => {
                let one = Coefficient::number(Rational::one());
                Some(Sum { terms: BTreeMap::from([(vec![(i as u32, 1)], one)]) })
            }
            Node::Parameter(i) => {
                let value = self.table.parameter(i);
                self.checked(span, value).map(Sum::constant)
            }
            Node::Time | Node::Signal(_) => self.wrong(span, Mistake::MovesInTime),
            Node::Neg(a) => Some(negated(self.take(a)?)),
            Node::Add(a, b) => {
                let (a, b) = (self.take(a), self.take(b));
                self.add(a?, b?, span)
            }
            Node::Sub(a, b) => {
                let (a, b) = (self.take(a), self.take(b));
                self.add(a?, negated(b?), span)
            }
            Node::Mul(a, b) => {
                let (a, b) = (self.take(a), self.take(b));
                self.multiply(&a?, &b?, span)
            }
            Node::Div(a, b) => {
                let (a, b) = (self.take(a), self.take(b));
                let b = b?;
                let Some(divisor) = b.as_constant() else {
                    return self.wrong(span, Mistake::DivisionByMomentum);
                };
                let inverse = self.table.power(&divisor, -1);
                let inverse = self.checked(span, inverse)?;
                self.multiply(&a?, &Sum::constant(inverse), span)
            }
            Node::Pow(a, b) => {
                let (a, b) = (self.take(a), self.take(b));
                let b = b?;
                let Some(power) = b.as_constant() else {
                    return self.wrong(span, Mistake::MomentumInExponent);
                };
                self.power(&a?, &power, span)
            }
            Node::Call(function, a) => {
                let Some(argument) = self.take(a)?.as_constant() else {
                    return self.wrong(span, Mistake::NotPolynomial(function.name()));
                };
                let value = self.table.call(function, &argument);
                self.checked(span, value).map(Sum::constant)
            }
        }
    }

    fn add(&mut self, a: Sum, b: Sum, span: Span) -> Option<Sum> {
        let (mut large, small) = if a.terms.len() >= b.terms.len() { (a, b) } else { (b, a) };
        for (monomial, value) in small.terms {
            let sum = match large.terms.remove(&monomial) {
                Some(before) => {
                    let sum = self.table.add(&before, &value);
                    self.checked(span, sum)?
                }
                None => value,
            };
            if !sum.is_zero() {
                large.terms.insert(monomial, sum);
            }
        }
        if large.terms.len() > MOST_TERMS {
            return self.wrong(span, Mistake::TooManyTerms(large.terms.len(), MOST_TERMS));
        }
        Some(large)
    }

    fn multiply(&mut self, a: &Sum, b: &Sum, span: Span) -> Option<Sum> {
        let degree = a.degree() + b.degree();
        if degree > HIGHEST_DEGREE {
            return self.wrong(span, Mistake::LargePower(degree.to_string(), HIGHEST_DEGREE));
        }
        self.products = self.products.saturating_add(a.terms.len().saturating_mul(b.terms.len()));
        if self.products > MOST_PRODUCTS {
            return self.wrong(span, Mistake::TooManyTerms(self.products, MOST_PRODUCTS));
        }
        let mut result = Sum::default();
        for (left, x) in &a.terms {
            cancel::check();
            for (right, y) in &b.terms {
                let product = self.table.multiply(x, y);
                let mut value = self.checked(span, product)?;
                let monomial = monomial_product(left, right);
                if let Some(before) = result.terms.remove(&monomial) {
                    let sum = self.table.add(&before, &value);
                    value = self.checked(span, sum)?;
                }
                if !value.is_zero() {
                    result.terms.insert(monomial, value);
                }
            }
            if result.terms.len() > MOST_TERMS {
                return self.wrong(span, Mistake::TooManyTerms(result.terms.len(), MOST_TERMS));
            }
        }
        Some(result)
    }

    fn power(&mut self, base: &Sum, power: &Coefficient, span: Span) -> Option<Sum> {
        if let Some(base) = base.as_constant() {
            let value = self.table.raise(&base, power);
            return self.checked(span, value).map(Sum::constant);
        }
        let Some(number) = power.as_number() else {
            return self.wrong(span, Mistake::UnknownPower);
        };
        if !number.is_integer() {
            return self.wrong(span, Mistake::FractionalPower(number.to_string()));
        }
        match number.numer().to_i64() {
            Some(n) if n < 0 => self.wrong(span, Mistake::NegativePower(n.to_string())),
            Some(n) if n <= i64::from(HIGHEST_DEGREE) => {
                let mut result = Sum::constant(Coefficient::number(Rational::one()));
                for _ in 0..n {
                    result = self.multiply(&result, base, span)?;
                }
                Some(result)
            }
            _ => self.wrong(span, Mistake::LargePower(number.to_string(), HIGHEST_DEGREE)),
        }
    }
}

fn negated(mut sum: Sum) -> Sum {
    sum.terms.values_mut().for_each(Coefficient::negate);
    sum
}
