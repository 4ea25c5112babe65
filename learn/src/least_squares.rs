//! Linear least squares by QR, with ridge, and damped Gauss–Newton on top of it.

use coadjoint_codegen::cancel;
use nalgebra::{DMatrix, DVector};

/// About the products in the reduction of a piece of a matrix: a tenth of a second.
const PIECE: usize = 1 << 27;

/// A least-squares problem min |A c − b|², reduced once to its triangle R by Householder QR, so
/// that many ridge weights are cheap.
#[derive(Clone, Debug)]
pub(crate) struct Reduced {
    triangle: DMatrix<f64>,
    right: DVector<f64>,
    /// The mean squared norm of a column of A: the unit of the ridge.
    scale: f64,
}

impl Reduced {
    /// Reduces the problem min |A c − b|² with A = `matrix` and b = `right`.
    pub(crate) fn new(matrix: DMatrix<f64>, right: DVector<f64>) -> Self {
        let (rows, columns) = matrix.shape();
        let scale = matrix.norm_squared() / columns.max(1) as f64;
        if rows <= columns {
            return Self { triangle: matrix, right, scale };
        }
        // A long matrix is reduced piece by piece: the triangle so far above the next rows.
        let piece = (PIECE / columns.pow(2).max(1)).max(4 * columns);
        let (mut triangle, mut reduced) = (DMatrix::zeros(0, columns), DVector::zeros(0));
        for first in (0..rows).step_by(piece) {
            cancel::check();
            let (above, count) = (triangle.nrows(), piece.min(rows - first));
            let mut stacked = triangle.insert_rows(above, count, 0.0);
            stacked.rows_mut(above, count).copy_from(&matrix.rows(first, count));
            reduced = reduced.insert_rows(above, count, 0.0);
            reduced.rows_mut(above, count).copy_from(&right.rows(first, count));
            let qr = stacked.qr();
            qr.q_tr_mul(&mut reduced);
            triangle = qr.unpack_r();
            reduced = reduced.rows(0, triangle.nrows()).into_owned();
        }
        Self { triangle, right: reduced, scale }
    }

    /// The minimiser of |A c − b|² + ridge·s²|c|², s² the mean squared column norm of A.
    ///
    /// `None` where the minimiser is not unique to rounding (take a larger ridge) or not finite.
    pub(crate) fn solve(&self, ridge: f64) -> Option<DVector<f64>> {
        self.solve_near(ridge, None)
    }

    /// As [`Reduced::solve`], with the ridge pulling to `anchor` in place of 0.
    pub(crate) fn solve_near(
        &self,
        ridge: f64,
        anchor: Option<&DVector<f64>>,
    ) -> Option<DVector<f64>> {
        cancel::check();
        let columns = self.triangle.ncols();
        if ridge <= 0.0 {
            if self.triangle.nrows() < columns {
                return None;
            }
            return back_substitute(&self.triangle, &self.right);
        }
        let weight = (ridge * self.scale.max(f64::MIN_POSITIVE)).sqrt();
        let rows = self.triangle.nrows();
        let mut matrix = DMatrix::zeros(rows + columns, columns);
        matrix.rows_mut(0, rows).copy_from(&self.triangle);
        let mut right = DVector::zeros(rows + columns);
        right.rows_mut(0, rows).copy_from(&self.right);
        for k in 0..columns {
            matrix[(rows + k, k)] = weight;
            right[rows + k] = anchor.map_or(0.0, |a| weight * a[k]);
        }
        let qr = matrix.qr();
        qr.q_tr_mul(&mut right);
        back_substitute(&qr.unpack_r(), &right)
    }
}

/// Solves R c = b for the upper triangle R; `None` if R is singular to rounding.
fn back_substitute(triangle: &DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    let columns = triangle.ncols();
    let largest = (0..columns).map(|k| triangle[(k, k)].abs()).fold(0.0, f64::max);
    let smallest = (0..columns).map(|k| triangle[(k, k)].abs()).fold(f64::INFINITY, f64::min);
    if smallest.is_nan() || smallest <= largest * f64::EPSILON * (columns + 4) as f64 {
        return None;
    }
    let solution = triangle.solve_upper_triangular(&right.rows(0, columns).into_owned())?;
    solution.iter().all(|v| v.is_finite()).then_some(solution)
}

