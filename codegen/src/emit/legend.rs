//! The meaning of a program's folded coefficients.

use super::subscript::{subscript, superscript};
use crate::integrator::Coefficients;

/// Beyond as many coefficients no one looks them up.
const MOST_LINES: usize = 4000;

/// A line for each slot that holds a coefficient of S: `c[3] = 2 C(p₁ p₂²), of S₃ + S₅`.
#[must_use]
pub(crate) fn lines(coefficients: &Coefficients) -> Vec<String> {
    let mut lines = Vec::new();
    for (slot, &(base, scale)) in coefficients.slots().iter().enumerate() {
        let Some(factors) = coefficients.monomials().get(base) else { continue };
        let monomial: Vec<String> = factors
            .iter()
            .map(|&(coordinate, exponent)| {
                let power =
                    if exponent == 1 { String::new() } else { superscript(exponent as usize) };
                format!("p{}{power}", subscript(coordinate as usize + 1))
            })
            .collect();
        let mut orders: Vec<u32> =
            coefficients.bases()[base].iter().map(|term| term.step_power).collect();
        orders.dedup();
        let orders: Vec<String> =
            orders.iter().map(|&k| format!("S{}", subscript(k as usize))).collect();
        let scale = if scale == 1 { String::new() } else { format!("{scale} ") };
        lines.push(format!(
            "c[{slot}] = {scale}C({}), of {}",
            monomial.join(" "),
            orders.join(" + ")
        ));
    }
    if lines.len() > MOST_LINES {
        lines.clear();
    }
    lines
}
