//! The chart's derivatives as power series in t, coefficient by coefficient, for a series x(t) without constant term.

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use crate::hamilton_jacobi::{DeriveError, TermLimit};
use crate::lie::{Chart, CubicEntry, LieAlgebra, cubic};
use crate::number::{BernoulliWeights, Rational, integer, ratio};
use crate::poly::{Arithmetic, Multiplication, Polynomial, SumError, sum_of_products};

/// Selects a map of the algebra or its transpose.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// ad_x and xξx.
    Algebra,
    /// ad_x^T and ξ ↦ ⟨v, xξx⟩.
    Dual,
}

/// The coefficient of t^`order` in [x, v], whose component k is Σ_{i,j} c_ij^k x_i v_j, or in ad_x^T v, whose component j is
/// Σ_{i,k} c_ij^k x_i v_k.
pub(super) fn bilinear(
    work: &mut Work,
    algebra: &LieAlgebra,
    side: Side,
    (x, v): (&[Series], &[Series]),
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    // Looking through zeros is work too, or a long truncation of a trivial flow would never end.
    work.charge(algebra.structure().len().saturating_mul(order + 1))?;
    let mut lists = vec![Vec::new(); algebra.dim()];
    for c in algebra.structure() {
        let (from, to) = match side {
            Side::Algebra => (c.j, c.k),
            Side::Dual => (c.k, c.j),
        };
        convolve(&mut lists[to], &c.value, &x[c.i], &v[from], order);
    }
    lists.iter().map(|list| work.sum(list)).collect()
}

/// Σ_j weight(j) A^j v for A = ad_x or its transpose.
pub(super) struct Powers<'a> {
    algebra: &'a LieAlgebra,
    side: Side,
    /// A^j v for j ≥ 1; x has no constant term, so power j begins at order j.
    powers: Vec<Vec<Series>>,
}

impl<'a> Powers<'a> {
    pub(super) fn new(algebra: &'a LieAlgebra, side: Side) -> Self {
        Self { algebra, side, powers: Vec::new() }
    }

    /// The coefficient of t^`order`, that of v counting as 0 where it is missing.
    pub(super) fn extend(
        &mut self,
        work: &mut Work,
        (x, v): (&[Series], &[Series]),
        order: usize,
        mut weight: impl FnMut(usize) -> Rational,
    ) -> Result<Vec<Polynomial>, DeriveError> {
        if order > 0 {
            let zeros = vec![Polynomial::zero(work.variables); order];
            self.powers.push(vec![zeros; v.len()]);
        }
        for j in 1..=order {
            let below = if j == 1 { v } else { &self.powers[j - 2] };
            let next = bilinear(work, self.algebra, self.side, (x, below), order)?;
            for (series, coefficient) in self.powers[j - 1].iter_mut().zip(next) {
                series.push(coefficient);
            }
        }
        let one = Polynomial::constant(work.variables, Rational::one());
        let weights: Vec<Rational> = (0..=order).map(&mut weight).collect();
        let sum = |(i, v): (usize, &Series)| {
            let of = |j: usize| match j {
                0 => v.get(order),
                j => self.powers[j - 1][i].get(order),
            };
            let terms = weights.iter().enumerate().filter(|(_, weight)| !weight.is_zero());
            let terms: Vec<_> =
                terms.filter_map(|(j, weight)| Some((weight.clone(), of(j)?, &one))).collect();
            work.sum(&terms)
        };
        v.iter().enumerate().map(sum).collect()
    }
}

/// (d^L τ_x)⁻¹ v, or its transpose J_R(x, v).
pub(super) struct Inverse<'a> {
    form: Form<'a>,
    side: Side,
    algebra: &'a LieAlgebra,
}

enum Form<'a> {
    /// The weights (−1)^k B_k/k!.
    Exponential(BernoulliWeights, Powers<'a>),
    /// v + ½ A v − ¼ xvx.
    Cayley(Vec<CubicEntry>),
}