/// When a damped Gauss–Newton iteration stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussNewton {
    /// The maximum number of linearisations.
    pub iterations: usize,
    /// The iteration stops when a step lowers the sum of squares by less than this fraction.
    pub relative_decrease: f64,
    /// The weight of |c|², relative to the mean squared column norm: it picks the smallest among
    /// unknowns the residuals cannot tell apart.
    pub ridge: f64,
}

impl GaussNewton {
    /// Minimises |r(c)|² from `start` by Levenberg–Marquardt steps.
    ///
    /// `linearise` gives r and ∂r/∂c, `residual` r alone; `None` marks unknowns where r does not
    /// exist, which are then not stepped to. Returns the unknowns at the end, and |r|² at the start and after each accepted
    /// step; `None` if r does not exist at the start.
    pub fn minimise(
        &self,
        start: DVector<f64>,
        mut residual: impl FnMut(&DVector<f64>) -> Option<DVector<f64>>,
        mut linearise: impl FnMut(&DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)>,
    ) -> Option<(DVector<f64>, Vec<f64>)> {
        let mut unknowns = start;
        let mut damping = 1e-6;
        let mut history = Vec::new();
        for _ in 0..self.iterations {
            let (current, jacobian) = linearise(&unknowns)?;
            let before = current.norm_squared();
            if history.is_empty() {
                history.push(before);
            }
            let ridge_unit = jacobian.norm_squared() / jacobian.ncols().max(1) as f64 * self.ridge;
            let penalty = |c: &DVector<f64>| ridge_unit * c.norm_squared();
            // Unknowns c + δ: J c_new ≈ J c − r; the ridge pulls to 0, the damping to c.
            let right = &jacobian * &unknowns - &current;
            let reduced = Reduced::new(jacobian, right);
            let mut accepted = None;
            for _ in 0..24 {
                let total = damping + self.ridge;
                let anchor = &unknowns * (damping / total);
                let candidate = reduced.solve_near(total, Some(&anchor));
                let after = candidate.as_ref().and_then(&mut residual).map(|r| r.norm_squared());
                match (candidate, after) {
                    (Some(c), Some(after)) if after + penalty(&c) < before + penalty(&unknowns) => {
                        accepted = Some((c, after));
                        break;
                    }
                    _ => damping = damping.max(1e-16) * 10.0,
                }
            }
            let Some((next, after)) = accepted else { break };
            unknowns = next;
            history.push(after);
            damping = (damping * 0.05).max(1e-18);
            if before - after <= self.relative_decrease * before {
                break;
            }
        }
        Some((unknowns, history))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ridge_zero_is_the_exact_solution_and_ridge_shrinks() {
        let matrix = DMatrix::from_row_slice(4, 2, &[1.0, 0.0, 1.0, 1.0, 1.0, 2.0, 1.0, 3.0]);
        let right = DVector::from_row_slice(&[1.0, 3.0, 5.0, 7.0]);
        let reduced = Reduced::new(matrix, right);
        let exact = reduced.solve(0.0).unwrap();
        assert!((exact - DVector::from_row_slice(&[1.0, 2.0])).norm() < 1e-14);
        assert!(reduced.solve(1e-2).unwrap().norm() < 5.0_f64.sqrt());
    }

    #[test]
    fn a_singular_problem_needs_a_ridge() {
        let matrix = DMatrix::from_element(5, 2, 1.0);
        let reduced = Reduced::new(matrix, DVector::from_element(5, 2.0));
        assert!(reduced.solve(0.0).is_none());
        let smallest = reduced.solve(1e-12).unwrap();
        assert!((smallest - DVector::from_element(2, 1.0)).norm() < 1e-6);
    }

    #[test]
    fn gauss_newton_finds_the_minimum_of_rosenbrock() {
        // Rosenbrock's function as a sum of squares: r = (1 − a, 10 (b − a²)), minimum at (1, 1).
        let residual = |c: &DVector<f64>| {
            Some(DVector::from_row_slice(&[1.0 - c[0], 10.0 * (c[1] - c[0] * c[0])]))
        };
        let linearise = |c: &DVector<f64>| {
            let jacobian = DMatrix::from_row_slice(2, 2, &[-1.0, 0.0, -20.0 * c[0], 10.0]);
            residual(c).map(|r| (r, jacobian))
        };
        let options = GaussNewton { iterations: 200, relative_decrease: 0.0, ridge: 0.0 };
        let start = DVector::from_row_slice(&[-1.2, 1.0]);
        let (unknowns, _) = options.minimise(start, residual, linearise).unwrap();
        assert!((unknowns - DVector::from_element(2, 1.0)).norm() < 1e-10);
    }
}
