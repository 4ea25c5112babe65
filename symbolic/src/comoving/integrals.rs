//! Linear integrals ⟨μ, η⟩, and the linear term of H that is one, by exact linear algebra.

use std::collections::BTreeMap;

use num_traits::{One, Signed, Zero};

use crate::lie::{Echelon, LieAlgebra};
use crate::number::Rational;
use crate::poly::{Polynomial, split_at};

/// The maximum number of multiplications in an elimination.
const OPERATIONS: u64 = 10_000_000;

/// Coordinates of an element of the algebra.
pub(super) type Element = Vec<Rational>;

/// The terms ⟨μ, L⟩ of H that are linear in the momenta, for each product of symbols (variable, power).
type Linear = BTreeMap<Vec<(u32, u32)>, Element>;

/// A basis of the η ∈ 𝔤 for which ⟨μ, η⟩ is an integral of H, whatever values its symbols have, in reduced echelon form:
/// where a generator is such an η, it is in the basis. Empty where that is too much work to find.
pub(super) fn linear_integrals(algebra: &LieAlgebra, hamiltonian: &Polynomial) -> Vec<Element> {
    let dim = algebra.dim();
    // Σ η_j μ̇_j = 0, monomial by monomial.
    let mut equations: BTreeMap<Vec<(u32, u32)>, BTreeMap<u32, Rational>> = BTreeMap::new();
    for (j, rate) in algebra.hamiltonian_field(hamiltonian).iter().enumerate() {
        for (factors, value) in rate.factors() {
            equations.entry(factors).or_default().insert(j as u32, value);
        }
    }
    let mut rows: Vec<_> = equations.into_values().collect();
    // Short equations first keep the others short.
    rows.sort_by_key(BTreeMap::len);
    let mut echelon = Echelon::new(OPERATIONS);
    let mut rank = 0;
    for row in rows {
        rank += usize::from(echelon.insert(row).is_some());
        if rank == dim || echelon.within_limit().is_err() {
            return Vec::new();
        }
    }
    let dense = |vector: BTreeMap<u32, Rational>| {
        let entry = |i| vector.get(&(i as u32)).cloned().unwrap_or_else(Rational::zero);
        (0..dim).map(entry).collect()
    };
    let kernel = echelon.kernel(dim as u32).unwrap_or_default();
    kernel.into_iter().map(dense).collect()
}

/// ⟨μ, η⟩ in this many variables.
pub(super) fn functional(variables: usize, element: &[Rational]) -> Polynomial {
    let terms = element.iter().enumerate().filter(|(_, value)| !value.is_zero());
    Polynomial::from_factors(
        variables,
        terms.map(|(i, value)| (vec![(i as u32, 1)], value.clone())),
    )
}

/// Whether {H, f} = 0.
pub(super) fn commute(algebra: &LieAlgebra, hamiltonian: &Polynomial, f: &Polynomial) -> bool {
    let field = algebra.hamiltonian_field(hamiltonian);
    let slopes = f.gradient(algebra.dim());
    let zero = Polynomial::zero(hamiltonian.variables());
    let rate = slopes.iter().zip(&field).fold(zero, |sum, (slope, rate)| &sum + &(slope * rate));
    rate.is_zero()
}

/// The part ⟨μ, ξ⟩ of the linear terms of H that commutes with the rest of H; zero where there is none. Its flow is
/// exp(tξ), and only the rest is left to a series.
///
/// Of ⟨μ, L⟩, L = Σ σ L_σ with products σ of symbols, it takes for each σ the orthogonal projection of L_σ (in the
/// coordinates of the basis) onto the η for which ⟨μ, η⟩ commutes, where that makes the coordinates of L_σ smaller in sum.
/// A term that commutes with all of 𝔤 is left: the series is exact for it.
#[must_use]
pub fn commuting_field(algebra: &LieAlgebra, hamiltonian: &Polynomial) -> Polynomial {
    let (dim, variables) = (algebra.dim(), hamiltonian.variables());
    let mut linear = Linear::new();
    let mut others = Vec::new();
    for (factors, value) in hamiltonian.factors() {
        match split_at(&factors, dim) {
            (&[(i, 1)], symbols) => {
                let zeros = || vec![Rational::zero(); dim];
                linear.entry(symbols.to_vec()).or_insert_with(zeros)[i as usize] = value;
            }
            _ => others.push((factors, value)),
        }
    }
    let moves = |element: &Element| algebra.structure().iter().any(|c| !element[c.i].is_zero());
    if !linear.values().any(moves) || others.is_empty() {
        return Polynomial::zero(variables);
    }
    // With all of L taken it is enough that each L_σ commutes with the other terms; a part of L must commute with L too.
    let others = Polynomial::from_factors(variables, others);
    let field = projected(algebra, &linear, linear_integrals(algebra, &others), variables);
    if field.is_zero() || commute(algebra, hamiltonian, &field) {
        return field;
    }
    projected(algebra, &linear, linear_integrals(algebra, hamiltonian), variables)
}

/// Σ σ ⟨μ, ξ_σ⟩ with the projections ξ_σ of the L_σ onto the span of `basis`.
fn projected(
    algebra: &LieAlgebra,
    linear: &Linear,
    basis: Vec<Element>,
    variables: usize,
) -> Polynomial {
    let basis = orthogonal(basis);
    let mut field = Polynomial::zero(variables);
    for (symbols, element) in linear {
        let mut rest = element.clone();
        remove(&mut rest, &basis);
        let taken: Element = element.iter().zip(&rest).map(|(all, rest)| all - rest).collect();
        let size = |element: &Element| element.iter().map(Rational::abs).sum::<Rational>();
        let taken = functional(variables, &taken);
        let central = algebra.hamiltonian_field(&taken).iter().all(Polynomial::is_zero);
        if size(&rest) < size(element) && !central {
            let product = [(symbols.clone(), Rational::one())];
            field = &field + &(&taken * &Polynomial::from_factors(variables, product));
        }
    }
    field
}

/// An orthogonal basis of the same span.
fn orthogonal(basis: Vec<Element>) -> Vec<Element> {
    let mut result: Vec<Element> = Vec::new();
    for mut element in basis {
        remove(&mut element, &result);
        result.push(element);
    }
    result
}

/// Takes the projections onto elements that are orthogonal to each other off an element.
fn remove(element: &mut Element, orthogonal: &[Element]) {
    let dot = |a: &Element, b: &Element| {
        let entries = a.iter().zip(b).filter(|(a, b)| !a.is_zero() && !b.is_zero());
        entries.map(|(a, b)| a * b).sum::<Rational>()
    };
    for other in orthogonal {
        let factor = dot(element, other) / dot(other, other);
        if factor.is_zero() {
            continue;
        }
        for (entry, value) in element.iter_mut().zip(other).filter(|(_, value)| !value.is_zero()) {
            *entry -= &factor * value;
        }
    }
}
