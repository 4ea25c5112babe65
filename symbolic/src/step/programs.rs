//! The programs of a step, put together.

use coadjoint_program::limits::{NEAR, RATE_OF_HALF_TURN};
use coadjoint_program::{Kernel, KernelParts, Programs};

use super::solving::{ROUNDINGS, Scheme, inputs, squares_of_series, tolerance};
use super::vector::{all_at_most, finite};
use crate::graph::{Graph, Id, Program};
use crate::integrator::{Integrator, Kicks};
use crate::lie::{self, LieAlgebra};
use crate::poly::Numeric;
use crate::potential::Potential;
use crate::step::StepError;
use crate::step::product::{ESTIMATED, Part, Product};

/// The programs of a step; the integrator's folded coefficients come first, after them those of the bound on the
/// Hessian, the square of the radius, and with kicks the length of one.
pub(crate) fn kernel(
    integrator: &Integrator,
    scheme: Scheme,
    group: &Product,
    (base, bound_len): (usize, usize),
) -> Result<Kernel, StepError> {
    let (guess, correct) = scheme.programs(integrator, group, (base, bound_len));
    let radius = base + bound_len;
    let (transport, frame) = (transport(group), frame(integrator, group)?);
    // Between kicks a frame moves on with each flow.
    let (transport, frame) = match (frame, &integrator.kicks) {
        (Some(frame), Some(_)) => (followed(group, &transport, &frame), None),
        (frame, _) => (transport, frame),
    };
    let programs = Programs {
        guess,
        correct,
        accept: accept(integrator, scheme, group, radius),
        transport,
        frame,
        sound: sound(group),
        watch: watch(
            |graph, mu| graph.call(&integrator.energy, mu),
            &integrator.problem.algebra,
            integrator.kicks.as_ref().map(Acting::of_kicks),
            group,
        ),
        matrix: matrix(group),
    };
    let kernel = Kernel::new(KernelParts {
        dim: group.dim(),
        element: group.element(),
        unknowns: group.dim(),
        solution: group.dim(),
        tolerance: ROUNDINGS * f64::EPSILON,
        near: NEAR,
        corrections: scheme.corrections(),
        programs,
    })?;
    kicked(kernel, integrator.kicks.as_ref(), group, radius + 1)
}

/// The kernel of a flow with kicks between flows, if there are any, whose length is this coefficient.
pub(super) fn kicked(
    kernel: Kernel,
    kicks: Option<&Kicks>,
    group: &Product,
    length: usize,
) -> Result<Kernel, StepError> {
    let Some(kicks) = kicks else { return Ok(kernel) };
    let flows = kicks.splitting.flows().len() as u32;
    Ok(kernel.with_kicks(kick(kicks, group, length), flows)?)
}

/// g, μ ↦ μ + l·τ(g), with the torque τ of the potential and the length l of the kick.
fn kick(kicks: &Kicks, group: &Product, length: usize) -> Program {
    let (n, m) = (group.dim(), group.element());
    let graph = Graph::new();
    let (g, mu) = (inputs(&graph, 0, m), inputs(&graph, m, n));
    let matrix = group.matrix(&graph, &g);
    let torque = graph.call_from(&kicks.kick.torque, matrix.entries(), kicks.first);
    let length = graph.slot(length);
    let kicked = torque.iter().zip(&mu).map(|(&torque, &mu)| graph.times_plus(torque, length, mu));
    graph.finish(m + n, &kicked.collect::<Vec<_>>())
}

/// g, μ, x ↦ the state moved by the increment, then by the frame of one flow.
fn followed(group: &Product, transport: &Program, frame: &Program) -> Program {
    let (n, m) = (group.dim(), group.element());
    let graph = Graph::new();
    let mut moved = graph.call(transport, &inputs(&graph, 0, m + n + n));
    moved.push(graph.constant(1.0));
    graph.finish(m + n + n, &graph.call(frame, &moved))
}

/// μ, x, the residual bound, the distance from the guess ↦ 1 where the step is accepted.
fn accept(integrator: &Integrator, scheme: Scheme, group: &Product, radius: usize) -> Program {
    let n = group.dim();
    let graph = Graph::new();
    let (mu, x) = (inputs(&graph, 0, n), inputs(&graph, n, n));
    let (residual_bound, distance) = (graph.input(2 * n), graph.input(2 * n + 1));
    let (tolerance, near) = (tolerance(&graph), graph.constant(NEAR));
    let extent = group.extent(&graph, &x);
    let one = graph.constant(1.0);
    let radius = graph.slot(radius);
    let inverse_square = |share: f64| graph.constant((1.0 / share).powi(2));
    // Newton's method judges the rate at which motions part with its matrices, the fixed point by the turn.
    let rate = integrator.largest_rate.filter(|_| scheme == Scheme::FixedPoint);
    let most = rate.map_or(1.0, |rate| rate / RATE_OF_HALF_TURN);
    let [series, others] =
        [group.estimated(), ESTIMATED].map(|share| inverse_square(share.min(most)));
    // No series has a radius so large that its square has no place in 32 bits.
    let finite = graph.constant(f64::from(f32::MAX));
    let extent = graph.mul(extent, graph.select(radius, finite, series, others));
    let mut tests = vec![(residual_bound, tolerance), (distance, near), (extent, one)];
    // A factor of the group that hardly moves must not hide another.
    let squares = squares_of_series(&graph, integrator, group, &mu);
    tests.extend(squares.into_iter().map(|square| (square, radius)));
    graph.finish(2 * n + 2, &[all_at_most(&graph, &tests)])
}

