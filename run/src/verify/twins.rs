//! How far rounding may carry a motion over many steps, as measured.
//!
//! A bound that multiplies the worst of every step says nothing after a few of them. So two motions that start a little
//! beside the one judged go with it: how far they part is what a deviation made on the way may grow to, and the bounds
//! of the single steps, times that growth, are what rounding may do. This is measured, not proven.

use coadjoint_codegen::judge::{End, Motion, Setting, Stop};
use nalgebra::{DMatrix, DVector};

/// How far beside the motion the others start, relative to it.
const BESIDE: f64 = 1e-8;
/// The growth found may be exceeded by this factor.
const SAFETY: f64 = 10.0;

/// Motions beside one that is judged.
pub struct Twins {
    motions: Vec<Motion>,
    /// The sums of what rounding may do in each step, relative to momentum and element.
    momentum: f64,
    element: f64,
    /// The least distance of each so far, relative to the momentum.
    nearest: Vec<f64>,
    /// The largest growth of a distance in momentum, and from a distance in momentum to one of the element.
    growth: f64,
    turned: f64,
}

/// The bounds on rounding over many steps, relative to momentum and element.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub momentum: f64,
    pub element: f64,
}

impl Twins {
    /// Beside a motion from this momentum.
    pub fn new(mu: &[f64]) -> Self {
        let size = DVector::from_column_slice(mu).norm();
        let n = mu.len();
        let beside = |turn: usize| {
            // Directions in which no coordinate is left out.
            let direction = DVector::from_fn(n, |i, _| {
                let weight = 1.0 / ((i + turn) % n + 1) as f64;
                if (i + turn).is_multiple_of(2) { weight } else { -weight }
            });
            let shift = direction.scale(BESIDE * size / direction.norm());
            let moved: Vec<f64> = mu.iter().zip(shift.iter()).map(|(mu, s)| mu + s).collect();
            Motion::new(&moved)
        };
        let motions: Vec<Motion> = if size > 0.0 { vec![beside(0), beside(1)] } else { Vec::new() };
        let nearest = vec![BESIDE; motions.len()];
        Self { motions, momentum: 0.0, element: 0.0, nearest, growth: 1.0, turned: 1.0 }
    }

    /// Goes a step with the motion, which this step has led to where it is.
    ///
    /// # Errors
    /// Where a motion beside it stops.
    pub fn step(
        &mut self,
        setting: &mut Setting<'_>,
        (end, before): (&End, f64),
        motion: &Motion,
        unit: f64,
    ) -> Result<(), Stop> {
        // Momenta of the end are in its own units, in which the step's start had the size `before`.
        self.momentum += ratio(end.momentum_bound, before);
        let element = end.element.iter().map(|g| g.to_f64() * g.to_f64()).sum::<f64>().sqrt();
        self.element += ratio(end.element_bound, element);
        let here = DVector::from_vec(motion.momentum());
        let whole = matrix(motion, end.element.len());
        for (twin, nearest) in self.motions.iter_mut().zip(&mut self.nearest) {
            twin.step(setting, None, unit)?;
            let there = DVector::from_vec(twin.momentum());
            let apart = ratio((there - &here).norm(), here.norm());
            let turned = ratio((matrix(twin, end.element.len()) - &whole).norm(), whole.norm());
            self.growth = larger(self.growth, apart / *nearest);
            self.turned = larger(self.turned, turned / *nearest);
            // A distance within rounding does not count.
            *nearest = if apart < *nearest { apart.max(BESIDE * 1e-3) } else { *nearest };
        }
        Ok(())
    }

    /// The bounds on rounding so far, for an element whose matrix and its inverse have norms with this product.
    pub fn bounds(&self, condition: f64) -> Bounds {
        Bounds {
            momentum: SAFETY * self.growth * self.momentum,
            element: SAFETY * (condition * self.element + self.turned * self.momentum),
        }
    }
}

/// The element of a motion from the identity.
pub fn matrix(motion: &Motion, entries: usize) -> DMatrix<f64> {
    let size = (0..=entries).find(|n| n * n >= entries).unwrap_or(0);
    let identity = DMatrix::<f64>::identity(size, size);
    DMatrix::from_row_slice(size, size, &motion.element_from(identity.as_slice()))
}

fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a / b }
}

fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() || b > a { b } else { a }
}
