//! Power series in t whose coefficients are computed one after the other, never twice.

use super::{DeriveError, TermLimit};
use crate::number::{Rational, integer};
use crate::poly::{Polynomial, Product, SumError, sum_of_products};
use num_traits::One;
use std::collections::BTreeMap;

/// The highest degree of a Hamiltonian.
const HIGHEST_DEGREE: u32 = 1000;

/// The coefficients of t⁰, t¹, … known so far.
pub(crate) type Series = Vec<Polynomial>;

/// Counts the work done and stops when it exceeds the limit.
pub(crate) struct Work {
    limit: TermLimit,
    products: u64,
    pub(crate) order: usize,
    pub(crate) variables: usize,
}

impl Work {
    pub(crate) fn new(variables: usize, limit: TermLimit) -> Self {
        Self { limit, products: 0, order: 0, variables }
    }

    /// Σ factor · left · right.
    pub(crate) fn sum(
        &mut self,
        products: &[(Rational, &Polynomial, &Polynomial)],
    ) -> Result<Polynomial, DeriveError> {
        let mut list = Vec::with_capacity(products.len());
        let mut count = 1_usize;
        for (factor, left, right) in products {
            let pairs = left.len().saturating_mul(right.len());
            let cost = left.words().saturating_mul(right.words());
            count = count.saturating_add(pairs.saturating_mul(cost));
            list.push(Product { factor: factor.clone(), left, right });
        }
        self.charge(count)?;
        let sum = sum_of_products(self.variables, &list, self.limit.terms);
        sum.map_err(|error| match error {
            SumError::Terms(terms) => {
                DeriveError::TooLarge { order: self.order, terms, limit: self.limit.terms }
            }
            SumError::Degree => DeriveError::Degree { degree: u32::MAX, limit: HIGHEST_DEGREE },
        })
    }

    /// Counts products of words before they are made.
    pub(crate) fn charge(&mut self, products: usize) -> Result<(), DeriveError> {
        self.products = self.products.saturating_add(products as u64);
        if self.products > self.limit.products {
            return Err(DeriveError::TooMuchWork {
                order: self.order,
                products: self.products,
                limit: self.limit.products,
            });
        }
        Ok(())
    }
}

/// Pushes the products of the coefficient of t^`order` in left · right.
pub(crate) fn convolve<'a>(
    list: &mut Vec<(Rational, &'a Polynomial, &'a Polynomial)>,
    factor: &Rational,
    left: &'a [Polynomial],
    right: &'a [Polynomial],
    order: usize,
) {
    for (i, a) in left.iter().enumerate().take(order + 1) {
        if let Some(b) = right.get(order - i)
            && !a.is_zero()
            && !b.is_zero()
        {
            list.push((factor.clone(), a, b));
        }
    }
}

/// The factors (variable, exponent) of a monomial and its coefficient.
type Term = (Vec<(u32, u32)>, Rational);

/// Polynomials in the momenta evaluated on a series, in nested (Horner) form with shared parts.
pub(crate) struct Composition {
    nodes: Vec<Node>,
    roots: Vec<usize>,
}

struct Node {
    /// The part without momenta: a polynomial in the symbols.
    constant: Polynomial,
    /// (momentum a, node of the cofactor): the node is constant + Σ_a μ_a · cofactor.
    branches: Vec<(usize, usize)>,
    series: Series,
}

impl Composition {
    pub(crate) fn new(dimension: usize, polynomials: &[Polynomial]) -> Result<Self, DeriveError> {
        let mut composition = Self { nodes: Vec::new(), roots: Vec::new() };
        let mut known = BTreeMap::new();
        for polynomial in polynomials {
            // The form nests as deep as the degree.
            let degree = polynomial.degree();
            if degree > HIGHEST_DEGREE {
                return Err(DeriveError::Degree { degree, limit: HIGHEST_DEGREE });
            }
            let terms = polynomial.factors().collect();
            let root = composition.insert(dimension, polynomial.variables(), terms, &mut known);
            composition.roots.push(root);
        }
        Ok(composition)
    }

    fn insert(
        &mut self,
        dimension: usize,
        variables: usize,
        terms: Vec<Term>,
        known: &mut BTreeMap<Vec<Term>, usize>,
    ) -> usize {
        if let Some(node) = known.get(&terms) {
            return *node;
        }
        let mut constant = Vec::new();
        let mut parts: BTreeMap<usize, Vec<Term>> = BTreeMap::new();
        for (factors, value) in &terms {
            // Factors ascend, so a momentum comes first if there is one.
            match factors.first() {
                Some(&(a, exponent)) if (a as usize) < dimension => {
                    let mut rest = factors.clone();
                    match exponent {
                        1 => drop(rest.remove(0)),
                        _ => rest[0].1 = exponent - 1,
                    }
                    parts.entry(a as usize).or_default().push((rest, value.clone()));
                }
                _ => constant.push((factors.clone(), value.clone())),
            }
        }
        let mut branches = Vec::new();
        for (a, part) in parts {
            branches.push((a, self.insert(dimension, variables, part, known)));
        }
        let constant = Polynomial::from_factors(variables, constant);
        self.nodes.push(Node { constant, branches, series: Vec::new() });
        known.insert(terms, self.nodes.len() - 1);
        self.nodes.len() - 1
    }

    /// Computes the coefficient of t^`order` of every node from the series of the momenta, which
    /// must be known through that order.
    pub(crate) fn extend(
        &mut self,
        work: &mut Work,
        momenta: &[Series],
        order: usize,
    ) -> Result<(), DeriveError> {
        let one = Polynomial::constant(work.variables, Rational::one());
        for index in 0..self.nodes.len() {
            let node = &self.nodes[index];
            let mut list = Vec::new();
            if order == 0 && !node.constant.is_zero() {
                list.push((Rational::one(), &node.constant, &one));
            }
            for &(a, child) in &node.branches {
                let child = &self.nodes[child].series;
                convolve(&mut list, &Rational::one(), &momenta[a], child, order);
            }
            let value = work.sum(&list)?;
            self.nodes[index].series.push(value);
        }
        Ok(())
    }

    /// The coefficient of t^`order` of the polynomial of this index.
    pub(crate) fn coefficient(&self, polynomial: usize, order: usize) -> &Polynomial {
        &self.nodes[self.roots[polynomial]].series[order]
    }
}

/// The identity series μ: t⁰ is the momenta themselves.
pub(crate) fn identity(dimension: usize, variables: usize) -> Vec<Series> {
    (0..dimension).map(|i| vec![Polynomial::variable(variables, i)]).collect()
}

/// 1/order as a rational.
pub(crate) fn reciprocal(order: usize) -> Rational {
    integer(order.max(1) as i64).recip()
}
