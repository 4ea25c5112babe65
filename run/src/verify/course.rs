//! A motion by the right solution of each step, and how far rounding may have carried another from it.
//!
//! Over a few steps the bounds of the judge are multiplied. A bound that multiplies the worst of every step says nothing
//! after more of them: then two motions that start a little beside the one judged go with it. How far they part is how far
//! a deviation made on the way may grow, and the bounds of the single steps, times that growth, are what rounding
//! may do. This is measured, not proven.

use coadjoint_codegen::judge::{Branch, Enclosure, End, Inside, RightSolution, Setting, Stop};
use nalgebra::DVector;

use super::states::{Reading, condition};
use crate::number::maximum;

/// The unit roundoff of what is judged.
const UNIT: f64 = f64::EPSILON / 2.0;
/// Up to this number of steps the bounds on what rounding does are multiplied.
const PROVEN: u64 = 3;
/// The largest relative effect of rounding at which numbers are still judged.
const VAGUE: f64 = 1e-3;
/// The ratio of the last two terms of the series up to which a step is accepted, and what rounding may add.
const LARGEST_RATIO: f64 = 0.5 * (1.0 + 1e-9);
/// The relative distance at which the neighbouring motions start.
const BESIDE: f64 = 1e-8;
/// The growth found may be exceeded by this factor.
const SAFETY: f64 = 10.0;

/// Reasons for which the judge stops at a step.
pub(crate) enum Trouble {
    /// The step is wrong.
    Wrong(String),
    /// Nothing can be said of it.
    Unknown(String),
}

impl From<Stop> for Trouble {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Branch(Branch::Folds(s)) => {
                Self::Wrong(format!("has no right solution: its continuation folds at s = {s:.4}"))
            }
            Stop::Branch(_) => Self::Unknown("its right solution was not found".to_owned()),
            Stop::Judge(error) => Self::Unknown(error.to_string()),
        }
    }
}

/// A motion that is judged.
pub(crate) struct Judged {
    motion: Enclosure,
    /// Rows of the group's matrices.
    size: usize,
    twins: Option<Twins>,
}

/// Motions beside one that is judged.
struct Twins {
    /// With the least distance of each so far, relative to the momentum.
    motions: Vec<(Enclosure, f64)>,
    /// The sums of what rounding may do in each step, relative to momentum and element.
    momentum: f64,
    element: f64,
    /// The largest growth of a distance in momentum, and from a distance in momentum to one of the element.
    growth: f64,
    turned: f64,
}

impl Judged {
    /// From this momentum, over `steps` steps, in a group whose matrices have `size` rows.
    pub(crate) fn new(mu: &[f64], steps: u64, size: usize) -> Self {
        let twins = (steps > PROVEN).then(|| Twins::new(mu));
        Self { motion: Enclosure::new(mu), size, twins }
    }

    /// One step by its right solution, which must lie inside the chart and be of a series that means something.
    pub(crate) fn step(&mut self, setting: &mut Setting<'_>) -> Result<(), Trouble> {
        let step = self.motion.here(setting).map_err(Stop::Judge)?;
        let right = step.right_solution().map_err(Stop::Branch)?;
        let x: Vec<f64> = step.increment(&right).iter().map(|x| x.to_f64()).collect();
        match step.inside(&x) {
            Inside::Yes => {}
            Inside::No(size) => {
                let what = format!("lies outside the chart: an eigenvalue has the size {size:.3}");
                return Err(Trouble::Wrong(what));
            }
            Inside::CannotTell => {
                return Err(Trouble::Unknown("it lies at the limit of the chart".to_owned()));
            }
        }
        if let Some(ratio) = step.at(&x).ok().and_then(|point| point.series_ratio(UNIT))
            && !(ratio <= LARGEST_RATIO)
        {
            let what = format!("is of a series whose last two terms have the ratio {ratio:.3}");
            return Err(Trouble::Wrong(what));
        }
        let Some(twins) = &mut self.twins else {
            return Ok(self.motion.step(setting, Some(right), UNIT)?);
        };
        let momentum = step.momentum().iter().map(|m| m.to_f64());
        let before = DVector::from_iterator(x.len(), momentum).norm();
        let end = step.end(&right, UNIT).map_err(Stop::Judge)?;
        self.motion.step(setting, Some(right.clone()), UNIT)?;
        Ok(twins.step(setting, (&right, &end, before), &self.motion, self.size)?)
    }

