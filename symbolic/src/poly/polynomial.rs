//! The polynomial type.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::collections::BTreeMap;

use coadjoint_program::{Graph, Id};
use num_traits::{One, ToPrimitive, Zero};

use crate::cancel;
use crate::number::{Fractions, Rational};

/// A sparse polynomial in a fixed number of variables with exact rational coefficients.
///
/// Terms are kept in lexicographically descending order of their exponents. Arithmetic is exact:
/// machine integers are used while they provably suffice and big integers otherwise, exponents
/// are packed into one word while they fit and kept as lists of factors otherwise.
///
/// ```
/// use coadjoint_symbolic::number::ratio;
/// use coadjoint_symbolic::poly::Polynomial;
///
/// let x = Polynomial::variable(2, 0);
/// let y = Polynomial::variable(2, 1);
/// let square = (&x + &y.scale(&ratio(1, 2))).pow(2);
/// let terms: Vec<_> = square.terms().collect();
/// assert_eq!(terms[0], (vec![2, 0], ratio(1, 1)));
/// assert_eq!(terms[1], (vec![1, 1], ratio(1, 1)));
/// assert_eq!(terms[2], (vec![0, 2], ratio(1, 4)));
/// ```
///
/// Binary operations expect both operands to have the same number of variables; if they differ
/// the result has the larger number, the variables of both counted from the first. The total
/// degree of a product must be below 2³²: derivations refuse more, and `*` returns zero.
#[derive(Clone)]
pub struct Polynomial {
    pub(super) variables: usize,
    /// No term has a greater total degree.
    pub(super) bound: u32,
    pub(super) keys: Keys,
    pub(super) values: Fractions,
}

/// The monomials of a polynomial, descending.
#[derive(Clone)]
pub(crate) enum Keys {
    Packed(Vec<u128>),
    Sparse(Vec<Factors>),
}

impl Keys {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Packed(keys) => keys.len(),
            Self::Sparse(keys) => keys.len(),
        }
    }

    pub(super) fn packed(&self) -> &[u128] {
        match self {
            Self::Packed(keys) => keys,
            Self::Sparse(_) => &[],
        }
    }

    pub(super) fn sparse(&self) -> &[Factors] {
        match self {
            Self::Packed(_) => &[],
            Self::Sparse(keys) => keys,
        }
    }
}

impl Polynomial {
    /// The zero polynomial.
    pub fn zero(variables: usize) -> Self {
        let keys = match Packing::new(variables) {
            Some(_) => Keys::Packed(Vec::new()),
            None => Keys::Sparse(Vec::new()),
        };
        Self { variables, bound: 0, keys, values: Fractions::empty() }
    }

    /// A constant polynomial.
    pub fn constant(variables: usize, value: Rational) -> Self {
        Self::from_factors(variables, [(Vec::new(), value)])
    }

    /// The polynomial that is the variable of this index; zero if there is no such variable.
    pub fn variable(variables: usize, index: usize) -> Self {
        if index >= variables {
            return Self::zero(variables);
        }
        Self::from_factors(variables, [(vec![(index as u32, 1)], Rational::one())])
    }

    /// The sum of the given terms (exponents of all variables, coefficient). Exponents beyond the
    /// number of variables are ignored, missing ones are zero.
    pub fn from_terms(
        variables: usize,
        terms: impl IntoIterator<Item = (Vec<u32>, Rational)>,
    ) -> Self {
        let factors = terms.into_iter().map(|(exponents, value)| {
            let factors = exponents.iter().enumerate().map(|(i, &e)| (i as u32, e)).collect();
            (factors, value)
        });
        Self::from_factors(variables, factors)
    }

