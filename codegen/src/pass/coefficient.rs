//! Coefficients of monomials in the momentum: exact numbers times opaque factors.
//!
//! A coefficient is a rational times a product of integer powers of *atoms*: parameters, function
//! values, and sums. Products never expand sums, so (a − b)² keeps its digits when a ≈ b; equal
//! products are one entry of a table, so coefficients that differ by a rational factor only are
//! recognised at once.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

use crate::diagnostic::Mistake;
use crate::expr::{Function, Node, ParameterExpr};
use crate::number::Rational;

/// The maximum number of bits of a numerator or denominator.
const MOST_BITS: u64 = 1 << 14;
/// The maximum power of an atom.
const HIGHEST_POWER: i64 = 1000;
/// The maximum depth to which functions and sums may be nested.
const DEEPEST: usize = 200;

/// A product of powers of atoms, by its number in the table; [`ONE`] is the empty product.
pub(super) type Product = usize;

pub(super) const ONE: Product = 0;

/// rational · product; zero if the rational is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Coefficient {
    pub factor: Rational,
    pub product: Product,
}

impl Coefficient {
    pub(super) fn number(value: Rational) -> Self {
        Self { factor: value, product: ONE }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.factor.is_zero()
    }

    pub(super) fn as_number(&self) -> Option<&Rational> {
        (self.product == ONE || self.is_zero()).then_some(&self.factor)
    }

    pub(super) fn negate(&mut self) {
        self.factor = -std::mem::take(&mut self.factor);
    }
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Atom {
    Parameter(usize),
    Call(Function, Coefficient),
    /// At least two terms, without common rational factor, the first one positive.
    Sum(Vec<(Product, Rational)>),
}

/// The table of atoms and products seen so far.
#[derive(Debug)]
pub(super) struct Interner {
    atoms: Vec<(Atom, usize)>,
    atom_numbers: BTreeMap<Atom, usize>,
    /// Powers by atom, ascending.
    products: Vec<Vec<(usize, i32)>>,
    product_numbers: BTreeMap<Vec<(usize, i32)>, Product>,
}

impl Interner {
    pub(super) fn new() -> Self {
        Self {
            atoms: Vec::new(),
            atom_numbers: BTreeMap::new(),
            products: vec![Vec::new()],
            product_numbers: BTreeMap::from([(Vec::new(), ONE)]),
        }
    }

    pub(super) fn parameter(&mut self, index: usize) -> Result<Coefficient, Mistake> {
        self.atom(Atom::Parameter(index))
    }

    fn atom(&mut self, atom: Atom) -> Result<Coefficient, Mistake> {
        let number = match self.atom_numbers.get(&atom) {
            Some(&number) => number,
            None => {
                let depth = 1 + self.operand_depth(&atom);
                if depth > DEEPEST {
                    return Err(Mistake::Other(
                        format!("coefficients are nested more than {DEEPEST} deep"),
                        Some("give the inner expression as a parameter of its own".to_owned()),
                    ));
                }
                self.atom_numbers.insert(atom.clone(), self.atoms.len());
                self.atoms.push((atom, depth));
                self.atoms.len() - 1
            }
        };
        let product = self.product(vec![(number, 1)]);
        Ok(Coefficient { factor: Rational::one(), product })
    }

    fn operand_depth(&self, atom: &Atom) -> usize {
        let product_depth = |product: Product| {
            self.products[product].iter().map(|&(atom, _)| self.atoms[atom].1).max().unwrap_or(0)
        };
        match atom {
            Atom::Parameter(_) => 0,
            Atom::Call(_, argument) => product_depth(argument.product),
            Atom::Sum(terms) => terms.iter().map(|&(p, _)| product_depth(p)).max().unwrap_or(0),
        }
    }

    fn product(&mut self, powers: Vec<(usize, i32)>) -> Product {
        if let Some(&number) = self.product_numbers.get(&powers) {
            return number;
        }
        self.product_numbers.insert(powers.clone(), self.products.len());
        self.products.push(powers);
        self.products.len() - 1
    }

