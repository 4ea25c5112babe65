//! The equations of a step, and their solution by sweeps that a linear model corrects.

use coadjoint_program::collocation::{LARGEST_MODEL, MAX_SWEEPS, Nodes, ROUNDING, SOLVED, degree};

use super::drive::Drive;
use super::energy::{Energy, Undefined};
use super::rates::{Rates, in_units, mixed, total};
use crate::group::LieGroup;
use crate::group::middle::add;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// The growth of a momentum over that at the start beyond which sweeps have diverged.
const DIVERGED: f64 = 1e30;

/// The equations of one step from (g, μ).
pub(super) struct Equations<'a, G: LieGroup, E, D, const M: usize> {
    pub group: &'a G,
    pub energy: &'a E,
    pub drive: &'a D,
    pub element: &'a G::Element,
    pub mu: &'a G::Vector,
    /// The time in the middle of the step.
    pub middle: f64,
    pub step: f64,
}

/// The rates at which an attempt to solve the equations ended.
pub(super) struct Attempt<V: Coordinates<f64>, const M: usize> {
    pub rates: Rates<V, M>,
    /// The increment of the whole step.
    pub x: V,
    pub sweeps: u32,
    /// The change by the last sweep, relative to the momentum.
    pub residual: f64,
    /// With one node, by how much a change of the momentum in the middle of the first guess changes that which follows from it,
    /// to first order: a sum of rows; 1 where there is no linear model.
    pub gain: f64,
    /// The momenta at the nodes.
    pub momenta: V::Rows<M>,
    /// The momentum at the start, with the impulse of the torque as the start sees it.
    pub pushed: V,
    pub ending: Ending<V>,
}

/// The time and the momentum at which the gradient or the drive is not finite, and the expression of the drive that is not.
type Lost<V> = (f64, V, Option<Undefined>);

/// The outcome of an attempt.
pub(super) enum Ending<V> {
    Solved,
    NotConverged,
    /// The gradient is not finite at this time and momentum, or an expression of the drive is not.
    Undefined(f64, V, Option<Undefined>),
}

/// The Hessian and the momentum in the middle about which changes of rates are linear.
struct Linearisation<'a, V: Coordinates<f64>, const M: usize> {
    hessian: V::Matrix,
    p: V,
    nodes: &'a Nodes<M>,
}

