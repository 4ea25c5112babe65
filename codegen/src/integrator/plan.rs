//! Choosing the predictor's degree and the Hessian's truncation.

use std::collections::BTreeSet;

use crate::hamilton_jacobi::{DeriveError, TermLimit, predictor};
use crate::poly::Polynomial;
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
    /// The plan with which one Newton step reaches rounding for h|Ω| up to about one.
    ///
    /// Measured on the free body: degree 8 for K = 7, 10 for K = 11 and 13, 12 for K = 17; a
    /// Hessian truncated one order below the predictor leaves no more than the predictor's error
    /// times itself.
    #[must_use]
    pub fn single_newton_step(truncation: usize) -> Self {
        let even = (4 + truncation / 2).div_ceil(2) * 2;
        let predictor_degree = even.min(truncation + 1);
        Self { predictor_degree, hessian_truncation: truncation.min(predictor_degree - 1) }
    }

    /// Newton steps needed with a predictor of `degree` instead, each doubling the digits.
    fn newton_steps(self, degree: usize) -> usize {
        let mut reached = degree + 1;
        let mut steps = 1;
        while reached < self.predictor_degree + 1 {
            reached *= 2;
            steps += 1;
        }
        steps
    }

    /// Lowers the predictor's degree to where predictor and Newton steps together take fewest
    /// operations, and returns the predictor: `[order in h][component]`.
    ///
    /// `newton_operations` is what one evaluation of gradient and Hessian takes.
    ///
    /// # Errors
    /// [`DeriveError`] if not even the constant predictor can be derived.
    pub fn with_predictor(
        self,
        problem: &Problem,
        newton_operations: usize,
        limit: TermLimit,
    ) -> Result<(Self, Vec<Vec<Polynomial>>), DeriveError> {
        let n = problem.algebra.dim();
        // Chart, Jacobian 1 − D·Hess S, and elimination.
        let newton = newton_operations + 2 * n.pow(3) + 2 * n.pow(3) / 3 + 10 * n * n;
        let derive = |degree| {
            predictor(&problem.algebra, problem.chart, &problem.hamiltonian, degree, limit)
        };
        let mut best = derive(0)?;
        let mut best_degree = 0;
        let mut best_cost = self.newton_steps(0) * newton;
        for degree in (2..=self.predictor_degree).step_by(2) {
            let candidate = match derive(degree) {
                Ok(candidate) => candidate,
                Err(DeriveError::TooLarge { .. } | DeriveError::TooMuchWork { .. }) => break,
                Err(error) => return Err(error),
            };
            let own = operations(&candidate, n);
            let cost = own + self.newton_steps(degree) * newton;
            if cost < best_cost {
                (best, best_degree, best_cost) = (candidate, degree, cost);
            } else if own > best_cost {
                break;
            }
        }
        Ok((Self { predictor_degree: best_degree, ..self }, best))
    }
}

/// About two operations for each monomial of each component.
fn operations(predictor: &[Vec<Polynomial>], dim: usize) -> usize {
    let monomials = |component: usize| {
        let orders = predictor.iter().filter_map(|order| order.get(component));
        let exponents = orders.flat_map(Polynomial::terms).map(|(exponents, _)| {
            let mut momenta = exponents;
            momenta.truncate(dim);
            momenta
        });
        exponents.collect::<BTreeSet<_>>().len()
    };
    2 * (0..dim).map(monomials).sum::<usize>()
}
