//! One builder for every front end: a problem becomes an integrator, ready for any back end.

mod coefficients;
mod flow;
mod fold;
mod kick;
mod lower;
mod plan;

pub use coefficients::{Coefficients, Contribution};
pub use fold::FoldTable;
pub use kick::{Kick, Kicks};
pub(crate) use lower::DefectTerm;
pub(crate) use plan::{Guesses, operations};
pub use plan::{Plan, Predictor};

use std::sync::OnceLock;

use crate::comoving::Frame;
use crate::graph::Program;
use crate::hamilton_jacobi::{self, DeriveError, GeneratingSeries, TermLimit};
use crate::problem::{Problem, Solver};

/// [`Integrator::largest_rate`] of K = 1, 3, 5.
const LARGEST_RATES: [f64; 3] = [0.95, 1.9, 3.0];

/// Terms of S₃ that are derived to learn whether it vanishes, where K = 1.
const TERMS_OF_THIRD: usize = 1000;

/// Everything a back end needs to write or run a step: exact coefficients and straight-line
/// programs over them.
///
/// Programs read momenta as inputs and folded coefficients as slots.
#[derive(Clone, Debug)]
pub struct Integrator {
    /// The system.
    pub problem: Problem,
    /// S₁ … S_K.
    pub series: GeneratingSeries,
    /// Predictor degree and Hessian truncation, and why.
    pub plan: Plan,
    /// The coefficients C_m(h, parameters).
    pub coefficients: Coefficients,
    /// p ↦ S(p).
    pub value: Program,
    /// p ↦ ∂S/∂p.
    pub gradient: Program,
    /// p ↦ ∂S/∂p, then the upper triangle of the Hessian row by row; `None` for the fixed point,
    /// which needs none.
    pub hessian: Option<Program>,
    /// As `hessian`, with the Hessian truncated as the plan says; `None` where that changes
    /// nothing.
    pub newton: Option<Program>,
    /// Bounds what `newton` leaves out of the Hessian.
    pub(crate) defect: Vec<DefectTerm>,
    /// μ′ ↦ a first guess of p, or of x, as [`Plan::predictor`] says.
    pub predictor: Program,
    /// μ ↦ H_red(μ).
    pub energy: Program,
    /// μ ↦ y for each part of the comoving frame's motion: exp y follows the map of S.
    pub frame: Vec<Program>,
    /// The kicks of a potential between flows.
    pub kicks: Option<Kicks>,
    /// The largest rate at which motions may part in a step, where the ratio of the last terms of the series tells too
    /// little: with Z = ad_xᵀ + 2 ∂p/∂x·Hess S, to first order h times the derivative of μ̇ = ad\*_{∂H/∂μ} μ, the rate is
    /// √(maxᵢ Σⱼ |ZᵢⱼZⱼᵢ|). Found by experiments (`docs/measurements/acceptance.md`). None where S₁ is the whole series, and
    /// for learned maps.
    pub largest_rate: Option<f64>,
    /// [`Problem::units`].
    pub units: Vec<f64>,
    /// The result of [`Self::fold_table`], kept.
    table: OnceLock<FoldTable>,
    /// The result of [`Self::factors`], kept.
    factors: OnceLock<Vec<u32>>,
}

impl Integrator {
    /// The direct factor of the group that each coordinate belongs to; found once.
    pub fn factors(&self) -> &[u32] {
        self.factors.get_or_init(|| self.problem.algebra.factor_of_coordinates())
    }

    /// All coefficients, as [`FoldTable::new`] orders them; made once.
    pub fn fold_table(&self) -> &FoldTable {
        self.table.get_or_init(|| FoldTable::new(self))
    }

    /// Derives the series and lowers it.
    ///
    /// # Errors
    /// [`DeriveError`] where the series cannot be derived or is too large.
    pub fn build(problem: Problem, limit: TermLimit) -> Result<Self, DeriveError> {
        let series = hamilton_jacobi::derive(
            &problem.algebra,
            problem.chart,
            problem.generated(),
            problem.truncation,
            limit,
        )?;
        Self::with_plan(problem, series, None, limit)
    }