impl<G, E, D, const M: usize> Equations<'_, G, E, D, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
    D: Drive<G>,
{
    pub(super) const NODES: Nodes<M> = Nodes::new();

    /// Solves the equations from a first guess of the rates.
    #[inline(always)]
    pub(super) fn solve(&self, guess: Rates<G::Vector, M>) -> Attempt<G::Vector, M> {
        let dim = self.mu.dim();
        let unit = |i| self.energy.unit(i);
        let scale_with = |impulse: &G::Vector| {
            let largest = in_units(self.mu, unit).max(in_units(impulse, unit));
            if largest > 0.0 { largest } else { 1.0 }
        };
        let mut scale = scale_with(&guess.impulse);
        let whole = |rates: &Rates<G::Vector, M>| {
            let x: G::Vector = total(dim, &Self::NODES.weights, &rates.x);
            let mut p = self.group.dexp_transpose(&x, self.mu);
            if D::ACTS {
                // ½[(d^R exp_{x/2})ᵀ μ + (d^R exp_{−x/2})ᵀ μ″]
                let half = self.group.dexp_transpose(&scaled(&x, 0.5), &rates.impulse);
                p = G::Vector::from_entries(dim, |i| half[i].times_plus(0.5, p[i]));
            }
            (x, p)
        };
        let mut rates = guess;
        let (mut x, mut p) = whole(&rates);
        let model = self.model(&p);
        let mut momenta = G::Vector::zero_rows::<M>(dim);
        let mut pushed = self.mu.clone();
        let (mut sweeps, mut residual, mut before) = (0, f64::INFINITY, f64::INFINITY);
        let ending = loop {
            let mut change = match self.sweep(&rates, (&x, &p), &mut momenta) {
                Ok(next) => next,
                // A momentum this large shows that sweeps diverge, not that the gradient has no value there.
                Err((_, mu, _))
                    if (0..dim).any(|i| !mu[i].all_finite() || mu[i].abs() > DIVERGED * scale) =>
                {
                    break Ending::NotConverged;
                }
                Err((time, mu, known)) => break Ending::Undefined(time, mu, known),
            };
            sweeps += 1;
            if D::ACTS {
                let turned = self.group.exp_transport(&scaled(&x, -0.5), &change.impulse).1;
                pushed = G::Vector::from_entries(dim, |i| self.mu[i] + turned[i]);
                scale = scale_with(&change.impulse);
            }
            change.add(dim, -1.0, &rates);
            residual = change.size(dim, scale, unit);
            if let Some(model) = &model {
                let linear = model.change(self.group, &rates, &change);
                rates.add(dim, 1.0, &linear);
            }
            rates.add(dim, 1.0, &change);
            (x, p) = whole(&rates);
            let shrinks = if sweeps == 1 { 1.0 } else { (residual / before).min(0.5) };
            if residual * shrinks <= SOLVED || residual >= before && residual < ROUNDING {
                break Ending::Solved;
            }
            if sweeps == MAX_SWEEPS || !residual.all_finite() {
                break Ending::NotConverged;
            }
            before = residual;
        };
        let gain = model.filter(|_| M == 1).map_or(1.0, |model| model.gain(self.group));
        Attempt { rates, x, sweeps, residual, gain, momenta, pushed, ending }
    }

    /// [`Attempt::gain`] at the momentum in the middle that belongs to x.
    pub(super) fn gain(&self, x: &G::Vector) -> f64 {
        let model = self.model(&self.group.dexp_transpose(x, self.mu));
        model.map_or(1.0, |model| model.gain(self.group))
    }

    /// The rates that follow from others, with the increment of the step and the momentum in the middle, and the momenta at the nodes.
    ///
    /// # Errors
    /// [`Lost`].
    #[inline(always)]
    fn sweep(
        &self,
        rates: &Rates<G::Vector, M>,
        (whole, p): (&G::Vector, &G::Vector),
        mu: &mut <G::Vector as Coordinates<f64>>::Rows<M>,
    ) -> Result<Rates<G::Vector, M>, Lost<G::Vector>> {
        let (nodes, degree, dim) = (&Self::NODES, degree(M), p.dim());
        let x = mixed(&G::Vector::zeros(dim), &nodes.matrix, &rates.x);
        let p = mixed(p, &nodes.matrix, &rates.p);
        *mu = self.group.node_momenta::<M>(&x, &p, degree);
        let mut omega = G::Vector::zero_rows::<M>(dim);
        let mut poison = [0.0; M];
        for i in 0..M {
            let time = nodes.times[i].times_plus(self.step, self.middle);
            let gradient = self.energy.gradient(time, &G::Vector::at::<M>(dim, mu, i));
            for k in 0..dim {
                omega[k][i] = gradient[k] * self.step;
            }
        }
        for k in 0..dim {
            for i in 0..M {
                poison[i] = omega[k][i].times_plus(0.0, poison[i]);
            }
        }
        for i in 0..M {
            if poison[i] != 0.0 {
                let time = nodes.times[i].times_plus(self.step, self.middle);
                return Err((time, G::Vector::at::<M>(dim, mu, i), None));
            }
        }
        let mut impulse = G::Vector::zeros(dim);
        let mut forces = G::Vector::zero_rows::<M>(if D::ACTS { dim } else { 0 });
        if D::ACTS {
            let middle = self.group.compose(self.element, &self.group.exp(&scaled(whole, 0.5)));
            for i in 0..M {
                let time = nodes.times[i].times_plus(self.step, self.middle);
                let place = G::Vector::at::<M>(dim, &x, i);
                let back = scaled(&place, -1.0);
                let g = self.group.compose(&middle, &self.group.exp(&place));
                let momentum = G::Vector::at::<M>(dim, mu, i);
                let own = scaled(&G::Vector::at::<M>(dim, &omega, i), 1.0 / self.step);
                let [velocity, torque] = self.drive.acting(time, &g, &momentum, &own);
                if (0..dim).any(|k| !velocity[k].all_finite() || !torque[k].all_finite()) {
                    let known = self.drive.undefined(time, &g, &momentum, &own);
                    return Err((time, momentum, known.or(Some(super::energy::UNKNOWN_DRIVE))));
                }
                let torque = scaled(&torque, self.step);
                let force = self.group.dexp_transpose(&back, &torque);
                let turned = self.group.exp_transport(&back, &torque).1;
                for k in 0..dim {
                    omega[k][i] = velocity[k].times_plus(self.step, omega[k][i]);
                    forces[k][i] = force[k];
                    impulse[k] = nodes.weights[i].times_plus(turned[k], impulse[k]);
                }
            }
        }
        let [x, mut p] = self.group.node_rates::<M>(&x, &p, &omega, degree);
        if D::ACTS {
            add::<f64, G::Vector, M>(dim, &mut p, 1.0, &forces);
        }
        Ok(Rates { x, p, impulse })
    }

    /// The linear model about the momentum `p`, where its Hessian is finite and not too large.
    #[inline(always)]
    fn model(&self, p: &G::Vector) -> Option<Linearisation<'static, G::Vector, M>> {
        let dim = p.dim();
        if dim > LARGEST_MODEL {
            return None;
        }
        let mut hessian = self.energy.hessian(self.middle, p);
        let mut poison = 0.0;
        for i in 0..dim {
            for j in 0..dim {
                hessian[(i, j)] *= self.step;
                poison = hessian[(i, j)].times_plus(0.0, poison);
            }
        }
        (poison == 0.0).then(|| Linearisation { hessian, p: p.clone(), nodes: &Self::NODES })
    }
}