    /// The sum of the given terms, each a list of factors (variable, exponent) and a coefficient.
    pub fn from_factors(
        variables: usize,
        terms: impl IntoIterator<Item = (Vec<(u32, u32)>, Rational)>,
    ) -> Self {
        let mut sums: BTreeMap<std::cmp::Reverse<Factors>, Rational> = BTreeMap::new();
        for (factors, value) in terms {
            cancel::check();
            let mut merged: BTreeMap<u32, u32> = BTreeMap::new();
            for (variable, exponent) in factors {
                if exponent > 0 && (variable as usize) < variables {
                    let slot = merged.entry(variable).or_insert(0);
                    *slot = slot.saturating_add(exponent);
                }
            }
            let key = Factors(merged.into_iter().collect());
            *sums.entry(std::cmp::Reverse(key)).or_insert_with(Rational::zero) += value;
        }
        sums.retain(|_, value| !value.is_zero());
        let bound = sums.keys().map(|key| degree(&key.0)).max().unwrap_or(0);
        let values: Vec<Rational> = sums.values().cloned().collect();
        let values = Fractions::from_rationals(&values);
        let keys = sums.into_keys().map(|key| key.0);
        let keys = match Self::packing(variables, bound) {
            Some(packing) => Keys::Packed(keys.map(|key| packing.pack(&key.0)).collect()),
            None => Keys::Sparse(keys.collect()),
        };
        Self { variables, bound, keys, values }
    }

    /// The packing of monomials up to a total degree, if there is one.
    pub(super) fn packing(variables: usize, bound: u32) -> Option<Packing> {
        Packing::new(variables).filter(|packing| packing.holds(bound))
    }

    pub(super) fn assemble(variables: usize, bound: u32, keys: Keys, values: Fractions) -> Self {
        Self { variables, bound, keys, values }
    }

    /// The keys in the packed form, or as lists of factors. Packed is asked for only where the
    /// degrees fit.
    pub(super) fn keys_for(&self, packed: bool) -> Cow<'_, Keys> {
        match (&self.keys, packed, Packing::new(self.variables)) {
            (Keys::Packed(keys), false, Some(packing)) => Cow::Owned(Keys::Sparse(
                keys.iter().map(|&key| Factors(packing.unpack(key).into())).collect(),
            )),
            (Keys::Sparse(keys), true, Some(packing)) => {
                Cow::Owned(Keys::Packed(keys.iter().map(|key| packing.pack(&key.0)).collect()))
            }
            _ => Cow::Borrowed(&self.keys),
        }
    }

    /// Adds variables until there are `variables`.
    pub fn widened(&self, variables: usize) -> Cow<'_, Self> {
        if variables <= self.variables {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self::from_factors(variables, self.factors()))
    }

    /// The number of variables of the polynomial's ring, whether they occur or not.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// True for the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.keys.len() == 0
    }

    /// The number of terms.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// The number of 64-bit words of the largest numerator; one for machine integers.
    pub(crate) fn words(&self) -> usize {
        match &self.values {
            Fractions::Small { .. } => 1,
            large => usize::try_from(large.bits() / 64 + 1).unwrap_or(usize::MAX),
        }
    }

    /// The total degree; zero for the zero polynomial.
    pub fn degree(&self) -> u32 {
        (0..self.len()).map(|i| self.monomial(i).iter().map(|(_, e)| e).sum()).max().unwrap_or(0)
    }

    fn monomial(&self, index: usize) -> Cow<'_, [(u32, u32)]> {
        match (&self.keys, Packing::new(self.variables)) {
            (Keys::Packed(keys), Some(packing)) => Cow::Owned(packing.unpack(keys[index])),
            (Keys::Sparse(keys), _) => Cow::Borrowed(&keys[index].0),
            // Packed keys exist only where a packing does.
            (Keys::Packed(_), None) => Cow::Borrowed(&[]),
        }
    }

    /// The terms (exponents of all variables, coefficient), exponents descending
    /// lexicographically.
    pub fn terms(&self) -> impl Iterator<Item = (Vec<u32>, Rational)> + '_ {
        (0..self.len()).map(|index| {
            let mut exponents = vec![0; self.variables];
            for &(variable, exponent) in self.monomial(index).iter() {
                exponents[variable as usize] = exponent;
            }
            (exponents, self.values.get(index))
        })
    }

    /// The terms as factors (variable, exponent), ascending by variable, and coefficient; in the
    /// order of [`terms`](Self::terms). Costs nothing for variables that do not occur.
    pub fn factors(&self) -> impl Iterator<Item = (Vec<(u32, u32)>, Rational)> + '_ {
        (0..self.len()).map(|index| (self.monomial(index).into_owned(), self.values.get(index)))
    }

    /// The value at a point in floating point; missing coordinates count as zero.
    pub fn evaluate(&self, point: &[f64]) -> f64 {
        let mut sum = 0.0;
        for index in 0..self.len() {
            let mut term = self.values.to_f64(index);
            for &(variable, exponent) in self.monomial(index).iter() {
                let x = point.get(variable as usize).copied().unwrap_or(0.0);
                term *= x.powi(i32::try_from(exponent).unwrap_or(i32::MAX));
            }
            sum += term;
        }
        sum
    }
}

