//! Steps that are not ordinary, followed between their nodes, and compared with two of half the size.

use coadjoint_program::collocation::{LARGEST_REACH, NEAR_LIMIT, degree};

use super::Collocation;
use super::energy::Energy;
use super::rates::{Rates, total};
use super::solving::{Attempt, Ending, Equations};
use crate::error::{Circumstances, StepError};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// Parts of a step that are looked at at least: where H is a closure, which says nothing of its reach, many.
const PARTS: [usize; 2] = [16, 64];

/// Halves of a part over which the functions of H vary too much.
const HALVINGS: u32 = 8;

/// The largest square of a reach of a part.
const FINE: f64 = 0.25;

/// Points that are looked at at most.
const MOST: u32 = 4096;

/// The largest defect of a rate: h times what the velocity at a point differs from that of the polynomial through the nodes, and
/// h times what the force does, relative to the momentum.
const LARGEST_DEFECT: f64 = 0.5;

/// The largest integral of a defect from the beginning of the step on, by the number of nodes.
const LARGEST_INTEGRAL: [f64; 8] = [0.1, 0.1, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2];

/// The largest difference of the momenta after the step and after two of half the size, relative to the momentum.
const LARGEST_DIFFERENCE: f64 = 0.15;

/// Sweeps that steps of a closure take at most where they are ordinary.
const ORDINARY_SWEEPS: u32 = 14;

/// A point of a step, and the defects of its rates there.
struct Point<V> {
    /// From the middle, in step sizes.
    at: f64,
    momentum: V,
    x: V,
    p: V,
}

/// The reason if a step is not followed.
enum Lost<V> {
    /// This measure exceeds this limit.
    Measured(f64, f64),
    /// The gradient is not finite at this time and momentum.
    Undefined(f64, V),
}

/// The integrals of the defects so far, and how many points have been looked at.
struct Course<V> {
    x: V,
    p: V,
    points: u32,
}

