//! The implicit equation of a step: cᵢ = (1 + |c|²) aᵢ + fᵢ cⱼ cₖ.

use crate::{
    arithmetic::{Vector, cross, dot},
    method::RunError,
};

const MAX_ITERATIONS: usize = 100;

/// As published: fixed-point iteration to 1e−15 from c = a.
#[inline(always)]
pub fn fixed_point(a: &Vector, f: &Vector) -> Result<Vector, RunError> {
    let mut c = *a;
    for _ in 0..MAX_ITERATIONS {
        let scale = 1.0 + dot(&c, &c);
        let new = [
            scale * a[0] + f[0] * c[1] * c[2],
            scale * a[1] + f[1] * c[2] * c[0],
            scale * a[2] + f[2] * c[0] * c[1],
        ];
        let change = distance(&new, &c);
        c = new;
        if change <= 1e-15 {
            return Ok(c);
        }
    }
    // Rounding may keep the last bit alternating; anything larger is divergence.
    let scale = 1.0 + dot(&c, &c);
    let residual: Vector =
        std::array::from_fn(|i| scale * a[i] + f[i] * c[(i + 1) % 3] * c[(i + 2) % 3] - c[i]);
    if residual.iter().all(|r| r.abs() < 1e-14) { Ok(c) } else { Err(RunError::NotConverged) }
}

/// Newton's method from a guess, until the next correction would be below rounding.
#[inline(always)]
pub fn newton(a: &Vector, f: &Vector, guess: Vector) -> Result<Vector, RunError> {
    let mut c = guess;
    for _ in 0..MAX_ITERATIONS {
        let scale = 1.0 + dot(&c, &c);
        let products = [c[1] * c[2], c[2] * c[0], c[0] * c[1]];
        let residual: Vector = std::array::from_fn(|i| c[i] - scale * a[i] - f[i] * products[i]);
        // Rows of 1 − 2 a cᵀ − (f ∘ cross terms); solved by Cramer's rule with cross products of the columns.
        let rows = [
            [
                1.0 - 2.0 * a[0] * c[0],
                -2.0 * a[0] * c[1] - f[0] * c[2],
                -2.0 * a[0] * c[2] - f[0] * c[1],
            ],
            [
                -2.0 * a[1] * c[0] - f[1] * c[2],
                1.0 - 2.0 * a[1] * c[1],
                -2.0 * a[1] * c[2] - f[1] * c[0],
            ],
            [
                -2.0 * a[2] * c[0] - f[2] * c[1],
                -2.0 * a[2] * c[1] - f[2] * c[0],
                1.0 - 2.0 * a[2] * c[2],
            ],
        ];
        let minors =
            [cross(&rows[1], &rows[2]), cross(&rows[2], &rows[0]), cross(&rows[0], &rows[1])];
        let inverse = 1.0 / dot(&rows[0], &minors[0]);
        let change: Vector = std::array::from_fn(|i| {
            inverse
                * (minors[0][i] * residual[0]
                    + minors[1][i] * residual[1]
                    + minors[2][i] * residual[2])
        });
        for i in 0..3 {
            c[i] -= change[i];
        }
        let size = change.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        if size < 5e-9 {
            return Ok(c);
        }
        if !size.is_finite() {
            break;
        }
    }
    Err(RunError::NotConverged)
}

#[inline(always)]
fn distance(u: &Vector, v: &Vector) -> f64 {
    (u[0] - v[0]).abs().max((u[1] - v[1]).abs()).max((u[2] - v[2]).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_solve_the_same_equation() {
        let (a, f) = ([0.2, 0.05, 0.1], [-0.3, 0.4, -0.2]);
        let (one, two) = (fixed_point(&a, &f).unwrap(), newton(&a, &f, a).unwrap());
        assert!(distance(&one, &two) < 1e-15);
    }

    #[test]
    fn no_solution_is_an_error() {
        assert_eq!(fixed_point(&[2.0, 0.0, 0.0], &[0.0; 3]), Err(RunError::NotConverged));
        assert_eq!(
            newton(&[2.0, 0.0, 0.0], &[0.0; 3], [2.0, 0.0, 0.0]),
            Err(RunError::NotConverged)
        );
    }
}