    pub(super) fn multiply(
        &mut self,
        a: &Coefficient,
        b: &Coefficient,
    ) -> Result<Coefficient, Mistake> {
        let factor = limited(&a.factor * &b.factor)?;
        let product = match (a.product, b.product) {
            (ONE, other) | (other, ONE) => other,
            (a, b) => {
                let mut powers: BTreeMap<usize, i32> = self.products[a].iter().copied().collect();
                for &(atom, power) in &self.products[b] {
                    *powers.entry(atom).or_insert(0) += power;
                }
                powers.retain(|_, power| *power != 0);
                if let Some(power) = powers.values().find(|p| i64::from(p.abs()) > HIGHEST_POWER) {
                    return Err(Mistake::LargePower(power.to_string(), HIGHEST_POWER as u32));
                }
                self.product(powers.into_iter().collect())
            }
        };
        Ok(Coefficient { factor, product })
    }

    pub(super) fn add(&mut self, a: &Coefficient, b: &Coefficient) -> Result<Coefficient, Mistake> {
        if a.is_zero() {
            return Ok(b.clone());
        }
        if b.is_zero() {
            return Ok(a.clone());
        }
        if a.product == b.product {
            let factor = limited(&a.factor + &b.factor)?;
            return Ok(Coefficient { factor, product: a.product });
        }
        let mut terms: BTreeMap<Product, Rational> = BTreeMap::new();
        for (product, value) in self.summands(a).into_iter().chain(self.summands(b)) {
            *terms.entry(product).or_insert_with(Rational::zero) += value;
        }
        terms.retain(|_, value| !value.is_zero());
        let Some(lead) = terms.values().next() else {
            return Ok(Coefficient::number(Rational::zero()));
        };
        // The common factor is divided out, with the sign of the first term.
        let negative = lead.is_negative();
        let mut numerator = lead.numer().abs();
        let mut denominator = lead.denom().clone();
        for value in terms.values() {
            numerator = numerator.gcd(value.numer());
            denominator = denominator.lcm(value.denom());
        }
        let mut content = limited(Rational::new(numerator, denominator))?;
        if negative {
            content = -content;
        }
        let mut terms: Vec<(Product, Rational)> =
            terms.into_iter().map(|(product, value)| (product, value / &content)).collect();
        let single = if terms.len() == 1 { terms.pop() } else { None };
        if let Some((product, value)) = single {
            return Ok(Coefficient { factor: value * content, product });
        }
        let mut sum = self.atom(Atom::Sum(terms))?;
        sum.factor = content;
        Ok(sum)
    }

    fn summands(&self, a: &Coefficient) -> Vec<(Product, Rational)> {
        if let [(atom, 1)] = self.products[a.product][..]
            && let Atom::Sum(terms) = &self.atoms[atom].0
        {
            return terms.iter().map(|(product, value)| (*product, value * &a.factor)).collect();
        }
        vec![(a.product, a.factor.clone())]
    }

    pub(super) fn power(&mut self, a: &Coefficient, n: i64) -> Result<Coefficient, Mistake> {
        if n.abs() > HIGHEST_POWER {
            return Err(Mistake::LargePower(n.to_string(), HIGHEST_POWER as u32));
        }
        if n < 0 && a.is_zero() {
            return Err(Mistake::DivisionByZero);
        }
        let bits = a.factor.numer().bits().max(a.factor.denom().bits());
        if bits > 1 && bits.saturating_mul(n.unsigned_abs()) > MOST_BITS {
            return Err(Mistake::LargeCoefficient(MOST_BITS));
        }
        let factor = Pow::pow(&a.factor, n as i32);
        let scaled: Vec<(usize, i64)> =
            self.products[a.product].iter().map(|&(i, p)| (i, i64::from(p) * n)).collect();
        if let Some((_, power)) = scaled.iter().find(|(_, p)| p.abs() > HIGHEST_POWER) {
            return Err(Mistake::LargePower(power.to_string(), HIGHEST_POWER as u32));
        }
        let powers = scaled.into_iter().filter(|&(_, p)| p != 0).map(|(i, p)| (i, p as i32));
        let product = self.product(powers.collect());
        Ok(Coefficient { factor, product })
    }

