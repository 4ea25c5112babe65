//! The equation of a step as programs: a first guess, and a correction of it.

use std::ops::Range;

use coadjoint_geometry::series::NEWTON;

use super::tables::structure_of;
use super::vector::{Eliminated, Matrix, dot, finite, largest};
use crate::graph::{Graph, Id, Program};
use crate::integrator::{Integrator, Predictor};
use crate::lie::LieAlgebra;
use crate::step::product::{Part, Product};

/// Inputs of a program, this many from one on.
pub(crate) fn inputs(graph: &Graph, from: usize, count: usize) -> Vec<Id> {
    (from..from + count).map(|i| graph.input(i)).collect()
}

/// The largest residual accepted, relative to the largest coordinate of μ in [`Integrator::units`], in units of rounding.
pub(crate) const ROUNDINGS: f64 = 4.0;

/// The largest residual accepted, relative to the largest coordinate of μ.
pub(crate) fn tolerance(graph: &Graph) -> Id {
    let (unit, many) = (graph.epsilon(), graph.constant(ROUNDINGS));
    graph.mul(many, unit)
}

/// Up to this size of a correction, relative to μ, the estimate of what it leaves is a bound.
const TRUSTED: f64 = 1e-3;

/// Corrections of Newton's method at most, and evaluations of the fixed point.
const CORRECTIONS: u32 = 12;
const EVALUATIONS: u32 = 60;

/// Rounding of p by the fixed point may stay above the tolerance: by this number of units for each dimension, and at most.
const ROUNDINGS_EACH: f64 = 4.0;
const MOST_ROUNDINGS: f64 = 32.0;

/// The truncation allowed in a chart's derivative where chords correct it.
const CHORD: f64 = 1e-3;

/// The solver of p = (d^R τ_x)ᵀ μ, x = ∂S/∂p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    /// By Newton's method: each correction has the matrices of its own place.
    Newton,
    /// By one step of Newton's method, which counts as part of the guess, and chords with its matrices after that: where
    /// the guess is not near enough for a single step.
    Chord,
    /// By the fixed point p ← (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), which needs neither the Hessian of S nor the derivative of the
    /// chart: for many dimensions.
    FixedPoint,
}

/// p, as the guess or a correction leaves it, and what a correction knows about itself.
struct Corrected {
    p: Vec<Id>,
    x: Vec<Id>,
    /// The largest coordinates of the correction (relative to μ) and of what it adds to x.
    relative: Id,
    stretch: Id,
}

/// The matrices of a step of Newton's method.
struct Matrices {
    hessian: Matrix,
    jacobian: Eliminated,
    /// The square of the rate and of the largest one that is accepted, where the truncation limits it: see
    /// [`Integrator::largest_rate`].
    rate: Option<(Id, Id)>,
    /// [`Integrator::units`].
    units: Vec<f64>,
}

impl Scheme {
    /// The scheme for an integrator.
    pub(crate) fn of(integrator: &Integrator) -> Self {
        if integrator.hessian.is_none() {
            return Self::FixedPoint;
        }
        match integrator.plan.chords(&integrator.problem) {
            0 => Self::Newton,
            _ => Self::Chord,
        }
    }

    /// The truncation allowed in a chart's derivative, relative to it.
    pub(crate) fn slope(self) -> f64 {
        match self {
            Self::Newton | Self::FixedPoint => NEWTON,
            Self::Chord => CHORD,
        }
    }

    /// Corrections at most.
    pub(crate) fn corrections(self) -> u32 {
        match self {
            Self::Newton | Self::Chord => CORRECTIONS,
            Self::FixedPoint => EVALUATIONS / 2,
        }
    }

    /// The programs `guess` and `correct` of a kernel; see [`coadjoint_program::Programs`].
    pub(crate) fn programs(
        self,
        integrator: &Integrator,
        group: &Product,
        bound: (usize, usize),
    ) -> (Program, Program) {
        match self {
            Self::Newton => (guess(integrator, group, bound), newton(integrator, group)),
            Self::Chord => chord(integrator, group, bound),
            Self::FixedPoint => fixed_point(integrator, group, bound),
        }
    }
}