    /// By how much the motion stretches: the product of the norms of its element and the inverse, where there is one.
    pub(crate) fn stretch(&self) -> Option<f64> {
        condition(&element(&self.motion, self.size))
    }

    /// The deviations of momentum and element over what rounding may have done.
    ///
    /// # Errors
    /// Fails if that is so much that nothing can be said.
    pub(crate) fn deviations(
        &self,
        before: &Reading,
        after: &Reading,
    ) -> Result<(f64, Option<f64>), String> {
        let elements = before.element.as_ref().zip(after.element.as_ref());
        let Some(twins) = &self.twins else {
            let element = elements.map(|(g, next)| self.motion.element_deviation(g, next));
            return Ok((self.motion.momentum_deviation(&after.momentum), element));
        };
        let over = |error: f64, size: f64, bound: f64| match error {
            0.0 => Ok(0.0),
            _ if !(bound <= VAGUE) => {
                Err(format!("rounding may do as much as {bound:.1e} in that many steps"))
            }
            error => Ok(error / (size * bound)),
        };
        let vector = |values: &[f64]| DVector::from_column_slice(values);
        let here = vector(&self.motion.momentum());
        let error = (&here - vector(&after.momentum)).norm();
        let bound = SAFETY * twins.growth * twins.momentum;
        let momentum = over(error, here.norm(), bound);
        let Some((g, next)) = elements else { return Ok((momentum?, None)) };
        let condition = self.stretch().ok_or("the group element has no inverse")?;
        let bound = SAFETY * (condition * twins.element + twins.turned * twins.momentum);
        let whole = vector(&element(&self.motion, self.size)).norm();
        let apart = (vector(&self.motion.element_from(g)) - vector(next)).norm();
        let element = over(apart, vector(g).norm() * whole, bound)?;
        Ok((momentum?, Some(element)))
    }
}

impl Twins {
    /// Beside a motion from this momentum.
    fn new(mu: &[f64]) -> Self {
        let (n, size) = (mu.len(), DVector::from_column_slice(mu).norm());
        let beside = |turn: usize| {
            // Directions in which no coordinate is left out.
            let direction = DVector::from_fn(n, |i, _| {
                let weight = 1.0 / ((i + turn) % n + 1) as f64;
                if (i + turn).is_multiple_of(2) { weight } else { -weight }
            });
            let shift = direction.scale(BESIDE * size / direction.norm());
            let moved: Vec<f64> = mu.iter().zip(shift.iter()).map(|(mu, s)| mu + s).collect();
            (Enclosure::new(&moved), BESIDE)
        };
        let motions = if size > 0.0 { vec![beside(0), beside(1)] } else { Vec::new() };
        Self { motions, momentum: 0.0, element: 0.0, growth: 1.0, turned: 1.0 }
    }

    /// Goes a step with the motion, which this step, by its right solution, has led to where it is. Momenta of the end are in its own units, in
    /// which the step's start had the size `before`.
    fn step(
        &mut self,
        setting: &mut Setting<'_>,
        (right, end, before): (&RightSolution, &End, f64),
        motion: &Enclosure,
        size: usize,
    ) -> Result<(), Stop> {
        let own = end.element.iter().map(|g| g.to_f64() * g.to_f64()).sum::<f64>().sqrt();
        self.momentum += ratio(end.momentum_bound, before);
        self.element += ratio(end.element_bound, own);
        let vector = |values: Vec<f64>| DVector::from_vec(values);
        let (here, whole) = (vector(motion.momentum()), vector(element(motion, size)));
        for (twin, nearest) in &mut self.motions {
            let known = twin.beside(setting, right, end.scale);
            twin.step(setting, known, UNIT)?;
            let apart = ratio((vector(twin.momentum()) - &here).norm(), here.norm());
            let turned = ratio((vector(element(twin, size)) - &whole).norm(), whole.norm());
            self.growth = maximum(self.growth, apart / *nearest);
            self.turned = maximum(self.turned, turned / *nearest);
            // A distance within rounding does not count.
            *nearest = if apart < *nearest { apart.max(BESIDE * 1e-3) } else { *nearest };
        }
        Ok(())
    }
}

/// The element of a motion from the identity, row by row.
fn element(motion: &Enclosure, size: usize) -> Vec<f64> {
    motion.element_from(nalgebra::DMatrix::<f64>::identity(size, size).as_slice())
}

fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a / b }
}
