//! The comoving frame: a part of H whose flow is known and commutes with the rest.
//!
//! A free body turns at Ω = I⁻¹Π, and most of that is uniform: with c between the 1/Iᵢ the part c|Π|²/2
//! of H, a Casimir, makes it turn about the fixed direction of its momentum, and what the body does in the
//! frame that turns along is slow. A symmetric top's spin s is an integral; without ½(1/I₃ − 1/I₁)s² it
//! is a spherical top, which knows nothing of the spin. In both cases H = H₀ + f with commuting flows,
//! that of f is exp of something known, and only H₀ is left to the series: it has fewer terms, and they
//! are smaller by powers of the ratio of the speeds.

use crate::expr::ParameterExpr;
use crate::hamilton_jacobi::{TermLimit, derive};
use crate::lie::{Chart, LieAlgebra, casimirs};
use crate::number::Rational;
use crate::poly::Polynomial;
use crate::problem::Symbol;
use num_traits::{One, Signed, ToPrimitive};
use std::collections::{BTreeMap, BTreeSet};

/// The truncation at which series are compared: what S₃ vanishes from vanishes from all.
const COMPARED: usize = 3;

/// The part f of H that moves the frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Functions of coordinates s = μ_e that are integrals and commute: the flow turns g and μ about
    /// the axes e.
    pub spin: Polynomial,
    /// Multiples of quadratic Casimirs C: the flow moves g along ∂C/∂μ and leaves μ.
    pub casimirs: Polynomial,
    /// H − f, which is left to the series.
    pub rest: Polynomial,
}

impl Frame {
    /// Makes every sum of symbols in the rest, 1/I₁ − 1/I₂ say, a symbol of its own: the series would
    /// expand its powers. The new ones are appended to `symbols`; `names` are those of the parameters.
    #[must_use]
    pub fn with_symbols(self, dim: usize, symbols: &mut Vec<Symbol>, names: &[String]) -> Self {
        let mut grouped: BTreeMap<Vec<(u32, u32)>, Vec<(Vec<(u32, u32)>, Rational)>> =
            BTreeMap::new();
        for (factors, value) in self.rest.factors() {
            let (momenta, own) = split(&factors, dim);
            grouped.entry(momenta.to_vec()).or_default().push((own.to_vec(), value));
        }
        let mut terms = Vec::with_capacity(grouped.len());
        // Sums with leading coefficient one, and the symbols they have become.
        let mut known: Vec<(Vec<(Vec<(u32, u32)>, Rational)>, usize)> = Vec::new();
        for (mut factors, mut sum) in grouped {
            let (Some((first, leading)), 1..) = (sum.first().cloned(), sum.len()) else { continue };
            if sum.len() == 1 {
                factors.extend(first);
                terms.push((factors, leading));
                continue;
            }
            for (_, value) in &mut sum {
                *value = &*value / &leading;
            }
            let place = match known.iter().find(|(other, _)| *other == sum) {
                Some(&(_, place)) => place,
                None => {
                    let expr = expression(&sum, dim, symbols);
                    let text = expr.text(names);
                    symbols.push(Symbol { expr, text });
                    known.push((sum, symbols.len() - 1));
                    symbols.len() - 1
                }
            };
            factors.push(((dim + place) as u32, 1));
            terms.push((factors, leading));
        }
        let variables = dim + symbols.len();
        let wider = |polynomial: &Polynomial| polynomial.in_variables(variables);
        Self {
            spin: wider(&self.spin),
            casimirs: wider(&self.casimirs),
            rest: Polynomial::from_factors(variables, terms),
        }
    }

    /// f.
    #[must_use]
    pub fn energy(&self) -> Polynomial {
        &self.spin + &self.casimirs
    }

    /// The parts that are not zero. They commute, but each is an exponential of its own.
    pub fn parts(&self) -> impl Iterator<Item = &Polynomial> {
        [&self.spin, &self.casimirs].into_iter().filter(|part| !part.is_zero())
    }
}

