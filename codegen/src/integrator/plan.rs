//! Choosing the predictor's degree and the Hessian's truncation.

use crate::hamilton_jacobi::{GeneratingSeries, TermLimit};
use crate::problem::Problem;

/// What surrounds the exact gradient in a step. None of it changes the map, only its cost: the
/// solve goes on until rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The degree in h of the predictor.
    pub predictor_degree: usize,
    /// The Hessian is taken of S₁ … S_k for k up to this.
    pub hessian_truncation: usize,
}

impl Plan {
    /// A plan by operation count.
    #[must_use]
    pub fn choose(problem: &Problem, _series: &GeneratingSeries, _limit: TermLimit) -> Self {
        Self { predictor_degree: (problem.truncation + 1).min(8), hessian_truncation: problem.truncation.min(7) }
    }
}