impl<G, E, const M: usize> Collocation<G, E, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    /// True for a solved step that may be wrong although its nodes do not show it: where the arguments of
    /// H's functions go far from node to node. Of a closure that is not known, and steps without a step before them, or that took
    /// many sweeps, or whose `measure`, as a share of its limit, is near it, count instead.
    pub(super) fn is_unusual(
        &self,
        mu: &G::Vector,
        middle: f64,
        attempt: &Attempt<G::Vector, M>,
        measure: f64,
    ) -> bool {
        let dim = mu.dim();
        let nodes = &Self::NODES;
        let limit = LARGEST_REACH[M - 1];
        let start = self.step().times_plus(-0.5, middle);
        let mut last = (start, mu.clone());
        let mut unusual = false;
        for node in 0..=M {
            let next = match node == M {
                // The polynomial through the start and the nodes, at the end.
                true => {
                    let ahead: G::Vector = total(dim, &nodes.ahead, &attempt.momenta);
                    let sign = if M.is_multiple_of(2) { 1.0 } else { -1.0 };
                    let end = G::Vector::from_entries(dim, |i| mu[i].times_plus(sign, ahead[i]));
                    (self.step().times_plus(0.5, middle), end)
                }
                false => {
                    let time = nodes.times[node].times_plus(self.step(), middle);
                    (time, G::Vector::at::<M>(dim, &attempt.momenta, node))
                }
            };
            match self.energy().reach((last.0, &last.1), (next.0, &next.1)) {
                Some(square) => unusual |= square.is_nan() || square > limit,
                None => {
                    let cold = self.noted == 0;
                    return cold || attempt.sweeps > ORDINARY_SWEEPS || measure > NEAR_LIMIT;
                }
            }
            last = next;
        }
        unusual
    }

    /// Follows a solved step: between its nodes the polynomial through them has to solve the equations of motion too, however finely
    /// one has to look so that the functions of H vary little from point to point; and two steps of half the size have to lead to
    /// the same momentum.
    ///
    /// # Errors
    /// The first measure that is too large, or a gradient that is not finite.
    #[cold]
    pub(super) fn follow(
        &self,
        mu: &G::Vector,
        middle: f64,
        attempt: &Attempt<G::Vector, M>,
        at: Circumstances,
    ) -> Result<(), StepError> {
        self.followed(mu, middle, attempt).map_err(|lost| match lost {
            Lost::Measured(tail, limit) => StepError::Unresolved { tail, limit, at },
            Lost::Undefined(time, node) => self.undefined(mu, time, &node, at),
        })
    }

    fn followed(
        &self,
        mu: &G::Vector,
        middle: f64,
        attempt: &Attempt<G::Vector, M>,
    ) -> Result<(), Lost<G::Vector>> {
        let dim = mu.dim();
        let p = self.group().dexp_transpose(&attempt.x, mu);
        let point = |at| self.point(mu, middle, &p, attempt, at);
        let mut last = point(-0.5)?;
        let known = self.energy().reach((middle, mu), (middle, mu)).is_some();
        let parts = PARTS[usize::from(!known)];
        let mut course = Course { x: G::Vector::zeros(dim), p: G::Vector::zeros(dim), points: 1 };
        for part in 1..=parts {
            let next = point(part as f64 / parts as f64 - 0.5)?;
            self.pass(middle, &point, (&last, &next), HALVINGS, &mut course)?;
            last = next;
        }
        // The end itself, from which the polynomials are a little away.
        let (_, end) = self.group().exp_transport(&attempt.x, mu);
        let time = self.step().times_plus(0.5, middle);
        let omega = self.energy().gradient(time, &end);
        if (0..dim).any(|i| !omega[i].all_finite()) {
            return Err(Lost::Undefined(time, end));
        }
        if let Some(square) = self.energy().reach((time, &last.momentum), (time, &end)) {
            within(square, LARGEST_REACH[M - 1])?;
        }
        let mut half = mu.clone();
        for part in [-0.25, 0.25] {
            let step = 0.5 * self.step();
            let middle = part.times_plus(self.step(), middle);
            let (group, energy) = (self.group(), self.energy());
            let equations = Equations { group, energy, mu: &half, middle, step };
            let Attempt { x, ending, residual, .. } = equations.solve(Rates::<_, M>::zero(dim));
            match ending {
                Ending::Solved => {}
                Ending::NotConverged => return Err(Lost::Measured(residual, LARGEST_DIFFERENCE)),
                Ending::Undefined(time, mu) => return Err(Lost::Undefined(time, mu)),
            }
            half = self.group().exp_transport(&x, &half).1;
        }
        within(end.minus(&half).largest_entry() / scale(mu), LARGEST_DIFFERENCE)
    }

    /// Goes on from one point to another, by halves where the functions of H vary much between them.
    fn pass<F>(
        &self,
        middle: f64,
        point: &F,
        (from, to): (&Point<G::Vector>, &Point<G::Vector>),
        halvings: u32,
        course: &mut Course<G::Vector>,
    ) -> Result<(), Lost<G::Vector>>
    where
        F: Fn(f64) -> Result<Point<G::Vector>, Lost<G::Vector>>,
    {
        let time = |point: &Point<G::Vector>| point.at.times_plus(self.step(), middle);
        let reach = self.energy().reach((time(from), &from.momentum), (time(to), &to.momentum));
        if halvings > 0 && reach.is_some_and(|square| square.is_nan() || square > FINE) {
            course.points += 1;
            if course.points > MOST {
                return Err(Lost::Measured(f64::INFINITY, LARGEST_DEFECT));
            }
            let between = point(0.5 * (from.at + to.at))?;
            self.pass(middle, point, (from, &between), halvings - 1, course)?;
            return self.pass(middle, point, (&between, to), halvings - 1, course);
        }
        let weight = 0.5 * (to.at - from.at);
        let add = |sum: &G::Vector, a: &G::Vector, b: &G::Vector| {
            G::Vector::from_entries(sum.dim(), |i| (a[i] + b[i]).times_plus(weight, sum[i]))
        };
        course.x = add(&course.x, &from.x, &to.x);
        course.p = add(&course.p, &from.p, &to.p);
        let limit = LARGEST_INTEGRAL[M - 1];
        within(course.x.largest_entry(), limit)?;
        within(course.p.largest_entry(), limit)
    }

    /// The momentum on the polynomials at a time, and the defects of the rates there.
    ///
    /// # Errors
    /// The gradient is not finite, or a defect is too large.
    fn point(
        &self,
        mu: &G::Vector,
        middle: f64,
        p: &G::Vector,
        attempt: &Attempt<G::Vector, M>,
        at: f64,
    ) -> Result<Point<G::Vector>, Lost<G::Vector>> {
        let (dim, degree) = (mu.dim(), degree(M));
        let [values, integrals] = Self::NODES.at(at);
        let [rate, force] = [&attempt.rates.x, &attempt.rates.p]
            .map(|rows| total::<G::Vector, M>(dim, &values, rows));
        let [x, moved] = [&attempt.rates.x, &attempt.rates.p]
            .map(|rows| total::<G::Vector, M>(dim, &integrals, rows));
        let one = |vector: G::Vector| G::Vector::by_node::<1>(dim, |_| vector.clone());
        let p = G::Vector::from_entries(dim, |i| p[i] + moved[i]);
        let (x, p) = (one(x), one(p));
        let momenta = self.group().node_momenta::<1>(&x, &p, degree);
        let momentum = G::Vector::at::<1>(dim, &momenta, 0);
        let time = at.times_plus(self.step(), middle);
        let omega = self.energy().gradient(time, &momentum);
        if (0..dim).any(|i| !omega[i].all_finite()) {
            return Err(Lost::Undefined(time, momentum));
        }
        let omega = one(G::Vector::from_entries(dim, |i| omega[i] * self.step()));
        let [x, p] = self.group().node_rates::<1>(&x, &p, &omega, degree);
        let x = G::Vector::from_entries(dim, |i| x[i][0] - rate[i]);
        let scale = scale(mu);
        let p = G::Vector::from_entries(dim, |i| (p[i][0] - force[i]) / scale);
        within(x.largest_entry(), LARGEST_DEFECT)?;
        within(p.largest_entry(), LARGEST_DEFECT)?;
        Ok(Point { at, momentum, x, p })
    }
}

/// The largest coordinate of a momentum, to which others are relative; 1 where it is 0.
fn scale<V: Coordinates<f64>>(mu: &V) -> f64 {
    let size = mu.largest_entry();
    if size > 0.0 { size } else { 1.0 }
}

/// # Errors
/// A measure exceeds its limit, or is not a number.
fn within<V>(measure: f64, limit: f64) -> Result<(), Lost<V>> {
    if measure <= limit { Ok(()) } else { Err(Lost::Measured(measure, limit)) }
}
