//! The programs of a step, put together.

use coadjoint_program::{Kernel, Precision, Programs};
use num_traits::ToPrimitive;

use super::StepError;
use super::part::Part;
use super::product::Product;
use super::vector::{Matrix, all_at_most, dot, finite, largest, solve};
use crate::graph::{Graph, Id, Program};
use crate::integrator::{Integrator, Predictor};
use crate::lie;
use crate::poly::Polynomial;

/// What may be left of the equation, relative to the largest coordinate of μ: four units of rounding.
fn tolerance(precision: Precision) -> f64 {
    4.0 * precision.epsilon()
}

/// A solution this near to its first guess, relative to μ, is the one continued from the identity.
const NEAR: f64 = 0.05;

/// Up to this size of a correction, relative to μ, the estimate of what it leaves is a bound.
const TRUSTED: f64 = 1e-3;

/// Up to which share of a half turn, as the inverse of its square, steps are accepted at once: half of it, or a third
/// where S is no series with a radius.
const OF_SERIES: f64 = 4.0;
const OF_OTHERS: f64 = 9.0;

/// Corrections at most.
const CORRECTIONS: u32 = 12;

/// The Casimirs that are watched have this degree at most.
const CASIMIR_DEGREE: u32 = 3;

/// How far a group element may be from the group: the square root of rounding.
fn off_group(precision: Precision) -> f64 {
    precision.epsilon().sqrt()
}

fn inputs(graph: &mut Graph, from: usize, count: usize) -> Vec<Id> {
    (from..from + count).map(|i| graph.input(i)).collect()
}

/// The programs of a step; the integrator's folded coefficients come first, after them those of the bound on the
/// Hessian, and the square of the radius.
pub fn kernel(
    integrator: &Integrator,
    group: &Product,
    (base, bound_len): (usize, usize),
    precision: Precision,
) -> Result<Kernel, StepError> {
    let programs = Programs {
        guess: guess(integrator, group, base, bound_len),
        correct: correct(integrator, group, precision),
        accept: accept(group, base + bound_len, precision),
        transport: transport(group),
        frame: frame(integrator, group)?,
        sound: sound(group, precision),
        watch: watch(integrator, group),
        matrix: matrix(group),
    };
    let (dim, element) = (group.dim(), group.element());
    let kernel = Kernel::new(dim, element, tolerance(precision), NEAR, CORRECTIONS, programs)?;
    Ok(kernel.in_precision(precision))
}

/// μ ↦ p, 1/scale, half the bound on what the Hessian leaves out times the scale.
fn guess(integrator: &Integrator, group: &Product, base: usize, bound_len: usize) -> Program {
    let n = group.dim();
    let mut graph = Graph::new();
    let mu = inputs(&mut graph, 0, n);
    let found = graph.call(&integrator.predictor, &mu);
    let mut outputs = match integrator.plan.predictor {
        Predictor::Flow(_) => group.pull_back(&mut graph, &found, &mu),
        Predictor::Explicit(_) => found,
    };
    let smallest = graph.constant(f64::from(f32::MIN_POSITIVE));
    let size = largest(&mut graph, &mu);
    let scale = graph.add(size, smallest);
    let one = graph.constant(1.0);
    outputs.push(graph.div(one, scale));
    let mut bound = graph.zero();
    if bound_len > 0 {
        let square = dot(&mut graph, &mu, &mu);
        let size = graph.sqrt(square);
        for degree in (0..bound_len).rev() {
            let coefficient = graph.slot(base + degree);
            bound = graph.times_plus(bound, size, coefficient);
        }
        let half = graph.constant(0.5);
        let half = graph.mul(half, scale);
        bound = graph.mul(half, bound);
    }
    outputs.push(bound);
    graph.finish(n, &outputs)
}