/// |μ|² of each factor of the group on which S₃ … S_K depend: what says how they converge. The translations of a free
/// body are not among them. In a factor whose S depends on the momenta of a subalgebra alone, x is in it, and p on it follows
/// from μ on it: only they count, as those of the rotations of a body on SE(3) in the frame that moves with its mass.
pub(crate) fn squares_of_series(
    graph: &Graph,
    integrator: &Integrator,
    group: &Product,
    mu: &[Id],
) -> Vec<Id> {
    let factors = group.whole_factors(&integrator.coefficients.beyond_first());
    let (all, structure) =
        (integrator.coefficients.of_series(), structure_of(&integrator.problem.algebra));
    let mu = in_units(graph, mu, &integrator.units, 1);
    let square = |own: Range<usize>| {
        let inside = |i: &usize| own.contains(i) && all.contains(i);
        let closed = structure.iter().all(|(i, j, k, _)| !inside(i) || !inside(j) || inside(k));
        let counts = |i: &usize| !closed || inside(i);
        let own: Vec<Id> = own.clone().filter(counts).map(|i| mu[i]).collect();
        dot(graph, &own, &own)
    };
    factors.into_iter().map(square).collect()
}

/// Coordinates times these numbers to this power.
fn in_units(graph: &Graph, list: &[Id], units: &[f64], power: i32) -> Vec<Id> {
    let times = |(&entry, unit): (&Id, &f64)| match unit.powi(power) {
        1.0 => entry,
        unit => graph.mul(entry, graph.constant(unit)),
    };
    list.iter().zip(units).map(times).collect()
}

/// The largest of coordinates times these numbers to this power, by one multiplication for each number.
pub(super) fn largest_in_units(graph: &Graph, list: &[Id], units: &[f64], power: i32) -> Id {
    let mut parts: Vec<(f64, Vec<Id>)> = Vec::new();
    for (&entry, &unit) in list.iter().zip(units) {
        match parts.iter_mut().find(|(own, _)| *own == unit) {
            Some((_, own)) => own.push(entry),
            None => parts.push((unit, vec![entry])),
        }
    }
    let units: Vec<f64> = parts.iter().map(|(unit, _)| *unit).collect();
    let sizes: Vec<Id> = parts.iter().map(|(_, own)| largest(graph, own)).collect();
    let sizes = in_units(graph, &sizes, &units, power);
    let first = sizes.first().copied().unwrap_or_else(|| graph.zero());
    sizes.into_iter().skip(1).fold(first, |all, size| graph.max(all, size))
}

/// The first guess of p, 1/scale, and half the bound on what the Hessian leaves out times the scale, the scale being the
/// largest coordinate of μ.
fn start(
    graph: &Graph,
    integrator: &Integrator,
    group: &Product,
    (base, bound_len): (usize, usize),
    mu: &[Id],
) -> (Vec<Id>, Id, Id) {
    let found = graph.call(&integrator.predictor, mu);
    let guess = match integrator.plan.predictor {
        Predictor::Flow(_) => group.pull_back(graph, &found, mu),
        Predictor::Explicit(_) => found,
    };
    let smallest = graph.constant(f64::from(f32::MIN_POSITIVE));
    let scale = largest_in_units(graph, mu, &integrator.units, 1);
    let scale = graph.add(scale, smallest);
    let inverse_scale = graph.div(graph.constant(1.0), scale);
    let mut bound = graph.zero();
    if bound_len > 0 {
        let mut square = graph.zero();
        for own in squares_of_series(graph, integrator, group, mu) {
            square = graph.add(square, own);
        }
        let size = graph.sqrt(square);
        for degree in (0..bound_len).rev() {
            bound = graph.times_plus(bound, size, graph.slot(base + degree));
        }
        bound = graph.mul(graph.mul(graph.constant(0.5), scale), bound);
    }
    (guess, inverse_scale, bound)
}

