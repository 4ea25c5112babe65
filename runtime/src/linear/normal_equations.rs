//! Least squares in a few unknowns.

use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// The rounding of a right-hand side, in units of the number's.
const ROUNDING: f64 = 16.0;
/// Squares of sines of angles between columns below which they count as the same.
const RIDGE: f64 = 1e-14;

/// The normal equations of Σ yₙ columnₙ ≈ right, summed up over samples.
///
/// What columns below rounding add to it, or differences of columns that are nearly the same, is rounding.
pub struct NormalEquations<T, const N: usize> {
    /// The lower triangle.
    matrix: [[T; N]; N],
    right: [T; N],
    /// The square of what is rounding in the right-hand sides.
    noise: T,
}

impl<T: Scalar, const N: usize> Default for NormalEquations<T, N> {
    fn default() -> Self {
        let zero = T::of(0.0);
        Self {
            matrix: [[zero; N]; N],
            right: [zero; N],
            noise: T::of(f64::from(f32::MIN_POSITIVE)),
        }
    }
}

impl<T: Scalar, const N: usize> NormalEquations<T, N> {
    /// Adds a sample, whose right-hand side has been found with the rounding of `whole`.
    pub fn add<V: Coordinates<T>>(&mut self, columns: &[V; N], right: &V, whole: &V) {
        for i in 0..N {
            for j in 0..=i {
                self.matrix[i][j] += columns[i].pairing(&columns[j]);
            }
            self.right[i] += columns[i].pairing(right);
        }
        let rounding = T::of(ROUNDING) * T::epsilon();
        self.noise += whole.pairing(whole) * rounding * rounding;
    }

    /// The y of least squares, by L D Lᵀ.
    pub fn solution(&self) -> [T; N] {
        let Self { matrix: mut m, right: mut y, noise, .. } = *self;
        for i in 0..N {
            m[i][i] += self.matrix[i][i].times_plus(T::of(RIDGE), noise);
            for j in 0..i {
                for k in 0..j {
                    m[i][j] = (-m[i][k]).times_plus(m[j][k] * m[k][k], m[i][j]);
                }
                m[i][j] /= m[j][j];
            }
            for k in 0..i {
                m[i][i] = (-m[i][k]).times_plus(m[i][k] * m[k][k], m[i][i]);
                y[i] = (-m[i][k]).times_plus(y[k], y[i]);
            }
        }
        for i in (0..N).rev() {
            y[i] /= m[i][i];
            for k in i + 1..N {
                y[i] = (-m[k][i]).times_plus(y[k], y[i]);
            }
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    /// Columns u, v, w and what is made of them.
    fn equations(shares: [f64; 3], w: impl Fn(f64) -> Vector2<f64>) -> NormalEquations<f64, 3> {
        let mut equations = NormalEquations::default();
        for i in 0..5 {
            let i = f64::from(i);
            let columns = [Vector2::new(1.0, i), Vector2::new(0.1 * i, 0.3), w(i)];
            let right = columns[0] * shares[0] + columns[1] * shares[1] + columns[2] * shares[2];
            equations.add(&columns, &right, &Vector2::new(1.0, 0.0));
        }
        equations
    }

    #[test]
    fn shares_are_found() {
        let found = equations([0.2, -0.03, 0.7], |i| Vector2::new(0.01 * i * i, 0.1)).solution();
        for (found, expected) in found.into_iter().zip([0.2, -0.03, 0.7]) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }

    #[test]
    fn columns_that_tell_nothing_get_nothing() {
        assert_eq!(NormalEquations::<f64, 3>::default().solution(), [0.0; 3]);
        let [u, v, w] = equations([0.2, 0.1, 0.0], |_| Vector2::zeros()).solution();
        assert!((u - 0.2).abs() < 1e-9 && (v - 0.1).abs() < 1e-9 && w == 0.0, "{u} {v} {w}");
        // What is below rounding adds no more than that.
        let [.., w] = equations([0.2, 0.1, 1.0], |i| Vector2::new(1e-17 * i * i, 1e-17)).solution();
        assert!(w.abs() < 5.0, "{w}");
    }

    #[test]
    fn equal_columns_share() {
        let found = equations([0.3, 0.1, 0.3], |i| Vector2::new(1.0, i)).solution();
        assert!((found[0] + found[2] - 0.6).abs() < 1e-4, "{found:?}");
        assert!(found.iter().all(|y| y.abs() < 1.0), "{found:?}");
    }
}
