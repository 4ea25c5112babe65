//! The space of Casimirs of one degree.

use super::error::{CasimirError, MONOMIALS, OPERATIONS};
use crate::cancel;
use crate::lie::LieAlgebra;
use crate::lie::elimination::{Echelon, Exceeded};
use crate::number::{Field, Rational, Residue, reconstruct};
use crate::poly::{Polynomial, Product, sum_of_products};
use std::collections::{BTreeMap, BTreeSet};

/// A basis in reduced echelon form by leading monomials.
///
/// The linear system is solved modulo a prime, the solutions are lifted to rationals and checked
/// exactly. As many solutions modulo a prime as checked solutions means that none is missing,
/// because a rank can only fall modulo a prime. Should the lifting fail, the system is solved over
/// the rationals.
pub(super) fn of_degree(
    algebra: &LieAlgebra,
    degree: u32,
) -> Result<Vec<Polynomial>, CasimirError> {
    let monomials = monomials(algebra.dim(), degree);
    let fail = |Exceeded| CasimirError::TooMuchWork {
        algebra: algebra.name().into(),
        degree,
        limit: OPERATIONS,
    };
    if let Some(kernel) = kernel::<Residue>(algebra, &monomials) {
        let kernel = kernel.map_err(fail)?;
        let lifted: Option<Vec<Polynomial>> = kernel
            .iter()
            .map(|vector| {
                let lifted: Option<BTreeMap<u32, Rational>> =
                    vector.iter().map(|(c, value)| Some((*c, reconstruct(*value)?))).collect();
                let candidate = polynomial(algebra, &monomials, &lifted?);
                is_casimir(algebra, &candidate).then_some(candidate)
            })
            .collect();
        if let Some(lifted) = lifted {
            return Ok(lifted);
        }
    }
    let kernel = kernel::<Rational>(algebra, &monomials).unwrap_or_else(|| Ok(Vec::new()));
    let kernel = kernel.map_err(fail)?;
    Ok(kernel.iter().map(|vector| polynomial(algebra, &monomials, vector)).collect())
}

/// Whether the monomials of a degree are few enough to be looked through.
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

/// The kernel of C ↦ ({C, μ_j})_j; None if a structure constant has no image in the field.
#[allow(clippy::type_complexity)]
fn kernel<F: Field>(
    algebra: &LieAlgebra,
    monomials: &[Vec<u32>],
) -> Option<Result<Vec<BTreeMap<u32, F>>, Exceeded>> {
    // {C, ·} is a derivation of the bracket, so it vanishes on what generates the algebra or not at
    // all, and fewer equations do.
    let generating = generating_subset(algebra);
    let mut structure: BTreeMap<u32, Vec<(u32, u32, F)>> = BTreeMap::new();
    for c in algebra.structure().iter().filter(|c| generating.contains(&c.j)) {
        let value = F::from_rational(&c.value)?;
        structure.entry(c.i as u32).or_default().push((c.j as u32, c.k as u32, value));
    }
    // One equation for each j and each monomial of {C, μ_j} = −Σ_i,l ∂_iC c_ij^l μ_l.
    let mut equations: BTreeMap<(u32, Vec<u32>), BTreeMap<u32, F>> = BTreeMap::new();
    let minus = F::one().negated();
    for (column, monomial) in monomials.iter().enumerate() {
        cancel::check();
        for place in 0..monomial.len() {
            // A repeated variable comes once for each repetition, which is its exponent.
            for (j, l, value) in structure.get(&monomial[place]).into_iter().flatten() {
                let mut image = monomial.clone();
                image[place] = *l;
                image.sort_unstable();
                let equation = equations.entry((*j, image)).or_default();
                let slot = equation.entry(column as u32).or_insert_with(F::zero);
                slot.minus_product(&minus, value);
                if slot.is_zero() {
                    equation.remove(&(column as u32));
                }
            }
        }
    }
    let mut rows: Vec<BTreeMap<u32, F>> = equations.into_values().collect();
    // Short equations first keep the others short.
    rows.sort_by_key(BTreeMap::len);
    let mut echelon = Echelon::new(OPERATIONS);
    for row in rows {
        echelon.insert(row);
        if let Err(exceeded) = echelon.within_limit() {
            return Some(Err(exceeded));
        }
    }
    Some(echelon.kernel(monomials.len() as u32).map(|mut kernel| {
        kernel.reverse();
        kernel
    }))
}

fn polynomial(
    algebra: &LieAlgebra,
    monomials: &[Vec<u32>],
    vector: &BTreeMap<u32, Rational>,
) -> Polynomial {
    let terms = vector.iter().map(|(column, value)| {
        let factors = monomials[*column as usize].iter().map(|&variable| (variable, 1));
        (factors.collect(), value.clone())
    });
    Polynomial::from_factors(algebra.dim(), terms)
}

/// Whether {C, μ_j} = 0 for all j, exactly.
fn is_casimir(algebra: &LieAlgebra, candidate: &Polynomial) -> bool {
    let n = algebra.dim();
    let gradient = candidate.gradient(n);
    let momenta: Vec<Polynomial> = (0..n).map(|i| Polynomial::variable(n, i)).collect();
    let mut brackets: Vec<Vec<Product<'_>>> = (0..n).map(|_| Vec::new()).collect();
    for c in algebra.structure() {
        brackets[c.j].push(Product {
            factor: c.value.clone(),
            left: &gradient[c.i],
            right: &momenta[c.k],
        });
    }
    brackets.iter().all(|b| sum_of_products(n, b, usize::MAX).is_ok_and(|sum| sum.is_zero()))
}
