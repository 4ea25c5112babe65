//! First guesses for several steps to come, and the fine gradients there, taken at once.

use super::lagged::{LOOK_AHEAD, LaggedModel, Start};
use crate::chart::Chart;
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// First guesses for the next steps, each made at the end to which the one before leads, and the fine gradients there,
/// which are taken at once: in the lanes of one number they cost little more than one.
#[derive(Clone, Debug)]
pub(super) struct LookAhead<V, T> {
    /// x and p of each step.
    guesses: [(V, V); LOOK_AHEAD],
    fine: [V; LOOK_AHEAD],
    /// [`Start::slope`].
    slope: Option<T>,
    /// The next guess; all are used up where there is none.
    next: usize,
}

impl<V: Coordinates<T>, T: Scalar> LookAhead<V, T> {
    /// No guesses yet; `None` where steps do not go by such.
    #[inline(always)]
    pub fn new<S>(generating: &S) -> Option<Self>
    where
        S: LaggedModel + ?Sized,
        S::Group: LieGroup<Vector = V, Scalar = T>,
    {
        let zero = V::zeros(generating.group().dim());
        let ahead = generating.predict_increment(&zero).is_some();
        ahead.then(|| Self {
            guesses: core::array::from_fn(|_| (zero.clone(), zero.clone())),
            fine: core::array::from_fn(|_| zero.clone()),
            slope: None,
            next: LOOK_AHEAD,
        })
    }

    /// Where the solve of the next step starts, from `mu`, with so many steps to go.
    #[inline(always)]
    pub fn next<S>(&mut self, generating: &S, mu: &V, steps: u64) -> Start<V, T>
    where
        S: LaggedModel + ?Sized,
        S::Group: LieGroup<Vector = V, Scalar = T>,
    {
        if self.next == LOOK_AHEAD {
            self.look(generating, mu, steps.min(LOOK_AHEAD as u64) as usize);
            self.next = 0;
        }
        // Where the guess was made is known to be `mu` for the first only; the others were made beside it.
        let settled = self.next == 0;
        let (x, p) = self.guesses[self.next].clone();
        let fine = self.fine[self.next].clone();
        self.next += 1;
        Start { p, x: Some(x), settled, fine, slope: self.slope }
    }

    /// Forgets the guesses: what comes next does not follow from the steps so far.
    pub fn forget(&mut self) {
        self.next = LOOK_AHEAD;
    }

    /// Guesses for so many steps from `mu`.
    #[inline(always)]
    fn look<S>(&mut self, generating: &S, mu: &V, steps: usize)
    where
        S: LaggedModel + ?Sized,
        S::Group: LieGroup<Vector = V, Scalar = T>,
    {
        let (group, chart) = (generating.group(), S::Chart::default());
        let mut mu = mu.clone();
        for k in 0..LOOK_AHEAD {
            if k < steps {
                // There is one, or there would be no looking ahead.
                let x = generating.predict_increment(&mu).unwrap_or_else(|| V::zeros(mu.dim()));
                let p = chart.pull_back(group, &x, &mu);
                mu = chart.transport(group, &x, &mu).1;
                self.guesses[k] = (x, p);
            } else {
                self.guesses[k] = self.guesses[k - 1].clone();
            }
        }
        let points: [V; LOOK_AHEAD] = core::array::from_fn(|k| self.guesses[k].1.clone());
        self.fine = generating.fine_gradients(&points);
        let least = T::of(f64::from(f32::MIN_POSITIVE));
        let slopes = (1..steps).map(|k| {
            let moved = points[k].clone().minus(&points[k - 1]).largest_entry();
            let change = self.fine[k].clone().minus(&self.fine[k - 1]).largest_entry();
            change / (moved + least)
        });
        // One step alone tells nothing; then it is what it was before.
        self.slope = slopes.reduce(T::simd_max).or(self.slope);
    }
}
