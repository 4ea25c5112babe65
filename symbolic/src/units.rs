//! Units in which the coordinates of a momentum are measured where sizes of all of them are compared.
//!
//! Translations have a unit of length that rotations do not have: the maps that stretch an abelian ideal, as those of the
//! translations of SE(3), and leave a subalgebra beside it as it is are automorphisms. A step must not depend on that unit, so
//! each ideal is measured in the one in which the coefficients of H are as near to each other as they can be.

use num_traits::ToPrimitive;

use crate::lie::LieAlgebra;
use crate::poly::split_at;
use crate::problem::Problem;

/// Up to this many dimensions.
const DIMENSIONS: usize = 256;

/// The abelian ideals spanned by coordinates that a subalgebra beside them, spanned by coordinates too, acts on.
fn ideals(algebra: &LieAlgebra) -> Vec<Vec<bool>> {
    let (n, structure) = (algebra.dim(), algebra.structure());
    let mut found: Vec<Vec<bool>> = Vec::new();
    for seed in 0..n {
        let mut inside = vec![false; n];
        inside[seed] = true;
        let mut grows = true;
        while grows {
            grows = false;
            for c in structure {
                if (inside[c.i] || inside[c.j]) && !inside[c.k] {
                    (inside[c.k], grows) = (true, true);
                }
            }
        }
        let splits = structure.iter().all(|c| match (inside[c.i], inside[c.j]) {
            (true, true) => false,
            (false, false) => !inside[c.k],
            _ => true,
        });
        let acted_on = structure.iter().any(|c| inside[c.i] || inside[c.j]);
        if splits && acted_on && !found.contains(&inside) {
            found.push(inside);
        }
    }
    found
}

/// The solution of symmetric equations, the right side being the last column; 0 where they leave a number open.
fn solved(mut equations: Vec<Vec<f64>>) -> Vec<f64> {
    let count = equations.len();
    for k in 0..count {
        let pivot = equations[k].clone();
        if pivot[k].abs() <= 1e-9 {
            equations[k].iter_mut().for_each(|entry| *entry = 0.0);
            continue;
        }
        for (i, equation) in equations.iter_mut().enumerate() {
            let factor = if i == k { 1.0 - 1.0 / pivot[k] } else { equation[k] / pivot[k] };
            equation.iter_mut().zip(&pivot).for_each(|(entry, own)| *entry -= factor * own);
        }
    }
    equations.iter().map(|equation| equation[count]).collect()
}

impl Problem {
    /// The factor of each coordinate of a momentum where sizes are compared: 1 outside of all ideals of translations.
    /// Coefficients c of the monomials of H in these units and one of the momentum, which are found by least squares of ln |c|,
    /// differ the least from that unit; so another unit of length in H changes nothing but rounding.
    pub fn units(&self) -> Vec<f64> {
        let n = self.algebra.dim();
        let ideals = if n <= DIMENSIONS { ideals(&self.algebra) } else { Vec::new() };
        let mut units = vec![1.0; n];
        if ideals.is_empty() {
            return units;
        }
        let defaults = self.facts().defaults();
        let symbols: Vec<f64> =
            self.symbols.iter().map(|symbol| symbol.expr.evaluate(&defaults)).collect();
        let count = 1 + ideals.len();
        // The normal equations, with their right side as the last column.
        let mut equations = vec![vec![0.0; count + 1]; count];
        for (powers, value) in self.hamiltonian.factors() {
            let (momenta, of_symbols) = split_at(&powers, n);
            let mut size = value.to_f64().unwrap_or(f64::NAN).abs().ln();
            for &(i, power) in of_symbols {
                let symbol = symbols.get(i as usize - n).copied().unwrap_or(f64::NAN);
                size += f64::from(power) * symbol.abs().ln();
            }
            if !size.is_finite() {
                continue;
            }
            let degree = |ideal: Option<&Vec<bool>>| -> f64 {
                let own = momenta.iter().filter(|(i, _)| ideal.is_none_or(|own| own[*i as usize]));
                own.map(|&(_, power)| f64::from(power)).sum()
            };
            let of_ideals = ideals.iter().map(|ideal| degree(Some(ideal)));
            let row: Vec<f64> =
                [degree(None) - 1.0].into_iter().chain(of_ideals).chain([-size]).collect();
            for (equation, own) in equations.iter_mut().zip(&row) {
                equation.iter_mut().zip(&row).for_each(|(sum, other)| *sum += own * other);
            }
        }
        let solution = solved(equations);
        for (ideal, size) in ideals.iter().zip(solution.iter().skip(1)) {
            let unit = (-size).exp();
            if unit.is_normal() {
                let own = units.iter_mut().zip(ideal).filter(|(_, inside)| **inside);
                own.for_each(|(own, _)| *own *= unit);
            }
        }
        units
    }
}
