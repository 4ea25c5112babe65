//! The polynomial type.

use crate::number::{Rational, integer};
use num_traits::{One, ToPrimitive, Zero};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::{Add, Mul, Neg, Sub};

/// A polynomial in a fixed number of variables with exact rational coefficients.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Polynomial {
    variables: usize,
    terms: BTreeMap<Reverse<Vec<u32>>, Rational>,
}

impl Polynomial {
    /// The zero polynomial.
    #[must_use]
    pub fn zero(variables: usize) -> Self {
        Self { variables, terms: BTreeMap::new() }
    }

    /// A constant polynomial.
    #[must_use]
    pub fn constant(variables: usize, value: Rational) -> Self {
        Self::from_terms(variables, [(vec![0; variables], value)])
    }

    /// The polynomial that is the variable of this index; zero if there is no such variable.
    #[must_use]
    pub fn variable(variables: usize, index: usize) -> Self {
        if index >= variables {
            return Self::zero(variables);
        }
        let mut exponents = vec![0; variables];
        exponents[index] = 1;
        Self::from_terms(variables, [(exponents, Rational::one())])
    }

    /// The sum of the given terms; exponents are padded or cut to the number of variables.
    pub fn from_terms(
        variables: usize,
        terms: impl IntoIterator<Item = (Vec<u32>, Rational)>,
    ) -> Self {
        let mut result = Self::zero(variables);
        for (mut exponents, value) in terms {
            exponents.resize(variables, 0);
            result.add_term(exponents, value);
        }
        result
    }

    fn add_term(&mut self, exponents: Vec<u32>, value: Rational) {
        let slot = self.terms.entry(Reverse(exponents)).or_insert_with(Rational::zero);
        *slot += value;
        self.terms.retain(|_, v| !v.is_zero());
    }

    /// How many variables the polynomial has, used or not.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Whether it is the zero polynomial.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The number of terms.
    #[must_use]
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether there are no terms; the same as [`is_zero`](Self::is_zero).
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// The total degree; zero for the zero polynomial.
    #[must_use]
    pub fn degree(&self) -> u32 {
        self.terms.keys().map(|Reverse(e)| e.iter().sum()).max().unwrap_or(0)
    }

    /// The terms, exponents descending lexicographically.
    pub fn terms(&self) -> impl Iterator<Item = (Vec<u32>, Rational)> + '_ {
        self.terms.iter().map(|(Reverse(e), c)| (e.clone(), c.clone()))
    }

    /// The partial derivative by the variable of this index.
    #[must_use]
    pub fn derivative(&self, index: usize) -> Self {
        let mut result = Self::zero(self.variables);
        for (Reverse(e), c) in &self.terms {
            if index < self.variables && e[index] > 0 {
                let mut exponents = e.clone();
                exponents[index] -= 1;
                result.terms.insert(Reverse(exponents), c * integer(i64::from(e[index])));
            }
        }
        result
    }

    /// The polynomial times a number.
    #[must_use]
    pub fn scale(&self, factor: &Rational) -> Self {
        if factor.is_zero() {
            return Self::zero(self.variables);
        }
        let terms = self.terms.iter().map(|(e, c)| (e.clone(), c * factor)).collect();
        Self { variables: self.variables, terms }
    }

    /// The polynomial to a power.
    #[must_use]
    pub fn pow(&self, exponent: u32) -> Self {
        let mut result = Self::constant(self.variables, Rational::one());
        for _ in 0..exponent {
            result = &result * self;
        }
        result
    }

    /// The value at a point; missing coordinates count as zero.
    #[must_use]
    pub fn evaluate(&self, point: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (Reverse(exponents), c) in &self.terms {
            let mut term = c.to_f64().unwrap_or(f64::NAN);
            for (i, &e) in exponents.iter().enumerate() {
                if e > 0 {
                    term *= point.get(i).copied().unwrap_or(0.0).powi(e as i32);
                }
            }
            sum += term;
        }
        sum
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: &Polynomial) -> Polynomial {
        let mut result = self.clone();
        for (Reverse(e), c) in &other.terms {
            result.add_term(e.clone(), c.clone());
        }
        result
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        self.scale(&integer(-1))
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: &Polynomial) -> Polynomial {
        self + &-other
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: &Polynomial) -> Polynomial {
        let mut terms: BTreeMap<Reverse<Vec<u32>>, Rational> = BTreeMap::new();
        for (Reverse(a), x) in &self.terms {
            for (Reverse(b), y) in &other.terms {
                let exponents = a.iter().zip(b).map(|(i, j)| i + j).collect();
                *terms.entry(Reverse(exponents)).or_insert_with(Rational::zero) += x * y;
            }
        }
        terms.retain(|_, v| !v.is_zero());
        Polynomial { variables: self.variables, terms }
    }
}
