//! Steps by collocation against the flow by another method in steps that follow its error.

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::Coordinates;
use coadjoint::{LieGroup, Phase};

use super::verdict::{Tally, Wrong};

/// Systems and momenta drawn of one seed.
pub const DRAWS: usize = 32;
/// Steps made from each, the later ones from guesses by the earlier ones.
const STEPS: usize = 4;

/// Makes the steps of a trajectory, whose group element it keeps.
pub trait Mover<V> {
    /// Whether the step from this momentum is accepted.
    fn advance(&mut self, mu: &mut V) -> bool;

    /// Ad\*_g μ
    fn spatial(&self, mu: &V) -> V;
}

/// The runtime's steps.
pub struct Generic<G: LieGroup<Scalar = f64>, E: Energy<G::Vector>, const M: usize> {
    pub group: G,
    pub step: Collocation<G, E, M>,
    pub element: G::Element,
}

impl<G, E, const M: usize> Mover<G::Vector> for Generic<G, E, M>
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    fn advance(&mut self, mu: &mut G::Vector) -> bool {
        let mut state = Phase::<G>::new(self.element.clone(), mu.clone());
        let made = self.step.advance(&mut state, 0.0).is_ok();
        (self.element, *mu) = (state.group_element, state.momentum);
        made
    }

    fn spatial(&self, mu: &G::Vector) -> G::Vector {
        self.group.coadjoint(&self.element, mu)
    }
}

/// The largest sum of magnitudes in a coordinate of Ad\*_g μ, in which they may cancel.
fn summands<V: Coordinates<f64>>(mover: &dyn Mover<V>, mu: &V) -> f64 {
    let n = mu.dim();
    let mut sums = vec![0.0; n];
    for j in 0..n {
        let column = mover.spatial(&V::unit(n, j));
        for i in 0..n {
            sums[i] += (column[i] * mu[j]).abs();
        }
    }
    sums.into_iter().fold(0.0, f64::max)
}

/// Steps of one size from a momentum, and how far, relatively, they may be from the flow.
pub struct Trial<'a, G: LieGroup<Scalar = f64>, E> {
    pub group: &'a G,
    pub energy: &'a E,
    pub h: f64,
    pub farthest: f64,
    /// Between which poles or edges of the energy a momentum is.
    pub sides: &'a dyn Fn(&G::Vector) -> Vec<f64>,
    pub about: String,
}

impl<G: LieGroup<Scalar = f64>, E: Energy<G::Vector>> Trial<'_, G, E> {
    /// How far an end is from the flow, as a share of the farthest; `None` where the flow cannot be followed.
    pub fn share(&self, from: &G::Vector, to: &G::Vector) -> Option<f64> {
        let exact = flow(self, from)?;
        let away = to.clone().minus(&exact).largest_entry() / from.largest_entry();
        let same = (self.sides)(to) == (self.sides)(&exact);
        Some(if same { away / self.farthest } else { f64::INFINITY })
    }

    /// Compares each accepted step with the flow; of a refused one `right` tells whether it would have been right.
    pub fn follow(
        &self,
        mover: &mut dyn Mover<G::Vector>,
        mut mu: G::Vector,
        right: impl Fn(&G::Vector) -> bool,
        tally: &mut Tally,
    ) {
        let far = |a: &G::Vector, b: &G::Vector| a.clone().minus(b).largest_entry();
        let spatial = mover.spatial(&mu);
        for _ in 0..STEPS {
            let before = mu.clone();
            let example = || format!("{}, h = {}, μ = {before:?}", self.about, self.h);
            if !mover.advance(&mut mu) {
                tally.refused += 1;
                if far(&mu, &before) != 0.0 {
                    tally.note(Wrong::Changed, example);
                }
                tally.right += u64::from(right(&before));
                break;
            }
            tally.accepted += 1;
            let kept = far(&mover.spatial(&mu), &spatial) / summands(mover, &mu);
            tally.deviation = tally.deviation.max(kept / 1e-12);
            if kept.is_nan() || kept > 1e-12 {
                tally.note(Wrong::State, example);
            }
            let Some(share) = self.share(&before, &mu) else {
                tally.unsure += 1;
                continue;
            };
            if share.is_nan() || share > 1.0 {
                tally.note(Wrong::Branch, || {
                    format!("{:.1e} from the flow: {}", share * self.farthest, example())
                });
            } else if share > tally.residual {
                (tally.residual, tally.worst) = (share, example());
            }
        }
    }
}

/// The momentum after the time h, by the pair of orders 5 and 4 of Dormand and Prince; none where its steps become too short.
fn flow<G: LieGroup<Scalar = f64>>(
    Trial { group, energy, h, sides, .. }: &Trial<'_, G, impl Energy<G::Vector>>,
    start: &G::Vector,
) -> Option<G::Vector> {
    const A: [&[f64]; 7] = [
        &[],
        &[1.0 / 5.0],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
        &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ];
    const E: [f64; 7] = [
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ];
    let n = group.dim();
    let slope = |m: &G::Vector| group.ad_star(&energy.gradient(0.0, m), m);
    let size = start.largest_entry();
    let side = sides(start);
    let (mut m, mut done, mut part) = (start.clone(), 0.0, 1e-3);
    for _ in 0..60_000 {
        let part_now = f64::min(part, 1.0 - done);
        let mut k: Vec<G::Vector> = vec![slope(&m)];
        let mut next = m.clone();
        for row in &A[1..] {
            next = G::Vector::from_entries(n, |i| {
                m[i] + h * part_now * row.iter().zip(&k).map(|(a, k)| a * k[i]).sum::<f64>()
            });
            k.push(slope(&next));
        }
        let error = (0..n)
            .map(|i| h * part_now * E.iter().zip(&k).map(|(e, k)| e * k[i]).sum::<f64>())
            .fold(0.0, |worst: f64, e| if e.is_nan() { f64::INFINITY } else { worst.max(e.abs()) });
        let error = error / (1e-8 * size.max(next.largest_entry()));
        let fits = error <= 1.0 && sides(&next) == side;
        if fits {
            (m, done) = (next, done + part_now);
            if done >= 1.0 - 1e-14 {
                return Some(m);
            }
        }
        let factor = if error > 0.0 { 0.9 * error.powf(-0.2) } else { 5.0 };
        part = part_now * factor.clamp(0.2, if fits { 5.0 } else { 0.5 });
        if part < 1e-11 {
            return None;
        }
    }
    None
}
