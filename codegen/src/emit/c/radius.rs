//! Which coefficients the radius of a series is of, and how they count.

use super::HeaderError;
use crate::integrator::Integrator;

/// Degrees that the bound on all directions knows of, as in the runtime.
const DEGREES: u32 = 64;

/// A monomial of one of the last two terms of the series, in the coordinates of one direct factor of the group.
#[derive(Clone, Debug, PartialEq)]
pub struct LastTerm {
    /// The number of the base of its coefficient.
    pub base: usize,
    /// Its order, K or K − 2.
    pub order: usize,
    /// The factor.
    pub factor: u32,
    /// The degree of its gradient.
    pub degree: u32,
    /// The weight of its coefficient: a bound on the gradient in these coordinates where |p| of each factor is one.
    pub weight: f64,
}

/// The monomials of S_K and S_{K−2}, as the runtime's `generating::series::radius` weighs them.
///
/// # Errors
/// [`HeaderError::Degree`] for one of too high a degree.
pub fn last_terms(integrator: &Integrator) -> Result<Vec<LastTerm>, HeaderError> {
    let coefficients = &integrator.coefficients;
    let factors = integrator.problem.algebra.factor_of_coordinates();
    let mut terms = Vec::new();
    for (_, order, base) in coefficients.last_orders(integrator.problem.truncation) {
        let monomial = coefficients.monomials().get(base).map_or(&[][..], Vec::as_slice);
        let degree: u32 = monomial.iter().map(|&(_, power)| power).sum();
        if degree > DEGREES {
            return Err(HeaderError::Degree { degree, limit: DEGREES });
        }
        // The degree in the coordinates of each factor.
        let mut degrees: Vec<(u32, u32)> = Vec::new();
        for &(i, power) in monomial {
            let factor = factors.get(i as usize).copied().unwrap_or(0);
            match degrees.iter_mut().find(|(own, _)| *own == factor) {
                Some((_, sum)) => *sum += power,
                None => degrees.push((factor, power)),
            }
        }
        let highest: f64 = monomial.iter().map(|&(_, power)| half_power(power)).product();
        let spheres: f64 = degrees.iter().map(|&(_, own)| half_power(own)).product();
        terms.extend(degrees.into_iter().map(|(factor, own)| {
            let weight = f64::from(own) * highest / spheres;
            LastTerm { base, order, factor, degree: degree - 1, weight }
        }));
    }
    Ok(terms)
}

/// n^{n/2}.
fn half_power(n: u32) -> f64 {
    let whole = (0..n / 2).fold(1.0, |power, _| power * f64::from(n));
    if n.is_multiple_of(2) { whole } else { whole * f64::from(n).sqrt() }
}
