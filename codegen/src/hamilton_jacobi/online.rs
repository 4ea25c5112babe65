//! Power series in t whose coefficients are computed one after the other, never twice.

use super::{DeriveError, TermLimit};
use crate::lie::{LieAlgebra, StructureConstant};
use crate::number::{Rational, integer};
use crate::poly::{Polynomial, Product, sum_of_products};
use num_traits::One;
use std::collections::BTreeMap;

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
        for (factor, left, right) in products {
            self.products = self
                .products
                .saturating_add((left.len() as u64).saturating_mul(right.len() as u64));
            list.push(Product { factor: factor.clone(), left, right });
        }
        if self.products > self.limit.products {
            return Err(DeriveError::TooMuchWork {
                order: self.order,
                products: self.products,
                limit: self.limit.products,
            });
        }
        sum_of_products(self.variables, &list, self.limit.terms).map_err(|terms| {
            DeriveError::TooLarge { order: self.order, terms, limit: self.limit.terms }
        })
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

/// The coefficient of t^`order` in ad_x^T w: component j is Σ_{i,l} c_ij^l x_i w_l.
pub(crate) fn coadjoint(
    work: &mut Work,
    algebra: &LieAlgebra,
    x: &[Series],
    w: &[Series],
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    bilinear(work, algebra, order, |c| (c.j, &x[c.i], &w[c.k]))
}

/// The coefficient of t^`order` in [x, w]: component k is Σ_{i,j} c_ij^k x_i w_j.
pub(crate) fn adjoint(
    work: &mut Work,
    algebra: &LieAlgebra,
    x: &[Series],
    w: &[Series],
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    bilinear(work, algebra, order, |c| (c.k, &x[c.i], &w[c.j]))
}

fn bilinear<'a>(
    work: &mut Work,
    algebra: &LieAlgebra,
    order: usize,
    select: impl Fn(&StructureConstant) -> (usize, &'a Series, &'a Series),
) -> Result<Vec<Polynomial>, DeriveError> {
    let mut lists = vec![Vec::new(); algebra.dim()];
    for c in algebra.structure() {
        let (component, left, right) = select(c);
        convolve(&mut lists[component], &c.value, left, right, order);
    }
    lists.iter().map(|list| work.sum(list)).collect()
}

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
    pub(crate) fn new(dimension: usize, polynomials: &[Polynomial]) -> Self {
        let mut composition = Self { nodes: Vec::new(), roots: Vec::new() };
        let mut known = Vec::new();
        for polynomial in polynomials {
            let root = composition.insert(dimension, polynomial, &mut known);
            composition.roots.push(root);
        }
        composition
    }

    fn insert(
        &mut self,
        dimension: usize,
        polynomial: &Polynomial,
        known: &mut Vec<(Polynomial, usize)>,
    ) -> usize {
        if let Some((_, node)) = known.iter().find(|(p, _)| p == polynomial) {
            return *node;
        }
        let variables = polynomial.variables();
        let mut constant = Vec::new();
        let mut parts: BTreeMap<usize, Vec<(Vec<u32>, Rational)>> = BTreeMap::new();
        for (mut exponents, value) in polynomial.terms() {
            match exponents.iter().take(dimension).position(|&e| e > 0) {
                None => constant.push((exponents, value)),
                Some(a) => {
                    exponents[a] -= 1;
                    parts.entry(a).or_default().push((exponents, value));
                }
            }
        }
        let mut branches = Vec::new();
        for (a, terms) in parts {
            let part = Polynomial::from_terms(variables, terms);
            branches.push((a, self.insert(dimension, &part, known)));
        }
        self.nodes.push(Node {
            constant: Polynomial::from_terms(variables, constant),
            branches,
            series: Vec::new(),
        });
        known.push((polynomial.clone(), self.nodes.len() - 1));
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