/// Finds the frame in which the series of the rest, S₁ + S₃, has fewest terms; `None` where nothing
/// makes it shorter.
///
/// Integrals are looked for among the coordinates, not their combinations: choose a basis with the axis
/// of symmetry in it. Variables of `hamiltonian` beyond the dimension are symbols.
///
/// ```
/// use coadjoint_codegen::comoving::comoving;
/// use coadjoint_codegen::lie::{Chart, catalogue::lookup};
/// use coadjoint_codegen::number::ratio;
/// use coadjoint_codegen::poly::Polynomial;
///
/// let body = |inverse: [i64; 3]| {
///     let square = |i: usize| Polynomial::variable(3, i).pow(2).scale(&ratio(inverse[i], 2));
///     &(&square(0) + &square(1)) + &square(2)
/// };
/// let so3 = lookup("SO3").unwrap();
/// // x²/2 + y² + 3z²/2 without |μ|² is (z² − x²)/2.
/// let frame = comoving(&so3, Chart::Exponential, &body([1, 2, 3])).unwrap();
/// assert_eq!(frame.energy(), body([2, 2, 2]));
/// // x²/2 + y²/2 + z² without z²/2 is |μ|²/2, of which one step is exact.
/// let frame = comoving(&so3, Chart::Exponential, &body([1, 1, 2])).unwrap();
/// assert_eq!(frame.spin, body([0, 0, 1]));
/// ```
#[must_use]
pub fn comoving(algebra: &LieAlgebra, chart: Chart, hamiltonian: &Polynomial) -> Option<Frame> {
    let length = |h: &Polynomial| length(algebra, chart, h);
    let mut rest = hamiltonian.clone();
    let mut fewest = length(&rest)?;
    let mut spin = Polynomial::zero(hamiltonian.variables());
    for axis in axes(algebra, hamiltonian) {
        let found = best(&rest, spins(&rest, axis, algebra.dim()), &length);
        if let Some((terms, part)) = found.filter(|&(terms, _)| terms < fewest) {
            (fewest, rest, spin) = (terms, &rest - &part, &spin + &part);
        }
    }
    let mut moved = Polynomial::zero(hamiltonian.variables());
    for casimir in casimirs(algebra, 2).unwrap_or_default() {
        let found = best(&rest, multiples(&rest, &casimir, algebra.dim()), &length);
        if let Some((terms, part)) = found.filter(|&(terms, _)| terms < fewest) {
            (fewest, rest, moved) = (terms, &rest - &part, &moved + &part);
        }
    }
    (rest != *hamiltonian).then_some(Frame { spin, casimirs: moved, rest })
}

/// The coordinates that are integrals and commute with those before them.
fn axes(algebra: &LieAlgebra, hamiltonian: &Polynomial) -> Vec<usize> {
    let field = algebra.hamiltonian_field(hamiltonian);
    let bracket = |i: usize, j: usize| algebra.structure().iter().any(|c| (c.i, c.j) == (i, j));
    let mut axes: Vec<usize> = Vec::new();
    for (axis, rate) in field.iter().enumerate() {
        if rate.is_zero() && !axes.iter().any(|&other| bracket(axis, other)) {
            axes.push(axis);
        }
    }
    axes
}

/// How many monomials in the momenta S₁ and S₃ of a Hamiltonian have, or `None` where it has none.
fn length(algebra: &LieAlgebra, chart: Chart, hamiltonian: &Polynomial) -> Option<usize> {
    let dim = algebra.dim();
    if hamiltonian.factors().all(|(factors, _)| split(&factors, dim).0.is_empty()) {
        return None;
    }
    let series = derive(algebra, chart, hamiltonian, COMPARED, TermLimit::default()).ok()?;
    let monomials = |k: usize| {
        let factors = series.order(k).factors();
        let monomials: BTreeSet<_> =
            factors.map(|(factors, _)| split(&factors, dim).0.to_vec()).collect();
        monomials.len()
    };
    Some((1..=COMPARED).map(monomials).sum())
}

/// The candidate that leaves fewest terms, and their number. Of equals the one that leaves the smallest
/// coefficients where they are numbers, otherwise the middle one: of the three of a body, the axis of
/// middle inertia in the usual order.
fn best(
    rest: &Polynomial,
    candidates: Vec<Polynomial>,
    length: &impl Fn(&Polynomial) -> Option<usize>,
) -> Option<(usize, Polynomial)> {
    let lengths = candidates.iter().map(|part| length(&(rest - part))).collect::<Vec<_>>();
    let fewest = lengths.iter().flatten().min().copied()?;
    let equals: Vec<Polynomial> = candidates
        .into_iter()
        .zip(lengths)
        .filter(|(_, length)| *length == Some(fewest))
        .map(|(part, _)| part)
        .collect();
    let middle = equals.len() / 2;
    let size = |(at, part): (usize, &Polynomial)| {
        let left = rest - part;
        let numbers = left.factors().map(|(_, value)| value.to_f64().map_or(0.0, f64::abs));
        (numbers.fold(0.0, f64::max), at.abs_diff(middle))
    };
    let smallest = equals
        .iter()
        .enumerate()
        .map(size)
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
    let at = equals.iter().enumerate().position(|candidate| size(candidate) == smallest)?;
    Some((fewest, equals.into_iter().nth(at)?))
}