/// A correction of Newton's method: p, μ, constants ↦ the next p, x there to second order, a bound on what is left, the
/// length of the correction.
fn correct(integrator: &Integrator, group: &Product, precision: Precision) -> Program {
    let n = group.dim();
    let mut graph = Graph::new();
    let (p, mu) = (inputs(&mut graph, 0, n), inputs(&mut graph, n, n));
    let (inverse_scale, half_bound) = (graph.input(2 * n), graph.input(2 * n + 1));
    let outputs = graph.call(integrator.iteration(), &p);
    let (x, triangle) = outputs.split_at(n);
    // The upper triangle, row by row.
    let place = |i: usize, j: usize| {
        let (i, j) = (i.min(j), i.max(j));
        i * n - i * i.saturating_sub(1) / 2 - i + j
    };
    let hessian = Matrix::new(n, n, |i, j| triangle[place(i, j)]);
    let (pulled, derivative) = group.pull_back_with_derivative(&mut graph, x, &mu);
    // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
    let product = derivative.times(&mut graph, &hessian);
    let (zero, one) = (graph.zero(), graph.constant(1.0));
    let jacobian = Matrix::new(n, n, |i, j| {
        let unit = if i == j { one } else { zero };
        graph.sub(unit, product.at(i, j))
    });
    let residual: Vec<Id> = p.iter().zip(&pulled).map(|(&a, &b)| graph.sub(a, b)).collect();
    let correction = solve(&mut graph, &jacobian, &residual);
    let shift = hessian.apply(&mut graph, &correction);
    let next: Vec<Id> = p.iter().zip(&correction).map(|(&a, &b)| graph.sub(a, b)).collect();
    // x moves linearly with p; what that leaves out is of the order of what Newton leaves.
    let moved: Vec<Id> = x.iter().zip(&shift).map(|(&a, &b)| graph.sub(a, b)).collect();

    let length = largest(&mut graph, &correction);
    let relative = graph.mul(length, inverse_scale);
    let stretch = largest(&mut graph, &shift);
    let bend = match integrator.problem.is_quadratic() {
        true => {
            let size = largest(&mut graph, x);
            let square = graph.mul(size, size);
            let quarter = graph.constant(0.25);
            graph.mul(square, quarter)
        }
        false => one,
    };
    let bend = graph.mul(bend, relative);
    let half = graph.constant(0.5);
    let curved = graph.times_plus(half, stretch, bend);
    let rest = graph.mul(half_bound, relative);
    let estimate = graph.times_plus(stretch, curved, rest);
    let (trusted, tolerance) = (graph.constant(TRUSTED), graph.constant(tolerance(precision)));
    let left = graph.select(relative, trusted, estimate, relative);
    let rounded = graph.min(left, relative);
    let left = graph.select(relative, tolerance, rounded, left);
    let outputs: Vec<Id> = next.into_iter().chain(moved).chain([left, relative]).collect();
    graph.finish(2 * n + 2, &outputs)
}

/// μ, x, what is left, the way ↦ 1 where the step is right.
fn accept(group: &Product, radius: usize, precision: Precision) -> Program {
    let n = group.dim();
    let mut graph = Graph::new();
    let (mu, x) = (inputs(&mut graph, 0, n), inputs(&mut graph, n, n));
    let (left, way) = (graph.input(2 * n), graph.input(2 * n + 1));
    let (tolerance, near) = (graph.constant(tolerance(precision)), graph.constant(NEAR));
    let extent = group.extent(&mut graph, &x);
    let one = graph.constant(1.0);
    let square = dot(&mut graph, &mu, &mu);
    let radius = graph.slot(radius);
    let (series, others) = (graph.constant(OF_SERIES), graph.constant(OF_OTHERS));
    let finite = graph.constant(precision.largest());
    let share = graph.select(radius, finite, series, others);
    let extent = graph.mul(extent, share);
    let tests = [(left, tolerance), (way, near), (extent, one), (square, radius)];
    let verdict = all_at_most(&mut graph, &tests);
    graph.finish(2 * n + 2, &[verdict])
}

