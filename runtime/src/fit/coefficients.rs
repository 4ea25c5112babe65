//! The corrections of coefficients by least squares.

use alloc::vec::Vec;

use nalgebra::{ComplexField, DMatrix, DVector};

use super::least_squares::{least_squares, smallest_solution};
use super::motion::{Point, Step};
use crate::adjustable::{Adjustable, Part};
use crate::coordinates::Coordinates;
use crate::generating_function::{GeneratingFunction, VectorOf};
use crate::group::LieGroup;

/// Directions in the space of coefficients that change the values by less than this are left alone:
/// the motion does not tell them.
const RIDGE: f64 = 1e-9;

/// The same for the first guess, of which nobody needs more than half the digits.
const GUESS_RIDGE: f64 = 1e-6;

/// The terms of S whose coefficients are fitted: those of S_{K−2} and S_K, on which, along a motion,
/// what lower ones could do can be done as well; of short series all, which are few.
pub fn free_terms<S: Adjustable>(generating: &S) -> Vec<usize> {
    let truncation = generating.truncation();
    let lowest = if truncation > 5 { truncation - 2 } else { 0 };
    chosen(generating, |part, order| part == Part::Series && order >= lowest)
}

/// The terms of one coordinate of the first guess that are fitted: those of the highest two orders.
fn free_guess<S: Adjustable>(generating: &S, coordinate: usize) -> Vec<usize> {
    let of_it = |part| part == Part::Guess(coordinate);
    let terms = (0..generating.terms()).map(|number| generating.term(number));
    let highest = terms.filter(|term| of_it(term.part)).map(|term| term.order).max().unwrap_or(0);
    chosen(generating, |part, order| of_it(part) && order + 2 >= highest && order > 0)
}

fn chosen<S: Adjustable>(generating: &S, wanted: impl Fn(Part, usize) -> bool) -> Vec<usize> {
    let term = |number: &usize| generating.term(*number);
    (0..generating.terms()).filter(|n| wanted(term(n).part, term(n).order)).collect()
}

/// The corrections of the free terms of S that make Σ (pᵢ δxᵢ)² the least, and of all such the
/// smallest; zero for the others.
pub fn of_series<S>(generating: &S, free: &[usize], points: &[Point<VectorOf<S>>]) -> Vec<f64>
where
    S: Adjustable,
    S::Group: LieGroup<Scalar = f64>,
{
    let dim = generating.group().dim();
    let steps: Vec<_> = points.iter().flat_map(|point| [&point.before, &point.after]).collect();
    let weights = weights(dim, &steps);
    let mut matrix = DMatrix::zeros(dim * steps.len(), free.len());
    let mut right = DVector::zeros(dim * steps.len());
    for (n, step) in steps.iter().enumerate() {
        let left = residual(generating, step);
        for (i, weight) in weights.iter().enumerate() {
            right[n * dim + i] = left[i] * weight;
        }
    }
    for (mut column, &number) in matrix.column_iter_mut().zip(free) {
        let monomial = generating.term(number).monomial;
        for (n, step) in steps.iter().enumerate() {
            for &(i, exponent) in monomial {
                let derivative = monomial.iter().fold(f64::from(exponent), |product, &(j, e)| {
                    product * power(step.p[j as usize], if i == j { e - 1 } else { e })
                });
                column[n * dim + i as usize] = derivative * weights[i as usize];
            }
        }
    }
    let mut corrections = alloc::vec![0.0; generating.terms()];
    for (&number, &value) in free.iter().zip(least_squares(matrix, &right, RIDGE).iter()) {
        corrections[number] = value;
    }
    corrections
}

/// The corrections of the first guess that make its error at the points the least; zero for the terms
/// of S.
pub fn of_guess<S>(generating: &S, points: &[Point<VectorOf<S>>]) -> Vec<f64>
where
    S: Adjustable,
    S::Group: LieGroup<Scalar = f64>,
{
    let mut corrections = alloc::vec![0.0; generating.terms()];
    let errors: Vec<_> = points.iter().map(|point| missed(generating, point)).collect();
    for coordinate in 0..generating.group().dim() {
        let free = free_guess(generating, coordinate);
        let mut matrix = DMatrix::zeros(points.len(), free.len());
        let right = DVector::from_iterator(points.len(), errors.iter().map(|e| e[coordinate]));
        for (mut column, &number) in matrix.column_iter_mut().zip(&free) {
            let monomial = generating.term(number).monomial;
            for (entry, point) in column.iter_mut().zip(points) {
                let factors = monomial.iter().map(|&(j, e)| power(point.mu[j as usize], e));
                // The even part is taken twice.
                *entry = factors.fold(2.0, |product, factor| product * factor);
            }
        }
        let found = smallest_solution(matrix, &right, GUESS_RIDGE);
        for (&number, &value) in free.iter().zip(found.iter()) {
            corrections[number] = value;
        }
    }
    corrections
}

/// The error of the first guess at a point.
pub fn missed<S>(generating: &S, point: &Point<VectorOf<S>>) -> VectorOf<S>
where
    S: GeneratingFunction,
    S::Group: LieGroup<Scalar = f64>,
{
    point.after.p.clone().minus(&generating.predict_after(&point.before.p, &point.mu))
}

/// x − ∂S/∂p(p).
pub fn residual<S>(generating: &S, step: &Step<VectorOf<S>>) -> VectorOf<S>
where
    S: GeneratingFunction,
    S::Group: LieGroup<Scalar = f64>,
{
    step.x.clone().minus(&generating.gradient(&step.p))
}

/// xⁿ.
fn power(x: f64, n: u32) -> f64 {
    (0..n).fold(1.0, |power, _| power * x)
}

/// How much the coordinates of x count: as much as the coordinates of p they are paired with, so that
/// the fit does not depend on units.
fn weights<V: Coordinates<f64>>(dim: usize, steps: &[&Step<V>]) -> Vec<f64> {
    let size = |i: usize| {
        let squares: f64 = steps.iter().map(|step| step.p[i] * step.p[i]).sum();
        squares.max(f64::MIN_POSITIVE)
    };
    let sizes: Vec<f64> = (0..dim).map(size).collect();
    let largest = sizes.iter().fold(0.0, |a, &b| f64::max(a, b));
    // A coordinate that is hardly used still counts a little.
    sizes.iter().map(|&size| ComplexField::sqrt(size / largest + 1e-4)).collect()
}
