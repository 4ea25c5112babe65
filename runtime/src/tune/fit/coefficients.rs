//! The corrections of coefficients by least squares.

use alloc::vec::Vec;

use nalgebra::{ComplexField, DMatrix, DVector};

use super::least_squares::least_squares;
use super::motion::{Point, Step};
use crate::generating::VectorOf;
use crate::generating::{Adjustable, Term, TermOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::solve::Predict;

/// Directions in the space of coefficients that change the values by less than this are left alone:
/// the motion does not tell them.
const RIDGE: f64 = 1e-7;
/// Steps of refinement at most.
const REFINEMENT: usize = 8;

/// The same for the first guess, of which nobody needs more than half the digits.
const GUESS_RIDGE: f64 = 1e-6;
const GUESS_REFINEMENT: usize = 1;

/// The terms of S whose coefficients are fitted: those of S_{K−2} and S_K, on which, along a motion,
/// what lower ones could do can be done as well; of short series all, which are few.
pub fn free_terms<S: Adjustable + Predict>(generating: &S) -> Vec<usize> {
    let truncation = generating.truncation();
    let lowest = if truncation > 5 { truncation - 2 } else { 0 };
    let free = |number: &usize| {
        let term = generating.term(*number);
        term.of == TermOf::Series && term.order >= lowest
    };
    (0..generating.terms()).filter(free).collect()
}

/// The terms of one coordinate of the first guess that are fitted, with their numbers: those of the
/// highest two orders.
fn free_guess<'a>(terms: &[(usize, Term<'a>)], coordinate: usize) -> Vec<(usize, Monomial<'a>)> {
    let of_it = terms.iter().filter(|(_, term)| term.of == TermOf::Guess(coordinate));
    let highest = of_it.clone().map(|(_, term)| term.order).max().unwrap_or(0);
    let free = of_it.filter(|(_, term)| term.order + 2 >= highest && term.order > 0);
    free.map(|(number, term)| (*number, term.monomial)).collect()
}

/// The corrections of the free terms of S that make Σ (pᵢ δxᵢ)² the least, and of all such the
/// smallest; zero for the others.
pub fn of_series<S>(generating: &S, free: &[usize], points: &[Point<VectorOf<S>>]) -> Vec<f64>
where
    S: Adjustable + Predict,
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
    let monomials: Vec<Monomial> = free.iter().map(|&n| generating.term(n).monomial).collect();
    let highest = highest_exponent(monomials.iter().copied());
    for (n, step) in steps.iter().enumerate() {
        let powers = Powers::of(&step.p, dim, highest);
        for (column, monomial) in monomials.iter().enumerate() {
            // Each derivative is the product of what stands before its factor, and of what stands after.
            let mut before = 1.0;
            for (factor, &(i, exponent)) in monomial.iter().enumerate() {
                let rest = &monomial[factor + 1..];
                let after = rest.iter().fold(1.0, |product, &(j, e)| product * powers.get(j, e));
                let derivative = f64::from(exponent) * powers.get(i, exponent - 1);
                matrix[(n * dim + i as usize, column)] =
                    before * derivative * after * weights[i as usize];
                before *= powers.get(i, exponent);
            }
        }
    }
    let found = least_squares(matrix, &right, RIDGE, REFINEMENT);
    let mut corrections = alloc::vec![0.0; generating.terms()];
    for (&number, &value) in free.iter().zip(found.iter()) {
        corrections[number] = value;
    }
    corrections
}

/// The corrections of the first guess that make its error at the points the least; zero for the terms
/// of S.
pub fn of_guess<S>(generating: &S, points: &[Point<VectorOf<S>>]) -> Vec<f64>
where
    S: Adjustable + Predict,
    S::Group: LieGroup<Scalar = f64>,
{
    let mut corrections = alloc::vec![0.0; generating.terms()];
    let terms = (0..generating.terms()).map(|number| (number, generating.term(number)));
    let terms: Vec<_> = terms.filter(|(_, term)| term.of != TermOf::Series).collect();
    if terms.is_empty() {
        return corrections;
    }
    let dim = generating.group().dim();
    let highest = highest_exponent(terms.iter().map(|(_, term)| term.monomial));
    let powers = points.iter().map(|point| Powers::of(&point.mu, dim, highest));
    let powers: Vec<Powers> = powers.collect();
    let errors: Vec<_> = points.iter().map(|point| missed(generating, point)).collect();
    for coordinate in 0..dim {
        let free = free_guess(&terms, coordinate);
        let mut matrix = DMatrix::zeros(points.len(), free.len());
        let right = DVector::from_iterator(points.len(), errors.iter().map(|e| e[coordinate]));
        for (n, powers) in powers.iter().enumerate() {
            for (column, (_, monomial)) in free.iter().enumerate() {
                // The even part is taken twice.
                let value = |product: f64, &(j, e): &(u32, u32)| product * powers.get(j, e);
                matrix[(n, column)] = monomial.iter().fold(2.0, value);
            }
        }
        let found = least_squares(matrix, &right, GUESS_RIDGE, GUESS_REFINEMENT);
        for (&(number, _), &value) in free.iter().zip(found.iter()) {
            corrections[number] = value;
        }
    }
    corrections
}

/// The error of the first guess at a point.
pub fn missed<S>(generating: &S, point: &Point<VectorOf<S>>) -> VectorOf<S>
where
    S: Predict,
    S::Group: LieGroup<Scalar = f64>,
{
    point.after.p.clone().minus(&generating.predict_after(&point.before.p, &point.mu))
}

/// x − ∂S/∂p(p).
pub fn residual<S>(generating: &S, step: &Step<VectorOf<S>>) -> VectorOf<S>
where
    S: Predict,
    S::Group: LieGroup<Scalar = f64>,
{
    step.x.clone().minus(&generating.gradient(&step.p))
}

/// Pairs of a coordinate and its exponent.
type Monomial<'a> = &'a [(u32, u32)];

fn highest_exponent<'a>(monomials: impl Iterator<Item = Monomial<'a>>) -> u32 {
    monomials.flatten().map(|&(_, exponent)| exponent).max().unwrap_or(0)
}

/// The powers of coordinates up to some exponent.
struct Powers {
    /// How many there are of each coordinate.
    count: usize,
    powers: Vec<f64>,
}

impl Powers {
    fn of<V: Coordinates<f64>>(vector: &V, dim: usize, highest: u32) -> Self {
        let count = highest as usize + 1;
        let mut powers = Vec::with_capacity(dim * count);
        for i in 0..dim {
            let mut power = 1.0;
            for _ in 0..count {
                powers.push(power);
                power *= vector[i];
            }
        }
        Self { count, powers }
    }

    fn get(&self, coordinate: u32, exponent: u32) -> f64 {
        self.powers[coordinate as usize * self.count + exponent as usize]
    }
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
