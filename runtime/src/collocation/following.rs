//! The judgement of a solution: its nodes have to resolve it, and where it is not ordinary it is made again in parts that are.

use coadjoint_program::collocation::{
    LARGEST_FORCE, LARGEST_REACH, LARGEST_TAIL, NEAR_LIMIT, SLOW, ordinary_sweeps,
};
use nalgebra::SimdComplexField;

use super::drive::Drive;
use super::energy::{Energy, UNKNOWN, Undefined};
use super::rates::{Rates, largest, total};
use super::solving::{Attempt, Ending, Equations};
use crate::error::{Circumstances, StepError};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// Halvings of a step that is made in parts: at least, where H is a closure, which says nothing of its reach, more.
const LEAST: [u32; 2] = [1, 4];

/// Halvings at most.
const MOST: u32 = 7;

/// The largest difference of the momenta after a step and after its parts, relative to the momentum.
const LARGEST_DIFFERENCE: f64 = 0.1;

/// Sweeps that ordinary steps of a closure take at most.
const CLOSURE_SWEEPS: u32 = 8;

/// exp(x), and the momentum after the step.
pub(super) type Moved<G> = (<G as LieGroup>::Element, <G as LieGroup>::Vector);

impl<G, E, D, const M: usize> Equations<'_, G, E, D, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
    D: Drive<G>,
{
    /// The step of an attempt: solved, in the chart, with velocities that the nodes resolve, and with the end of its parts where it is
    /// not an ordinary step. One from a cold guess has no steps before it.
    pub(super) fn judge(
        &self,
        attempt: &Attempt<G::Vector, M>,
        cold: bool,
    ) -> Result<Moved<G>, StepError> {
        let (moved, measure) = self.resolve(attempt)?;
        if self.ordinary(attempt, &moved.1, measure, (cold, 1.0)).is_err() {
            self.follow(attempt, &moved.1)?;
        }
        Ok(moved)
    }

    /// Checks that parts of a step, each an ordinary one, lead to its end: to about this momentum, and as near to it as H's
    /// functions ask for.
    #[cold]
    fn follow(&self, attempt: &Attempt<G::Vector, M>, end: &G::Vector) -> Result<(), StepError> {
        let time = self.step.times_plus(0.5, self.middle);
        let omega = self.energy.gradient(time, end);
        if (0..end.dim()).any(|i| !omega[i].all_finite()) {
            return Err(self.undefined(time, end, None, circumstances(attempt)));
        }
        let known = self.energy.reach((time, end), (time, end)).is_some();
        let (_, parts) = self.in_parts(LEAST[usize::from(!known)], MOST)?;
        let size = self.mu.largest_entry();
        let scale = if size > 0.0 { size } else { 1.0 };
        let difference = end.clone().minus(&parts).largest_entry() / scale;
        let square = self.energy.reach((time, end), (time, &parts)).unwrap_or(0.0);
        within(attempt, difference, LARGEST_DIFFERENCE)?;
        within(attempt, square, LARGEST_REACH[M - 1])
    }

    /// The state after parts that are ordinary steps, made by this many halvings at least and at most: in the shortest parts, which a
    /// jump in time may be short against, the time stands still for this.
    fn in_parts(&self, least: u32, most: u32) -> Result<Moved<G>, StepError> {
        if least == 0 {
            let attempt = self.solve(Rates::zero(self.mu.dim()));
            let moves = if most == 0 { 0.0 } else { 1.0 };
            let made = self.resolve(&attempt).and_then(|((increment, end), measure)| {
                self.ordinary(&attempt, &end, measure, (false, moves))?;
                Ok((self.group.compose(self.element, &increment), end))
            });
            if made.is_ok() || most == 0 {
                return made;
            }
        }
        let half = |element: &G::Element, mu: &G::Vector, part: f64| {
            let (step, middle) = (0.5 * self.step, part.times_plus(self.step, self.middle));
            let equations = Equations::<G, E, D, M> { element, mu, middle, step, ..*self };
            equations.in_parts(least.saturating_sub(1), most - 1)
        };
        let (element, mu) = half(self.element, self.mu, -0.25)?;
        half(&element, &mu, 0.25)
    }

    /// Checks that an attempt is solved, in the chart and resolved by its nodes: where to it moves, and its measure as a share of the limit.
    fn resolve(&self, attempt: &Attempt<G::Vector, M>) -> Result<(Moved<G>, f64), StepError> {
        let at = circumstances(attempt);
        match &attempt.ending {
            Ending::Solved => {}
            Ending::NotConverged => {
                let Attempt { sweeps, residual, .. } = *attempt;
                return Err(StepError::NotConverged { iterations: sweeps, residual, at });
            }
            Ending::Undefined(time, node, known) => {
                return Err(self.undefined(*time, node, *known, at));
            }
        }
        let extent = self.group.exp_extent(&attempt.x);
        if extent.is_nan() || extent > 1.0 {
            return Err(StepError::OutsideChart { extent: extent.simd_sqrt(), at });
        }
        let limit = LARGEST_TAIL[M - 1];
        let [tail, force] = match M {
            1 => [self.bend(attempt), 0.0],
            _ => self.tails(attempt),
        };
        within(attempt, tail, limit)?;
        within(attempt, force, LARGEST_FORCE)?;
        let moved = self.group.exp_transport(&attempt.x, &attempt.pushed);
        Ok((moved, (tail / limit).max(force / LARGEST_FORCE)))
    }

    /// Checks that a solved step cannot be wrong without its nodes showing it: that it took few sweeps, and that the arguments of H's
    /// functions go not far from the start to the first node, from node to node, and to the end, while the time moves by this share of
    /// the step. Of a closure that is not known, and steps from a cold guess, with more sweeps than a few, or whose measure is near its limit, are
    /// not ordinary instead.
    fn ordinary(
        &self,
        attempt: &Attempt<G::Vector, M>,
        end: &G::Vector,
        measure: f64,
        (cold, moves): (bool, f64),
    ) -> Result<(), StepError> {
        let dim = self.mu.dim();
        // Of a drive the linear model knows nothing, and sweeps converge linearly.
        let most = ordinary_sweeps(if D::ACTS { usize::MAX } else { dim });
        within(attempt, f64::from(attempt.sweeps), most)?;
        let time = |at: f64| (moves * at).times_plus(self.step, self.middle);
        let mut last = (time(-0.5), self.mu.clone());
        for node in 0..=M {
            let next = match node {
                node if node < M => {
                    let momentum = G::Vector::at::<M>(dim, &attempt.momenta, node);
                    (time(Self::NODES.times[node]), momentum)
                }
                _ => (time(0.5), end.clone()),
            };
            let Some(square) = self.energy.reach((last.0, &last.1), (next.0, &next.1)) else {
                let long = cold || attempt.sweeps > CLOSURE_SWEEPS;
                return within(attempt, if long { f64::INFINITY } else { measure }, NEAR_LIMIT);
            };
            within(attempt, square, LARGEST_REACH[M - 1])?;
            last = next;
        }
        Ok(())
    }

    /// The highest polynomials through two nodes and more: of the velocity, as a share of it, and of the force, times the
    /// step and relative to the momentum.
    fn tails(&self, attempt: &Attempt<G::Vector, M>) -> [f64; 2] {
        let (dim, rates) = (self.mu.dim(), &attempt.rates);
        let [x, p] = [&rates.x, &rates.p].map(|rows| {
            let part: G::Vector = total(dim, &Self::NODES.highest, rows);
            part.largest_entry()
        });
        let share = |part, whole| if part == 0.0 { 0.0 } else { part / whole };
        let velocity = largest::<G::Vector, M>(dim, &rates.x);
        // Two nodes see the acceleration alone.
        let velocity = if M == 2 { velocity.worse(SLOW) } else { velocity };
        [share(x, velocity), share(p, self.scale(attempt))]
    }

    /// The error of a step with one node, about, which has no polynomial to show it: the product of its velocity, of its
    /// force f relative to the momentum, and of what the force changes: the velocity, by the gain of the equations, and
    /// the momentum, by f. All are times the step, so this is of third order. The gain is that at the first guess as long as
    /// this is far below its limit, else that at the solution.
    fn bend(&self, attempt: &Attempt<G::Vector, M>) -> f64 {
        let size = |rows| largest::<G::Vector, M>(self.mu.dim(), rows);
        let force = size(&attempt.rates.p);
        if force == 0.0 {
            return 0.0;
        }
        let force = force / self.scale(attempt);
        let bend = |gain: f64| force * size(&attempt.rates.x) * (gain + force);
        let about = bend(attempt.gain);
        match about <= NEAR_LIMIT * LARGEST_TAIL[0] {
            true => about,
            false => bend(self.gain(&attempt.x)),
        }
    }

    /// The size of the momentum, or of that with the impulse where it is larger.
    fn scale(&self, attempt: &Attempt<G::Vector, M>) -> f64 {
        self.mu.largest_entry().max(if D::ACTS { attempt.pushed.largest_entry() } else { 0.0 })
    }

    /// The error of a gradient, or of a known expression, that is not finite at a node.
    #[cold]
    fn undefined(
        &self,
        time: f64,
        node: &G::Vector,
        known: Option<Undefined>,
        at: Circumstances,
    ) -> StepError {
        let known = known.or_else(|| self.energy.undefined(time, node));
        let Undefined { expression, argument } = known.unwrap_or(UNKNOWN);
        let at = (node != self.mu).then_some(at);
        StepError::Undefined { expression, argument, time, at }
    }
}

fn circumstances<V: Coordinates<f64>, const M: usize>(attempt: &Attempt<V, M>) -> Circumstances {
    Circumstances { x: attempt.x.largest_entry(), ratio: 0.0, usable_step: None }
}

/// Checks that a measure of an attempt is a number within its limit.
fn within<V: Coordinates<f64>, const M: usize>(
    attempt: &Attempt<V, M>,
    tail: f64,
    limit: f64,
) -> Result<(), StepError> {
    match tail <= limit {
        true => Ok(()),
        false => Err(StepError::Unresolved { tail, limit, at: circumstances(attempt) }),
    }
}