/// g, μ, x ↦ g·τ(x), Ad\*_{τ(x)⁻¹} μ.
pub(super) fn transport(group: &Product) -> Program {
    let (n, m) = (group.dim(), group.element());
    let graph = Graph::new();
    let g = inputs(&graph, 0, m);
    let (mu, x) = (inputs(&graph, m, n), inputs(&graph, m + n, n));
    let moved = group.transport(&graph, &g, &x, &mu);
    let outputs: Vec<Id> = moved.g.into_iter().chain(moved.mu).collect();
    graph.finish(m + n + n, &outputs)
}

/// g, μ, a number of steps ↦ both moved on by the comoving frame.
fn frame(integrator: &Integrator, group: &Product) -> Result<Option<Program>, StepError> {
    if integrator.frame.is_empty() {
        return Ok(None);
    }
    let (n, m) = (group.dim(), group.element());
    let graph = Graph::new();
    let mut g = inputs(&graph, 0, m);
    let mut mu = inputs(&graph, m, n);
    let times = graph.input(m + n);
    for motion in &integrator.frame {
        let y = graph.call(motion, &mu);
        let y: Vec<Id> = y.iter().map(|&entry| graph.mul(times, entry)).collect();
        let moved = group.move_frame(&graph, &g, &y, &mu).ok_or_else(|| {
            let group = integrator.problem.algebra.name().to_owned();
            StepError::Frame { group }
        })?;
        (g, mu) = (moved.g, moved.mu);
    }
    let outputs: Vec<Id> = g.into_iter().chain(mu).collect();
    Ok(Some(graph.finish(m + n + 1, &outputs)))
}

/// g, μ ↦ 1 where both are finite and g is on the group, to the square root of rounding.
pub(super) fn sound(group: &Product) -> Program {
    let (n, m) = (group.dim(), group.element());
    let graph = Graph::new();
    let (g, mu) = (inputs(&graph, 0, m), inputs(&graph, m, n));
    let defect = graph.add(group.defect(&graph, &g), finite(&graph, &mu));
    let limit = graph.epsilon();
    graph.finish(m + n, &[all_at_most(&graph, &[(defect, graph.sqrt(limit))])])
}

/// A force, as far as it changes quantities that are watched.
pub(super) struct Acting<'a> {
    /// V, and the number of its first slot, where it has a potential.
    pub energy: Option<(&'a Program, usize)>,
    /// The force: the potential, else the torque; none without one.
    pub torque: Option<&'a Potential>,
}

impl<'a> Acting<'a> {
    pub(super) fn of_kicks(kicks: &'a Kicks) -> Self {
        let energy = kicks.kick.energy.as_ref().map(|energy| (energy, kicks.first));
        Self { energy, torque: Some(&kicks.kick.potential) }
    }
}

/// g, μ ↦ the energy H_red(μ) + V(g), the first being given, then the Casimirs of low degree that are conserved.
pub(super) fn watch(
    energy: impl Fn(&Graph, &[Id]) -> Vec<Id>,
    algebra: &LieAlgebra,
    acting: Option<Acting<'_>>,
    group: &Product,
) -> Program {
    let (n, m) = (group.dim(), group.element());
    let graph = Graph::new();
    let (g, mu) = (inputs(&graph, 0, m), inputs(&graph, m, n));
    let mut outputs = energy(&graph, &mu);
    let mut casimirs = lie::watched_casimirs(algebra);
    if let Some(Acting { energy, torque }) = acting {
        if let Some((energy, first)) = energy {
            let matrix = group.matrix(&graph, &g);
            for energy in graph.call_from(energy, matrix.entries(), first) {
                outputs[0] = graph.add(outputs[0], energy);
            }
        }
        casimirs.retain(|casimir| torque.is_none_or(|torque| torque.keeps(casimir)));
    }
    let casimirs = casimirs.iter();
    outputs.extend(casimirs.map(|casimir| Numeric::new(casimir, n, &[]).node(&graph, &mu)));
    graph.finish(m + n, &outputs)
}

/// g ↦ its matrix, row by row.
pub(super) fn matrix(group: &Product) -> Program {
    let m = group.element();
    let graph = Graph::new();
    let matrix = group.matrix(&graph, &inputs(&graph, 0, m));
    graph.finish(m, matrix.entries())
}
