//! Least squares of ill-conditioned systems.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

/// The refinement ends where so many steps do not make a fifth of what is left go away.
const PATIENCE: usize = 3;

/// Columns multiplied at once.
const BLOCK: usize = 32;

/// The y with |A y − b|² + ridge² |y|² least, where columns count as of length one; then refined in
/// at most so many steps, so that the ridge holds back only what hardly changes A y.
///
/// By the normal equations, of which there are as many as A has columns, or rows if these are fewer:
/// y = M b with M = (Aᵀ A + ridge²)⁻¹ Aᵀ = Aᵀ (A Aᵀ + ridge²)⁻¹. What is left, b − A y, is made
/// smaller by conjugate residuals on K = A M, whose eigenvalues σ²/(σ² + ridge²) are one but for the
/// few singular values σ below the ridge (Saad, *Iterative Methods for Sparse Linear Systems*, § 6.8).
/// For rounding not to spoil M a ridge must not be below 1e-7.
pub fn least_squares(
    mut matrix: DMatrix<f64>,
    right: &DVector<f64>,
    ridge: f64,
    steps: usize,
) -> DVector<f64> {
    let scales = normalise(&mut matrix);
    let mut solution = DVector::zeros(matrix.ncols());
    let transpose = matrix.transpose();
    let wide = matrix.nrows() < matrix.ncols();
    let mut gram = if wide { gram(&matrix, &transpose) } else { gram(&transpose, &matrix) };
    for i in 0..gram.nrows() {
        gram[(i, i)] += ridge * ridge;
    }
    // The ridge keeps it positive, so that there are factors.
    let Some(factors) = gram.cholesky() else { return solution };
    let approximate = |left: &DVector<f64>| match wide {
        true => &transpose * factors.solve(left),
        false => factors.solve(&(&transpose * left)),
    };

    let mut left = right.clone();
    let mut direction = approximate(&left);
    let mut image = &matrix * &direction;
    let mut weight = left.dot(&image);
    let mut sizes = Vec::with_capacity(steps);
    for step in 0..steps {
        let length = weight / image.norm_squared();
        if !length.is_finite() {
            break;
        }
        solution.axpy(length, &direction, 1.0);
        left.axpy(-length, &image, 1.0);
        sizes.push(left.norm());
        let idle = step >= PATIENCE && sizes[step] > 0.8 * sizes[step - PATIENCE];
        if idle || step + 1 == steps {
            break;
        }
        let next = approximate(&left);
        let next_image = &matrix * &next;
        let next_weight = left.dot(&next_image);
        let turn = next_weight / weight;
        direction = next + direction * turn;
        image = next_image + image * turn;
        weight = next_weight;
    }
    for (value, scale) in solution.iter_mut().zip(scales) {
        *value *= scale;
    }
    solution
}

/// The lower triangle of A Aᵀ, by blocks of columns: half the work of all of it.
fn gram(a: &DMatrix<f64>, transpose: &DMatrix<f64>) -> DMatrix<f64> {
    let n = a.nrows();
    let mut gram = DMatrix::zeros(n, n);
    for start in (0..n).step_by(BLOCK) {
        let (below, width) = (n - start, BLOCK.min(n - start));
        let mut block = gram.view_mut((start, start), (below, width));
        block.gemm(1.0, &a.rows(start, below), &transpose.columns(start, width), 0.0);
    }
    gram
}

/// Makes every column of length one that is not zero; returns the factors.
fn normalise(matrix: &mut DMatrix<f64>) -> Vec<f64> {
    let mut scales = Vec::with_capacity(matrix.ncols());
    for mut column in matrix.column_iter_mut() {
        let norm = column.norm();
        let scale = if norm > 0.0 { 1.0 / norm } else { 0.0 };
        column *= scale;
        scales.push(scale);
    }
    scales
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_fitted_whose_columns_are_nearly_dependent() {
        // Monomials on [1, 1.2]: a condition number of 1e12.
        let points: Vec<f64> = (0..40).map(|i| 1.0 + 0.005 * f64::from(i)).collect();
        let matrix = DMatrix::from_fn(40, 9, |i, j| points[i].powi(j as i32));
        let right = DVector::from_iterator(40, points.iter().map(|x| x.sin()));
        let found = least_squares(matrix.clone(), &right, 1e-7, 12);
        let left = (&matrix * &found - &right).amax();
        assert!(left < 1e-10, "{left:e}");
        // What the equations leave open stays small.
        assert!(found.amax() < 2.0, "{found}");
    }

    #[test]
    fn of_many_solutions_the_smallest_is_found() {
        let matrix = DMatrix::from_fn(3, 6, |i, j| (1.0 + 0.3 * i as f64).powi(j as i32));
        let right = DVector::from_vec(vec![1.0, -2.0, 0.5]);
        let found = least_squares(matrix.clone(), &right, 1e-7, 12);
        assert!((&matrix * &found - &right).amax() < 1e-9);
        let zero = least_squares(DMatrix::zeros(2, 3), &DVector::repeat(2, 1.0), 1e-7, 12);
        assert_eq!(zero, DVector::zeros(3));
    }

    #[test]
    fn a_column_of_zeros_gets_nothing() {
        let matrix = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 2.0, 0.0, 2.0, 0.0]);
        let found = least_squares(matrix, &DVector::from_vec(vec![2.0, 4.0, 4.0]), 1e-7, 12);
        assert!((found[0] - 2.0).abs() < 1e-15 && found[1] == 0.0);
    }
}