impl<V: Coordinates<f64>, const M: usize> Linearisation<'_, V, M> {
    /// The largest sum of a row of h·H″·∂P/∂x, where P = μ + ½ad\*_x μ to first order.
    fn gain<G: LieGroup<Scalar = f64, Vector = V>>(&self, group: &G) -> f64 {
        let dim = self.p.dim();
        let mut rows = V::zeros(dim);
        for j in 0..dim {
            let turned = group.ad_star(&V::unit(dim, j), &self.p);
            for i in 0..dim {
                let entry: f64 = (0..dim).map(|k| self.hessian[(i, k)] * turned[k]).sum();
                rows[i] += 0.5 * entry.abs();
            }
        }
        rows.largest_entry()
    }

    /// The change of the rates in the next sweep that follows from this one, to first order in it and in the step.
    #[inline(always)]
    fn change<G>(&self, group: &G, rates: &Rates<V, M>, change: &Rates<V, M>) -> Rates<V, M>
    where
        G: LieGroup<Scalar = f64, Vector = V>,
    {
        let dim = self.p.dim();
        let x: V = total(dim, &self.nodes.weights, &change.x);
        let turned = group.ad_star(&x, &self.p);
        let middle = V::from_entries(dim, |k| 0.5 * turned[k]);
        let here = V::by_node::<M>(dim, |_| self.p.clone());
        let x = mixed(&V::zeros(dim), &self.nodes.matrix, &change.x);
        let p = mixed(&middle, &self.nodes.matrix, &change.p);
        let mut mu = p.clone();
        add::<f64, V, M>(dim, &mut mu, 0.5, &group.ad_stars::<M>(&x, &here));
        let mut velocity = V::zero_rows::<M>(dim);
        for k in 0..dim {
            let mut sum = [0.0; M];
            for l in 0..dim {
                for i in 0..M {
                    sum[i] = self.hessian[(k, l)].times_plus(mu[l][i], sum[i]);
                }
            }
            velocity[k] = sum;
        }
        let mut force = V::zero_rows::<M>(dim);
        add::<f64, V, M>(dim, &mut force, 0.5, &group.ad_stars::<M>(&velocity, &here));
        add::<f64, V, M>(dim, &mut force, 0.5, &group.ad_stars::<M>(&rates.x, &p));
        add::<f64, V, M>(dim, &mut velocity, 0.5, &group.brackets::<M>(&x, &rates.x));
        Rates { x: velocity, p: force, impulse: V::zeros(dim) }
    }
}

/// s·v
#[inline(always)]
fn scaled<V: Coordinates<f64>>(v: &V, s: f64) -> V {
    V::from_entries(v.dim(), |i| s * v[i])
}