/// μ ↦ p, 1/scale, half the bound on what the Hessian leaves out times the scale.
fn guess(integrator: &Integrator, group: &Product, bound: (usize, usize)) -> Program {
    let n = group.dim();
    let graph = Graph::new();
    let mu = inputs(&graph, 0, n);
    let (mut outputs, inverse_scale, bound) = start(&graph, integrator, group, bound, &mu);
    outputs.extend([inverse_scale, bound]);
    graph.finish(n, &outputs)
}

/// ∂S/∂p and the Hessian of S, which the program gives as the upper triangle row by row.
pub(crate) fn hessian_of(graph: &Graph, program: &Program, p: &[Id]) -> (Vec<Id>, Matrix) {
    let n = p.len();
    let mut x = graph.call(program, p);
    let triangle = x.split_off(n);
    let place = |i: usize, j: usize| {
        let (i, j) = (i.min(j), i.max(j));
        i * n - i * i.saturating_sub(1) / 2 - i + j
    };
    (x, Matrix::new(n, n, |i, j| triangle[place(i, j)]))
}

/// The equation and its matrices at p: x, the residual F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
fn linearised(
    graph: &Graph,
    integrator: &Integrator,
    group: &Product,
    p: &[Id],
    mu: &[Id],
) -> (Vec<Id>, Vec<Id>, Matrices) {
    let n = group.dim();
    let (x, hessian) = hessian_of(graph, integrator.iteration(), p);
    let (pulled, derivative) = group.pull_back_with_derivative(graph, &x, mu);
    let unit = Matrix::identity(graph, n);
    let back = Matrix::new(n, n, |i, j| graph.neg(derivative.at(i, j)));
    let matrix = back.times_plus(graph, &hessian, &unit);
    let residual = p.iter().zip(&pulled).map(|(&a, &b)| graph.sub(a, b)).collect();
    let jacobian = Eliminated::new(graph, &matrix);
    let rate = integrator.largest_rate.map(|largest| {
        let product = Matrix::new(n, n, |i, j| graph.sub(unit.at(i, j), matrix.at(i, j)));
        let rate = square_of_rate(graph, &integrator.problem.algebra, &x, &product);
        (rate, graph.constant(largest * largest))
    });
    let units = integrator.units.clone();
    (x, residual, Matrices { hessian, jacobian, rate, units })
}

/// maxᵢ Σⱼ |ZᵢⱼZⱼᵢ| of Z = ad_xᵀ + 2 D·Hess S, which to first order is h times the derivative of μ̇ = ad\*_{∂H/∂μ} μ: a
/// bound on how fast motions part that does not depend on the units of the coordinates.
pub(crate) fn square_of_rate(
    graph: &Graph,
    algebra: &LieAlgebra,
    x: &[Id],
    product: &Matrix,
) -> Id {
    let n = x.len();
    let two = graph.constant(2.0);
    let mut z = Matrix::new(n, n, |i, j| graph.mul(two, product.at(i, j)));
    for (i, j, k, c) in structure_of(algebra) {
        z.set(j, k, graph.times_plus(graph.constant(c), x[i], z.at(j, k)));
    }
    let rows: Vec<Id> = (0..n)
        .map(|i| {
            let mut sum = graph.zero();
            for j in 0..n {
                sum = graph.add(sum, graph.abs(graph.mul(z.at(i, j), z.at(j, i))));
            }
            sum
        })
        .collect();
    largest(graph, &rows)
}

impl Matrices {
    /// p less the solution of the linearised equation. x moves linearly with p; what that leaves out is of the order of
    /// what Newton leaves.
    fn correct(
        &self,
        graph: &Graph,
        (p, x, residual): (&[Id], &[Id], &[Id]),
        inverse_scale: Id,
    ) -> Corrected {
        let correction = self.jacobian.solve(graph, residual);
        let shift = self.hessian.apply(graph, &correction);
        let less = |list: &[Id], change: &[Id]| -> Vec<Id> {
            list.iter().zip(change).map(|(&a, &b)| graph.sub(a, b)).collect()
        };
        let (p, x) = (less(p, &correction), less(x, &shift));
        let sized = largest_in_units(graph, &correction, &self.units, 1);
        let mut relative = graph.mul(sized, inverse_scale);
        if let Some((rate, most)) = self.rate {
            // Too long a step is not near anything.
            relative = graph.select(rate, most, relative, graph.constant(f64::from(f32::MAX)));
        }
        let stretch = largest_in_units(graph, &shift, &self.units, -1);
        Corrected { p, x, relative, stretch }
    }
}

