//! Which coefficients the radius of a series is of, and how they count.

use super::HeaderError;
use crate::integrator::Integrator;

/// Degrees that the bound on all directions knows of, as in the runtime.
const DEGREES: u32 = 64;

/// A monomial of one of the last two terms of the series.
#[derive(Clone, Debug, PartialEq)]
pub struct LastTerm {
    /// The number of the base of its coefficient.
    pub base: usize,
    /// Its order, K or K − 2.
    pub order: usize,
    /// The degree of its gradient.
    pub degree: u32,
    /// The weight of its coefficient: a bound on the gradient over the unit sphere.
    pub weight: f64,
}

/// The monomials of S_K and S_{K−2}, as the runtime's `generating::series::radius` weighs them.
///
/// # Errors
/// [`HeaderError::Degree`] for one of too high a degree.
pub fn last_terms(integrator: &Integrator) -> Result<Vec<LastTerm>, HeaderError> {
    let coefficients = &integrator.coefficients;
    let mut terms = Vec::new();
    for (_, order, base) in coefficients.last_orders(integrator.problem.truncation) {
        let monomial = coefficients.monomials().get(base).map_or(&[][..], Vec::as_slice);
        let degree: u32 = monomial.iter().map(|&(_, power)| power).sum();
        if degree > DEGREES {
            return Err(HeaderError::Degree { degree, limit: DEGREES });
        }
        if degree > 0 {
            let highest: f64 = monomial.iter().map(|&(_, power)| half_power(power)).product();
            let weight = f64::from(degree) * highest / half_power(degree);
            terms.push(LastTerm { base, order, degree: degree - 1, weight });
        }
    }
    Ok(terms)
}

/// n^{n/2}.
fn half_power(n: u32) -> f64 {
    let whole = (0..n / 2).fold(1.0, |power, _| power * f64::from(n));
    if n.is_multiple_of(2) { whole } else { whole * f64::from(n).sqrt() }
}
