//! Jacobi's elliptic functions and complete integrals, for closed-form solutions.

use std::f64::consts::{FRAC_PI_2, PI};

/// K(k), by the arithmetic–geometric mean (Abramowitz and Stegun, 17.6.3).
pub fn complete_first(k: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (1.0 - k * k).sqrt());
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    FRAC_PI_2 / a
}

/// Π(n, k) = ∫₀^{π/2} dθ/((1 − n sin²θ) √(1 − k² sin²θ)), n < 1: the integrand is periodic and
/// analytic, so the trapezoidal rule converges exponentially.
pub fn complete_third(n: f64, k: f64) -> f64 {
    const POINTS: u32 = 400;
    let sum: f64 = (0..POINTS)
        .map(|i| {
            let square = (PI * f64::from(i) / f64::from(POINTS)).sin().powi(2);
            1.0 / ((1.0 - n * square) * (1.0 - k * k * square).sqrt())
        })
        .sum();
    FRAC_PI_2 * sum / f64::from(POINTS)
}

/// (sn u, cn u, dn u) by the descending Landen transformation (Abramowitz and Stegun, 16.4).
pub fn jacobi(u: f64, k: f64) -> (f64, f64, f64) {
    let mut means = vec![(1.0_f64, k)];
    let mut b = (1.0 - k * k).sqrt();
    while means[means.len() - 1].1.abs() > 1e-16 {
        let a = means[means.len() - 1].0;
        means.push((0.5 * (a + b), 0.5 * (a - b)));
        b = (a * b).sqrt();
    }
    let last = means.len() - 1;
    let mut angle = 2.0_f64.powi(last as i32) * means[last].0 * u;
    for &(a, c) in means[1..].iter().rev() {
        angle = 0.5 * (angle + (c / a * angle.sin()).asin());
    }
    let (sn, cn) = angle.sin_cos();
    (sn, cn, (1.0 - k * k * sn * sn).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // Abramowitz and Stegun, table 17.1 (m = ½), and Π(0, k) = K(k).
        let k = 0.5_f64.sqrt();
        assert!((complete_first(k) - 1.854_074_677_301_372).abs() < 1e-15);
        assert!((complete_third(0.0, k) - complete_first(k)).abs() < 1e-15);
        // Π(n, 0) = π/(2 √(1 − n))
        assert!((complete_third(-3.0, 0.0) - PI / 4.0).abs() < 1e-14);
        // sn K = 1, dn K = k′; sn² + cn² = 1 at a quarter of the period
        let (sn, cn, dn) = jacobi(complete_first(k), k);
        assert!((sn - 1.0).abs() < 1e-15 && cn.abs() < 1e-14 && (dn - k).abs() < 1e-15);
        // sn(K/2) = 1/√(1 + k′) (Abramowitz and Stegun, 16.5.2)
        let (half, _, _) = jacobi(complete_first(k) / 2.0, k);
        assert!((half - 1.0 / (1.0 + k).sqrt()).abs() < 1e-14);
    }
}
