//! Choosing the predictor and the Hessian's truncation.

use std::collections::HashSet;

use super::coefficients::{BaseTerm, Coefficients};
use super::flow;
use crate::hamilton_jacobi::{DeriveError, GeneratingSeries, PredictorRows, TermLimit};
use crate::integrator::lower::collect;
use crate::lie::Chart;
use crate::poly::{Arithmetic, Factors, Polynomial, split_at};
use crate::problem::{Problem, Solver};

/// The first guess of p in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predictor {
    /// Polynomials of μ′ for the coordinates of p, up to this degree in h.
    Explicit(usize),
    /// x along the exact flow up to this degree in h, four, six or eight, and p = (d^R τ_x)ᵀ μ′; for the
    /// exponential chart.
    Flow(usize),
}

impl Predictor {
    /// The degree in h up to which the guess is exact.
    pub(crate) fn degree(self) -> usize {
        match self {
            Self::Explicit(degree) | Self::Flow(degree) => degree,
        }
    }
}

/// The choices around the exact gradient in a step. None of them changes the map, only its cost: the
/// solve goes on until rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The solver for p.
    pub solver: Solver,
    /// The first guess.
    pub predictor: Predictor,
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

    /// Chord steps after the first, Newton's, until the error is of the order in h that is `goal`. With
    /// the predictor's error of order e, every step gains e + 1 orders, or k + 2 if the Hessian leaves
    /// out S_{k+2} and higher and that is less.
    fn chord_steps(self, truncation: usize, goal: usize) -> usize {
        let start = self.predictor.degree() + 1;
        let complete = self.hessian_truncation >= truncation;
        let gain = if complete { start + 1 } else { (start + 1).min(self.hessian_truncation + 2) };
        goal.saturating_sub(start).div_ceil(gain).saturating_sub(1)
    }

    /// The expected number of chord steps after the first step, which is Newton's.
    pub(crate) fn chords(self, problem: &Problem) -> usize {
        let degree = Self::single_step_degree(problem.truncation);
        let goal = if corrects_dearly(problem) { degree + 5 } else { 2 * degree + 2 };
        self.chord_steps(problem.truncation, goal)
    }

    /// The plan whose predictor, Newton step and chord steps take fewest operations, by the number
    /// of monomials; and the polynomials of an explicit predictor, `[order in h][component]`.
    /// `terms` are those of S.
    ///
    /// # Errors
    /// [`DeriveError`] if not even the constant predictor can be derived.
    pub(crate) fn choose(
        problem: &Problem,
        terms: &[BaseTerm],
        limit: TermLimit,
    ) -> Result<(Self, Vec<Vec<Polynomial>>), DeriveError> {
        let mut guesses = Guesses::new(problem, limit)?;
        let (_, plan) = Self::cheapest(problem, terms, &mut guesses)?;
        let mut polynomials = guesses.known;
        match plan.predictor {
            Predictor::Explicit(degree) => polynomials.truncate(degree + 1),
            Predictor::Flow(_) => polynomials.clear(),
        }
        Ok((plan, polynomials))
    }

    /// About the operations of a step of the series S₁ … S_K, K the problem's truncation, with the
    /// cheapest plan.
    ///
    /// # Errors
    /// As [`Plan::choose`].
    pub(crate) fn operations(
        problem: &Problem,
        series: &GeneratingSeries,
        guesses: &mut Guesses<'_>,
    ) -> Result<usize, DeriveError> {
        let dim = problem.algebra.dim();
        let orders = (1..=problem.truncation).map(|k| (k as u32, series.order(k)));
        let terms = collect(&mut Coefficients::default(), dim, orders);
        Ok(Self::cheapest(problem, &terms, guesses)?.0)
    }

    /// The cheapest plan with the operations of a step. Explicit predictors are tried as long as no other plan is cheaper, and
    /// they take no more than [`MOST_PRODUCTS`].
    fn cheapest(
        problem: &Problem,
        terms: &[BaseTerm],
        guesses: &mut Guesses<'_>,
    ) -> Result<(usize, Self), DeriveError> {
        let highest = Self::single_step_degree(problem.truncation);
        let newton = problem.solver() == Solver::Newton;
        let costs = Costs::new(problem, terms);
        let mut found: Vec<(usize, Self)> = Vec::new();
        if guesses.along_flow {
            let possible = flow::DEGREES.iter().filter(|&&degree| degree <= highest).count();
            let degrees = &flow::DEGREES[..possible];
            // If a correction is dear, the best guess available pays.
            let first = if corrects_dearly(problem) { possible.saturating_sub(1) } else { 0 };
            for &degree in &degrees[first..] {
                // From x to p the chart is evaluated once more.
                let own = guesses.flow(degree) + WAIT;
                found.extend(costs.cheapest(Predictor::Flow(degree), own));
            }
        }
        let mut least = found.iter().map(|&(cost, _)| cost).min().unwrap_or(usize::MAX);
        let last = if newton { highest } else { HIGHEST_CHEAP_DEGREE };
        let (mut monomials, mut data) = (HashSet::new(), 0);
        let mut explicit: Vec<(usize, Self)> = Vec::new();
        let tried = if corrects_dearly(problem) && !found.is_empty() { 0 } else { last + 1 };
        for degree in 0..tried {
            let Some(row) = guesses.row(degree)? else { break };
            for (i, component) in row.iter().enumerate() {
                let factors = component.factors();
                let dim = problem.algebra.dim();
                let momenta = |f: &[(u32, u32)]| Factors(split_at(f, dim).0.into());
                monomials.extend(factors.map(|(factors, _)| (i, momenta(&factors))));
            }
            data += row.iter().map(Polynomial::len).sum::<usize>();
            if !found.is_empty() && data > MOST_DATA * monomials.len() {
                break;
            }
            // About two operations for each monomial. They only grow with the degree.
            let own = 2 * monomials.len();
            if own > least {
                break;
            }
            // From the constant guess Newton's method is near enough to be accepted only where steps are short.
            let possible = !newton || degree == 1 || degree > 0 && degree % 2 == 0;
            if possible {
                let plan = costs.cheapest(Predictor::Explicit(degree), own);
                explicit.extend(plan);
                least = plan.map_or(least, |(cost, _)| cost.min(least));
            }
        }
        // Of equal costs the explicit predictor's comes first.
        let best = explicit.into_iter().chain(found).min_by_key(|&(cost, _)| cost);
        let constant = || Self {
            solver: problem.solver(),
            predictor: Predictor::Explicit(0),
            hessian_truncation: problem.truncation,
        };
        let (cost, plan) = best.unwrap_or_else(|| (usize::MAX, constant()));
        Ok((cost, plan))
    }
}

