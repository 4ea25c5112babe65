//! Jacobi's theta functions on the real line and at a fixed distance from it.

/// More terms than any nome below 0.9 needs at double precision.
const TERMS: usize = 24;

/// The four functions at a real argument, and θ₄ at z + iy: weights of sin and cos of multiples of z, once per nome.
#[derive(Clone, Debug)]
pub struct Theta {
    /// 2 q^((k+½)²).
    odd: [f64; TERMS],
    /// 2 q^(k²), k ≥ 1.
    even: [f64; TERMS],
    /// The same times cosh 2ky and sinh 2ky.
    shifted: [[f64; 2]; TERMS],
    terms: usize,
}

/// θ₁, θ₂, θ₃, θ₄ at z and θ₄(z + iy).
#[derive(Clone, Copy, Debug)]
pub struct Values {
    /// θ₁(z).
    pub first: f64,
    /// θ₂(z).
    pub second: f64,
    /// θ₃(z).
    pub third: f64,
    /// θ₄(z).
    pub fourth: f64,
    /// Real and imaginary part of θ₄(z + iy).
    pub shifted: [f64; 2],
}

impl Theta {
    /// The functions of nome `q`, with shift `y` below −½ ln q.
    #[must_use]
    pub fn new(q: f64, y: f64) -> Self {
        let mut theta = Self {
            odd: [0.0; TERMS],
            even: [0.0; TERMS],
            shifted: [[0.0; 2]; TERMS],
            terms: TERMS,
        };
        for k in 0..TERMS {
            let n = (k + 1) as f64;
            theta.odd[k] = 2.0 * q.powf((k as f64 + 0.5).powi(2));
            theta.even[k] = 2.0 * q.powf(n * n);
            // Each exponential beside the power, so that neither overflows.
            let (up, down) =
                ((n * n * q.ln() + 2.0 * n * y).exp(), (n * n * q.ln() - 2.0 * n * y).exp());
            theta.shifted[k] = [up + down, up - down];
            if theta.shifted[k][0] < 1e-18 && theta.odd[k] < 1e-18 * theta.odd[0] {
                theta.terms = k;
                break;
            }
        }
        theta
    }

    /// θ₄′(iy)/(i θ₄(iy)).
    #[must_use]
    pub fn logarithmic_slope(&self) -> f64 {
        let (mut value, mut slope) = (1.0, 0.0);
        for k in 0..self.terms {
            let n = (k + 1) as f64;
            let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
            value += sign * self.shifted[k][0];
            slope -= sign * 2.0 * n * self.shifted[k][1];
        }
        slope / value
    }

    /// All of them at z.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, z: f64) -> Values {
        let (sine, cosine) = z.sin_cos();
        let (sine2, cosine2) = (2.0 * sine * cosine, 1.0 - 2.0 * sine * sine);
        let mut values =
            Values { first: 0.0, second: 0.0, third: 1.0, fourth: 1.0, shifted: [1.0, 0.0] };
        let (mut s_odd, mut c_odd) = (sine, cosine);
        let (mut s_even, mut c_even) = (sine2, cosine2);
        let mut sign = 1.0;
        for k in 0..self.terms {
            values.first += sign * self.odd[k] * s_odd;
            values.second += self.odd[k] * c_odd;
            values.third += self.even[k] * c_even;
            values.fourth -= sign * self.even[k] * c_even;
            // cos(2n(z + iy)) = cos 2nz cosh 2ny − i sin 2nz sinh 2ny.
            values.shifted[0] -= sign * self.shifted[k][0] * c_even;
            values.shifted[1] += sign * self.shifted[k][1] * s_even;
            (s_odd, c_odd) = (s_odd * cosine2 + c_odd * sine2, c_odd * cosine2 - s_odd * sine2);
            (s_even, c_even) =
                (s_even * cosine2 + c_even * sine2, c_even * cosine2 - s_even * sine2);
            sign = -sign;
        }
        values
    }

    /// θ₂, θ₃, θ₄ at 0.
    #[must_use]
    pub fn constants(&self) -> [f64; 3] {
        let values = self.at(0.0);
        [values.second, values.third, values.fourth]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_add_up() {
        // θ₂⁴ + θ₄⁴ = θ₃⁴ (Jacobi), and θ₁² θ₃(0)²... at z: θ₁²θ₄(0)² = θ₃²θ₂(0)² − θ₂²θ₃(0)² (Whittaker–Watson 21.2).
        let theta = Theta::new(0.12, 0.3);
        let [second, third, fourth] = theta.constants();
        assert!((second.powi(4) + fourth.powi(4) - third.powi(4)).abs() < 1e-14);
        let v = theta.at(0.7);
        let left = v.first.powi(2) * fourth.powi(2);
        let right = v.third.powi(2) * second.powi(2) - v.second.powi(2) * third.powi(2);
        assert!((left - right).abs() < 1e-14);
    }

    #[test]
    fn slope_is_the_derivative_of_the_shifted_function() {
        // d/dy ln θ₄(iy) = i θ₄′(iy)/θ₄(iy) = −(θ₄′(iy)/(i θ₄(iy))).
        let value = |y: f64| Theta::new(0.05, y).at(0.0).shifted[0];
        let (y, h) = (0.4, 1e-5);
        let numeric = (value(y + h).ln() - value(y - h).ln()) / (2.0 * h);
        assert!((numeric + Theta::new(0.05, y).logarithmic_slope()).abs() < 1e-9);
    }
}
