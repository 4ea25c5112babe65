//! Polynomial Casimirs, by exact linear algebra.

mod error;
mod invariants;

use super::LieAlgebra;
use super::elimination::Echelon;
use crate::number::Rational;
use crate::poly::Polynomial;
use num_traits::One;
use std::collections::BTreeMap;

pub use error::CasimirError;

/// Generators of the polynomial Casimirs of degree at most `degree`: every Casimir up to that
/// degree is a polynomial in them, and none is a polynomial in the others.
///
/// A Casimir is a polynomial C on 𝔤\* in the coordinates dual to the basis with {C, μ_j} = 0 for
/// all j. They are ordered by degree, then by leading monomial, have integer coefficients without
/// common divisor and a positive first one. Between generators of one degree the choice is that of
/// reduced echelon form.
///
/// Degrees are independent because the Poisson tensor is linear. If the basis splits into
/// commuting ideals, as that of a direct product does, each is treated by itself.
///
/// ```
/// use coadjoint_symbolic::lie::{casimirs, catalogue::lookup};
///
/// let found = casimirs(&lookup("SE3").unwrap(), 2).unwrap();
/// assert_eq!(found.len(), 2); // Π·Γ and |Γ|²
/// assert_eq!(found[1].terms().next().unwrap().0, [0, 0, 0, 2, 0, 0]);
/// ```
///
/// # Errors
/// If there are too many monomials or too much work.
pub fn casimirs(algebra: &LieAlgebra, degree: u32) -> Result<Vec<Polynomial>, CasimirError> {
    let mut result = Vec::new();
    let mut known: Vec<(LieAlgebra, Vec<Polynomial>)> = Vec::new();
    for indices in algebra.ideals() {
        let ideal = algebra.restricted(&indices);
        let found = match known.iter().find(|(other, _)| *other == ideal) {
            Some((_, found)) => found.clone(),
            None => {
                let found = indecomposable(&ideal, degree)?;
                known.push((ideal, found.clone()));
                found
            }
        };
        result.extend(found.iter().map(|casimir| {
            let terms = casimir.factors().map(|(factors, value)| {
                let place = |(v, e): (u32, u32)| (indices[v as usize] as u32, e);
                (factors.into_iter().map(place).collect(), value)
            });
            Polynomial::from_factors(algebra.dim(), terms)
        }));
    }
    result.sort_by_cached_key(|casimir| {
        let lead = casimir.terms().next().map(|(exponents, _)| exponents);
        (casimir.degree(), std::cmp::Reverse(lead))
    });
    Ok(result)
}

/// The Casimirs that runs and emitted code watch: generators of degree two at most, or one where two is too much work.
/// Those of higher degrees take long to find in large algebras; [`casimirs`] finds them.
#[must_use]
pub fn watched_casimirs(algebra: &LieAlgebra) -> Vec<Polynomial> {
    [2, 1].into_iter().find_map(|degree| casimirs(algebra, degree).ok()).unwrap_or_default()
}

fn indecomposable(algebra: &LieAlgebra, degree: u32) -> Result<Vec<Polynomial>, CasimirError> {
    invariants::check_size(algebra, degree)?;
    let mut generators: Vec<Polynomial> = Vec::new();
    for k in 1..=degree {
        let space = invariants::of_degree(algebra, k)?;
        let products = products(algebra.dim(), &generators, k);
        if space.len() == products.len() {
            // Products of algebraically independent generators fill the space; where they are
            // dependent the elimination below decides.
            if independent(&products) {
                continue;
            }
        }
        let monomials = numbering(products.iter().chain(&space));
        let mut echelon = Echelon::new(u64::MAX);
        for product in &products {
            echelon.insert(row(&monomials, product));
        }
        for invariant in &space {
            if let Some(rest) = echelon.insert(row(&monomials, invariant)) {
                let terms: Vec<(Vec<(u32, u32)>, Rational)> = monomials
                    .iter()
                    .filter_map(|(factors, &column)| {
                        Some((factors.0.clone(), rest.get(&column)?.clone()))
                    })
                    .collect();
                generators.push(Polynomial::from_factors(algebra.dim(), terms).primitive());
            }
        }
    }
    Ok(generators)
}

/// A monomial, ordered so that the leading one comes first.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Monomial(Vec<(u32, u32)>);

fn numbering<'a>(polynomials: impl Iterator<Item = &'a Polynomial>) -> BTreeMap<Monomial, u32> {
    let mut monomials: BTreeMap<Monomial, u32> = BTreeMap::new();
    for polynomial in polynomials {
        monomials.extend(polynomial.factors().map(|(factors, _)| (Monomial(factors), 0)));
    }
    for (number, slot) in monomials.values_mut().enumerate() {
        *slot = number as u32;
    }
    monomials
}

fn row(monomials: &BTreeMap<Monomial, u32>, polynomial: &Polynomial) -> BTreeMap<u32, Rational> {
    let terms = polynomial.factors();
    terms.filter_map(|(f, value)| Some((*monomials.get(&Monomial(f))?, value))).collect()
}

fn independent(polynomials: &[Polynomial]) -> bool {
    let monomials = numbering(polynomials.iter());
    let mut echelon = Echelon::new(u64::MAX);
    polynomials.iter().all(|p| echelon.insert(row(&monomials, p)).is_some())
}

/// All products of generators of exactly this degree.
fn products(variables: usize, generators: &[Polynomial], degree: u32) -> Vec<Polynomial> {
    let mut partial = vec![(Polynomial::constant(variables, Rational::one()), 0)];
    for generator in generators {
        let step = generator.degree();
        let mut extended = Vec::new();
        for (product, reached) in partial {
            let mut next = product;
            let mut at = reached;
            while at <= degree {
                extended.push((next.clone(), at));
                next = &next * generator;
                at += step;
            }
        }
        partial = extended;
    }
    partial.into_iter().filter(|(_, at)| *at == degree).map(|(product, _)| product).collect()
}