/// A sum of products of symbols as an expression.
fn expression(
    sum: &[(Vec<(u32, u32)>, Rational)],
    dim: usize,
    symbols: &[Symbol],
) -> ParameterExpr {
    let boxed = |a: ParameterExpr, b: ParameterExpr| (Box::new(a), Box::new(b));
    let mut total: Option<ParameterExpr> = None;
    for (factors, value) in sum {
        let size = value.abs();
        let mut product =
            (!size.is_one() || factors.is_empty()).then_some(ParameterExpr::Rational(size));
        for &(variable, power) in factors {
            let Some(symbol) = symbols.get(variable as usize - dim) else { continue };
            let mut own = symbol.expr.clone();
            if power > 1 {
                own = ParameterExpr::Powi(Box::new(own), i32::try_from(power).unwrap_or(i32::MAX));
            }
            product = Some(match product {
                None => own,
                Some(product) => {
                    let (a, b) = boxed(product, own);
                    ParameterExpr::Mul(a, b)
                }
            });
        }
        let Some(product) = product else { continue };
        total = Some(match (total, value.is_negative()) {
            (None, false) => product,
            (None, true) => ParameterExpr::Neg(Box::new(product)),
            (Some(total), negative) => {
                let (a, b) = boxed(total, product);
                if negative { ParameterExpr::Sub(a, b) } else { ParameterExpr::Add(a, b) }
            }
        });
    }
    total.unwrap_or_else(|| ParameterExpr::Rational(Rational::one()))
}

/// Functions of one coordinate: all its powers but the square, and of the square what it has more than
/// another coordinate, or all of it, or nothing.
fn spins(hamiltonian: &Polynomial, axis: usize, dim: usize) -> Vec<Polynomial> {
    let variables = hamiltonian.variables();
    let square = |i: usize| coefficient(hamiltonian, &[(i as u32, 2)], dim);
    let others = hamiltonian.factors().filter(|(factors, _)| {
        matches!(split(factors, dim).0, [(variable, power)] if *variable as usize == axis && *power != 2)
    });
    let others = Polynomial::from_factors(variables, others);
    let own = square(axis);
    let mut shares: Vec<Polynomial> = (0..dim)
        .filter(|&other| other != axis)
        .map(square)
        .filter(|square| !square.is_zero())
        .map(|square| &own - &square)
        .collect();
    shares.extend([own, Polynomial::zero(variables)]);
    let axis = Polynomial::variable(variables, axis).pow(2);
    distinct(shares.iter().map(|share| &others + &(share * &axis)))
}

/// The multiples of a Casimir that cancel one of its monomials in H.
fn multiples(hamiltonian: &Polynomial, casimir: &Polynomial, dim: usize) -> Vec<Polynomial> {
    if casimir.degree() < 2 {
        return Vec::new();
    }
    distinct(casimir.factors().map(|(monomial, value)| {
        let share = coefficient(hamiltonian, &monomial, dim).scale(&(Rational::one() / value));
        &share * casimir
    }))
}

/// Without zeros and repetitions.
fn distinct(candidates: impl Iterator<Item = Polynomial>) -> Vec<Polynomial> {
    let mut result: Vec<Polynomial> = Vec::new();
    for candidate in candidates {
        if !candidate.is_zero() && !result.contains(&candidate) {
            result.push(candidate);
        }
    }
    result
}

/// The coefficient of a monomial in the momenta, a polynomial in the symbols.
fn coefficient(hamiltonian: &Polynomial, momenta: &[(u32, u32)], dim: usize) -> Polynomial {
    let terms = hamiltonian.factors().filter_map(|(factors, value)| {
        let (own, symbols) = split(&factors, dim);
        (own == momenta).then(|| (symbols.to_vec(), value))
    });
    Polynomial::from_factors(hamiltonian.variables(), terms.collect::<Vec<_>>())
}

/// The factors that are momenta, and those that are symbols.
fn split(factors: &[(u32, u32)], dim: usize) -> (&[(u32, u32)], &[(u32, u32)]) {
    factors.split_at(factors.partition_point(|&(variable, _)| (variable as usize) < dim))
}
