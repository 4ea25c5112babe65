//! Matrices with few digits, made elements of a group of rotations or rigid motions.

use crate::lie::LieAlgebra;

/// The largest defect of orthogonality that counts as rounding.
const FARTHEST: f64 = 1e-2;
/// Each step squares the defect.
const STEPS: usize = 6;

/// Replaces a matrix near the group by the nearest element, where every generator is antisymmetric but for rows of
/// zeros: rotations, unitary matrices, motions, and products of them. Translations stay as they are.
///
/// # Errors
/// The text of the error: another group, or a matrix that is not near it.
pub(super) fn project(matrix: &mut [Vec<f64>], algebra: &LieAlgebra) -> Result<(), String> {
    let size = matrix.len();
    let basis = algebra.basis().unwrap_or_default();
    let mut turns = vec![false; size];
    basis.iter().flat_map(|m| m.entries()).for_each(|(i, ..)| turns[i] = true);
    let antisymmetric = basis
        .iter()
        .all(|m| m.entries().all(|(i, j, value)| !turns[j] || m.get(j, i) == -value.clone()));
    if basis.is_empty() || !antisymmetric {
        return Err(format!(
            "`project` finds elements of rotations, unitary matrices and rigid motions, not of {}",
            algebra.name()
        ));
    }
    for (i, row) in matrix.iter_mut().enumerate().filter(|(i, _)| !turns[*i]) {
        row.fill(0.0);
        row[i] = 1.0;
    }
    let rows: Vec<usize> = (0..size).filter(|&i| turns[i]).collect();
    // Newton's iteration X ← X(3 − XᵀX)/2 for the orthogonal factor of the polar decomposition.
    for step in 0..STEPS {
        let mut square = vec![vec![0.0; size]; size];
        for &k in &rows {
            for &i in rows.iter().filter(|&&i| matrix[k][i] != 0.0) {
                rows.iter().for_each(|&j| square[i][j] += matrix[k][i] * matrix[k][j]);
            }
        }
        let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let defects = rows.iter().flat_map(|&i| rows.iter().map(move |&j| (i, j)));
        let defect = defects.map(|(i, j)| (square[i][j] - unit(i, j)).abs());
        let defect = defect.fold(0.0, |most, x| if x <= most { most } else { x });
        if step == 0 && (defect.is_nan() || defect > FARTHEST) {
            return Err(format!(
                "the matrix is not near {}: its columns are orthonormal to {defect:.1e} only",
                algebra.name()
            ));
        }
        for &i in &rows {
            let old = matrix[i].clone();
            for &j in &rows {
                let turned: f64 = rows.iter().map(|&k| old[k] * square[k][j]).sum();
                matrix[i][j] = (3.0 * old[j] - turned) / 2.0;
            }
        }
    }
    Ok(())
}