    pub(super) fn call(
        &mut self,
        function: Function,
        a: &Coefficient,
    ) -> Result<Coefficient, Mistake> {
        if let Some(number) = a.as_number() {
            if let Some(value) = exact(function, number) {
                return Ok(Coefficient::number(value));
            }
            let value = function.apply(number.to_f64().unwrap_or(f64::NAN));
            if !value.is_finite() {
                return Err(Mistake::NotReal(format!("{}({number})", function.name())));
            }
        }
        self.atom(Atom::Call(function, a.clone()))
    }

    /// The operation of a node on constants; `b` is the second operand, where there is one.
    pub(super) fn apply(
        &mut self,
        node: &Node,
        a: &Coefficient,
        b: Option<&Coefficient>,
    ) -> Result<Coefficient, Mistake> {
        let minus = |a: &Coefficient| Coefficient { factor: -&a.factor, product: a.product };
        match (node, b) {
            (Node::Neg(_), _) => Ok(minus(a)),
            (Node::Call(function, _), _) => self.call(*function, a),
            (Node::Add(..), Some(b)) => self.add(a, b),
            (Node::Sub(..), Some(b)) => self.add(a, &minus(b)),
            (Node::Mul(..), Some(b)) => self.multiply(a, b),
            (Node::Div(..), Some(b)) => {
                let inverse = self.power(b, -1)?;
                self.multiply(a, &inverse)
            }
            (_, Some(b)) => self.raise(a, b),
            (_, None) => Ok(a.clone()),
        }
    }

    /// base^power.
    pub(super) fn raise(
        &mut self,
        base: &Coefficient,
        power: &Coefficient,
    ) -> Result<Coefficient, Mistake> {
        match power.as_number().filter(|power| power.is_integer()) {
            Some(whole) => match whole.numer().to_i64() {
                Some(n) => self.power(base, n),
                None => Err(Mistake::LargePower(whole.to_string(), HIGHEST_POWER as u32)),
            },
            None => self.root(base, power),
        }
    }

    /// base^power, by a root where that is exact or a square root, else by exp(power·ln base).
    fn root(&mut self, base: &Coefficient, power: &Coefficient) -> Result<Coefficient, Mistake> {
        let whole = |value: &BigInt| value.to_i64().filter(|n| n.abs() <= HIGHEST_POWER);
        let fraction = power.as_number().and_then(|p| Some((whole(p.numer())?, whole(p.denom())?)));
        if let Some((n, 2)) = fraction {
            let root = self.call(Function::Sqrt, base)?;
            return self.power(&root, n);
        }
        if let (Some((n, degree)), Some(number)) = (fraction, base.as_number())
            && let Some(root) = exact_root(number, degree as u32)
        {
            return self.power(&Coefficient::number(root), n);
        }
        let logarithm = self.call(Function::Ln, base)?;
        let exponent = self.multiply(power, &logarithm)?;
        self.call(Function::Exp, &exponent)
    }

    /// The value of a coefficient without parameters: exact where it is rational, else the number of floating point
    /// nearest to it, to rounding.
    pub(super) fn value(&self, a: &Coefficient) -> Result<Rational, Mistake> {
        if let Some(number) = a.as_number() {
            return Ok(number.clone());
        }
        let expression = self.scaled(&a.factor, a.product);
        let value = expression.evaluate(&[]);
        Rational::from_float(value).ok_or_else(|| Mistake::NotReal(expression.text(&[])))
    }

    pub(super) fn expression(&self, product: Product) -> ParameterExpr {
        let powers = &self.products[product];
        let of_sign = |negative: bool| {
            let factors = powers.iter().filter(|(_, power)| (*power < 0) == negative);
            let factors = factors.map(|&(atom, power)| {
                let base = self.atom_expression(atom);
                let power = power.abs();
                if power == 1 { base } else { ParameterExpr::Powi(Box::new(base), power) }
            });
            balanced(factors.collect(), ParameterExpr::Mul)
        };
        let one = || ParameterExpr::Rational(Rational::one());
        match (of_sign(false), of_sign(true)) {
            (numerator, Some(denominator)) => {
                ParameterExpr::Div(Box::new(numerator.unwrap_or_else(one)), Box::new(denominator))
            }
            (Some(numerator), None) => numerator,
            (None, None) => one(),
        }
    }

