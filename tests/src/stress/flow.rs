//! Steps by collocation against the flow by another method in steps that follow its error.

use coadjoint::LieGroup;
use coadjoint::groups::MatrixGroup;
use nalgebra::{DMatrix, DVector};

use super::runtime::{Snapshot, Steps, Way};
use super::verdict::{Tally, Wrong};

/// Steps made from each momentum, the later ones from guesses by the earlier ones.
const STEPS: u64 = 4;

/// Steps of one size, and how far, relatively, they may be from the flow.
pub struct Trial<'a> {
    pub steps: &'a dyn Steps,
    /// Steps judged at their nodes alone, as if all arguments went nowhere: a refused step would have been right if theirs is.
    pub still: Option<&'a dyn Steps>,
    pub group: &'a MatrixGroup,
    pub gradient: &'a dyn Fn(&[f64]) -> Vec<f64>,
    pub h: f64,
    pub farthest: f64,
    /// Between which poles or edges of the energy a momentum is.
    pub sides: &'a dyn Fn(&[f64]) -> Vec<f64>,
    pub about: String,
}

fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers
        .into_iter()
        .fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { most.max(x.abs()) })
}

impl Trial<'_> {
    /// Compares each accepted step with the flow.
    pub fn follow(&self, at: &[f64], mu: &[f64], tally: &mut Tally) {
        let mut last = None;
        for number in 1..=STEPS {
            let Some(made) = self.steps.go(Way::Many(number), at, mu) else { return };
            let before = last.unwrap_or_else(|| made.before.clone());
            let example = || format!("{}, h = {}, μ = {:?}", self.about, self.h, before.momentum);
            if made.error.is_some() {
                tally.refused += 1;
                if made.after.text != before.text {
                    tally.note(Wrong::Changed, example);
                }
                let still = self.still.and_then(|still| still.go(Way::One, at, &before.momentum));
                let right = still
                    .filter(|made| made.error.is_none())
                    .and_then(|made| self.share(&before.momentum, &made.after.momentum));
                tally.right += u64::from(right.is_some_and(|share| share <= 1.0));
                return;
            }
            tally.accepted += 1;
            let kept = self.moved(&made.before, &made.after);
            tally.deviation = tally.deviation.max(kept / 1e-12);
            if kept.is_nan() || kept > 1e-12 {
                tally.note(Wrong::State, example);
            }
            match self.share(&before.momentum, &made.after.momentum) {
                None => tally.unsure += 1,
                Some(share) if share > 1.0 => tally.note(Wrong::Branch, || {
                    format!("{:.1e} from the flow: {}", share * self.farthest, example())
                }),
                Some(share) if share > tally.residual => {
                    (tally.residual, tally.worst) = (share, example());
                }
                Some(_) => {}
            }
            last = Some(made.after);
        }
    }

    /// The distance of an end from the flow, as a share of the farthest; `None` where the flow cannot be followed.
    fn share(&self, from: &[f64], to: &[f64]) -> Option<f64> {
        let exact = self.flow(from)?;
        let away = largest(to.iter().zip(&exact).map(|(a, b)| a - b));
        let away = away / largest(from.iter().copied());
        let same = (self.sides)(to) == (self.sides)(exact.as_slice());
        Some(if same { away / self.farthest } else { f64::INFINITY })
    }

    /// The change of the spatial momentum, relative to the sums of magnitudes in which Ad\*_g μ may cancel.
    fn moved(&self, before: &Snapshot, after: &Snapshot) -> f64 {
        let (group, size) = (self.group, self.group.matrix_size());
        let spatial = |state: &Snapshot, mu: &DVector<f64>| {
            let element = DMatrix::from_row_slice(size, size, &state.element);
            group.coadjoint(&element, mu)
        };
        let [old, new] = [before, after]
            .map(|state| spatial(state, &DVector::from_column_slice(&state.momentum)));
        let mut sums = DVector::zeros(group.dim());
        for (j, mu) in after.momentum.iter().enumerate() {
            let mut unit = DVector::zeros(group.dim());
            unit[j] = *mu;
            sums += spatial(after, &unit).abs();
        }
        largest((new - old).iter().copied()) / sums.max()
    }

    /// The momentum after the time h, by the pair of orders 5 and 4 of Dormand and Prince; none where its steps become too short.
    fn flow(&self, start: &[f64]) -> Option<DVector<f64>> {
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
        let slope = |m: &DVector<f64>| {
            let velocity = DVector::from_vec((self.gradient)(m.as_slice()));
            self.group.ad_star(&velocity, m)
        };
        let (size, side) = (largest(start.iter().copied()), (self.sides)(start));
        let (mut m, mut done, mut part) = (DVector::from_column_slice(start), 0.0, 1e-3);
        for _ in 0..60_000 {
            let now = f64::min(part, 1.0 - done);
            let mut k = vec![slope(&m)];
            let sum = |from: DVector<f64>, weights: &[f64], k: &[DVector<f64>]| {
                let terms = weights.iter().zip(k);
                terms.fold(from, |sum, (weight, k)| sum + k * (self.h * now * weight))
            };
            let mut next = m.clone();
            for row in &A[1..] {
                next = sum(m.clone(), row, &k);
                k.push(slope(&next));
            }
            let error = largest(sum(DVector::zeros(m.len()), &E, &k).iter().copied());
            let error = error / (1e-8 * size.max(largest(next.iter().copied())));
            let fits = error <= 1.0 && (self.sides)(next.as_slice()) == side;
            if fits {
                (m, done) = (next, done + now);
                if done >= 1.0 - 1e-14 {
                    return Some(m);
                }
            }
            let factor = if error > 0.0 { 0.9 * error.powf(-0.2) } else { 5.0 };
            part = now * factor.clamp(0.2, if fits { 5.0 } else { 0.5 });
            if part < 1e-11 {
                return None;
            }
        }
        None
    }
}