/// The first guesses of a problem, which do not depend on the truncation; each is made once.
pub(crate) struct Guesses<'a> {
    problem: &'a Problem,
    /// True if guesses along the flow are possible.
    along_flow: bool,
    /// Degrees of guesses along the flow, and their operations.
    flows: Vec<(usize, usize)>,
    /// The next polynomials of explicit guesses, until there are too many.
    rows: Option<PredictorRows<'a>>,
    /// Polynomials, `[order in h][component]`.
    known: Vec<Vec<Polynomial>>,
}

impl<'a> Guesses<'a> {
    /// # Errors
    /// [`DeriveError`] if not even the constant predictor can be derived.
    pub(crate) fn new(problem: &'a Problem, limit: TermLimit) -> Result<Self, DeriveError> {
        let Problem { algebra, chart, .. } = problem;
        let along_flow = problem.solver() == Solver::Newton && *chart == Chart::Exponential;
        let most = match algebra.dim() {
            dim if dim > SMALL && along_flow => limit.products.min(MOST_PRODUCTS),
            _ => limit.products,
        };
        let limit = TermLimit { products: most, ..limit };
        let (chart, generated) = (*chart, problem.generated());
        let rows = PredictorRows::new(algebra, chart, generated, limit, Arithmetic::Rounded)?;
        let (flows, known, rows) = (Vec::new(), Vec::new(), Some(rows));
        Ok(Self { problem, along_flow, flows, rows, known })
    }

    /// The operations of the guess along the flow of this degree.
    fn flow(&mut self, degree: usize) -> usize {
        if let Some((_, known)) = self.flows.iter().find(|(own, _)| *own == degree) {
            return *known;
        }
        let program = flow::increment_program(&mut Coefficients::default(), self.problem, degree);
        self.flows.push((degree, program.cost().total()));
        program.cost().total()
    }

    /// The polynomials of this degree in h, after those of all lower ones; none if they are too large.
    fn row(&mut self, degree: usize) -> Result<Option<&[Polynomial]>, DeriveError> {
        while self.known.len() <= degree {
            let Some(rows) = &mut self.rows else { return Ok(None) };
            match rows.next_row() {
                Ok(row) => self.known.push(row),
                Err(error) if degree > 0 && error.is_of_size() => self.rows = None,
                Err(error) => return Err(error),
            }
        }
        Ok(self.known.get(degree).map(Vec::as_slice))
    }
}

/// The largest dimension in which explicit predictors have few monomials.
const SMALL: usize = 3;
/// Products of coefficients at most in looking for an explicit predictor beside one along the flow in more dimensions: where
/// it takes more, it has too many monomials to be worth it.
const MOST_PRODUCTS: u64 = 5_000_000;

/// The most terms in symbols that a monomial of an explicit predictor has on average, where there is one along the flow: more
/// take longer to derive, to compile and to fold than the series itself.
const MOST_DATA: usize = 32;

/// The number of independent operations that fit into the time in which a chart or a small linear system waits for its own
/// results (measured on SO(3)).
const WAIT: usize = 300;