/// The factor by which the chart bends increments of x faster than the length of a correction. In a comoving frame x is short
/// where S is far from quadratic.
fn bend(graph: &Graph, integrator: &Integrator, x: &[Id]) -> Id {
    if !integrator.problem.is_quadratic() || integrator.problem.comoving.is_some() {
        return graph.constant(1.0);
    }
    let size = largest_in_units(graph, x, &integrator.units, -1);
    graph.mul(graph.mul(size, size), graph.constant(0.25))
}

/// The residual bound: the estimate where the distance from the matrices' point is short, else the correction itself;
/// the smaller of both where the correction is below rounding.
fn residual_bound(graph: &Graph, (estimate, relative, distance): (Id, Id, Id)) -> Id {
    let (trusted, tolerance) = (graph.constant(TRUSTED), tolerance(graph));
    let bound = graph.select(distance, trusted, estimate, relative);
    graph.select(relative, tolerance, graph.min(bound, relative), bound)
}

/// A correction of Newton's method: p, μ, constants ↦ the next p, x there to second order, the residual bound, the
/// length of the correction.
fn newton(integrator: &Integrator, group: &Product) -> Program {
    let n = group.dim();
    let graph = Graph::new();
    let (p, mu) = (inputs(&graph, 0, n), inputs(&graph, n, n));
    let (inverse_scale, half_bound) = (graph.input(2 * n), graph.input(2 * n + 1));
    let (x, residual, matrices) = linearised(&graph, integrator, group, &p, &mu);
    let corrected = matrices.correct(&graph, (&p, &x, &residual), inverse_scale);
    let Corrected { p, x: moved, relative, stretch } = corrected;
    let bend = graph.mul(bend(&graph, integrator, &x), relative);
    let curved = graph.times_plus(graph.constant(0.5), stretch, bend);
    let estimate = graph.times_plus(stretch, curved, graph.mul(half_bound, relative));
    let bound = residual_bound(&graph, (estimate, relative, relative));
    let outputs: Vec<Id> = p.into_iter().chain(moved).chain([bound, relative]).collect();
    graph.finish(2 * n + 2, &outputs)
}

/// The guess with a step of Newton's method from it, and a chord with the matrices of that step, which are among the
/// constants.
fn chord(integrator: &Integrator, group: &Product, bound: (usize, usize)) -> (Program, Program) {
    let n = group.dim();
    let graph = Graph::new();
    let mu = inputs(&graph, 0, n);
    let (p, inverse_scale, half_bound) = start(&graph, integrator, group, bound, &mu);
    let (x, residual, matrices) = linearised(&graph, integrator, group, &p, &mu);
    let first = matrices.correct(&graph, (&p, &x, &residual), inverse_scale);
    let mut outputs = first.p;
    outputs.extend([inverse_scale, half_bound, first.relative, first.stretch]);
    // The chord's graph, in which numbers that are known have no place among the constants.
    let chord = Graph::new();
    let mut known = std::collections::BTreeMap::new();
    let mut rename = |id: Id| {
        if let Some(value) = graph.known_number(id) {
            return chord.constant(value);
        }
        *known.entry(id).or_insert_with(|| {
            outputs.push(id);
            // After p, μ, and what is among the outputs in place of p.
            chord.input(n + outputs.len() - 1)
        })
    };
    let hessian = Matrix::new(n, n, |i, j| rename(matrices.hessian.at(i, j)));
    let jacobian = matrices.jacobian.map(&mut rename);
    // The rate has been judged with the guess.
    let matrices = Matrices { hessian, jacobian, rate: None, units: matrices.units };
    let inputs_of_chord = n + outputs.len();
    let guess = graph.finish(n, &outputs);
    let correct = chord_correction(chord, integrator, group, &matrices, inputs_of_chord);
    (guess, correct)
}