impl<'a> Inverse<'a> {
    pub(super) fn new(
        algebra: &'a LieAlgebra,
        chart: Chart,
        side: Side,
    ) -> Result<Self, DeriveError> {
        let form = match chart {
            Chart::Exponential => {
                Form::Exponential(BernoulliWeights::default(), Powers::new(algebra, side))
            }
            Chart::Cayley => Form::Cayley(cubic(algebra)?),
        };
        Ok(Self { form, side, algebra })
    }

    /// The coefficient of t^`order`; x and v must be known through that order, a missing coefficient of v counting as 0.
    pub(super) fn extend(
        &mut self,
        work: &mut Work,
        (x, v): (&[Series], &[Series]),
        order: usize,
    ) -> Result<Vec<Polynomial>, DeriveError> {
        match &mut self.form {
            Form::Exponential(weights, powers) => {
                powers.extend(work, (x, v), order, |j| weights.get(j))
            }
            Form::Cayley(cubic) => {
                let linear = bilinear(work, self.algebra, self.side, (x, v), order)?;
                let square = sandwich(work, cubic, self.side, (x, v), order)?;
                let one = Polynomial::constant(work.variables, Rational::one());
                let zero = Polynomial::zero(work.variables);
                let sum = |i: usize| {
                    work.sum(&[
                        (Rational::one(), v[i].get(order).unwrap_or(&zero), &one),
                        (ratio(1, 2), &linear[i], &one),
                        (ratio(-1, 4), &square[i], &one),
                    ])
                };
                (0..v.len()).map(sum).collect()
            }
        }
    }
}

/// The coefficient of t^`order` of xvx, or of ξ ↦ ⟨v, xξx⟩.
pub(super) fn sandwich(
    work: &mut Work,
    cubic: &[CubicEntry],
    side: Side,
    (x, v): (&[Series], &[Series]),
    order: usize,
) -> Result<Vec<Polynomial>, DeriveError> {
    let mut result = vec![Polynomial::zero(work.variables); v.len()];
    let one = Polynomial::constant(work.variables, Rational::one());
    for entry in cubic {
        // Both are one trilinear form; the transpose exchanges argument and result.
        let (from, to) = match side {
            Side::Algebra => (entry.argument, entry.result),
            Side::Dual => (entry.result, entry.argument),
        };
        for i in 0..=order {
            let Some(v) = v[from].get(order - i).filter(|v| !v.is_zero()) else { continue };
            let mut list = Vec::new();
            convolve(&mut list, &entry.value, &x[entry.first], &x[entry.second], i);
            let square = work.sum(&list)?;
            result[to] =
                work.sum(&[(Rational::one(), &result[to], &one), (Rational::one(), &square, v)])?;
        }
    }
    Ok(result)
}

/// The highest degree of a Hamiltonian.
const HIGHEST_DEGREE: u32 = 1000;

/// The coefficients of t⁰, t¹, … known so far.
pub(crate) type Series = Vec<Polynomial>;

/// Counts the work done and stops when it exceeds the limit.
pub(crate) struct Work {
    limit: TermLimit,
    arithmetic: Arithmetic,
    products: u64,
    pub(crate) order: usize,
    pub(crate) variables: usize,
}

impl Work {
    pub(crate) fn new(variables: usize, limit: TermLimit, arithmetic: Arithmetic) -> Self {
        Self { limit, arithmetic, products: 0, order: 0, variables }
    }

    /// Work with the Hamiltonian of a group of this dimension.
    ///
    /// # Errors
    /// Refuses one that has fewer variables than momenta.
    pub(super) fn on(
        hamiltonian: &Polynomial,
        dimension: usize,
        limit: TermLimit,
        arithmetic: Arithmetic,
    ) -> Result<Self, DeriveError> {
        match hamiltonian.variables() {
            variables if variables < dimension => {
                Err(DeriveError::Variables { variables, dimension })
            }
            variables => Ok(Self::new(variables, limit, arithmetic)),
        }
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
            list.push(Multiplication { factor: factor.clone(), left, right });
        }
        self.charge(count)?;
        let sum = sum_of_products(self.variables, &list, self.limit.terms, self.arithmetic);
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
    nodes: Vec<Vertex>,
    roots: Vec<usize>,
}

struct Vertex {
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
        self.nodes.push(Vertex { constant, branches, series: Vec::new() });
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
