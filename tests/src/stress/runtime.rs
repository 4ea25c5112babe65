//! The only place where the stress program touches the runtime: steps of any type behind one trait.

use coadjoint::generating::{PolynomialFunction, ScalarOf, VectorOf};
use coadjoint::groups::{Chart, Coordinates};
use coadjoint::lanes::{Lanes, ensemble};
use coadjoint::solve::{Integrator, solve};
use coadjoint::steps::{advance, advance_by};
use coadjoint::{GeneratingFunction, LieGroup, Phase, Scalar};

pub use crate::matrix_free::MatrixFree;
pub use coadjoint::groups::{Cayley, Exponential, Heisenberg, Power, SE2, SU2, SU3};
pub use coadjoint::{SE3, SO3};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    One,
    /// `advance_by`, this many steps.
    Many(u64),
}

impl Way {
    pub fn steps(self) -> u64 {
        match self {
            Self::One => 1,
            Self::Many(steps) => steps,
        }
    }
}

/// A state as numbers: the group element's matrix, row by row, and the momentum.
#[derive(Clone, Debug)]
pub struct Snapshot {
    pub element: Vec<f64>,
    pub momentum: Vec<f64>,
    /// Everything the runtime's own state holds, as text that tells every bit of finite numbers.
    pub text: String,
}

impl Snapshot {
    pub fn is_finite(&self) -> bool {
        self.element.iter().chain(&self.momentum).all(|v| v.is_finite())
    }
}

#[derive(Clone, Debug)]
pub struct Transition {
    pub before: Snapshot,
    /// The state after, whatever came.
    pub after: Snapshot,
    pub error: Option<String>,
}

/// Steps of one system and one size, by whatever makes them.
pub trait Steps {
    /// Steps from (exp(at), μ); `None` where these groups have no such steps.
    fn go(&self, way: Way, at: &[f64], mu: &[f64]) -> Option<Transition>;

    /// The x of a step, where it has one that a judge of series knows.
    fn solve(&self, _: &[f64]) -> Result<Vec<f64>, String> {
        Err("no series".to_owned())
    }

    /// The same steps of several states at once, in lanes; `None` where there are none.
    fn together(&self, _: &[(Vec<f64>, Vec<f64>)], _: u64) -> Option<Vec<Transition>> {
        None
    }

    /// The unit roundoff of the scalar.
    fn unit(&self) -> f64 {
        0.5 * f64::EPSILON
    }

    /// μ as the scalar holds it.
    fn rounded(&self, mu: &[f64]) -> Vec<f64> {
        mu.to_vec()
    }
}

/// The state (exp(at), μ).
pub fn phase<G: LieGroup>(group: &G, at: &[f64], mu: &[f64]) -> Phase<G> {
    let of = |v: &[f64]| G::Vector::from_entries(v.len(), |i| G::Scalar::of(v[i]));
    Phase::new(group.exp(&of(at)), of(mu))
}

pub fn snapshot<G: LieGroup>(group: &G, phase: &Phase<G>) -> Snapshot {
    let size = group.matrix_size();
    let element = (0..size * size)
        .map(|at| group.matrix_entry(&phase.group_element, at / size, at % size).largest_lane());
    let (element, momentum) = (element.collect(), entries(&phase.momentum));
    Snapshot { element, momentum, text: format!("{phase:?}") }
}

type PhaseOf<S> = Phase<<S as GeneratingFunction>::Group>;
type Together<S> = fn(&S, &mut [PhaseOf<S>], u64) -> Vec<(usize, String)>;

/// A generating function with what its group can do.
pub struct Runner<S: Integrator> {
    steps: S,
    together: Option<Together<S>>,
}

impl<S: Integrator> Runner<S> {
    /// With `advance` and `advance_by`.
    pub fn new(steps: S) -> Self {
        Self { steps, together: None }
    }

    /// And with `ensemble::advance_all`.
    pub fn in_lanes(mut self) -> Self
    where
        S: Lanes + Sync,
        Phase<S::Group>: Send,
    {
        self.together = Some(|steps, states, count| {
            let failures = ensemble::advance_all(steps, states, count);
            failures.into_iter().map(|f| (f.index, f.error.to_string())).collect()
        });
        self
    }

    fn vector(&self, v: &[f64]) -> VectorOf<S> {
        VectorOf::<S>::from_entries(v.len(), |i| ScalarOf::<S>::of(v[i]))
    }
}

fn entries<T: Scalar, V: Coordinates<T>>(v: &V) -> Vec<f64> {
    (0..v.dim()).map(|i| v[i].largest_lane()).collect()
}

impl<S: Integrator> Steps for Runner<S> {
    fn solve(&self, mu: &[f64]) -> Result<Vec<f64>, String> {
        match solve(&self.steps, &self.vector(mu)) {
            Ok(solution) => Ok(entries(&solution.x)),
            Err(error) => Err(error.to_string()),
        }
    }

    fn go(&self, way: Way, at: &[f64], mu: &[f64]) -> Option<Transition> {
        let mut phase = phase(self.steps.group(), at, mu);
        let before = snapshot(self.steps.group(), &phase);
        let result = match way {
            Way::One => advance(&self.steps, &mut phase).map(drop),
            Way::Many(steps) => advance_by(&self.steps, &mut phase, steps)
                .map(drop)
                .map_err(|stopped| stopped.error),
        };
        let error = result.err().map(|error| error.to_string());
        Some(Transition { before, after: snapshot(self.steps.group(), &phase), error })
    }

    fn together(&self, starts: &[(Vec<f64>, Vec<f64>)], steps: u64) -> Option<Vec<Transition>> {
        let run = self.together?;
        let mut phases: Vec<_> =
            starts.iter().map(|(at, mu)| phase(self.steps.group(), at, mu)).collect();
        let before: Vec<_> =
            phases.iter().map(|phase| snapshot(self.steps.group(), phase)).collect();
        let failures = run(&self.steps, &mut phases, steps);
        let outcomes =
            before.into_iter().zip(&phases).enumerate().map(|(index, (before, phase))| {
                let error = failures.iter().find(|f| f.0 == index).map(|f| f.1.clone());
                Transition { before, after: snapshot(self.steps.group(), phase), error }
            });
        Some(outcomes.collect())
    }

    fn unit(&self) -> f64 {
        0.5 * ScalarOf::<S>::epsilon().largest_lane()
    }

    fn rounded(&self, mu: &[f64]) -> Vec<f64> {
        entries(&self.vector(mu))
    }
}

/// S given by terms (order, c, \[(coordinate, power), …\]).
pub type Terms = Vec<(usize, f64, Vec<(usize, u32)>)>;

/// The polynomial as a generating function.
pub fn polynomial<G: LieGroup, C: Chart<G>>(
    group: G,
    chart: C,
    terms: Terms,
) -> PolynomialFunction<G, C> {
    PolynomialFunction::of_series(group, chart, terms).expect("terms of the group's dimension")
}
