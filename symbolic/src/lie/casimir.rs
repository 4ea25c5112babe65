//! Polynomial Casimirs, by exact linear algebra.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::Zero;

use crate::cancel;
use crate::lie::LieAlgebra;
use crate::lie::elimination::{Echelon, Exceeded, Row};
use crate::number::{Rational, integer};
use crate::poly::Polynomial;

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

/// The Casimirs that runs and emitted code watch: generators of degree two at most, or one if two is too much work. Higher
/// degrees take long in large algebras; [`casimirs`] finds them.
pub fn watched_casimirs(algebra: &LieAlgebra) -> Vec<Polynomial> {
    [2, 1].into_iter().find_map(|degree| casimirs(algebra, degree).ok()).unwrap_or_default()
}

fn indecomposable(algebra: &LieAlgebra, degree: u32) -> Result<Vec<Polynomial>, CasimirError> {
    check_size(algebra, degree)?;
    let mut generators: Vec<Polynomial> = Vec::new();
    for k in 1..=degree {
        let space = of_degree(algebra, k)?;
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

fn row(monomials: &BTreeMap<Monomial, u32>, polynomial: &Polynomial) -> Row {
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
    let mut partial = vec![(Polynomial::constant(variables, integer(1)), 0)];
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

/// A basis in reduced echelon form by leading monomials.
pub(super) fn of_degree(
    algebra: &LieAlgebra,
    degree: u32,
) -> Result<Vec<Polynomial>, CasimirError> {
    let monomials = monomials(algebra.dim(), degree);
    let kernel = kernel(algebra, &monomials).map_err(|Exceeded| CasimirError::TooMuchWork {
        algebra: algebra.name().into(),
        degree,
        limit: OPERATIONS,
    })?;
    Ok(kernel.iter().map(|vector| polynomial(algebra, &monomials, vector)).collect())
}

/// Refuses a degree with too many monomials to search.
pub(super) fn check_size(algebra: &LieAlgebra, degree: u32) -> Result<(), CasimirError> {
    // The count is C(n + degree − 1, degree), built up from exact smaller ones.
    let mut count = 1_u128;
    for i in 0..u128::from(degree) {
        count = count * (algebra.dim() as u128 + i) / (i + 1);
        if count > MONOMIALS as u128 {
            return Err(CasimirError::TooLarge {
                algebra: algebra.name().into(),
                degree,
                limit: MONOMIALS,
            });
        }
    }
    Ok(())
}

/// All monomials of this degree as sorted lists of variables, the leading one last.
fn monomials(n: usize, degree: u32) -> Vec<Vec<u32>> {
    let mut lists: Vec<Vec<u32>> = vec![Vec::new()];
    for _ in 0..degree {
        let mut longer = Vec::new();
        for list in &lists {
            for variable in list.last().copied().unwrap_or(0)..n as u32 {
                let mut next = list.clone();
                next.push(variable);
                longer.push(next);
            }
        }
        lists = longer;
    }
    // Lists ascend lexicographically, which is leading first; pivots are to fall on trailing
    // monomials, so that each solution is led by a monomial of its own.
    lists.sort_unstable_by(|a, b| b.cmp(a));
    lists
}

/// Basis elements that generate the algebra by brackets.
///
/// An element is left out if it is a multiple of a bracket of elements reached before. That finds
/// few generators where the basis is adapted to the algebra, and is correct for any.
fn generating_subset(algebra: &LieAlgebra) -> BTreeSet<usize> {
    let mut brackets: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for c in algebra.structure() {
        brackets.entry((c.i, c.j)).or_default().push(c.k);
    }
    let single: Vec<(usize, usize, usize)> = brackets
        .into_iter()
        .filter_map(|((i, j), along)| match along.as_slice() {
            [k] => Some((i, j, *k)),
            _ => None,
        })
        .collect();
    let mut chosen = BTreeSet::new();
    let mut reached = BTreeSet::new();
    for candidate in 0..algebra.dim() {
        if !reached.insert(candidate) {
            continue;
        }
        chosen.insert(candidate);
        loop {
            let before = reached.len();
            for (i, j, k) in &single {
                if reached.contains(i) && reached.contains(j) {
                    reached.insert(*k);
                }
            }
            if reached.len() == before {
                break;
            }
        }
    }
    chosen
}

/// The kernel of C ↦ ({C, μ_j})_j.
fn kernel(algebra: &LieAlgebra, monomials: &[Vec<u32>]) -> Result<Vec<Row>, Exceeded> {
    // {C, ·} is a derivation of the bracket, so it vanishes on what generates the algebra or not at
    // all, and fewer equations do.
    let generating = generating_subset(algebra);
    let mut structure: BTreeMap<u32, Vec<(u32, u32, &Rational)>> = BTreeMap::new();
    for c in algebra.structure().iter().filter(|c| generating.contains(&c.j)) {
        structure.entry(c.i as u32).or_default().push((c.j as u32, c.k as u32, &c.value));
    }
    // One equation for each j and each monomial of {C, μ_j} = −Σ_i,l ∂_iC c_ij^l μ_l.
    let mut equations: BTreeMap<(u32, Vec<u32>), Row> = BTreeMap::new();
    for (column, monomial) in monomials.iter().enumerate() {
        cancel::check();
        for place in 0..monomial.len() {
            // A repeated variable comes once for each repetition, which is its exponent.
            for (j, l, value) in structure.get(&monomial[place]).into_iter().flatten() {
                let mut image = monomial.clone();
                image[place] = *l;
                image.sort_unstable();
                let equation = equations.entry((*j, image)).or_default();
                let slot = equation.entry(column as u32).or_insert_with(Rational::zero);
                *slot += *value;
                if slot.is_zero() {
                    equation.remove(&(column as u32));
                }
            }
        }
    }
    let mut rows: Vec<Row> = equations.into_values().collect();
    // Short equations first keep the others short.
    rows.sort_by_key(BTreeMap::len);
    let mut echelon = Echelon::new(OPERATIONS);
    for row in rows {
        echelon.insert(row);
        echelon.within_limit()?;
    }
    let mut kernel = echelon.kernel(monomials.len() as u32)?;
    kernel.reverse();
    Ok(kernel)
}

fn polynomial(algebra: &LieAlgebra, monomials: &[Vec<u32>], vector: &Row) -> Polynomial {
    let terms = vector.iter().map(|(column, value)| {
        let factors = monomials[*column as usize].iter().map(|&variable| (variable, 1));
        (factors.collect(), value.clone())
    });
    Polynomial::from_factors(algebra.dim(), terms)
}

/// Monomials of one degree that are looked through at most.
pub(super) const MONOMIALS: usize = 50_000;

/// Multiplications in one elimination at most.
pub(super) const OPERATIONS: u64 = 100_000_000;

/// Errors of computing Casimirs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CasimirError {
    /// Too many monomials.
    #[error(
        "Casimirs of degree {degree} of {algebra} are among more than {limit} monomials; ask for a lower degree"
    )]
    TooLarge {
        /// The algebra.
        algebra: String,
        /// The degree.
        degree: u32,
        /// The most monomials that are looked through.
        limit: usize,
    },
    /// Too much arithmetic.
    #[error(
        "Casimirs of degree {degree} of {algebra} need more than {limit} multiplications; ask for a lower degree"
    )]
    TooMuchWork {
        /// The algebra.
        algebra: String,
        /// The degree.
        degree: u32,
        /// The limit.
        limit: u64,
    },
}