/// A chord: as [`newton`], with matrices from elsewhere.
fn chord_correction(
    graph: Graph,
    integrator: &Integrator,
    group: &Product,
    matrices: &Matrices,
    inputs_of_chord: usize,
) -> Program {
    let n = group.dim();
    let (p, mu) = (inputs(&graph, 0, n), inputs(&graph, n, n));
    let [inverse_scale, half_bound, first, first_stretch] =
        [0, 1, 2, 3].map(|i| graph.input(2 * n + i));
    let x = graph.call(&integrator.gradient, &p);
    let pulled = group.pull_back(&graph, &x, &mu);
    let residual: Vec<Id> = p.iter().zip(&pulled).map(|(&a, &b)| graph.sub(a, b)).collect();
    let corrected = matrices.correct(&graph, (&p, &x, &residual), inverse_scale);
    let Corrected { p, x: moved, relative, stretch } = corrected;
    // The matrices are of a place no farther away than twice the first correction and this one, and change by that twice
    // as much as over half the distance, which is Newton's.
    let distance = graph.add(first, relative);
    let far = graph.add(first_stretch, stretch);
    let two = graph.constant(2.0);
    let four = graph.constant(4.0);
    let slope = graph.constant(CHORD);
    let bend = graph.mul(bend(&graph, integrator, &x), distance);
    let curved = graph.times_plus(four, bend, graph.times_plus(two, far, slope));
    let estimate = graph.times_plus(stretch, curved, graph.mul(half_bound, relative));
    let bound = residual_bound(&graph, (estimate, relative, distance));
    let outputs: Vec<Id> = p.into_iter().chain(moved).chain([bound, distance]).collect();
    graph.finish(inputs_of_chord, &outputs)
}

/// The guess, and a correction by two evaluations of the fixed point: p, μ, 1/scale ↦ p after both, the x of the second,
/// the residual bound at that x, the length of the correction. The equation is solved where the second evaluation moves p by
/// rounding alone.
fn fixed_point(
    integrator: &Integrator,
    group: &Product,
    bound: (usize, usize),
) -> (Program, Program) {
    let n = group.dim();
    let graph = Graph::new();
    let mu = inputs(&graph, 0, n);
    let (mut outputs, inverse_scale, _) = start(&graph, integrator, group, bound, &mu);
    outputs.push(inverse_scale);
    let guess = graph.finish(n, &outputs);

    let graph = Graph::new();
    let (p, mu) = (inputs(&graph, 0, n), inputs(&graph, n, n));
    let inverse_scale = graph.input(2 * n);
    let evaluate = |graph: &Graph, p: &[Id]| {
        let x = graph.call(&integrator.gradient, p);
        let next = group.pull_back(graph, &x, &mu);
        (x, next)
    };
    let distance = |graph: &Graph, a: &[Id], b: &[Id]| {
        let change: Vec<Id> = a.iter().zip(b).map(|(&a, &b)| graph.sub(a, b)).collect();
        let change = in_units(graph, &change, &integrator.units, 1);
        graph.mul(largest(graph, &change), inverse_scale)
    };
    let (_, once) = evaluate(&graph, &p);
    let (x, twice) = evaluate(&graph, &once);
    let second = distance(&graph, &once, &twice);
    let moved = distance(&graph, &p, &twice);
    let tolerance = tolerance(&graph);
    let many = (ROUNDINGS_EACH * n as f64).clamp(ROUNDINGS, MOST_ROUNDINGS);
    let many = graph.constant(many);
    let unit = graph.epsilon();
    let bound = graph.select(second, graph.mul(many, unit), graph.min(second, tolerance), second);
    // The largest of many numbers may hide one that is none.
    let bound = graph.add(bound, finite(&graph, &twice));
    let outputs: Vec<Id> = twice.into_iter().chain(x).chain([bound, moved]).collect();
    (guess, graph.finish(2 * n + 1, &outputs))
}
