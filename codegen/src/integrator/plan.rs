//! Choosing the predictor's degree and the Hessian's truncation.

use std::collections::BTreeSet;

use super::terms::BaseTerm;
use crate::hamilton_jacobi::{DeriveError, TermLimit, predictor};
use crate::poly::Polynomial;
use crate::problem::{Problem, Solver};

/// What surrounds the exact gradient in a step. None of it changes the map, only its cost: the
/// solve goes on until rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// How a step solves for p.
    pub solver: Solver,
    /// The degree in h of the predictor.
    pub predictor_degree: usize,
    /// The Hessian is taken of S₁ … S_k for k up to this; of no meaning for the fixed point.
    pub hessian_truncation: usize,
}

impl Plan {
    /// The predictor degree with which one Newton step reaches rounding for h|Ω| up to about one;
    /// measured on the free body: 8 for K = 7, 10 for K = 11 and 13, 12 for K = 17.
    fn single_step_degree(truncation: usize) -> usize {
        let even = (4 + truncation / 2).div_ceil(2) * 2;
        even.min(truncation + 1)
    }

    /// Newton steps until the error is of the order in h that one step from the ideal predictor
    /// reaches. A step takes an error of order e to 2e + 1, or to e + k + 2 if the Hessian leaves
    /// out S_{k+2} and higher.
    fn newton_steps(self, truncation: usize) -> usize {
        let goal = 2 * Self::single_step_degree(truncation) + 2;
        let linear = self.hessian_truncation + 2;
        let mut order = self.predictor_degree + 1;
        let mut steps = 0;
        while steps == 0 || order < goal {
            let quadratic = 2 * order + 1;
            order = if self.hessian_truncation < truncation {
                quadratic.min(order + linear)
            } else {
                quadratic
            };
            steps += 1;
        }
        steps
    }

    /// The plan whose predictor and Newton steps together take fewest operations, by the number
    /// of monomials, with its predictor: `[order in h][component]`. `terms` are those of S.
    ///
    /// # Errors
    /// [`DeriveError`] if not even the constant predictor can be derived.
    pub fn choose(
        problem: &Problem,
        terms: &[BaseTerm],
        limit: TermLimit,
    ) -> Result<(Self, Vec<Vec<Polynomial>>), DeriveError> {
        let solver = problem.solver();
        if solver == Solver::FixedPoint {
            return Self::matrix_free(problem, terms, limit);
        }
        let truncation = problem.truncation;
        let n = problem.algebra.dim();
        // Chart, Jacobian 1 − D·Hess S, elimination; and the wait for one result before the next
        // can begin, in which about 300 independent operations would fit (measured on SO(3)).
        let overhead = 300 + 2 * n.pow(3) + 2 * n.pow(3) / 3 + 10 * n * n;
        let hessians: Vec<(usize, usize)> = (1..=truncation)
            .step_by(2)
            .map(|k| (k, overhead + gradient_operations(terms) + hessian_operations(terms, k)))
            .collect();
        let cheapest = |predictor_degree, own: usize| {
            let plans = hessians.iter().map(|&(hessian_truncation, newton)| {
                let plan = Self { solver, predictor_degree, hessian_truncation };
                (own + plan.newton_steps(truncation) * newton, plan)
            });
            // Of equal costs the better Hessian, which comes last.
            plans.reduce(|best, next| if next.0 <= best.0 { next } else { best })
        };
        let mut best: Option<(usize, Self, Vec<Vec<Polynomial>>)> = None;
        for degree in (0..=Self::single_step_degree(truncation)).step_by(2) {
            let Problem { algebra, chart, hamiltonian, .. } = problem;
            let polynomials = match predictor(algebra, *chart, hamiltonian, degree, limit) {
                Ok(polynomials) => polynomials,
                Err(DeriveError::TooLarge { .. } | DeriveError::TooMuchWork { .. })
                    if best.is_some() =>
                {
                    break;
                }
                Err(error) => return Err(error),
            };
            let own = predictor_operations(&polynomials, n);
            let Some((cost, plan)) = cheapest(degree, own) else { break };
            match &best {
                Some((least, ..)) if own > *least => break,
                Some((least, ..)) if cost >= *least => {}
                _ => best = Some((cost, plan, polynomials)),
            }
        }
        let constant = Self { solver, predictor_degree: 0, hessian_truncation: truncation };
        Ok(best
            .map_or_else(|| (constant, Vec::new()), |(_, plan, polynomials)| (plan, polynomials)))
    }