/// g, μ, x ↦ g·τ(x), Ad\*_{τ(x)⁻¹} μ.
fn transport(group: &Product) -> Program {
    let (n, m) = (group.dim(), group.element());
    let mut graph = Graph::new();
    let g = inputs(&mut graph, 0, m);
    let (mu, x) = (inputs(&mut graph, m, n), inputs(&mut graph, m + n, n));
    let moved = group.transport(&mut graph, &g, &x, &mu);
    let outputs: Vec<Id> = moved.g.into_iter().chain(moved.mu).collect();
    graph.finish(m + n + n, &outputs)
}

/// g, μ, a number of steps ↦ both moved on by the comoving frame.
fn frame(integrator: &Integrator, group: &Product) -> Result<Option<Program>, StepError> {
    if integrator.frame.is_empty() {
        return Ok(None);
    }
    let (n, m) = (group.dim(), group.element());
    let mut graph = Graph::new();
    let mut g = inputs(&mut graph, 0, m);
    let mut mu = inputs(&mut graph, m, n);
    let times = graph.input(m + n);
    for motion in &integrator.frame {
        let y = graph.call(motion, &mu);
        let y: Vec<Id> = y.iter().map(|&entry| graph.mul(times, entry)).collect();
        let moved = group.move_frame(&mut graph, &g, &y, &mu).ok_or_else(|| {
            let group = integrator.problem.algebra.name().to_owned();
            StepError::Frame { group }
        })?;
        (g, mu) = (moved.g, moved.mu);
    }
    let outputs: Vec<Id> = g.into_iter().chain(mu).collect();
    Ok(Some(graph.finish(m + n + 1, &outputs)))
}

/// g, μ ↦ 1 where both are finite and g is on the group.
fn sound(group: &Product, precision: Precision) -> Program {
    let (n, m) = (group.dim(), group.element());
    let mut graph = Graph::new();
    let (g, mu) = (inputs(&mut graph, 0, m), inputs(&mut graph, m, n));
    let defect = group.defect(&mut graph, &g);
    let rest = finite(&mut graph, &mu);
    let defect = graph.add(defect, rest);
    let limit = graph.constant(off_group(precision));
    let verdict = all_at_most(&mut graph, &[(defect, limit)]);
    graph.finish(m + n, &[verdict])
}

/// g, μ ↦ the energy H_red(μ), then the Casimirs of low degree.
fn watch(integrator: &Integrator, group: &Product) -> Program {
    let (n, m) = (group.dim(), group.element());
    let mut graph = Graph::new();
    let mu = inputs(&mut graph, m, n);
    let mut outputs = graph.call(&integrator.energy, &mu);
    let algebra = &integrator.problem.algebra;
    let casimirs = (1..=CASIMIR_DEGREE).rev().find_map(|d| lie::casimirs(algebra, d).ok());
    for casimir in casimirs.unwrap_or_default() {
        outputs.push(polynomial(&mut graph, &casimir, &mu));
    }
    graph.finish(m + n, &outputs)
}

/// The value of a polynomial in these coordinates.
fn polynomial(graph: &mut Graph, polynomial: &Polynomial, inputs: &[Id]) -> Id {
    let mut sum = graph.zero();
    for (factors, value) in polynomial.factors() {
        let mut product = graph.constant(value.to_f64().unwrap_or(f64::NAN));
        for (i, power) in factors {
            for _ in 0..power {
                product = graph.mul(product, inputs[i as usize]);
            }
        }
        sum = graph.add(sum, product);
    }
    sum
}

/// g ↦ its matrix, row by row.
fn matrix(group: &Product) -> Program {
    let m = group.element();
    let mut graph = Graph::new();
    let g = inputs(&mut graph, 0, m);
    let matrix = group.matrix(&mut graph, &g);
    graph.finish(m, matrix.entries())
}
