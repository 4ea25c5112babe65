//! Small fixed-size arithmetic shared by the peers: fused products, vectors, quaternions.

use crate::number::Number;

/// Three components.
pub type Vector = [f64; 3];
/// Scalar part first.
pub type Quaternion = [f64; 4];

/// a·b + c, fused where the target has the instruction (without it `mul_add` would call a slow library function).
#[inline(always)]
#[must_use]
pub fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// u × v.
#[inline(always)]
#[must_use]
pub fn cross<T: Number>(u: &[T; 3], v: &[T; 3]) -> [T; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// u · v.
#[inline(always)]
#[must_use]
pub fn dot(u: &Vector, v: &Vector) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// Hamilton's product.
#[inline(always)]
#[must_use]
pub fn multiply<T: Number>(a: &[T; 4], b: &[T; 4]) -> [T; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// q v q⁻¹ for a unit quaternion.
#[inline(always)]
#[must_use]
pub fn rotate<T: Number>(q: &[T; 4], v: &[T; 3]) -> [T; 3] {
    let axis = [q[1], q[2], q[3]];
    let t = cross(&axis, v).map(|component| component * 2.0);
    let s = cross(&axis, &t);
    [v[0] + q[0] * t[0] + s[0], v[1] + q[0] * t[1] + s[1], v[2] + q[0] * t[2] + s[2]]
}

/// The rotation matrix of a unit quaternion, by rows.
#[inline]
#[must_use]
pub fn matrix(q: &Quaternion) -> [Vector; 3] {
    let columns =
        [rotate(q, &[1.0, 0.0, 0.0]), rotate(q, &[0.0, 1.0, 0.0]), rotate(q, &[0.0, 0.0, 1.0])];
    std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row]))
}

/// (sin θ, cos θ): a polynomial for |θ| ≤ 1/2 (next terms below 2⁻⁵³), the library beyond it.
#[inline(always)]
#[must_use]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() > 0.5 {
        return angle.sin_cos();
    }
    let t = angle * angle;
    let t2 = t * t;
    let t4 = t2 * t2;
    let sine = fma(t, -1.0 / 6.0, 1.0)
        + t2 * fma(t, -1.0 / 5040.0, 1.0 / 120.0)
        + t4 * (fma(t, -1.0 / 39_916_800.0, 1.0 / 362_880.0) + t2 * (1.0 / 6_227_020_800.0));
    let cosine = fma(t, -0.5, 1.0)
        + t2 * fma(t, -1.0 / 720.0, 1.0 / 24.0)
        + t4 * (fma(t, -1.0 / 3_628_800.0, 1.0 / 40_320.0)
            + t2 * fma(t, -1.0 / 87_178_291_200.0, 1.0 / 479_001_600.0));
    (angle * sine, cosine)
}

/// The running sum of many small increments with the rounding of each addition carried along (Kahan).
#[derive(Clone, Copy, Debug)]
pub struct Compensated<const N: usize> {
    value: [f64; N],
    carry: [f64; N],
}

impl<const N: usize> Compensated<N> {
    /// Starts at `value`.
    #[must_use]
    pub fn new(value: [f64; N]) -> Self {
        Self { value, carry: [0.0; N] }
    }

    /// The sum so far, rounded.
    #[inline(always)]
    #[must_use]
    pub fn value(&self) -> [f64; N] {
        self.value
    }

    /// Adds an increment.
    #[inline(always)]
    pub fn add(&mut self, increment: &[f64; N]) {
        for i in 0..N {
            let corrected = increment[i] + self.carry[i];
            let sum = self.value[i] + corrected;
            self.carry[i] = corrected - (sum - self.value[i]);
            self.value[i] = sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomial_sine_agrees_with_the_library() {
        for step in -60..=60 {
            let angle = f64::from(step) / 100.0;
            let (sine, cosine) = sin_cos(angle);
            assert!(
                (sine - angle.sin()).abs() < 2.0e-16 && (cosine - angle.cos()).abs() < 2.5e-16,
                "{angle}"
            );
        }
    }

    #[test]
    fn quaternions_multiply_as_their_matrices() {
        let (a, b) = ([0.5, 0.5, -0.5, 0.5], [0.8, 0.0, 0.6, 0.0]);
        let v = [0.3, -1.2, 0.7];
        let (one, two) = (rotate(&multiply(&a, &b), &v), rotate(&a, &rotate(&b, &v)));
        assert!(one.iter().zip(two).all(|(x, y)| (x - y).abs() < 1e-15));
        let m = matrix(&a);
        let three = rotate(&a, &v);
        assert!((0..3).all(|i| (dot(&m[i], &v) - three[i]).abs() < 1e-15));
    }

    #[test]
    fn compensation_keeps_what_rounding_drops() {
        let mut sum = Compensated::new([1.0]);
        let mut plain = 1.0;
        for _ in 0..1_000_000 {
            sum.add(&[1e-17]);
            plain += 1e-17;
        }
        assert!((sum.value()[0] - (1.0 + 1e-11)).abs() < 1e-15);
        assert!((plain - (1.0f64 + 1e-11)).abs() > 1e-12);
    }
}
