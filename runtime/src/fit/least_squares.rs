//! Least squares of ill-conditioned systems.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

/// Passes over what the ridge held back.
const PASSES: usize = 2;

/// The y with |A y − b|² + ridge² |y|² least, where columns count as of length one; refined, so that
/// the ridge decides only where the equations do not.
pub fn least_squares(mut matrix: DMatrix<f64>, right: &DVector<f64>, ridge: f64) -> DVector<f64> {
    let (equations, unknowns) = matrix.shape();
    let scales = normalise(&mut matrix);
    let mut basis = matrix.clone().resize_vertically(equations + unknowns, 0.0);
    for column in 0..unknowns {
        basis[(equations + column, column)] = ridge;
    }
    let factors = basis.qr();
    let triangle = factors.r();
    let mut solution = DVector::zeros(unknowns);
    for _ in 0..PASSES {
        let mut left = (right - &matrix * &solution).resize_vertically(equations + unknowns, 0.0);
        factors.q_tr_mul(&mut left);
        // The ridge keeps the triangle from being singular.
        if let Some(step) = triangle.solve_upper_triangular(&left.rows(0, unknowns)) {
            solution += step;
        }
    }
    for (value, scale) in solution.iter_mut().zip(scales) {
        *value *= scale;
    }
    solution
}

/// The y with |A y − b|² + ridge² |y|² least, where columns count as of length one, for matrices with
/// fewer rows than columns: y = Aᵀ z with (A Aᵀ + ridge²) z = b, so that the work grows with the rows.
/// The ridge is squared, hence must not be below 1e-7.
pub fn smallest_solution(
    mut matrix: DMatrix<f64>,
    right: &DVector<f64>,
    ridge: f64,
) -> DVector<f64> {
    let scales = normalise(&mut matrix);
    let mut gram = &matrix * matrix.transpose();
    for i in 0..gram.nrows() {
        gram[(i, i)] += ridge * ridge;
    }
    // The ridge keeps it positive.
    let solved = gram.cholesky().map(|factors| matrix.tr_mul(&factors.solve(right)));
    let mut solution = solved.unwrap_or_else(|| DVector::zeros(matrix.ncols()));
    for (value, scale) in solution.iter_mut().zip(scales) {
        *value *= scale;
    }
    solution
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
        let found = least_squares(matrix.clone(), &right, 1e-9);
        let left = (&matrix * &found - &right).amax();
        assert!(left < 1e-10, "{left:e}");
        // What the equations leave open stays small.
        assert!(found.amax() < 2.0, "{found}");
    }

    #[test]
    fn of_many_solutions_the_smallest_is_found() {
        let matrix = DMatrix::from_fn(3, 6, |i, j| (1.0 + 0.3 * i as f64).powi(j as i32));
        let right = DVector::from_vec(vec![1.0, -2.0, 0.5]);
        let found = smallest_solution(matrix.clone(), &right, 1e-7);
        assert!((&matrix * &found - &right).amax() < 1e-9);
        let zero = smallest_solution(DMatrix::zeros(2, 3), &DVector::repeat(2, 1.0), 1e-7);
        assert_eq!(zero, DVector::zeros(3));
    }

    #[test]
    fn a_column_of_zeros_gets_nothing() {
        let matrix = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 2.0, 0.0, 2.0, 0.0]);
        let found = least_squares(matrix, &DVector::from_vec(vec![2.0, 4.0, 4.0]), 1e-9);
        assert!((found[0] - 2.0).abs() < 1e-15 && found[1] == 0.0);
    }
}