fn degree(factors: &Factors) -> u32 {
    factors.0.iter().fold(0_u32, |sum, (_, e)| sum.saturating_add(*e))
}

impl PartialEq for Polynomial {
    fn eq(&self, other: &Self) -> bool {
        if self.variables != other.variables || self.values != other.values {
            return false;
        }
        match (&self.keys, &other.keys) {
            (Keys::Packed(a), Keys::Packed(b)) => a == b,
            (Keys::Sparse(a), Keys::Sparse(b)) => a == b,
            _ => (0..self.len()).all(|i| self.monomial(i) == other.monomial(i)),
        }
    }
}

impl Eq for Polynomial {}

impl std::fmt::Debug for Polynomial {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.is_zero() {
            return f.write_str("0");
        }
        for (index, (factors, value)) in self.factors().enumerate() {
            if index > 0 {
                f.write_str(" + ")?;
            }
            write!(f, "{value}")?;
            for (variable, exponent) in factors {
                write!(f, "*x{variable}^{exponent}")?;
            }
        }
        Ok(())
    }
}

/// Σ c · Π x_i^power over (c, [(i, power)]).
#[derive(Clone, Debug, Default)]
pub struct Numeric(Vec<(f64, Vec<(usize, i32)>)>);

impl Numeric {
    /// `polynomial` in its first `variables` variables, with these values of the symbols after them.
    pub fn new(polynomial: &Polynomial, variables: usize, symbols: &[f64]) -> Self {
        let mut terms: Vec<(f64, Vec<(usize, i32)>)> = Vec::new();
        for (factors, value) in polynomial.factors() {
            let mut coefficient = value.to_f64().unwrap_or(f64::NAN);
            let mut own = Vec::new();
            for (i, power) in factors {
                let (i, power) = (i as usize, power as i32);
                match i.checked_sub(variables) {
                    Some(symbol) => {
                        coefficient *= symbols.get(symbol).map_or(f64::NAN, |x| x.powi(power));
                    }
                    None => own.push((i, power)),
                }
            }
            // Terms that differ in their symbols alone follow each other.
            match terms.last_mut() {
                Some((sum, factors)) if *factors == own => *sum += coefficient,
                _ => terms.push((coefficient, own)),
            }
        }
        Self(terms)
    }

    /// The value at x.
    pub fn value(&self, x: &[f64]) -> f64 {
        let product = |factors: &[(usize, i32)]| -> f64 {
            factors.iter().map(|&(i, power)| x[i].powi(power)).product()
        };
        self.0.iter().map(|(value, factors)| value * product(factors)).sum()
    }

    /// With the absolute values of the coefficients: at |x| the sum of the sizes of the terms, against which rounding and drift
    /// of the value are measured.
    #[must_use]
    pub fn absolute(&self) -> Self {
        Self(self.0.iter().map(|(value, factors)| (value.abs(), factors.clone())).collect())
    }

    /// The value at x as a node.
    pub fn node(&self, graph: &Graph, x: &[Id]) -> Id {
        self.0.iter().fold(graph.zero(), |sum, (value, factors)| {
            let power = |&(i, power): &(usize, i32)| graph.power(x[i], power.unsigned_abs());
            let term =
                factors.iter().map(power).fold(graph.constant(*value), |a, b| graph.mul(a, b));
            graph.add(sum, term)
        })
    }

    /// The terms.
    pub fn terms(&self) -> impl Iterator<Item = (f64, &[(usize, i32)])> {
        self.0.iter().map(|(value, factors)| (*value, factors.as_slice()))
    }

    /// The derivatives by the first `dim` variables.
    pub fn gradient(&self, dim: usize) -> Vec<Self> {
        let derivative = |i: usize| {
            let terms = self.0.iter().filter_map(|(value, factors)| {
                let at = factors.iter().position(|factor| factor.0 == i)?;
                let mut factors = factors.clone();
                let power = factors[at].1;
                factors[at].1 -= 1;
                factors.retain(|factor| factor.1 > 0);
                Some((value * f64::from(power), factors))
            });
            Self(terms.collect())
        };
        (0..dim).map(derivative).collect()
    }
}

