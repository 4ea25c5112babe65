//! The comoving frame: a summand of H whose flow is known and commutes with the rest.
//!
//! A free body turns at Ω = I⁻¹Π, and most of that is uniform: with c between the 1/Iᵢ the part c|Π|²/2
//! of H, a Casimir, makes it turn about the fixed direction of its momentum, and what the body does in the
//! frame that turns along is slow. A symmetric top's spin s is an integral; without ½(1/I₃ − 1/I₁)s² it
//! is a spherical top, which knows nothing of the spin. In both cases H = H₀ + f with commuting flows,
//! that of f is exp of something known, and only H₀ is left to the series: it has fewer terms, and they
//! are smaller by powers of the ratio of the speeds.

use std::collections::BTreeSet;

use num_traits::{One, ToPrimitive};

use crate::hamilton_jacobi::{TermLimit, derive};
use crate::lie::{Chart, LieAlgebra, casimirs};
use crate::number::Rational;
use crate::poly::{Polynomial, split_at};

/// The truncation at which series are compared: brackets that vanish from S₃ are missing from all terms.
const COMPARED: usize = 3;

/// The summand f of H whose flow moves the frame, and what is left of H without it.
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
    /// The function f as one polynomial.
    #[must_use]
    pub fn energy(&self) -> Polynomial {
        &self.spin + &self.casimirs
    }

    /// The summands of f that are not zero. Their flows commute, and each takes an exponential of its own.
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
/// use coadjoint_symbolic::comoving::comoving;
/// use coadjoint_symbolic::lie::{Chart, catalogue::lookup};
/// use coadjoint_symbolic::number::ratio;
/// use coadjoint_symbolic::poly::Polynomial;
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
    let dim = algebra.dim();
    let length = |h: &Polynomial| length(algebra, chart, h);
    let mut rest = hamiltonian.clone();
    let mut fewest = length(&rest)?;
    // Takes the best candidate off the rest, if the rest becomes shorter by it.
    let mut take = |candidates: &dyn Fn(&Polynomial) -> Vec<Polynomial>| {
        let (monomials, left, part) = best(&rest, candidates(&rest), &length)?;
        if monomials >= fewest {
            return None;
        }
        (fewest, rest) = (monomials, left);
        Some(part)
    };
    let sum = |parts: Vec<Polynomial>| {
        let zero = Polynomial::zero(hamiltonian.variables());
        parts.iter().fold(zero, |sum, part| &sum + part)
    };
    let axes = axes(algebra, hamiltonian);
    let spin = sum(axes.iter().filter_map(|&axis| take(&|h| spins(h, axis, dim))).collect());
    let known = casimirs(algebra, 2).unwrap_or_default();
    let casimirs = sum(known.iter().filter_map(|c| take(&|h| multiples(h, c, dim))).collect());
    (rest != *hamiltonian).then_some(Frame { spin, casimirs, rest })
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
    if hamiltonian.factors().all(|(factors, _)| split_at(&factors, dim).0.is_empty()) {
        return None;
    }
    let series = derive(algebra, chart, hamiltonian, COMPARED, TermLimit::default()).ok()?;
    let monomials = |k: usize| {
        let factors = series.order(k).factors();
        let monomials: BTreeSet<_> =
            factors.map(|(factors, _)| split_at(&factors, dim).0.to_vec()).collect();
        monomials.len()
    };
    Some((1..=COMPARED).map(monomials).sum())
}

/// The candidate that leaves fewest monomials, after their number and what is left. Of equals the one that leaves the
/// smallest coefficients, and of these (as where all are symbols) the one nearest to the middle: of the
/// three of a body, the axis of middle inertia in the usual order.
fn best(
    rest: &Polynomial,
    candidates: Vec<Polynomial>,
    length: &impl Fn(&Polynomial) -> Option<usize>,
) -> Option<(usize, Polynomial, Polynomial)> {
    let middle = candidates.len() / 2;
    let measured = candidates.into_iter().enumerate().filter_map(|(at, part)| {
        let left = rest - &part;
        let sizes = left.factors().map(|(_, value)| value.to_f64().map_or(0.0, f64::abs));
        let largest = sizes.fold(0.0, f64::max);
        Some((length(&left)?, largest, at.abs_diff(middle), left, part))
    });
    let least = measured.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    least.map(|(length, _, _, left, part)| (length, left, part))
}

/// Functions of one coordinate: all its powers but the square, and of the square what it has more than
/// another coordinate, or all of it, or nothing.
fn spins(hamiltonian: &Polynomial, axis: usize, dim: usize) -> Vec<Polynomial> {
    let variables = hamiltonian.variables();
    let square = |i: usize| coefficient(hamiltonian, &[(i as u32, 2)], dim);
    let others = hamiltonian.factors().filter(|(factors, _)| {
        matches!(split_at(factors, dim).0, [(variable, power)] if *variable as usize == axis && *power != 2)
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
        let (own, symbols) = split_at(&factors, dim);
        (own == momenta).then(|| (symbols.to_vec(), value))
    });
    Polynomial::from_factors(hamiltonian.variables(), terms.collect::<Vec<_>>())
}
