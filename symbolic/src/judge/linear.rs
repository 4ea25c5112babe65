//! Small dense matrices, row by row, in either precision.

use super::JudgeError;
use super::double_double::Real;

/// The unit matrix.
pub(super) fn identity<T: Real>(n: usize) -> Vec<T> {
    let mut matrix = vec![T::default(); n * n];
    (0..n).for_each(|i| matrix[i * n + i] = T::from(1.0));
    matrix
}

/// The product of two square matrices.
pub(super) fn multiply<T: Real>(n: usize, a: &[T], b: &[T]) -> Vec<T> {
    let mut product = vec![T::default(); n * n];
    multiply_into(n, a, b, &mut product);
    product
}

/// The same into a matrix that is there.
pub(super) fn multiply_into<T: Real>(n: usize, a: &[T], b: &[T], product: &mut [T]) {
    product.fill(T::default());
    for i in 0..n {
        for k in 0..n {
            let left = a[i * n + k];
            if left == T::default() {
                continue;
            }
            for j in 0..n {
                product[i * n + j] += left * b[k * n + j];
            }
        }
    }
}

/// Gauss' factors of a square matrix, with partial pivoting.
#[derive(Clone, Debug)]
pub(super) struct Lu<T> {
    n: usize,
    factors: Vec<T>,
    rows: Vec<usize>,
    /// The sign and the smallest and largest size of the pivots.
    pub(super) sign: f64,
    pub(super) smallest: f64,
    pub(super) largest: f64,
}

impl<T: Real> Lu<T> {
    /// `None` where the matrix is singular or not finite.
    pub(super) fn new(n: usize, mut matrix: Vec<T>) -> Option<Self> {
        let mut rows: Vec<usize> = (0..n).collect();
        let (mut sign, mut smallest, mut largest) = (1.0, f64::INFINITY, 0.0_f64);
        for k in 0..n {
            let mut pivot = k;
            for i in k..n {
                let value = matrix[i * n + k].double().abs();
                if !value.is_finite() {
                    return None;
                }
                if value > matrix[pivot * n + k].double().abs() {
                    pivot = i;
                }
            }
            if pivot != k {
                (0..n).for_each(|j| matrix.swap(k * n + j, pivot * n + j));
                rows.swap(k, pivot);
                sign = -sign;
            }
            let top = matrix[k * n + k];
            let value = top.double();
            if value == 0.0 {
                return None;
            }
            sign *= value.signum();
            smallest = smallest.min(value.abs());
            largest = largest.max(value.abs());
            for i in k + 1..n {
                let factor = matrix[i * n + k] / top;
                matrix[i * n + k] = factor;
                for j in k + 1..n {
                    let change = factor * matrix[k * n + j];
                    matrix[i * n + j] = matrix[i * n + j] - change;
                }
            }
        }
        Some(Self { n, factors: matrix, rows, sign, smallest, largest })
    }

    /// The solution for a right side.
    pub(super) fn solve(&self, right: &[T]) -> Result<Vec<T>, JudgeError> {
        let n = self.n;
        let mut x: Vec<T> = self.rows.iter().map(|&row| right[row]).collect();
        for i in 0..n {
            for j in 0..i {
                let change = self.factors[i * n + j] * x[j];
                x[i] = x[i] - change;
            }
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                let change = self.factors[i * n + j] * x[j];
                x[i] = x[i] - change;
            }
            x[i] = x[i] / self.factors[i * n + i];
        }
        if x.iter().all(|x| x.double().is_finite()) { Ok(x) } else { Err(JudgeError::OutOfRange) }
    }

    /// The Frobenius norm of the inverse.
    pub(super) fn inverse_norm(&self) -> f64 {
        let mut sum = 0.0_f64;
        for j in 0..self.n {
            let mut unit = vec![T::default(); self.n];
            unit[j] = T::from(1.0);
            let Ok(column) = self.solve(&unit) else { return f64::INFINITY };
            sum = sum
                .hypot(super::norm::norm(&column.iter().map(|v| v.double()).collect::<Vec<_>>()));
        }
        sum
    }
}