    fn atom_expression(&self, atom: usize) -> ParameterExpr {
        match &self.atoms[atom].0 {
            Atom::Parameter(index) => ParameterExpr::Parameter(*index),
            Atom::Call(function, argument) => ParameterExpr::Call(
                *function,
                Box::new(self.scaled(&argument.factor, argument.product)),
            ),
            Atom::Sum(terms) => {
                let positive = terms.iter().filter(|(_, value)| value.is_positive());
                let negative = terms.iter().filter(|(_, value)| value.is_negative());
                difference(
                    positive.map(|(product, value)| self.scaled(value, *product)).collect(),
                    negative.map(|(product, value)| self.scaled(&-value, *product)).collect(),
                )
            }
        }
    }

    pub(super) fn scaled(&self, factor: &Rational, product: Product) -> ParameterExpr {
        if product == ONE {
            return ParameterExpr::Rational(factor.clone());
        }
        let expression = self.expression(product);
        if factor.is_one() {
            return expression;
        }
        if (-factor).is_one() {
            return ParameterExpr::Neg(Box::new(expression));
        }
        let factor = ParameterExpr::Rational(factor.clone());
        ParameterExpr::Mul(Box::new(factor), Box::new(expression))
    }
}

/// Σ plus − Σ minus.
pub(super) fn difference(plus: Vec<ParameterExpr>, minus: Vec<ParameterExpr>) -> ParameterExpr {
    match (balanced(plus, ParameterExpr::Add), balanced(minus, ParameterExpr::Add)) {
        (Some(plus), Some(minus)) => ParameterExpr::Sub(Box::new(plus), Box::new(minus)),
        (Some(plus), None) => plus,
        (None, minus) => ParameterExpr::Neg(Box::new(
            minus.unwrap_or_else(|| ParameterExpr::Rational(Rational::zero())),
        )),
    }
}

/// Joins expressions pairwise, so that depth grows with the logarithm of their number.
pub(super) fn balanced(
    mut list: Vec<ParameterExpr>,
    join: fn(Box<ParameterExpr>, Box<ParameterExpr>) -> ParameterExpr,
) -> Option<ParameterExpr> {
    while list.len() > 1 {
        let mut halved = Vec::with_capacity(list.len().div_ceil(2));
        let mut items = list.into_iter();
        while let Some(a) = items.next() {
            halved.push(match items.next() {
                Some(b) => join(Box::new(a), Box::new(b)),
                None => a,
            });
        }
        list = halved;
    }
    list.pop()
}

fn limited(value: Rational) -> Result<Rational, Mistake> {
    if value.numer().bits().max(value.denom().bits()) > MOST_BITS {
        return Err(Mistake::LargeCoefficient(MOST_BITS));
    }
    Ok(value)
}

/// The root of this degree of a number from 0, if it is rational.
fn exact_root(x: &Rational, degree: u32) -> Option<Rational> {
    if x.is_negative() || degree == 0 {
        return None;
    }
    let root = Rational::new(x.numer().nth_root(degree), x.denom().nth_root(degree));
    (Pow::pow(&root, degree as i32) == *x).then_some(root)
}

/// Values that are rational numbers.
fn exact(function: Function, x: &Rational) -> Option<Rational> {
    match function {
        Function::Abs => Some(x.abs()),
        Function::Sign => Some(x.signum()),
        Function::Sqrt => exact_root(x, 2),
        Function::Sin | Function::Tan | Function::Atan | Function::Tanh if x.is_zero() => {
            Some(Rational::zero())
        }
        Function::Cos | Function::Exp if x.is_zero() => Some(Rational::one()),
        Function::Ln if x.is_one() => Some(Rational::zero()),
        _ => None,
    }
}
