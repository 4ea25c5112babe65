//! The modified moments of inertia that raise the order of the discrete Moser–Veselov algorithm.
//!
//! Hairer and Vilmart, *Preprocessed discrete Moser–Veselov algorithm for the full dynamics of the rigid body*,
//! J. Phys. A 39 (2006) 13225: 1/Ĩⱼ = σ/Iⱼ + d, with σ and d polynomials in η = ½h² Σ mᵢ²/Iᵢ and ν = ½h²|m|², which
//! the free body conserves.

use crate::arithmetic::{Vector, dot};

/// Ĩ for the given order (2, 4, 6, 8 or 10).
#[must_use]
pub fn modified_inertia(inertia: &Vector, momentum: &Vector, h: f64, order: u32) -> Vector {
    let energy: f64 = (0..3).map(|i| momentum[i] * momentum[i] / inertia[i]).sum();
    let eta = 0.5 * h * h * energy;
    let nu = 0.5 * h * h * dot(momentum, momentum);
    let (sigma, d) = Symmetric::new(inertia).factors(nu, eta, order);
    inertia.map(|moment| 1.0 / (sigma / moment + d))
}

/// The symmetric functions of the moments that the coefficients are made of.
struct Symmetric {
    inertia: Vector,
    delta: f64,
}

impl Symmetric {
    fn new(inertia: &Vector) -> Self {
        Self { inertia: *inertia, delta: inertia.iter().product() }
    }

    /// s_k = Σ Iᵢᵏ.
    fn s(&self, k: i32) -> f64 {
        self.inertia.iter().map(|moment| moment.powi(k)).sum()
    }

    /// x_k = Σ Iᵢ⁻ᵏ.
    fn x(&self, k: i32) -> f64 {
        self.s(-k)
    }

    /// r_ij = Σ (I_aⁱ + I_bⁱ)/I_cʲ over the cyclic permutations.
    fn r(&self, i: i32, j: i32) -> f64 {
        self.inertia.iter().map(|moment| (self.s(i) - moment.powi(i)) * moment.powi(-j)).sum()
    }

    /// σ and d up to the terms that the order needs.
    fn factors(&self, n: f64, e: f64, order: u32) -> (f64, f64) {
        let parts = [self.order4(n, e), self.order6(n, e), self.order8(n, e), self.order10(n, e)];
        let used = (order.saturating_sub(2) / 2) as usize;
        parts.iter().take(used).fold((1.0, 0.0), |(sigma, d), part| (sigma + part.0, d + part.1))
    }

    fn order4(&self, n: f64, e: f64) -> (f64, f64) {
        let delta = self.delta;
        let sigma = self.s(1) * n / (6.0 * delta) - self.x(1) * e / 3.0;
        let d = -n / (3.0 * delta) + self.s(1) * e / (6.0 * delta);
        (sigma, d)
    }

    fn order6(&self, n: f64, e: f64) -> (f64, f64) {
        let delta = self.delta;
        let sigma = (self.s(2) / delta - self.x(1)) * n * n / (30.0 * delta)
            + (1.0 - self.r(1, 1)) * n * e / (30.0 * delta)
            + (3.0 * self.s(1) / delta + 2.0 * self.x(2)) * e * e / 60.0;
        let d = -self.s(1) * n * n / (60.0 * delta * delta)
            + (self.x(1) / (10.0 * delta) - self.s(2) / (60.0 * delta * delta)) * n * e
            - (9.0 + self.r(1, 1)) * e * e / (60.0 * delta);
        (sigma, d)
    }

    fn order8(&self, n: f64, e: f64) -> (f64, f64) {
        let delta = self.delta;
        let (delta2, delta3) = (delta * delta, delta * delta * delta);
        let sigma = (4.0 * delta + 17.0 * self.s(3) - 15.0 * delta * self.r(1, 1)) * n * n * n
            / (2520.0 * delta3)
            + (9.0 * self.s(1) + 10.0 * delta * self.x(2) - 6.0 * self.r(2, 1)) * n * n * e
                / (420.0 * delta2)
            + ((6.0 * self.r(1, 2) - 100.0 * self.x(1)) * delta + 53.0 * self.s(2)) * n * e * e
                / (2520.0 * delta2)
            + (15.0 - delta * self.x(3) - 2.0 * self.r(1, 1)) * e * e * e / (630.0 * delta);
        let d = (34.0 * delta * self.x(1) - 19.0 * self.s(2)) * n * n * n / (2520.0 * delta3)
            + (self.s(3) + 2.0 * delta * self.r(1, 1) - 85.0 * delta) * n * n * e
                / (1260.0 * delta3)
            + (47.0 * self.s(1) + 13.0 * self.r(2, 1) - 38.0 * delta * self.x(2)) * n * e * e
                / (2520.0 * delta2)
            + (9.0 * delta * self.x(1) + delta * self.r(1, 2) - 11.0 * self.s(2)) * e * e * e
                / (1260.0 * delta2);
        (sigma, d)
    }