/// True if most of a step goes into its corrections: in more than [`SMALL`] dimensions and for long series. The Hessian is
/// then taken of the first terms alone.
fn corrects_dearly(problem: &Problem) -> bool {
    problem.solver() == Solver::Newton && problem.algebra.dim() > SMALL && problem.truncation >= 7
}

/// Such a Hessian is that of S₁ + S₃ + S₅.
const COARSE: usize = 5;
/// Corrections of x for one gradient, measured on SE(3).
const CORRECTIONS: usize = 3;

/// The cost of steps, in operations.
struct Costs {
    solver: Solver,
    truncation: usize,
    /// The order in h that the error is to reach.
    goal: usize,
    /// A chord step: gradient, chart, substitution; for the fixed point an evaluation.
    chord: usize,
    /// The first step, for each truncation of the Hessian: also its entries, the Jacobian
    /// 1 − D·Hess S, and elimination.
    newton: Vec<(usize, usize)>,
}

impl Costs {
    fn new(problem: &Problem, terms: &[BaseTerm]) -> Self {
        let n = problem.algebra.dim();
        let (solver, truncation) = (problem.solver(), problem.truncation);
        let degree = Plan::single_step_degree(truncation);
        if solver == Solver::FixedPoint {
            let evaluation = gradient_operations(terms) + CHART_OPERATIONS * n;
            return Self { solver, truncation, goal: 0, chord: evaluation, newton: Vec::new() };
        }
        if corrects_dearly(problem) {
            let coarse: Vec<_> =
                terms.iter().filter(|term| term.order as usize <= COARSE).cloned().collect();
            let corrections = CORRECTIONS * (WAIT + gradient_operations(&coarse));
            let step = corrections + gradient_operations(terms);
            let newton = vec![(COARSE, step)];
            return Self { solver, truncation, goal: degree + 5, chord: step, newton };
        }
        let goal = 2 * degree + 2;
        let chord = WAIT + 10 * n * n + gradient_operations(terms);
        let matrices = 2 * n.pow(3) + 2 * n.pow(3) / 3;
        let newton = (1..=truncation)
            .step_by(2)
            .map(|k| (k, matrices + chord + hessian_operations(terms, k)))
            .collect();
        Self { solver, truncation, goal, chord, newton }
    }

    /// The cheapest plan with a given predictor, which takes `own` operations.
    fn cheapest(&self, predictor: Predictor, own: usize) -> Option<(usize, Plan)> {
        let Self { solver, truncation, .. } = *self;
        if solver == Solver::FixedPoint {
            // Each evaluation gains about an order in h, and so does each degree of the predictor, whose terms
            // multiply with every degree: on a spin chain degree 2 has as many as the gradient of S₁ + S₃,
            // degree 4 has sixty times more.
            let evaluations = EVALUATIONS - predictor.degree();
            let plan = Plan { solver, predictor, hessian_truncation: truncation };
            return Some((own + evaluations * self.chord, plan));
        }
        let plans = self.newton.iter().map(|&(hessian_truncation, newton)| {
            let plan = Plan { solver, predictor, hessian_truncation };
            (own + newton + plan.chord_steps(truncation, self.goal) * self.chord, plan)
        });
        // Of equal costs the better Hessian, which comes last.
        plans.reduce(|best, next| if next.0 <= best.0 { next } else { best })
    }
}

/// Operations of a chart for each coordinate: exp and its derivative on SO(3), by measurement.
const CHART_OPERATIONS: usize = 30;
/// The degree up to which predictors of large systems are tried.
const HIGHEST_CHEAP_DEGREE: usize = 2;
/// Evaluations of the fixed point from the constant predictor to rounding, at h|Ω| of about 0.1.
const EVALUATIONS: usize = 10;

/// About the operations of ∂S and Hess S.
pub(crate) fn operations(dim: usize, truncation: usize, series: &GeneratingSeries) -> usize {
    let orders = (1..=truncation).map(|k| (k as u32, series.order(k)));
    let terms = collect(&mut Coefficients::default(), dim, orders);
    gradient_operations(&terms) + hessian_operations(&terms, truncation)
}

/// About one and a half operations for each monomial of each entry, since entries share powers.
fn gradient_operations(terms: &[BaseTerm]) -> usize {
    terms.iter().map(|term| term.factors.len()).sum::<usize>() * 3 / 2
}

/// Operations of the upper triangle of the Hessian of the terms up to `truncation`.
fn hessian_operations(terms: &[BaseTerm], truncation: usize) -> usize {
    let entries = |term: &BaseTerm| {
        let present = term.factors.len();
        let bent = term.factors.iter().filter(|&&(_, e)| e > 2).count();
        present * present.saturating_sub(1) / 2 + bent
    };
    let kept = terms.iter().filter(|term| term.order as usize <= truncation);
    kept.map(entries).sum::<usize>() * 3 / 2
}
