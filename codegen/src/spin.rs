//! Splitting off the spin of symmetric bodies.
//!
//! Where a coordinate s = μ_e of the momentum is an integral, the flows of H and of any function f(s)
//! commute, and that of f is known: μ and g turn about e by f′(s) per unit time. So H − f is left to
//! the series, whose length and speed of convergence depend on f. For a symmetric top, H = ½ a |Π|² +
//! ½ (b − a) s² + V(Γ), the part ½ (b − a) s² leaves a spherical top, which knows nothing of the spin.

use crate::hamilton_jacobi::{TermLimit, derive};
use crate::lie::{Chart, LieAlgebra};
use crate::poly::Polynomial;

/// The truncation at which series are compared: what S₃ vanishes from vanishes from all.
const COMPARED: usize = 3;

/// The part of H that is split off: a sum of functions of coordinates that are integrals and commute,
/// such that S of the rest has fewest terms. `None` where nothing makes it shorter.
///
/// Only coordinates are looked at, not their combinations: choose a basis with the axis of symmetry in
/// it. Variables of `hamiltonian` beyond the dimension are symbols.
///
/// ```
/// use coadjoint_codegen::lie::{Chart, catalogue::lookup};
/// use coadjoint_codegen::number::ratio;
/// use coadjoint_codegen::poly::Polynomial;
/// use coadjoint_codegen::spin::spin;
///
/// // H = (x² + y²)/2 + z²: what is left after z²/2 is |μ|²/2, of which one step is exact.
/// let square = |i, half| (Polynomial::variable(3, i).pow(2)).scale(&ratio(half, 2));
/// let h = &(&square(0, 1) + &square(1, 1)) + &square(2, 2);
/// let found = spin(&lookup("SO3").unwrap(), Chart::Exponential, &h).unwrap();
/// assert_eq!(found, square(2, 1));
/// ```
#[must_use]
pub fn spin(algebra: &LieAlgebra, chart: Chart, hamiltonian: &Polynomial) -> Option<Polynomial> {
    let dim = algebra.dim();
    let field = algebra.hamiltonian_field(hamiltonian);
    let commute = |i: usize, j: usize| !algebra.structure().iter().any(|c| (c.i, c.j) == (i, j));
    let mut rest = hamiltonian.clone();
    let mut fewest = length(algebra, chart, &rest)?;
    let mut axes: Vec<usize> = Vec::new();
    for axis in (0..dim).filter(|&axis| field[axis].is_zero()) {
        if !axes.iter().all(|&other| commute(axis, other)) {
            continue;
        }
        let shorter = candidates(&rest, axis, dim).into_iter().filter_map(|candidate| {
            let shorter = &rest - &candidate;
            Some((length(algebra, chart, &shorter)?, shorter))
        });
        // Of equals the first.
        if let Some((terms, shorter)) = shorter.min_by_key(|&(terms, _)| terms)
            && terms < fewest
        {
            (fewest, rest) = (terms, shorter);
            axes.push(axis);
        }
    }
    let found = hamiltonian - &rest;
    (!found.is_zero()).then_some(found)
}

/// How many terms S₁ and S₃ of a Hamiltonian have, or `None` where there is no momentum in it.
fn length(algebra: &LieAlgebra, chart: Chart, hamiltonian: &Polynomial) -> Option<usize> {
    let dim = algebra.dim();
    let moves =
        |factors: &[(u32, u32)]| factors.iter().any(|&(variable, _)| (variable as usize) < dim);
    if !hamiltonian.factors().any(|(factors, _)| moves(&factors)) {
        return None;
    }
    let series = derive(algebra, chart, hamiltonian, COMPARED, TermLimit::default()).ok()?;
    Some((1..=COMPARED).map(|k| series.order(k).len()).sum())
}

/// Functions of one coordinate to be tried: all its powers but the square, and of the
/// square what it has more than another coordinate, or all of it.
fn candidates(hamiltonian: &Polynomial, axis: usize, dim: usize) -> Vec<Polynomial> {
    let variables = hamiltonian.variables();
    // The coefficients of the pure powers of each coordinate, polynomials in the symbols.
    let pure = |coordinate: usize, wanted: &dyn Fn(u32) -> bool| {
        let terms = hamiltonian.factors().filter(|(factors, _)| {
            let mut momenta = factors.iter().filter(|(variable, _)| (*variable as usize) < dim);
            let only = momenta
                .next()
                .is_some_and(|&(variable, power)| variable as usize == coordinate && wanted(power));
            only && momenta.next().is_none()
        });
        Polynomial::from_factors(variables, terms)
    };
    let others = pure(axis, &|power| power != 2);
    let square = |coordinate: usize| {
        let terms = pure(coordinate, &|power| power == 2);
        // Moved to the axis, to be compared.
        let moved = terms.factors().map(|(mut factors, value)| {
            for (variable, _) in &mut factors {
                if *variable as usize == coordinate {
                    *variable = axis as u32;
                }
            }
            factors.sort_unstable();
            (factors, value)
        });
        Polynomial::from_factors(variables, moved.collect::<Vec<_>>())
    };
    let own = square(axis);
    let mut parts: Vec<Polynomial> = (0..dim)
        .filter(|&other| other != axis)
        .map(square)
        .filter(|square| !square.is_zero())
        .map(|square| &own - &square)
        .collect();
    parts.push(own);
    parts.push(Polynomial::zero(variables));
    let mut tried: Vec<Polynomial> = Vec::new();
    for part in parts {
        let candidate = &others + &part;
        if !candidate.is_zero() && !tried.contains(&candidate) {
            tried.push(candidate);
        }
    }
    tried
}