    fn order10(&self, n: f64, e: f64) -> (f64, f64) {
        let delta = self.delta;
        let (delta2, delta3, delta4) = (delta * delta, delta.powi(3), delta.powi(4));
        let (n2, e2) = (n * n, e * e);
        let (n4, n3e, n2e2, ne3, e4) = (n2 * n2, n2 * n * e, n2 * e2, n * e2 * e, e2 * e2);
        let (s1, s2, s3, s4) = (self.s(1), self.s(2), self.s(3), self.s(4));
        let (x1, x2, x3, x4) = (self.x(1), self.x(2), self.x(3), self.x(4));
        let (r11, r12, r13) = (self.r(1, 1), self.r(1, 2), self.r(1, 3));
        let (r21, r22, r31) = (self.r(2, 1), self.r(2, 2), self.r(3, 1));
        let sigma = (62.0 * s4 - 94.0 * delta * r21 + 66.0 * delta2 * x2 + 81.0 * delta * s1) * n4
            / (45360.0 * delta4)
            + (-77.0 * r31 + 75.0 * delta * r12 + 214.0 * s2 - 240.0 * delta * x1) * n3e
                / (22680.0 * delta3)
            + (26.0 * delta * r22 + 55.0 * s3 + 204.0 * delta
                - 50.0 * delta2 * x3
                - 59.0 * delta * r11)
                * n2e2
                / (7560.0 * delta3)
            + (137.0 * delta * x2 - delta * r13 + 3.0 * s1 - 69.0 * r21) * ne3 / (11340.0 * delta2)
            + (2.0 * delta2 * x4 + 5.0 * delta * r12 - 171.0 * delta * x1 + 159.0 * s2) * e4
                / (45360.0 * delta2);
        let d = (60.0 * delta * r11 - 61.0 * s3 - 247.0 * delta) * n4 / (45360.0 * delta4)
            + (54.0 * delta * s1 - s4 + 218.0 * delta * r21 - 426.0 * delta2 * x2) * n3e
                / (45360.0 * delta4)
            + (125.0 * delta * x1 - 5.0 * r31 - 130.0 * s2 + 4.0 * delta * r12) * n2e2
                / (7560.0 * delta3)
            + (67.0 * s3 - 735.0 * delta - 15.0 * delta * r22
                + 87.0 * delta * r11
                + 34.0 * delta2 * x3)
                * ne3
                / (22680.0 * delta3)
            + (165.0 * s1 - delta * r13 - 9.0 * r21 - 145.0 * delta * x2) * e4 / (45360.0 * delta2);
        (sigma, d)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_two_leaves_the_moments_alone() {
        let inertia = [1.5, 2.0, 2.5];
        let modified = modified_inertia(&inertia, &[2.0, 0.5, 1.0], 0.5, 2);
        assert!((0..3).all(|i| (modified[i] - inertia[i]).abs() < 1e-15));
    }

    #[test]
    fn terms_shrink_with_the_step_at_their_powers() {
        let symmetric = Symmetric::new(&[1.5, 2.0, 2.5]);
        let (n, e) = (0.3, 0.2);
        let orders = [Symmetric::order4, Symmetric::order6, Symmetric::order8, Symmetric::order10];
        for (power, order) in (1..).zip(orders) {
            let (coarse, fine) = (order(&symmetric, n, e), order(&symmetric, n / 2.0, e / 2.0));
            let ratio = 2f64.powi(power);
            assert!(
                (coarse.0 / fine.0 - ratio).abs() < 1e-10 * ratio
                    && (coarse.1 / fine.1 - ratio).abs() < 1e-10 * ratio
            );
        }
    }
}