    /// Lowers a derived series; with `plan` given, uses its predictor degree and Hessian
    /// truncation, whatever they cost.
    ///
    /// # Errors
    /// [`DeriveError`] where the predictor cannot be derived or is too large.
    pub fn with_plan(
        problem: Problem,
        series: GeneratingSeries,
        plan: Option<Plan>,
        limit: TermLimit,
    ) -> Result<Self, DeriveError> {
        let dim = problem.algebra.dim();
        let mut coefficients = Coefficients::default();
        let orders = (1..=problem.truncation).map(|k| (k as u32, series.order(k)));
        let s = lower::collect(&mut coefficients, dim, orders);
        coefficients.end_series(&s);
        let h = lower::collect(&mut coefficients, dim, [(0, &problem.hamiltonian)]);

        let table = &mut coefficients;
        let truncation = problem.truncation as u32;
        let solver = plan.map_or_else(|| problem.solver(), |plan| plan.solver);
        let gradient = (solver == Solver::Newton).then(|| lower::Gradient::new(table, dim, &s));
        let hessian = gradient.as_ref().map(|gradient| gradient.with_hessian(table, truncation));
        let (plan, polynomials) = match plan {
            Some(plan) => {
                let Problem { algebra, chart, .. } = &problem;
                let hamiltonian = problem.generated();
                let polynomials = match plan.predictor {
                    Predictor::Explicit(degree) => {
                        hamilton_jacobi::predictor(algebra, *chart, hamiltonian, degree, limit)?
                    }
                    Predictor::Flow(_) => Vec::new(),
                };
                (plan, polynomials)
            }
            None => Plan::choose(&problem, &s, limit)?,
        };
        let kept = plan.hessian_truncation as u32;
        let truncated = gradient.as_ref().filter(|_| kept < truncation);
        let newton = truncated.map(|gradient| gradient.with_hessian(table, kept));
        let newton = newton.filter(|program| hessian.as_ref() != Some(program));
        let units = problem.units();
        let defect = lower::defect(table, &s, kept, &units);
        let predictor = match plan.predictor {
            Predictor::Flow(degree) => flow::increment_program(table, &problem, degree),
            Predictor::Explicit(_) => {
                let components: Vec<_> = (0..dim)
                    .map(|i| {
                        let orders = polynomials.iter().enumerate().map(|(m, p)| (m as u32, &p[i]));
                        lower::collect(table, dim, orders)
                    })
                    .collect();
                lower::vector_program(table, dim, &components)
            }
        };
        let largest_rate = match problem.truncation {
            1 => Some(LARGEST_RATES[0]),
            3 => Some(LARGEST_RATES[1]),
            5 => Some(LARGEST_RATES[2]),
            _ => None,
        };
        let is_series = || !problem.learned && !is_first_whole(&problem, table);
        let largest_rate = largest_rate.filter(|_| is_series());
        let gradient = gradient.unwrap_or_else(|| lower::Gradient::new(table, dim, &s)).program();
        let value = lower::value_program(table, dim, &s);
        let energy = lower::value_program(table, dim, &h);
        let frame = problem.comoving.iter().flat_map(Frame::parts);
        let frame = frame
            .map(|part| {
                let rates = part.gradient(dim);
                let components: Vec<_> =
                    rates.iter().map(|rate| lower::collect(table, dim, [(1, rate)])).collect();
                lower::vector_program(table, dim, &components)
            })
            .collect();
        Ok(Self {
            problem,
            series,
            plan,
            coefficients,
            value,
            gradient,
            hessian,
            newton,
            defect,
            predictor,
            energy,
            frame,
            kicks: None,
            largest_rate,
            units,
            table: OnceLock::new(),
            factors: OnceLock::new(),
        })
    }

    /// The number of terms of S₁ + … + S_K.
    pub fn terms(&self) -> usize {
        (1..=self.problem.truncation).map(|k| self.series.order(k).len()).sum()
    }

    /// The program an iteration of the solver runs: gradient and Hessian, or the gradient alone.
    pub(crate) fn iteration(&self) -> &Program {
        self.newton.as_ref().or(self.hessian.as_ref()).unwrap_or(&self.gradient)
    }

    /// The number of coefficients of the bound of [`Integrator::defect`]: its degree plus one.
    pub(crate) fn defect_len(&self) -> usize {
        self.defect.iter().map(|term| term.degree as usize + 1).max().unwrap_or(0)
    }

    /// The order of accuracy, K + 1: the method is symmetric and even terms vanish.
    pub fn order(&self) -> usize {
        self.problem.truncation + 1
    }
}

/// True if S₃ … S_K vanish, or S₃ for K = 1.
fn is_first_whole(problem: &Problem, coefficients: &Coefficients) -> bool {
    if problem.truncation > 1 {
        return coefficients.beyond_first().is_empty();
    }
    let limit = TermLimit::new(TERMS_OF_THIRD);
    let Problem { algebra, chart, .. } = problem;
    hamilton_jacobi::derive(algebra, *chart, problem.generated(), 3, limit)
        .is_ok_and(|series| series.order(3).is_zero())
}