/// A monomial as a key of tables and sorted lists. A greater key has the lexicographically greater
/// exponents.
pub(crate) trait Key: Clone + Ord {
    /// The product of two monomials.
    fn product(&self, other: &Self) -> Self;
    /// A well mixed hash; tables use its upper bits.
    fn hash(&self) -> u64;
}

/// A packing of the exponents of a given number of variables into 128 bits, the first variable in the highest bits, so that
/// integer order is lexicographic order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Packing {
    variables: usize,
    width: u32,
}

impl Packing {
    /// `None` for more variables than leave four bits for each.
    pub(crate) fn new(variables: usize) -> Option<Self> {
        let width = match variables {
            0 => 32,
            1..=32 => (128 / variables as u32).min(32),
            _ => return None,
        };
        Some(Self { variables, width })
    }

    /// True if every monomial of this total degree fits, so that sums of keys cannot carry.
    pub(crate) fn holds(self, degree: u32) -> bool {
        u64::from(degree) < 1_u64 << self.width
    }

    #[inline(always)]
    pub(crate) fn shift(self, variable: usize) -> u32 {
        (self.variables - 1 - variable) as u32 * self.width
    }

    pub(crate) fn mask(self) -> u128 {
        (1_u128 << self.width) - 1
    }

    pub(crate) fn pack(self, factors: &[(u32, u32)]) -> u128 {
        let mut key = 0;
        for &(variable, exponent) in factors {
            key += u128::from(exponent) << self.shift(variable as usize);
        }
        key
    }

    pub(crate) fn unpack(self, key: u128) -> Vec<(u32, u32)> {
        let mut factors = Vec::new();
        for variable in 0..self.variables {
            let exponent = (key >> self.shift(variable)) & self.mask();
            if exponent > 0 {
                factors.push((variable as u32, exponent as u32));
            }
        }
        factors
    }
}

impl Key for u128 {
    #[inline(always)]
    fn product(&self, other: &Self) -> Self {
        self.wrapping_add(*other)
    }

    #[inline(always)]
    fn hash(&self) -> u64 {
        let low = (*self as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let high = ((*self >> 64) as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        let mixed = low ^ high.rotate_left(32);
        mixed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }
}

/// The factors (variable, exponent) of a monomial, ascending by variable, exponents positive.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Factors(pub(crate) Box<[(u32, u32)]>);

impl Ord for Factors {
    fn cmp(&self, other: &Self) -> Ordering {
        for (a, b) in self.0.iter().zip(&other.0) {
            // The smaller variable is the more significant one.
            let order = b.0.cmp(&a.0).then(a.1.cmp(&b.1));
            if order != Ordering::Equal {
                return order;
            }
        }
        self.0.len().cmp(&other.0.len())
    }
}

impl PartialOrd for Factors {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Key for Factors {
    fn product(&self, other: &Self) -> Self {
        Self(product(&self.0, &other.0).into_boxed_slice())
    }

    fn hash(&self) -> u64 {
        let mut hash = 0_u64;
        for &(variable, exponent) in &self.0 {
            let word = (u64::from(variable) << 32) | u64::from(exponent);
            hash = (hash.rotate_left(23) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        }
        hash
    }
}

/// Factors (variable, exponent), ascending by variable.
type Monomial = [(u32, u32)];

/// The product of two monomials.
pub fn product(a: &Monomial, b: &Monomial) -> Vec<(u32, u32)> {
    let mut result = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].0.cmp(&b[j].0) {
            Ordering::Less => {
                result.push(a[i]);
                i += 1;
            }
            Ordering::Greater => {
                result.push(b[j]);
                j += 1;
            }
            Ordering::Equal => {
                // The degree of every product is checked to fit before.
                result.push((a[i].0, a[i].1.saturating_add(b[j].1)));
                i += 1;
                j += 1;
            }
        }
    }
    result.extend_from_slice(&a[i..]);
    result.extend_from_slice(&b[j..]);
    result
}

/// The factors with variables before this one, the momenta say, and the others.
pub fn split_at(factors: &Monomial, variable: usize) -> (&Monomial, &Monomial) {
    factors.split_at(factors.partition_point(|&(own, _)| (own as usize) < variable))
}