    /// The plan for the fixed point. Each evaluation gains about an order in h, and so does each
    /// degree of the predictor, whose terms multiply with every degree: on a spin chain degree 2
    /// has as many as the gradient of S₁ + S₃, degree 4 has sixty times more.
    fn matrix_free(
        problem: &Problem,
        terms: &[BaseTerm],
        limit: TermLimit,
    ) -> Result<(Self, Vec<Vec<Polynomial>>), DeriveError> {
        let Problem { algebra, chart, hamiltonian, truncation, .. } = problem;
        let n = algebra.dim();
        let evaluation = gradient_operations(terms) + CHART_OPERATIONS * n;
        let mut best: Option<(usize, Self, Vec<Vec<Polynomial>>)> = None;
        for degree in 0..=HIGHEST_CHEAP_DEGREE {
            let polynomials = match predictor(algebra, *chart, hamiltonian, degree, limit) {
                Ok(polynomials) => polynomials,
                Err(DeriveError::TooLarge { .. } | DeriveError::TooMuchWork { .. })
                    if best.is_some() =>
                {
                    break;
                }
                Err(error) => return Err(error),
            };
            let plan = Self {
                solver: Solver::FixedPoint,
                predictor_degree: degree,
                hessian_truncation: *truncation,
            };
            let evaluations = EVALUATIONS - degree;
            let cost = predictor_operations(&polynomials, n) + evaluations * evaluation;
            if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                best = Some((cost, plan, polynomials));
            }
        }
        let constant = Self {
            solver: Solver::FixedPoint,
            predictor_degree: 0,
            hessian_truncation: *truncation,
        };
        Ok(best
            .map_or_else(|| (constant, Vec::new()), |(_, plan, polynomials)| (plan, polynomials)))
    }
}

/// Operations of a chart for each coordinate: exp and its derivative on SO(3), by measurement.
const CHART_OPERATIONS: usize = 30;
/// The degree up to which predictors of large systems are tried.
const HIGHEST_CHEAP_DEGREE: usize = 2;
/// Evaluations of the fixed point from the constant predictor to rounding, at h|Ω| of about 0.1.
const EVALUATIONS: usize = 10;

/// About two operations for each monomial of each component.
fn predictor_operations(predictor: &[Vec<Polynomial>], dim: usize) -> usize {
    let monomials = |component: usize| {
        let orders = predictor.iter().filter_map(|order| order.get(component));
        let momenta = orders.flat_map(Polynomial::factors).map(|(mut factors, _)| {
            factors.retain(|&(variable, _)| (variable as usize) < dim);
            factors
        });
        momenta.collect::<BTreeSet<_>>().len()
    };
    2 * (0..dim).map(monomials).sum::<usize>()
}

/// About one and a half operations for each monomial of each entry, since entries share powers.
fn gradient_operations(terms: &[BaseTerm]) -> usize {
    terms.iter().map(|term| term.factors.len()).sum::<usize>() * 3 / 2
}

/// The same for the upper triangle of the Hessian of the terms up to `truncation`.
fn hessian_operations(terms: &[BaseTerm], truncation: usize) -> usize {
    let entries = |term: &BaseTerm| {
        let present = term.factors.len();
        let bent = term.factors.iter().filter(|&&(_, e)| e > 2).count();
        present * present.saturating_sub(1) / 2 + bent
    };
    let kept = terms.iter().filter(|term| term.order as usize <= truncation);
    kept.map(entries).sum::<usize>() * 3 / 2
}
